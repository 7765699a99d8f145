# SPDX-License-Identifier: MIT
"""one_number.py ADAPTIVE FIXED FOLDER [PROBLEM ...] - the runs of ADAPTIVE that take one number, two at a time, beside the
best fixed set-ups of FIXED (tests/study/one-number.txt): problem x accuracy to the screen and to FOLDER/one-number.md, CSV
for the picture, and whether the recommendations of tests/study/README.md fit both.  Then the bound of the error and its
sources (--shares) with varied starts and rates: those of CERTIFY, numbers for --vary, of which a second or more also
asks whether steps in four name the same source."""
import csv
import os
import re
import statistics
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

program, fixed, folder = sys.argv[1:4]
document = os.path.join(os.path.dirname(os.path.abspath(__file__)), "README.md")
order = {"rk4": 4, "dp5": 5, "verner6": 6, "dop853": 8, "sdirk2": 2, "esdirk3": 3, "esdirk5": 5}
digits = range(2, 11)
certified_digits = range(2, 9)
variations = os.environ.get("CERTIFY", "11").split()
sources = ("steps", "waves", "iteration", "events")


def stored():
    """FIXED: (problem, digits) -> the best set-up, problem -> dots of the picture, in the order of the file."""
    best, dots = {}, {}
    with open(fixed) as f:
        for row in csv.reader(f):
            if row[0] == "best":
                best[row[1], -int(row[2].split("e")[1])] = {
                    "work": float(row[3]), "order": max(order[table] for table in row[5].split("/")),
                    "degree": int(row[8]), "tolerance": float(row[10])}
            elif row[0] == "dots":
                dots[row[1]] = [pair.split() for pair in row[2:]]
    return best, dots


def run(problem, digit):
    """The printed keys of one run, and the median degree of its waves."""
    log = os.path.join(folder, "one-number-%s-%d" % (problem, digit))
    command = [program, "--problem", problem, "--accuracy", "1e-%d" % digit, "--log", log]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return {"failed": done.stderr.strip().splitlines()[-1]}
    keys = {key: float(value) for key, value in (line.split() for line in done.stdout.splitlines())}
    with open(log + ".csv") as f:
        keys["degree"] = statistics.median(int(row["degree_A"]) for row in csv.DictReader(f))
    return keys


def cell(keys, least):
    if "failed" in keys:
        return keys["failed"]
    return "%.2g, %s" % (keys["ratio"], "%.2f" % (keys["evaluations"] / least["work"]) if least else "-")


def table(problems, runs, best):
    """error over accuracy, work over that of the best fixed set-up"""
    lines = ["| problem | " + " | ".join("1e-%d" % d for d in digits) + " |", "|" + "---|" * (1 + len(digits))]
    for p in problems:
        lines.append("| %s | " % p + " | ".join(cell(runs[p, d], best.get((p, d))) for d in digits) + " |")
    good = {key: keys for key, keys in runs.items() if "failed" not in keys}
    ratios = {key: keys["evaluations"] / best[key]["work"] for key, keys in good.items() if key in best}
    errors = {key: keys["ratio"] for key, keys in good.items()}
    lines.append("")
    if ratios:
        lines.append("Work over that of the best fixed set-up: median %.2f, largest %.2f, of %d cells; %d are above 1, %d above 3."
                     % (statistics.median(ratios.values()), max(ratios.values()), len(ratios),
                        sum(r > 1 for r in ratios.values()), sum(r > 3 for r in ratios.values())))
    lines.append("Error over accuracy: median %.2g, largest %.2g, of %d cells; %d are above 1, %d below 1/30; %d runs failed."
                 % (statistics.median(errors.values()), max(errors.values()), len(errors), sum(e > 1 for e in errors.values()),
                    sum(e < 1 / 30 for e in errors.values()), len(runs) - len(good)))
    return lines


def for_picture(problems, runs, best, dots):
    for p in problems:
        with open(os.path.join(folder, "one-number-%s.csv" % p), "w") as f:
            f.write("accuracy,error,work,best\n")
            for d in digits:
                if "failed" not in runs[p, d]:
                    keys, least = runs[p, d], best.get((p, d))
                    f.write("1e-%d,%g,%g,%g\n" % (d, keys["error"], keys["evaluations"], least["work"] if least else -1))
        with open(os.path.join(folder, "one-number-%s-all.csv" % p), "w") as f:
            f.writelines(",".join(dot) + "\n" for dot in dots.get(p, []))


def bounds(words):
    """The numbers in a cell of the table of recommendations: least and most; 'more' and 'nothing more' open the end."""
    numbers = [float(x) for x in re.findall(r"\d+(?:e-\d+)?", words.split(";")[0])]
    return min(numbers), float("inf") if "more" in words else max(numbers)


def recommended():
    with open(document) as f:
        rows = re.findall(r"^\| (1e-\d+) \| ([^|]*) \| [^|]* \| ([^|]*) \| ([^|]*) \|$", f.read().split("| target | degree of the waveform |")[1], re.M)
    if not rows:
        sys.exit(document + ": the table of recommendations is not where it was")
    return {-int(target.split("e")[1]): [bounds(words) for words in rest] for target, *rest in rows[:4]}


def check(problems, runs, best):
    """Median over the problems beside what is recommended; order and degree of the run are its own choice."""
    for d, (degree, order_, tolerance) in recommended().items():
        some = [best[p, d] for p in problems if (p, d) in best]
        own = [runs[p, d]["degree"] for p in problems if (p, d) in runs and "failed" not in runs[p, d]]
        if not some or not own:
            continue
        middle = {key: statistics.median(s[key] for s in some) for key in ("degree", "order", "tolerance")}
        fits = {"degree": degree[0] <= middle["degree"] <= degree[1], "order": order_[0] <= middle["order"] <= order_[1],
                "tolerance": tolerance[0] / 10 <= middle["tolerance"] <= tolerance[1] * 10}
        misfits = ", ".join(key for key, ok in fits.items() if not ok)
        yield "| 1e-%d | %s | %g | %s | %g | %s | %.0e | %s | %g |" % (
            d, span(degree), middle["degree"], span(order_), middle["order"], span(tolerance), middle["tolerance"],
            "not " + misfits if misfits else "yes", statistics.median(own))


def span(pair):
    if pair[1] == float("inf"):
        return "%g or more" % pair[0]
    return "%g" % pair[0] if pair[0] == pair[1] else "%g .. %g" % pair


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
    pairs = [(runs[p, d], runs[p, d + 1]) for p, d in runs if (p, d + 1) in runs]
    pairs = [pair for pair in pairs if not any("failed" in keys for keys in pair)]
    work = [b["evaluations"] / a["evaluations"] for a, b in pairs]
    left = [b["error"] / a["error"] for a, b in pairs]
    return ["", "A tenth of the accuracy takes %.2f times the work (median; 90 %%: %.2f) and leaves %.2f of the error (90 %%: %.2f, most %.2f)."
            % (statistics.median(work), at(work, 0.9), statistics.median(left), at(left, 0.9), max(left))]


def main():
    best, dots = stored()
    problems = sys.argv[4:] or list(dots)
    cells = [(p, d) for p in problems for d in digits]
    with ThreadPoolExecutor(2) as pool:
        runs = dict(zip(cells, pool.map(lambda cell_: run(*cell_), cells)))
    lines = table(problems, runs, best)
    for_picture(problems, runs, best, dots)
    head = ["| target | degree recommended | of the best fixed | order recommended | of the best fixed | "
            "tolerance recommended | of the best fixed | fits | degree of the run's waves |", "|" + "---|" * 9]
    advice = head + list(check(problems, runs, best))
    wide = [(p, d, v) for p in problems for d in certified_digits for v in variations]
    with ThreadPoolExecutor(2) as pool:
        bounded = dict(zip(wide, pool.map(lambda key: certify(*key, "2"), wide)))
        finer = dict(zip(wide, pool.map(lambda key: certify(*key, "4"), wide))) if len(variations) > 1 else {}
    sure, fits = certificate(bounded, finer)
    sure += tenth(runs)
    for key, keys in bounded.items():
        if not keys or keys["bound"] < keys["error"]:
            sure.append("%s 1e-%d, variation %s: %s" % (*key, "bound %g, error %g" % (keys["bound"], keys["error"]) if keys else "no bound"))
    for name, text in (("one-number.md", lines), ("one-number-advice.md", advice), ("one-number-sure.md", sure)):
        with open(os.path.join(folder, name), "w") as f:
            f.write("\n".join(text) + "\n")
        print("\n".join(text), end="\n\n")
    sys.exit(not fits or any("failed" in keys or keys["ratio"] > 1 for keys in runs.values()))


main()
