# SPDX-License-Identifier: MIT
"""one_number.py ADAPTIVE [PROBLEM ...] - the runs of ADAPTIVE that take one number, JOBS at a time, into the rows "run" of
tests/study/one-number.txt, and beside the best fixed set-ups there: problem x accuracy to the screen.  Fails where a run fails
or its error is above the accuracy."""
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import card

program = sys.argv[1]


def run(problem, digit):
    """A row: error and evaluations, or why there are none."""
    done = subprocess.run([program, "--problem", problem, "--accuracy", "1e-%d" % digit], capture_output=True, text=True, check=False)
    row = "run,%s,1e-%02d," % (problem, digit)
    if done.returncode != 0:
        return row + re.sub("[,\n]", ";", done.stderr.strip().splitlines()[-1])
    keys = dict(line.split(maxsplit=1) for line in done.stdout.splitlines())
    return row + "%s,%s" % (keys["error"], keys["evaluations"])


def main():
    problems = sys.argv[2:] or card.stored()["problems"]
    with ThreadPoolExecutor(int(os.environ.get("JOBS", "2"))) as pool:
        rows = list(pool.map(lambda cell: run(*cell), [(p, d) for p in problems for d in card.digits]))
    with open(card.fixed) as f:
        others = [line for line in f.read().splitlines() if not line.startswith(tuple("run,%s," % p for p in problems))]
    card.write(card.fixed, others + rows)
    print("error over the accuracy, work over that of the best fixed set-up:")
    print("\n".join(card.one_cells() + [""] + card.one_all()))
    sys.exit(any(not cell or cell[0] > 1 for (p, _), cell in card.cells().items() if p in problems))


main()
