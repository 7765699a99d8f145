# SPDX-License-Identifier: MIT
"""card.py [FOLDER] - the card examples/ACCURACY.md: its tables, which tests/scripts/figures.py writes into it, and its pictures,
which this program draws with gnuplot, by way of FOLDER (build/study/card), into examples/.  All of it from what make onenumber and
make converges have left in tests/study/one-number.txt and converges.txt."""
import csv
import hashlib
import math
import os
import re
import statistics
import subprocess
import sys

here = os.path.dirname(os.path.abspath(__file__))
examples = os.path.join(os.path.dirname(os.path.dirname(here)), "examples")
fixed = os.path.join(here, "one-number.txt")
digits = range(2, 11)
STIFF = ("stiff", "heat")  # a side of these has a solver of its own: it writes no slopes
STIFF_TABLE = {"rk4": "sdirk2", "dp5": "esdirk3", "verner6": "esdirk5", "dop853": "esdirk5"}
COARSEST = 1.001e-3  # tolerance: iqn.h asks for no coarser one, see IQN_TOL_RELATIVE there
TABLES = list(STIFF_TABLE)
EXCHANGES = ["ends", "older", "dense", "slopes"]  # the simple ones first: slopes need the derivative of what is sent


# ---- what is stored


def works(cells):
    """digit -> work, of a row that may end early; what was not reached is left out."""
    return {d: float(cell) for d, cell in zip(digits, cells) if cell != "-"}


def stored():
    """The rows of one-number.txt by their kinds."""
    found = {"problems": [], "best": {}, "under": {}, "class": {}, "run": {}}
    with open(fixed) as f:
        for kind, problem, *rest in csv.reader(f):
            if kind == "tried":
                found["problems"].append(problem)
            elif kind == "best":
                found["best"][problem, -int(rest[0].split("e")[1])] = {
                    "work": float(rest[1]), "degree": int(rest[6]), "exchange": rest[7], "tolerance": float(rest[8])}
            elif kind == "under":
                found["under"].setdefault(rest[0], {})[problem] = works(rest[1:])
            elif kind == "class":
                table, degree, exchange, tolerance = rest[:4]
                found["class"].setdefault((table, int(degree), exchange, float(tolerance)), {})[problem] = works(rest[4:])
            elif kind == "run":
                found["run"][problem, -int(rest[0].split("e")[1])] = {"error": float(rest[1]), "work": float(rest[2])} if len(rest) > 2 else None
    return found


def number(x):
    """Two digits, without an exponent."""
    return "%.0f" % x if x >= 9.95 else "%.1f" % x


def geometric(values):
    return math.exp(statistics.mean(math.log(v) for v in values))


# ---- the card: for each accuracy one set-up for all problems


def simplicity(key):
    table, degree, exchange, tolerance = key
    return degree, EXCHANGES.index(exchange), TABLES.index(table), -tolerance


def choice(found, problems, d, before):
    """Of all tables, degrees, exchanges and tolerances that of least work, in the geometric mean of the problems; windows and
    sub-steps are those that suit each problem.  The choice `before`, that of a digit less, stays where it costs at most a tenth more;
    of those within a twentieth of the least the simplest is taken.  A problem that needs more than twice its least work counts as
    three times.  Returns the choice and its work over the least of each problem."""
    reached = [p for p in problems if (p, d) in found["best"]]

    def over(key):
        return [found["class"][key].get(p, {}).get(d, math.inf) / found["best"][p, d]["work"] for p in reached]
    means = {key: geometric([min(x, 3) for x in over(key)]) for key in found["class"] if key[3] <= COARSEST}
    least = min(means.values())
    if before and means[before] <= 1.1 * least:
        return before, over(before)
    best = min((key for key in means if means[key] <= 1.05 * least), key=simplicity)
    return best, over(best)


CALLS = {"ends": "samples at step ends", "older": "`wf_advance(w, %d)`", "slopes": "`WF_SLOPE`", "dense": "`rk_dense` at 1/4, 1/2, 3/4"}


def exchange_call(key):
    return CALLS[key[2]] % (key[1] - 1) if key[2] == "older" else CALLS[key[2]]


def card():
    found = stored()
    best = found["best"]
    plain = [p for p in found["problems"] if p not in STIFF]
    key, stiff, body = None, None, []
    for d in digits:
        key, over = choice(found, plain, d, key)
        if any((p, d) in best for p in STIFF):
            stiff, _ = choice(found, STIFF, d, stiff)
            beside_stiff = "%d, %s, `%s`" % (stiff[1], exchange_call(stiff), STIFF_TABLE[stiff[0]])
        else:
            beside_stiff = "none found"
        reached = [best[p, d]["work"] / best[p, 2]["work"] for p in found["problems"] if (p, d) in best]
        within = [x for x in over if x < math.inf]
        lost = len(over) - len(within)
        body.append(["1e-%d" % d, "`wf_make(.., %d, ..)`, %s" % (key[1], exchange_call(key)), "`iqn_set(q, IQN_TOL_RELATIVE, %s)`" % power(key[3]),
                     '`rk_find("%s")`' % key[0], beside_stiff,
                     "1" if d == 2 else "%s (%s to %s), %d" % (number(statistics.median(reached)), number(min(reached)), number(max(reached)), len(reached)),
                     "%s (%s to %s)%s" % (number(statistics.median(over)), number(min(within)), number(max(within)), ", %d of %d above 2" % (lost, len(over)) if lost else "")])
    return markdown(["error", "data between the sides", "iteration", "time steps", "a stiff side: degree, data, table",
                     "work over that for 1e-2", "over the best of each problem"], body)


def blind():
    """The rows chosen without the problem that they are judged on."""
    found = stored()
    plain = [p for p in found["problems"] if p not in STIFF]

    def rows(problems):
        keys = [None]
        for d in digits:
            keys.append(choice(found, problems, d, keys[-1])[0])
        return dict(zip(digits, keys[1:]))
    every, same, over = rows(plain), 0, []
    for left_out in plain:
        for d, key in rows([p for p in plain if p != left_out]).items():
            if (left_out, d) in found["best"]:
                same += key == every[d]
                over.append(found["class"][key].get(left_out, {}).get(d, math.inf) / found["best"][left_out, d]["work"])
    return ["Chosen without the problem that it is judged on, the row is the same in %d of %d; its work over the best of that problem:" % (same, len(over)),
            "median %s, above 2 in %d." % (number(statistics.median(over)), sum(x == math.inf for x in over))]


def power(x):
    return re.sub(r"e-0*", "e-", "%.0e" % x)


def neighbours(found, d):
    """Work over that for one digit less, of the problems that reach both."""
    best = found["best"]
    return [best[p, d]["work"] / best[p, d - 1]["work"] for p in found["problems"] if (p, d) in best and (p, d - 1) in best]


def per_digit(found):
    return geometric([ratio for d in digits for ratio in neighbours(found, d)])


def facts():
    """What the best set-ups have in common."""
    found = stored()
    best = found["best"]
    fine = [b for (p, d), b in best.items() if d >= 5]
    told = sum(b["exchange"] in ("step ends + slopes", "3 within a step") for b in fine)
    cubic = {(p, d): found["under"]["degree 3"][p].get(d, math.inf) / b["work"] for (p, d), b in best.items()}
    coarse, at_8 = [x for (_, d), x in cubic.items() if d <= 7], [x for (_, d), x in cubic.items() if d == 8]
    early = sum(b["tolerance"] >= 99 * 10.0 ** -d for (p, d), b in best.items() if d >= 4)
    return ["- A digit more costs %.2g times the work (geometric mean of %d neighbours, %d problems)." % (
                per_digit(found), sum(len(neighbours(found, d)) for d in digits), len(found["problems"])),
            "- Degree 3 is enough down to 1e-7 (a tenth or more above the least work in %d of %d); at 1e-8 it takes %s times the least work, at most %s."
            % (sum(x >= 1.1 for x in coarse), len(coarse), number(statistics.median(at_8)), number(max(at_8))),
            "- At 1e-5 and below, %d of %d cheapest runs exchange slopes or values within a step." % (told, len(fine)),
            "- The iteration may stop early: at 1e-4 and below, %d of %d have a tolerance of 100 times the error or more." % (early, sum(d >= 4 for p, d in best))]


RESTRICTIONS = (
    ("degree 1", "degree 1 only, `wf_make(.., 1, ..)`"), ("degree 3", "degree 3 only"), ("degree 5 or more", "degree 5 or more"),
    ("step ends alone", "samples at step ends alone"), ("step ends and older samples", "these and older ones, `wf_advance`"),
    ("no slopes", "no slopes"), ("no values within a step", "no values within a step"),
    ("rk4; stiff sdirk2", "`rk4`; stiff `sdirk2`"), ("dp5; stiff esdirk3", "`dp5`; stiff `esdirk3`"),
    ("verner6; stiff esdirk5", "`verner6`; stiff `esdirk5`"), ("dop853; stiff esdirk5", "`dop853`; stiff `esdirk5`"),
    ("tolerance 1e-2", "`IQN_TOL_RELATIVE` 1e-2"), ("tolerance 1e-3 or less", "`IQN_TOL_RELATIVE` 1e-3 or less"),
    ("tolerance at most the error", "`IQN_TOL_RELATIVE` of the error or less"), ("one window", "one window"),
    ("one step in a window", "one step in a window"), ("8 steps in a window or more", "8 steps in a window or more"))
ON_THE_CARD = ("degree 1", "degree 3", "step ends alone", "step ends and older samples", "no slopes", "rk4; stiff sdirk2",
               "verner6; stiff esdirk5", "dop853; stiff esdirk5", "tolerance at most the error", "one window", "one step in a window")


def restricted(names=ON_THE_CARD, some=(2, 4, 6, 8)):
    """Work under a restriction over the least of all: median and largest of the problems."""
    found = stored()

    def cell(name, d):
        reached = [p for p in found["problems"] if (p, d) in found["best"]]
        over = [found["under"][name][p].get(d, math.inf) / found["best"][p, d]["work"] for p in reached]
        middle, lost = statistics.median(over), sum(x == math.inf for x in over)
        return "%s, %s" % (number(middle) if middle < math.inf else "-", "%d of %d not" % (lost, len(over)) if lost else number(max(over)))
    return markdown(["work: median, largest"] + ["error 1e-%d" % d for d in some],
                    [[text] + [cell(name, d) for d in some] for name, text in RESTRICTIONS if name in names])


def restricted_all():
    return restricted([name for name, _ in RESTRICTIONS], digits)


# ---- the run that takes one number


def cells():
    """(problem, digit) -> error over the accuracy, work over that of the best fixed set-up or None; None: the run failed."""
    found = stored()
    return {(p, d): run and (run["error"] * 10.0 ** d, run["work"] / found["best"][p, d]["work"] if (p, d) in found["best"] else None)
            for (p, d), run in found["run"].items()}


def one_cells():
    table = cells()
    problems = list(dict.fromkeys(p for p, _ in table))

    def text(cell):
        return "failed" if not cell else "%.2g, %s" % (cell[0], "%.2f" % cell[1] if cell[1] else "-")
    return markdown(["problem"] + ["1e-%d" % d for d in digits], [[p] + [text(table.get((p, d))) for d in digits] for p in problems])


def one_all():
    table = cells()
    errors = [cell[0] for cell in table.values() if cell]
    ratios = [cell[1] for cell in table.values() if cell and cell[1]]
    return ["Work over that of the best fixed set-up: median %.2f, largest %.2f, of %d cells; %d are above 1, %d above 3."
            % (statistics.median(ratios), max(ratios), len(ratios), sum(r > 1 for r in ratios), sum(r > 3 for r in ratios)),
            "Error over accuracy: median %.2g, largest %.2f, of %d cells; %d are above 1, %d below 1/30; %d runs failed."
            % (statistics.median(errors), max(errors), len(errors), sum(e > 1 for e in errors), sum(e < 1 / 30 for e in errors),
               len(table) - len(errors))]


def one():
    ratios = [cell[1] for cell in cells().values() if cell and cell[1]]
    return ["- A run that takes the accuracy alone: median work %.2f of that of the best fixed set-up found." % statistics.median(ratios)]


# ---- where the tube converges


def converges():
    with open(os.path.join(here, "converges.txt")) as f:
        rows = list(csv.reader(f))[1:]
    counts = [sum(row[k] != "-" for row in rows) for k in (2, 3, 4)]
    both = [float(row[3]) / float(row[2]) for row in rows if row[2] != "-" and row[3] != "-"]
    return ["Of %d tubes %d converge by the areas, %d by the pressures, %d by these with 400 pairs. Where both" % (len(rows), *counts),
            "unknowns converge, the pressures take %.2f of the iterations (median)." % statistics.median(both)]


def markdown(head, body):
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)] + ["| " + " | ".join(row) + " |" for row in body]


blocks = {"card": card, "blind": blind, "facts": facts, "restricted": restricted, "restricted-all": restricted_all, "one": one, "one-cells": one_cells, "one-all": one_all, "converges": converges}


# ---- pictures

PICTURES = {"trade.svg": "one-number.txt", "one-number.svg": "one-number.txt", "converges.svg": "converges.txt"}


def stamp(picture):
    """Of the data and the script that a picture is drawn from: the picture holds it, and figures.py --check compares."""
    digest = hashlib.sha256()
    for name in (PICTURES[picture], "card.gp"):
        with open(os.path.join(here, name), "rb") as f:
            digest.update(f.read())
    return "drawn from %s and card.gp, %s" % (PICTURES[picture], digest.hexdigest()[:16])


def by_digit(problems, value, middle):
    """Rows of CSV: accuracy, one column a problem, the one in the middle; "-" where there is none."""
    for d in digits:
        yield ",".join(["1e-%d" % d] + ["-" if v is None else "%.4g" % v for v in [value(p, d) for p in problems] + [middle(d)]])


def write(path, lines):
    with open(path, "w") as f:
        f.writelines(line + "\n" for line in lines)


def data(folder):
    found = stored()
    best, run, problems = found["best"], found["run"], found["problems"]
    write(os.path.join(folder, "digit.csv"), by_digit(
        problems, lambda p, d: best[p, d]["work"] / best[p, 2]["work"] if (p, d) in best else None,
        lambda d: statistics.median(best[p, d]["work"] / best[p, 2]["work"] for p in problems if (p, d) in best)))
    write(os.path.join(folder, "asked.csv"), by_digit(
        problems, lambda p, d: run[p, d]["error"] if run.get((p, d)) else None,
        lambda d: statistics.median(run[p, d]["error"] for p in problems if run.get((p, d)))))
    write(os.path.join(folder, "cells.csv"), ("%d,%d,%.4g,%.4g" % (d - 2, len(problems) - 1 - problems.index(p), cell[0], cell[1] or -1)
                                              for (p, d), cell in cells().items() if cell))
    with open(os.path.join(here, "converges.txt")) as f:
        write(os.path.join(folder, "converges.csv"), f.read().splitlines()[1:])
    return problems, "%.2g" % per_digit(found)


def by_colour(match):
    """Cells, a polygon of four corners each, as one path for each colour."""
    paths = {}
    for colour, x, y, across, along in re.findall(
            r"rgb\(([^)]*)\)' points = '([\d.]+),([\d.]+) ([\d.]+),[\d.]+ [\d.]+,([\d.]+) ", match.group(0)):
        corners = tuple(float(v) for v in (x, y, across, along))
        paths.setdefault("#%02x%02x%02x" % tuple(int(part) for part in colour.split(",")), []).append("M%.1f,%.1fH%.1fV%.1fH%.1fz" % (*corners, corners[0]))
    return "".join('<path stroke="none" fill="%s" d="%s"/>\n' % (colour, "".join(cells_)) for colour, cells_ in paths.items())


def slim(text):
    """An SVG of gnuplot without defaults, unused definitions and empty groups."""
    text = text.replace(' font-family="sans" ', " ").replace("<svg \n", '<svg font-family="sans"\n')
    text = re.sub(r' stroke-width="1.00" stroke-linecap="butt" stroke-linejoin="miter"', "", text)
    text = re.sub(r"^[ \t]+|[ \t]+$|^\n", "", text, flags=re.M)
    text = re.sub(r"(?:<polygon fill = 'rgb\([^)]*\)' points = '(?:[\d.]+,[\d.]+ ){4}'/>\n)+", by_colour, text)
    text = re.sub(r"<path stroke='black'  d='M[\d.,]+ M[\d.,]+  '/>\s*", "", text)
    if "#gpPt" not in text:
        text = re.sub(r"<defs>.*?</defs>\n", "", text, flags=re.S)
    return re.sub(r"<g [^>]*>\n</g>\n", "", text)


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.join("build", "study", "card")
    os.makedirs(folder, exist_ok=True)
    problems, per_decade = data(folder)
    settings = "T='%s'; out='%s'; problems='%s'; per_decade='%s'" % (folder, folder, " ".join(problems), per_decade)
    subprocess.run(["gnuplot", "-e", settings, os.path.join(here, "card.gp")], check=True)
    for picture in PICTURES:
        with open(os.path.join(folder, picture)) as f:
            text = slim(f.read())
        write(os.path.join(examples, picture), (text.rstrip() + "\n<!-- %s -->" % stamp(picture)).split("\n"))
        print("picture: examples/%s, %d KB" % (picture, os.path.getsize(os.path.join(examples, picture)) // 1000))


if __name__ == "__main__":
    main()
