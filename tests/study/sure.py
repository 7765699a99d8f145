# SPDX-License-Identifier: MIT
"""sure.py ADAPTIVE FOLDER [PROBLEM ...] - the bound of the error of examples/adaptive.c and its sources (--shares), two runs
at a time, with varied starts and rates: those of CERTIFY, numbers for --vary, of which a second one or more also asks whether
steps in four name the same source.  Table to the screen and to FOLDER/one-number-sure.md; fails where it is not what
tests/study/README.md promises."""
import os
import statistics
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

program, folder = sys.argv[1:3]
digits = range(2, 9)
variations = os.environ.get("CERTIFY", "11").split()
sources = ("steps", "waves", "iteration", "events")


def certify(problem, digit, vary, parts):
    """The printed numbers of one run with its bound and its shares; None: it said why there is none."""
    command = [program, "--problem", problem, "--accuracy", "1e-%d" % digit, "--vary", vary, "--shares", "--parts", parts]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return None
    lines = [line.split() for line in done.stdout.splitlines() if not line.startswith("limit")]
    return {line[0]: float(line[1]) for line in lines}


def shares(keys):
    return [keys["from_" + source] for source in sources]


def largest(keys):
    return max(range(len(sources)), key=shares(keys).__getitem__)


def at(values, part):
    return sorted(values)[min(len(values) - 1, int(part * len(values)))]


def certificate_rows(runs):
    """By problem and for all: (name, cells, in how many the bound holds, bound over error, runs, runs with shares)."""
    for name in list(dict.fromkeys(key[0] for key in runs)) + ["all"]:
        some = [keys for key, keys in runs.items() if name in (key[0], "all")]
        over = [keys["bound"] / keys["error"] if keys else 0 for keys in some]
        yield (name, len(some), sum(x >= 1 for x in over), over, [k["runs"] for k in some if k], [k["runs_with_shares"] for k in some if k])


def certificate(runs, finer):
    """The table, the sentence on the largest source, and whether all of it is what the documents promise."""
    lines = ["| problem | cells | the bound holds in | bound over error: least, median, 90 %, most | runs: median, most | with shares: median, most |",
             "|" + "---|" * 6]
    fits = True
    for name, cells, holds, over, one, both in certificate_rows(runs):
        lines.append("| %s | %d | %d | %.2f, %.2f, %.2f, %.2f | %.2f, %.2f | %.2f, %.2f |" % (
            name, cells, holds, min(over), statistics.median(over), at(over, 0.9), max(over), statistics.median(one), max(one),
            statistics.median(both), max(both)))
        if name == "all":
            fits = (holds >= 0.99 * cells and statistics.median(over) <= 1.6 and at(over, 0.9) <= 2
                    and statistics.median(one) <= 2.5 and statistics.median(both) <= 4.5)
    both = [(keys, finer[key]) for key, keys in runs.items() if keys and finer.get(key)]
    if both:
        same = [largest(a) == largest(b) for a, b in both]
        clear = [ok for ok, (_, b) in zip(same, both) if max(shares(b)) > 2 * sorted(shares(b))[-2]]
        lines += ["", "The largest source is the one that steps in four and a tolerance of 1/100 name in %d of %d cells; in %d of the %d where it is"
                  % (sum(same), len(same), sum(clear), len(clear)), "twice every other."]
        fits = fits and sum(same) >= 0.95 * len(same)
    return lines, fits


def tenth(runs):
    """What a tenth of the accuracy costs and leaves, of all cells that have such a neighbour."""
    pairs = [(keys, runs[p, d + 1, v]) for (p, d, v), keys in runs.items() if keys and runs.get((p, d + 1, v))]
    work = [b["evaluations"] / a["evaluations"] for a, b in pairs]
    left = [b["error"] / a["error"] for a, b in pairs]
    return ["", "A tenth of the accuracy takes %.2f times the work (median; 90 %%: %.2f) and leaves %.2f of the error (90 %%: %.2f, most %.2f)."
            % (statistics.median(work), at(work, 0.9), statistics.median(left), at(left, 0.9), max(left))]


def main():
    problems = sys.argv[3:] or "masses duffing pol stiff heat load damped switch relay rates tube".split()
    cells = [(p, d, v) for p in problems for d in digits for v in variations]
    with ThreadPoolExecutor(int(os.environ.get("JOBS", "2"))) as pool:
        runs = dict(zip(cells, pool.map(lambda key: certify(*key, "2"), cells)))
        finer = dict(zip(cells, pool.map(lambda key: certify(*key, "4"), cells))) if len(variations) > 1 else {}
    lines, fits = certificate(runs, finer)
    lines += tenth(runs)
    for key, keys in runs.items():
        if not keys or keys["bound"] < keys["error"]:
            lines.append("%s 1e-%d, variation %s: %s" % (*key, "bound %g, error %g" % (keys["bound"], keys["error"]) if keys else "no bound"))
    with open(os.path.join(folder, "one-number-sure.md"), "w") as f:
        f.write("\n".join(lines) + "\n")
    print("\n".join(lines))
    sys.exit(not fits)


main()
