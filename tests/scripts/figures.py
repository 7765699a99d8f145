#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""figures.py [FOLDER [NAME ...]] - write the figures of make bench, make study and the scenes into the documents below, between
<!-- figures NAME --> and <!-- end -->.  FOLDER: where they were built, build by default.  What was not run stays as it is, and is
named; with names, so do all others.
figures.py --check - write nothing; fail where a figure or a picture is not what the data in tests/study say."""
import glob
import math
import os
import re
import subprocess
import sys
import textwrap

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "study"))
import card

DOCUMENTS = ("README.md", "examples/README.md", "examples/ACCURACY.md", "examples/EXTREMES.md", "examples/TROUBLE.md", "tests/study/README.md")
check = sys.argv[1:] == ["--check"]
build = sys.argv[1] if len(sys.argv) > 1 and not check else "build"
chosen = list(card.blocks) if check else sys.argv[2:]


class Missing(Exception):
    pass


def read(*path):
    try:
        with open(os.path.join(build, *path)) as f:
            return f.read()
    except OSError:
        raise Missing(os.path.join(*path)) from None


def rows():
    """The rows of make bench: name -> (first number, second number)."""
    table = {}
    for line in read("bench", "rows").splitlines():
        name, a, b = line.split("\t")
        table[name] = float(a), float(b)
    return table


def names(bench):
    return [line.split("\t")[1:] for line in read("bench", "names").splitlines() if line.startswith(bench + "\t")]


def number(x):
    """Three digits, without an exponent where that is short."""
    if x == 0:
        return "0"
    if 1e-3 <= abs(x) < 1e5:
        text = "%.3g" % x
        return "%.0f" % x if "e" in text else text
    return "%.2e" % x


def markdown(head, body):
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)] + ["| " + " | ".join(row) + " |" for row in body]


def cell(table, key):
    return number(table[key][1]) if key in table else "-"


# ---- make bench; the documents have some of the rows, build/bench all of them

IQN_ROWS = (("100", "10"), ("1000", "20"), ("1000", "200"), ("10000", "20"), ("100000", "20"), ("1000000", "20"))
RK_ROWS = {"dp5 step": ("1", "10", "1000", "100000"), "rk4 step": ("1000",), "esdirk4 step": ("1000",), "dop853 step": ("1", "1000"),
           "dp5 error and norm": ("1", "1000"), "dp5 dense value": ("1000",)}
WAVEFORM_ROWS = (("fit", "1", "6"), ("fit", "10000", "6"), ("fit", "10000", "21"), ("fit", "1000000", "6"), ("value", "1", "6"),
                 ("value", "10000", "6"), ("value", "1000000", "6"))


def machine():
    machine = re.sub(r"\s+", " ", read("bench", "machine").strip())
    who = [text if text.split()[0] in (name, name + "'s") else "%s: %s" % (name, text)
           for name, text in names("iqn") + names("rk") if name not in ("hand-written", "typed-in loops", "iqn.h", "rk.h", "the other rk.h")]
    return ["`make bench` of %s on %s." % (read("bench", "date").strip(), machine),
            *wrapped(["Peers, as installed: " + "; ".join(dict.fromkeys(who)) + "."]),
            "Ratios are medians of the rounds of one run, every contender in a process of its own; loops and odeint are",
            "compiled with -O3 -march=native, the headers with -O2."]


def iqn():
    table = rows()
    cases = dict.fromkeys(tuple(k.split()[1:3]) for k in table if k.startswith("iqn "))
    if not cases:
        raise Missing("bench iqn")
    body = []
    for n, m in [case for case in cases if case in IQN_ROWS]:
        key = "iqn %s %s " % (n, m)
        body.append([n, m, number(table[key + "hand-written"][0])] + [cell(table, key + c) for c in ("iqn.h", "PETSc", "KINSOL", "SciPy")])
    return markdown(["N", "pairs", "hand-written, us", "iqn.h", "PETSc Anderson", "KINSOL", "SciPy Anderson"], body)


def rk():
    table = rows()
    cases = dict.fromkeys(re.match(r"rk (.*) (\d+) typed-in loops", k).groups() for k in table if k.startswith("rk ") and k.endswith("loops"))
    if not cases:
        raise Missing("bench rk")
    body = []
    for what, n in [case for case in cases if case[1] in RK_ROWS.get(case[0], ())]:
        key = "rk %s %s " % (what, n)
        body.append([what, n, number(table[key + "typed-in loops"][0])] + [cell(table, key + c) for c in ("rk.h", "odeint", "GSL", "ARKODE", "SciPy")])
    return markdown(["", "n", "loops, us", "rk.h", "odeint", "GSL", "ARKODE", "SciPy"], body)


def waveform():
    table = rows()
    found = (re.fullmatch(r"waveform (\w+) (\d+) (\d+) waveform.h", k) for k in table)
    cases = dict.fromkeys(m.groups() for m in found if m)
    if not cases:
        raise Missing("bench waveform")
    body = []
    for what, n, m in [case for case in cases if case in WAVEFORM_ROWS]:
        key = "waveform %s %s %s " % (what, n, m)
        floor = number(table[key + "floor"][0]) if key + "floor" in table else "-"
        ratio = cell(table, key + "waveform.h") if floor != "-" else "-"
        body.append([what, n, m, floor, number(table[key + "waveform.h"][0]), ratio, cell(table, key + "GSL"), cell(table, key + "SciPy")])
    return markdown(["", "n", "samples", "floor, us", "waveform.h, us", "waveform.h", "GSL", "SciPy"], body)


# ---- make study


def printed(first, last=None, count=None):
    """Lines of the summary as they were printed, from one that matches to one that matches, or so many."""
    lines = [re.sub(r".*\r|\033\[K", "", line) for line in read("study", "summary.txt").split("\n")]
    at = [i for i, line in enumerate(lines) if re.match(first, line)]
    if not at:
        raise Missing("study: " + first)
    some = lines[at[0]:]
    if count:
        some = some[:count]
    else:
        stop = [i for i, line in enumerate(some) if i > 0 and re.match(last, line)]
        some = some[:stop[0]] if stop else some
    while some and not some[-1].strip():
        some.pop()
    return some


def text(*parts):
    return ["```text"] + [line.rstrip() for part in parts for line in part] + ["```"]


def wrapped(lines, width=118):
    out = []
    for line in lines:
        while len(line) > width:
            cut = max(line.rfind("; ", 0, width), line.rfind(": ", 0, width), line.rfind("  ", 0, width))
            cut = cut if cut > 40 else line.rfind(" ", 0, width)
            if cut < 1:
                break
            out.append(line[:cut + 1].rstrip())
            line = "    " + line[cut + 1:].strip()
        out.append(line)
    return out


def recommend():
    """The cheapest set-ups for an error, of both problems."""
    body = []
    for problem, name in (("oscillator", "two masses"), ("heat", "heat")):
        for line in read("study", "recommend-%s.md" % problem).strip().splitlines()[2:]:
            body.append([part.strip() for part in line.strip("|").split("|")] + [name])
    body.sort(key=lambda row: -float(row[0]))
    return markdown(["error", "problem", "work", "windows", "sub-steps in each", "degree", "exchanged", "method", "tolerance", "iterations"],
                    [[row[0], row[-1]] + row[1:-1] for row in body])


def judged():
    return printed("signals, seed judge", "== ")


def study_signals():
    """Error by degree: some rows of two grids."""
    lines = judged()
    lines = lines[next(i for i, line in enumerate(lines) if line.startswith("error by degree")):]
    found = [re.match(r"(even|uneven, 90 %) +(degree [1359]|wf_choose)[^-\d]* ((?:[ ,up to\d]+? )?)((?: *\d\.\de[-+]\d\d)+)$", line) for line in lines[2:]]
    return markdown(["samples", "degree"] + lines[1].split(),
                    [[row.group(1), "`wf_choose`, up to 9" if row.group(2) == "wf_choose" else row.group(2).split()[1]] + row.group(4).split() for row in found if row])


def knobs_waveform():
    """Facts of the table of knobs, from the same lines as study-signals."""
    lines = judged()

    def values(first, second):
        found = [line.split()[-8:] for line in lines if line.startswith(first) and second in line]
        if not found:
            raise Missing("study: %s %s" % (first, second))
        return [[float(x) for x in row] for row in found]

    def broken(signal):
        row = [line.split() for line in lines if re.match(r" +%s +degree 3 " % signal, line)]
        return "%s becomes %s" % (row[0][3], row[0][4])
    over = [x for row in values("", "over the best") for x in row]
    smooth = [values("last step 1e-6", knots)[0][0] for knots in ("weighted", "averages", "at data")]
    work = re.search(r"with wf_choose ([\d.]+) times the work, with wf_error ([\d.]+)", "\n".join(lines))
    within = re.findall(r"within a factor of 3: (\d+) of (\d+)", "\n".join(lines))
    if not work or not within:
        raise Missing("study: signals")
    good, all_ = (sum(int(pair[k]) for pair in within) for k in (0, 1))
    far = [[max(row) for row in values("event 1e-3", degree)][-1] for degree in ("degree 1 ", "degree 9 ", "wf_choose")]
    return [
        "- `wf_choose`: median error %s to %s times that of the best of six fixed degrees, over all signals and grids; %s times the work of" % (
            number(min(over)), number(max(over)), number(float(work.group(1)))),
        "  the pushes and the fit of a window of 21 sub-steps of 1000 numbers, `wf_error` %s." % number(float(work.group(2))),
        "- `wf_error`: within a factor of 3 of the true error in %d of %d smooth cases." % (good, all_),
        "- Knots, last step 1e-6 of the others, smooth samples good to 1e-6, degree 3: error %.1e; at plain averages %.1e, at the data %.1e." % tuple(smooth),
        "- Times clustered behind an event, samples wrong by 1e-3, worst signal: degree 9 asked, and lowered until noise is amplified by at",
        "  most 100: error %.2g; degree 1 %.2g; `wf_choose` %.2g." % (far[1], far[0], far[2]),
        "- A break at the event, degree 3: a jump %s, a kink (circuit) %s." % (broken("jump"), broken("circuit"))]


def study_knobs():
    """A row for each knob: its values with the iterations."""
    some = r"(tube .*|heat 50 windows): ((?:filter QR2 default|noise|growth|reuse|columns|mixing|steps, all|delayed|mode).*?) +(\S+:\S+(?: \S+:\S+)*)$"
    found = [re.match(some, line) for line in printed("tube 100 windows", "least squares")]
    return markdown(["run", "what is set", "value: iterations"],
                    [[row.group(1), row.group(2), "; ".join(cell_.replace(":", ": ") for cell_ in row.group(3).split())] for row in found if row])


def study_squares():
    """Least squares beside Householder's; cells of the maps that converge."""
    found = [re.match(r" +1e(00|04|08|12|16) +(\S+) +(\S+)$", line) for line in printed("least squares", "cost of a step|history in single|cells that|== ")]
    head = re.match(r"cells that converge, of (\d+) tube and (\d+) heat cells: (.*)$", " ".join(printed("cells that", count=1)))
    body = [re.match(r"(\S+) (\d+)(?: and (\d+))?$", part.strip()).groups() for part in head.group(3).split(";")]
    return (markdown(["condition of 10 pairs, optimum 1e-3", "excess of the residual, iqn.h", "Householder"],
                     [["1e%d" % int(row.group(1)), row.group(2), row.group(3)] for row in found if row]) + [""] +
            markdown(["cells of the maps that converge", "tube, of %s" % head.group(1), "heat, of %s" % head.group(2)],
                     [[name.replace("-", ", ").replace("IQN, ", "IQN-"), tube_, heat_ or ""] for name, tube_, heat_ in body]))


def rules():
    return read("study", "rules.txt").splitlines()


def plain_double():
    """Iterations per window near round-off; 0.2.0 summed its products in double-double."""
    before = {"1": ("10.00", "12.00", "14.00"), "16": ("3.62", "3.94", "4.56")}
    tolerances = ("1e-8", "1e-10", "1e-12")

    def now(windows, tolerance):
        out = program("manufactured", "--m", "10", "--method", "gauss3", "--windows", windows, "--tolerance", tolerance)
        return re.search(r"^iterations (\S+)", out, re.M).group(1)
    return markdown(["windows, tolerance"] + ["%s, %s" % (w, t) for w in before for t in tolerances],
                    [["0.2.0, double-double"] + [n for w in before for n in before[w]],
                     ["iqn.h"] + [now(w, t) for w in before for t in tolerances]])


def study_rk():
    """Fewest evaluations for an error."""
    lines = "\n".join(line for line in printed(r".*fewest evaluations", r"Arenstorf|table +order"))
    body = [[name.strip()] + ["%s, %s" % hit for hit in re.findall(r"1e-\d+: (\S+) \((\d+)\)", rest)]
            for name, rest in re.findall(r"^(.*?)  +fewest evaluations for an error of(.*)$", lines, re.M)]
    return markdown(["fewest evaluations for an error of", "1e-2", "1e-4", "1e-8", "1e-10"], body)


def speed_flags():
    """Time at -O2 over that with -march=native."""
    found = re.findall(r"^(\S.*?) +(\d+) +-O2 +[\d.]+ us; over that with -march=native +([\d.]+); -O3 -march=native +([\d.]+)",
                       "\n".join(printed(r".*-O2 +[\d.]+ us", "== ")), re.M)
    calls, sizes = (list(dict.fromkeys(row[k] for row in found)) for k in (0, 1))
    value = {row[:2]: row[2:] for row in found}
    return markdown(["-O2 over -O2 -march=native (over -O3 -march=native), n ="] + sizes,
                    [[call] + ["%s (%s)" % value[call, n] for n in sizes] for call in calls])


def study_bits():
    """A row for each call, a column for each compiler and its flags."""
    lines = printed(".*-std=c99 -O0", "== ")
    calls = [re.match(r" +column \d+: (.*)", line).group(1).replace("; ", ", ") for line in lines if re.match(r" +column", line)]
    flags = [re.match(r"(\S+) -std=\S+ (.*?)  +(.*)$", line).groups() for line in lines if re.search(r"c99 -O2|-O3|-Ofast", line)]
    return markdown(["call"] + ["%s %s" % flag[:2] for flag in flags], [[call] + [flag[2].split()[k] for flag in flags] for k, call in enumerate(calls)])


# ---- the first README


def program(*command):
    try:
        return subprocess.run([os.path.join(build, command[0]), *command[1:]], capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        raise Missing(command[0]) from None


def five():
    table = rows()
    tube = re.search(r"^total\s+(\d+)", program("tube", "--settings", "kit"), re.M)
    if not tube:
        raise Missing("tube")
    key = "iqn 1000000 20 "
    step = table[key + "iqn.h"]
    return [
        "- Elastic tube with strong added mass, 100 windows: %s iterations with the defaults; the published" % tube.group(1),
        "  count is 846.",
        "- A quasi-Newton step of 1e6 numbers and 20 pairs takes %s times as long as one written by hand in" % number(step[1]),
        "  plain double; PETSc's Anderson takes %s times as long (%s, `make bench`)." % (cell(table, key + "PETSc"), read("bench", "date").strip()),
        "- Sums over all processes per iteration: %d with 2 pairs, %d with 50." % (table["sums 2"][0], table["sums 50"][0])]


def one_sure():
    """Of the last run; the cells where the bound does not hold are for the screen."""
    lines = read("study", "one-number-sure.md").splitlines()
    return [line for line in lines if not re.match(r"\S+ 1e-\d+, variation", line)]


def one_pulse():
    found = []
    for accuracy in ("1e-5", "1e-7"):
        out = program("adaptive", "--problem", "pulse", "--accuracy", accuracy, "--certify")
        error, bound = (float(re.search(r"^%s (\S+)" % key, out, re.M).group(1)) for key in ("error", "bound"))
        found.append("%.1g times the bound at %s" % (error / bound, accuracy))
    return ["  of a pulse of 1e-5 of the run between all of their stages (`--problem pulse`) it does not, and the error is %s." % " and ".join(found)]


def arena_text():
    return read("study", "arena-full-judge.txt")


STANDING = r"^(\S.*?)  +([\d.]+) +([\d.]+) +(\d+) of +(\d+) +(\d+) +(\d+) +(\d+) of (\d+)$"


def arena():
    found = re.findall(STANDING, arena_text(), re.M)[:3]
    if len(found) < 3:
        raise Missing("make arena")
    body = [[r[0], r[4], r[1], r[2], r[3], r[5], "%s of %s" % r[7:9]] for r in found]
    behind = ["- Behind by more than 1.10, %s: %s." % (name, text_.strip(" ;") or "none")
              for name, text_ in re.findall(r"^more than 1.10 behind, (users' jobs|told more):(.*)$", arena_text(), re.M)]
    lines = [part for line in behind for part in textwrap.wrap(line, 140, subsequent_indent="  ")]
    return markdown(["the defaults", "families", "median", "worst", "above 1.10", "another fails less often", "runs that fail"], body) + [""] + lines


def arena_settings():
    head, jobs, told = (re.findall(STANDING, part, re.M) for part in re.split(r"^each setting as the default.*\n", arena_text(), flags=re.M))
    return markdown(["setting", "users' jobs: median", "worst", "above 1.10", "runs that fail", "told more: median", "runs that fail"],
                    [[r[0], r[1], r[2], "%s of %s" % r[3:5], "%s of %s" % r[7:9], t[1], "%s of %s" % t[7:9]] for r, t in zip(jobs, told)])


def loops():
    """All words of make loops that were run in full, without OLD."""
    files = [name for name in sorted(glob.glob(os.path.join(build, "study", "loops-*.txt"))) if not re.search(r"-(part|old)\.txt$", name)]
    sums = {}
    for name in files:
        for way, *counts, ratio in re.findall(r"^loops of hosts, (.*?) +above 1.1: (\d+) of (\d+) .*given up: (\d+) of (\d+) windows; .* ([\d.]+)$",
                                              read("study", os.path.basename(name)), re.M):
            row = sums.setdefault(way, [0, 0, 0, 0, 0.])
            for k, count in enumerate(counts):
                row[k] += int(count)
            row[4] += math.log(float(ratio)) / len(files)
    if not sums:
        raise Missing("make loops")
    return markdown(["words: %d" % len(files), "hosts above 1.1 of their own loop", "windows given up", "evaluations over the own loop's"],
                    [[way, "%d of %d" % tuple(r[:2]), "%d of %d" % tuple(r[2:4]), "%.2f" % math.exp(r[4])] for way, r in sums.items()])


def several():
    found = re.findall(r"^(\S.*?)  +(iqn\.h|omega 1|Anderson|aa I+) +" + r" +([\d.]+) of ([\d.]+) \( *\d+\)" * 4 + "$", read("study", "loops-dev.txt"), re.M)
    if not found:
        raise Missing("make loops SEED=dev")
    easy = {game for game in {r[0] for r in found} if all(r[2::2] == r[3::2] for r in found if r[0] == game)}
    return markdown(["starts of 20 that reach a fixed point", "", "5 columns", "10", "20", "50"],
                    [[r[0], r[1]] + list(r[2::2]) for r in found if r[0] not in easy]) + (["", "From every start: %s." % ", ".join(sorted(easy))] if easy else [])


def endings():
    """Four tables of make promises."""
    lines = "\n".join(line for line in read("study", "promises-dev.txt").splitlines() if "units 1   apart" not in line and "in turn" not in line)
    scenes_ = re.search(r"^springs with stops, three scenes.*given up\)(.*); IQN_GROWTH 0:(.*)$", lines, re.M)
    springs = re.findall(r"^springs with stops, +(\d+) numbers, IQN_GROWTH (\d): given up in (\d+) of 100, evaluations ([\d.]+)", lines, re.M)
    given_up = {row[:2]: "%s (%s)" % row[2:] for row in springs}
    sizes, growths = (list(dict.fromkeys(row[k] for row in springs)) for k in (0, 1))
    rings = re.findall(r"^rings, (\d) fields of (\d), units 1e6 apart.*windows?\):  (.*)$", lines, re.M)
    units = re.findall(r"^units, solvers good to (\S+), at once, (\S.*?)  +(.*)$", lines, re.M)
    ways = [re.match(r"(\D+?) \d", way).group(1) for way in rings[0][2].split("  ")]
    apart = re.search(r"^units (.*) apart: evaluations", lines, re.M).group(1).split(", ")
    closed = re.search(r"^closed volumes without a fixed point, limits (.*): .*converged.* in (.*) of 1000 maps", lines, re.M)
    return (markdown(["springs with stops: given up of 100 (evaluations)"] + ["%s numbers" % n for n in sizes] + ["three scenes of two (-: given up)"],
                     [["`IQN_GROWTH` " + growth] + [given_up[n, growth] for n in sizes] + [scenes_.group(1 if growth != "0" else 2).strip()] for growth in growths]) + [""] +
            markdown(["rings, units 1e6 apart: given up of 100 (evaluations a window)"] + ways,
                     [["%s fields of %s" % row[:2]] + re.findall(r"\d+ \([\d.]+\)", row[2]) for row in rings]) + [""] +
            markdown(["units apart by: evaluations of the window with the load (-: given up)"] + apart,
                     [["solvers good to %s, %s" % row[:2]] + row[2].split() for row in units]) + [""] +
            markdown(["closed volumes without a fixed point, limit"] + closed.group(1).split(), [["\"converged\", of 1000 maps"] + closed.group(2).split()]))


def public():
    lines = re.findall(r"^public problems, (.*)$", read("study", "public.txt"), re.M)
    ours = [re.match(r"(.*?) +within 1.1 of the best rival: (\d+ of \d+) \(.*\); given up that a rival answers: (\d+)(?: \((.*)\))?$", line) for line in lines]
    theirs = [re.match(r"(.*?) +fails in (\d+), .* ([\d.]+)$", line) for line in lines]
    return (markdown(["iqn.h", "within 1.1 of the best rival", "given up that a rival answers", "which"],
                     [[row.group(1), row.group(2), row.group(3), row.group(4) or ""] for row in ours if row]) + [""] +
            markdown(["rival", "fails in", "evaluations over those of iqn.h, where both arrive"], [list(row.groups()) for row in theirs if row]))


def delayed():
    """Evaluations of each job; then their means over those without."""
    lines = read("study", "delayed-dev.txt").splitlines()
    ways = re.split(r"  +", lines[1].strip())
    jobs = [re.split(r"  +", line.strip()) for line in lines[2:] if not line.startswith("delayed pairs")]
    means = re.findall(r"^delayed pairs, (.*?), (\S+ windows?) +evaluations (\S+) of those without, (\d+) jobs", "\n".join(lines), re.M)
    kinds = list(dict.fromkeys((kind, jobs_) for kind, _, _, jobs_ in means))
    return (markdown([lines[0]] + ways, [row + [""] * (1 + len(ways) - len(row)) for row in jobs]) + [""] +
            markdown(["evaluations over those without"] + ways[1:],
                     [["%s, %s jobs that both answer" % kind] + [row[2] for row in means if row[0] == kind[0]] for kind in kinds]))


def sent():
    out = program("conservation")
    kept, lost = (abs(float(re.search(r"^imbalance_%s\s+(\S+)" % key, out, re.M).group(1))) for key in ("integral", "sampling"))
    return ["- With 16 sub-steps on one side and 5 on the other, means lose %s of what is exchanged," % (number(kept) if kept > 1e-15 else "round-off"),
            "  sampling loses %s." % ("%.1e" % lost).replace("e-0", "e-")]


# ---- the scenes


def tube(*options):
    """Iterations of the tube in 100 windows; a dash where a window did not converge."""
    out = program("tube", "--settings", "kit", *options)
    total, left = (re.search(r"^%s\s+(\d+)" % key, out, re.M) for key in ("total", "unconverged"))
    if not total or not left:
        raise Missing("tube")
    return "-" if int(left.group(1)) else total.group(1)


def tube_guess():
    cases = [("sine", "0.01", "1"), ("sine", "0.02", "1"), ("step", "0.01", "1"), ("step", "0.02", "1"), ("step", "0.01", "3")]
    guesses = ("0", "1", "2", "3", "4", "auto")
    return markdown(["`--inlet`", "`--dt`", "`--wall`", "constant", "linear", "quadratic", "cubic", "4", "`--predict auto`"],
                    [[inlet, dt, wall] + [tube("--inlet", inlet, "--dt", dt, "--wall", wall, "--predict", guess) for guess in guesses]
                     for inlet, dt, wall in cases])


def tube_mean():
    fluids = ("1", "2", "4", "8", "16")
    return markdown(["steps of the fluid in a window, solid: one"] + list(fluids),
                    [["iterations, solid has the mean pressure"] + [tube("--steps", n + ",1", "--pressure", "mean") for n in fluids]])


def piston():
    """Iterations (failures of the gas) in 0.06 s; a dash where a window has no answer."""
    binary = os.path.join(build, "piston")
    if not os.path.exists(binary):
        raise Missing("piston")

    def runs(*options):
        each = []
        for window, count in (("0.005", "12"), ("0.0075", "8"), ("0.01", "6"), ("0.015", "4"), ("0.02", "3"), ("0.03", "2")):
            out = subprocess.run([binary, "--window", window, "--windows", count, *options], capture_output=True, text=True, check=False)
            value = {key: re.search(r"^%s (\S+)" % key, out.stdout, re.M).group(1) for key in ("iterations", "failures")}
            each.append("-" if out.returncode else value["iterations"] + (" (%s)" % value["failures"] if value["failures"] != "0" else ""))
        return each
    cases = [("no guard", "--guard", "none"), ("going back", "--guard", "withdraw"), ("bound 0.001", "--bound", "0.001"),
             ("bound 0.001 and going back", "--bound", "0.001", "--guard", "both"), ("bound 0.1", "--bound", "0.1"),
             ("the same, pressure at most 10", "--peak", "10"),
             ("bound 0.1, fields by their residuals", "--scaling", "residual"), ("by the sums of residuals", "--scaling", "sum"),
             ("by units (`IQN_BY_WEIGHT`, the default of iqn.h)", "--scaling", "weight")]
    return markdown(["window, s", "0.005", "0.0075", "0.01", "0.015", "0.02", "0.03"], [[case[0], *runs(*case[1:])] for case in cases])


def answered(*options):
    """Of five runs of the tube with inputs moved by 1e-13: how many are answered in every window, and their mean iterations."""
    if not os.path.exists(os.path.join(build, "tube")):
        raise Missing("tube")
    found = []
    for seed in range(1, 6):
        out = subprocess.run([os.path.join(build, "tube"), "--settings", "kit"] + list(options),
                             env=dict(os.environ, SCENE_PERTURB=str(seed)), capture_output=True, text=True, check=False).stdout
        if re.search(r"^unconverged\s+0$", out, re.M):
            found.append(int(re.search(r"^total\s+(\d+)", out, re.M).group(1)))
    return len(found), "%d of 5%s" % (len(found), ", %.0f" % (sum(found) / len(found)) if found else "")


WALL = ("--wall", "0.3")
STEPS = ("--columns", "150", "--most", "200")
WHOLE = ("--steps", "4,4", "--windows", "12") + STEPS
PARTS = ("--dt", "0.0025", "--windows", "48") + STEPS
INLET = ("--inlet", "step", "--dt", "0.005", "--windows", "100")
PRESSURE = ("--unknown", "pressure")
DELAYED = PRESSURE + ("--steps", "4,4", "--windows", "12", "--columns", "800", "--most", "200", "--delay", "2")


def tube_ways():
    def row(name, options, *ways):
        return [name, answered(*options)[1], "; ".join("%s: %s" % (way, answered(*changed)[1]) for way, changed in ways)]
    return markdown(["tube", "answered, iterations", "a host's way"], [
        row("wall of 0.3 of the stiffness", WALL, ("the pressure as x", WALL + PRESSURE), ("first guess of degree 1", WALL + ("--predict", "1")),
            ("of degree 2", WALL + ("--predict", "2")), ("windows of .02", WALL + ("--dt", "0.02", "--windows", "50"))),
        row("four steps of both sides in a window", WHOLE, ("the pressure as x, delayed pairs, 800 columns", DELAYED), ("first guess of degree 1", WHOLE + ("--predict", "1")),
            ("windows as long as a step", PARTS), ("both", PARTS + ("--predict", "1"))),
        row("a step at the inlet, windows of .005", INLET, ("the pressure as x", INLET + PRESSURE), ("100 iterations in place of 40", INLET + ("--most", "100")))])


def limits():
    return ["- iqn.h: without a fixed point it gives up and says so. It may also give up where there are several",
            "  fixed points, and with strong added mass by the wrong x: with a wall of 0.3 of the stiffness",
            "  %d of five runs converge by default, %d by pressures." % tuple(answered(*options)[0] for options in (WALL, WALL + PRESSURE))]


def tube_unknown():
    """Iterations by either unknown, five runs each with inputs moved by 1e-13."""
    def both(name, *options, delay=True):
        cells = [answered(*options)[1].replace("5 of 5, ", ""), answered(*options, *PRESSURE)[1].replace("5 of 5, ", "")]
        return [name, *cells, answered(*options, *PRESSURE, "--delay", "2")[1].replace("5 of 5, ", "") if delay else ""]
    two = ("--steps", "2,2", "--windows", "10", "--columns", "150", "--most", "120")
    four = ("--steps", "4,4", "--windows", "8", "--columns", "800", "--most", "200")
    return markdown(["100 windows, or as said", "the areas", "the pressures", "and delayed pairs"], [
        both("defaults", delay=False), both("`--predict 2`", "--predict", "2", delay=False),
        both("`--dt 0.005`", "--dt", "0.005", delay=False), both("`--dt 0.0025`", "--dt", "0.0025", delay=False),
        both("`--wall 0.3`", "--wall", "0.3", delay=False),
        both("`--inlet step --dt 0.005`", "--inlet", "step", "--dt", "0.005", delay=False),
        both("`--steps 2,2`, 10 windows", *two), both("`--steps 4,4`, 8 windows", *four)])


def scenes_delayed():
    """Iterations as it is, and with delayed pairs in the first window; heat: means of five runs with inputs moved by 1e-13."""
    def mean(*command):
        path, found = os.path.join(build, command[0]), []
        for seed in range(1, 6):
            out = subprocess.run([path, *command[1:]], env=dict(os.environ, SCENE_PERTURB=str(seed)), capture_output=True, text=True, check=False).stdout
            found.append(float(re.search(r"^iterations (\S+)", out, re.M).group(1)))
        return "%.1f" % (sum(found) / len(found))

    def row(name, *command):
        return [name] + [mean(*command, "--delay", late) for late in ("0", "1")]
    heat = ("heat", "--pair", "steel_water", "--n", "50", "--filter", "0", "--columns", "400", "--iterations", "200", "--steps")
    euler = ("manufactured", "--g", "sin", "--windows", "10", "--steps", "4,4", "--columns", "800", "--filter", "0")
    return markdown(["iterations in a window", "as it is", "delayed"], [
        row("heat, `--pair steel_water --steps 4,4`", *heat, "4,4"), row("`--steps 8,8`", *heat, "8,8"),
        row("manufactured, 10 windows of 4,4 steps, implicit Euler, degree 1", *euler, "--method", "euler", "--degree", "1"),
        row("the same with cubic waveforms: do not", *euler, "--method", "euler", "--degree", "3")])


def trapezoid():
    out = program("trapezoid")
    body = []
    for way in ("explicit", "implicit", "waveform"):
        error = re.findall(r"^%s windows \d+ error (\S+) order (\S+) iterations (\S+)" % way, out, re.M)[-1]
        radius = dict(re.findall(r"^%s dt (\S+) radius (\S+)" % way, out, re.M))
        body.append([way, error[1], "%.1e" % float(error[0]), error[2]] + ["%.6g" % float(radius[dt]) for dt in ("0.1", "1", "100")])
    return markdown(["coupling", "order", "error, 320 windows", "iterations", "largest eigenvalue, dt 0.1", "1", "100"], body)


def delay():
    def row(name, *options):
        cells = []
        for problem in ("constant", "state"):
            out = program("delay", "--problem", problem, *options)
            cells += [re.search(r"^%s (\S+)" % key, out, re.M).group(1) for key in ("error", "steps")]
        return [name] + ["%.1e, %s" % (float(cells[i]), cells[i + 1]) for i in (0, 2)]
    return markdown(["error, steps", "delay 1", "delay of the state"], [
        row("`--tolerance 1e-12`", "--tolerance", "1e-12"), row("`--tolerance 1e-8`", "--tolerance", "1e-8"),
        row("a past of degree 1 in steps of .05, as others do", "--degree", "1", "--largest", "0.05"),
        row("`--tolerance 1e-4 --largest 0 --strict 0`: the trap", "--tolerance", "1e-4", "--largest", "0", "--strict", "0"),
        row("`--strict 1`", "--tolerance", "1e-4", "--largest", "0"),
        row("`--largest 0.2`", "--tolerance", "1e-4", "--strict", "0")])


def chain():
    out = program("chain")
    body = []
    for way in ("together", "in_turn"):
        found = re.findall(r"^%s windows (\d+) error (\S+).* iterations (\S+) plain (\S+)" % way, out, re.M)
        body.append([{"together": "all at once", "in_turn": "in turn"}[way]] + ["%s, %s" % row[2:] for row in found])
    body.append(["error"] + ["%.1e" % float(row[1]) for row in found])
    return markdown(["windows"] + [row[0] for row in found], body)


def fluxes():
    found = re.findall(r"^(\w+) imbalance (\S+) drift (\S+)", program("fluxes"), re.M)
    names_ = {"stages": "fluxes of the stages, running integral", "steps": "fluxes at the ends of steps", "sampling": "sampled by the surface"}
    return markdown(["", "lost, of what was exchanged", "error of the energy, as K of the air"],
                    [[names_[way], "%.1e" % float(lost), "%.1e" % float(drift)] for way, lost, drift in found])


def rain():
    found = re.findall(r"^rain_(\w+) least (\S+) imbalance (\S+)", program("fluxes"), re.M)
    names_ = {"monotone": "degree 2, `wf_monotone`", "cubic": "a cubic"}
    return markdown(["running integral of the rain", "least rate, of the mean", "lost"],
                    [[names_[way], "%.1e" % float(least), "%.1e" % float(lost)] for way, least, lost in found])


def windows():
    def row(name, *options):
        out = program("windows", *options)
        found = {key: re.search(r"^%s (\S+)" % key, out, re.M).group(1) for key in ("windows", "unconverged", "iterations", "anew_iterations", "error")}
        return [name, "%s of %s" % (found["unconverged"], found["windows"]), found["iterations"], found["anew_iterations"], "%.1e" % float(found["error"])]
    grow = ("--windows", "growing", "--longest", "0.4", "--factor")
    return markdown(["windows", "not converged", "iterations, pairs kept", "forgotten", "error"], [
        row("of 0.05", "--longest", "0.05"), row("of 0.2"), row("0.002 to 0.4, growing by 1.2", *grow, "1.2"), row("by 1.5", *grow, "1.5"), row("by 3", *grow, "3"),
        row("0.1 0.05 0.3 0.01 0.2, again and again", "--windows", "list"),
        row("the same, `--reuse 0`", "--windows", "list", "--reuse", "0"),
        row("of 0.3, cut at four events", "--longest", "0.3", "--events", "0.7,1.8001,2.35,3.3333")])


def aquifer():
    """Evaluations; a dash where a step did not converge in 400."""
    def count(*options):
        out = program("aquifer", *options)
        found = {key: re.search(r"^%s (\S+)" % key, out, re.M).group(1) for key in ("evaluations", "unconverged")}
        return found["evaluations"] if found["unconverged"] == "0" else "-"
    ways = [("--method", "own"), ("--method", "own", "--omega", "0.7"), ("--method", "own", "--omega", "0.5"), ("--method", "aitken"), ("--method", "iqn")]
    return markdown(["period, river", "plain", "damped, 0.7", "0.5", "Aitken", "iqn.h"],
                    [["%s days, %s m" % run] + [count("--days", run[0], "--river", run[1], *way) for way in ways]
                     for run in (("30", "8"), ("30", "1"), ("300", "1"), ("300", "0.5"), ("3000", "8"), ("30000", "8"))])


def aquifer_trials():
    lost = [float(re.search(r"^imbalance (\S+)", program("aquifer", "--trials", "4", "--after", after), re.M).group(1)) for after in ("commit", "discard")]
    return ["- A fixed number of trials: `iqn_discard` what has not converged, then go on. Its pairs would spoil",
            "  later steps: with `--trials 4 --after commit` %s %% of the water is lost in the worst step, with" % number(float("%.1g" % lost[0])),
            "  `--after discard` %s %%. `--take best`, the heads of the least change, is no better than the last." % ("%.0e" % lost[1]).replace("e-0", "e-")]


def trouble_strong():
    """Strong added mass: what a first guess, more iterations and the other unknown do, alone and together."""
    guess, more = ("--predict", "2"), ("--most", "100")
    ways = [("by areas", ()), ("guess", guess), ("iterations", more), ("both", guess + more), ("by pressures", PRESSURE), ("and both", PRESSURE + guess + more)]
    tubes = [("`--wall 0.3`", WALL), ("`--wall 0.2`", ("--wall", "0.2")), ("`--wall 0.1`", ("--wall", "0.1")), ("`--dt 0.0025`", ("--dt", "0.0025")),
             ("`--inlet step --dt 0.005`", ("--inlet", "step", "--dt", "0.005"))]
    return markdown([""] + [name for name, _ in ways], [[name] + [answered(*tube_, *way)[1] for _, way in ways] for name, tube_ in tubes])


def trouble_windows():
    """A loop of a host's own beside iqn.h by how many past windows take part."""
    def count(*options):
        return re.search(r"^evaluations (\S+)", program("aquifer", *options), re.M).group(1)
    runs = [("30", "8"), ("30", "1"), ("300", "1"), ("300", "0.5"), ("3000", "8"), ("30000", "8")]
    ways = [("own loop", ("--method", "own")), ("iqn.h", ()), ("`IQN_WINDOWS` 2", ("--reuse", "2")), ("1", ("--reuse", "1")), ("0", ("--reuse", "0"))]
    return markdown(["calls of H"] + ["%s days, %s m" % run for run in runs],
                    [[name] + [count("--days", days, "--river", river, *way) for days, river in runs] for name, way in ways])


def trouble_trials():
    """A host that stops after a few trials: steps not converged of 30, and what is lost in the worst step, in per cent."""
    def cell_(*options):
        out = program("aquifer", *options)
        open_, lost = (re.search(r"^%s (\S+)" % key, out, re.M).group(1) for key in ("unconverged", "imbalance"))
        return "%s, %s" % (open_, ("%.0e" % float(lost)).replace("e-0", "e-").replace("e+00", "").replace("e+0", "e"))
    ways = [("--method", "own"), ("--after", "commit"), ("--after", "discard"), ("--after", "discard", "--take", "best")]
    return markdown(["period, river, trials", "own loop", "iqn.h, committed", "discarded", "and the best taken"],
                    [["%s days, %s m, %s" % (days, river, trials)] + [cell_("--days", days, "--river", river, "--trials", trials, *way) for way in ways]
                     for days, river in (("30", "8"), ("300", "1"), ("300", "0.5"), ("3000", "8")) for trials in ("4", "8", "16")])


def extremes():
    """What the tests with an EXTREME print, in the order that the page has."""
    page = "examples/EXTREMES.md"
    with open(page) as f:
        order = re.findall(r"\| `(test_\w+) (\w+)` \|$", f.read(), re.M)
    found = []
    for path in sorted(glob.glob("tests/test_*.c")):
        with open(path) as f:
            parts = re.split(r"^TEST\(test_(\w+)\)$", f.read(), flags=re.M)
        names_ = [name for name, body in zip(parts[1::2], parts[2::2]) if "EXTREME(" in body]
        found += [(os.path.basename(path)[:-2], name) for name in names_]
    found.sort(key=lambda test: order.index(test) if test in order else len(order))
    body = []
    for test in found:
        lines = [line.split(" | ") for line in program(*test).splitlines() if line.startswith("# extreme | ")]
        body += [[line[1], line[2], "`%s %s`" % test] for line in lines]
    return markdown(["extreme", "what happens", "test"], body)


def patch():
    rows_ = re.findall(r"cells (\d+) iterations euclid ([\d.]+) mass ([\d.]+)", program("patch"))
    cells, euclid, mass = zip(*rows_)
    return markdown(["cells in the patch"] + list(cells), [["iterations, Euclid's norm"] + list(euclid), ["iterations, mass matrix"] + list(mass)])


def heat_counts():
    """Iterations per window of manufactured, means of ten runs with the start moved by up to 1e-13."""
    scene = os.path.join(build, "manufactured")
    if not os.path.exists(scene):
        raise Missing("manufactured")

    def mean(windows, options):
        counts = []
        for seed in range(10):
            out = subprocess.run([scene, "--method", "euler", "--degree", "1", "--g", "sin", "--windows", windows] + options,
                                 env=dict(os.environ, SCENE_PERTURB=str(seed)), capture_output=True, text=True, check=False).stdout
            counts.append(float(re.search(r"^iterations (\S+)", out, re.M).group(1)))
        return "%.1f" % (sum(counts) / 10)
    filtered = ["--columns", "20", "--reuse", "0", "--filter", "1e-3", "--judge", "end"]
    ours = [("full, pairs of 8 windows", ["--mode", "full"]),
            ("the same with its filter and 20 columns", ["--mode", "reduced"] + filtered),
            ("`--mode reduced --weight 0 --judge end`", ["--mode", "reduced", "--weight", "0", "--judge", "end"]),
            ("all samples judged, as an answer needs", ["--mode", "reduced", "--weight", "0"]),
            ("the same, the other samples with a weight of 1e-3", ["--mode", "reduced"])]
    body = [[name] + [mean(windows, options) for windows in ("2", "5", "10", "20", "50", "100")] for name, options in ours]
    body.insert(0, ["full, reference (no pairs of old windows)", "9.0", "8.4", "7.7", "7.2", "6.0", "5.2"])
    body.insert(2, ["reduced, reference (window end judged)", "10.5", "14.2", "14.7", "14.7", "14.2", "12.1"])
    return markdown(["window", "5", "2", "1", "0.5", "0.2", "0.1"], body)


STIFFNESS = {"10": "0.001", "100": "0.1", "316": "1", "1000": "10"}


def stages_rows(*options):
    """n -> solver -> evaluations, iterations per stage, error."""
    found = {}
    for n, solver, evaluations, iterations, error in re.findall(
            r"^ *(\d+) +[\d.]+ (\S+) +(\d+) +([\d.]+) +(\S+) ", program("stages", *options), re.M):
        found.setdefault(n, {})[solver] = evaluations, iterations, error
    return [(n, found[n]) for n in STIFFNESS]


def stages():
    solvers = ("plain", "Anderson", "quasi-Newton", "Newton", "Newton-blind")
    return markdown(["n, stiffness", "plain", "Anderson", "quasi-Newton, pairs kept", "Newton, pattern known", "Newton, pattern unknown"],
                    [[n + ", " + STIFFNESS[n]] + ["diverges" if row[solver][2] == "diverges" else row[solver][0] for solver in solvers]
                     for n, row in stages_rows()])


def stages_linear():
    return markdown(["n, stiffness", "quasi-Newton, 15 pairs", "Newton, band solver"],
                    [[n + ", " + STIFFNESS[n]] + ["%s, %s, %.1e" % (row[solver][0], row[solver][1], float(row[solver][2]))
                                                  for solver in ("quasi-Newton", "Newton")]
                     for n, row in stages_rows("--K", "0", "--once", "1")])


def remesh():
    found = [{key: re.search(r"^%s (\d+)$" % key, program("remesh", "--carry", carry), re.M).group(1) for key in ("worst_jump", "iterations")}
             for carry in ("1", "0")]
    return markdown(["", "all is carried over", "each mesh starts anew, `--carry 0`"],
                    [["most iterations more in the first window after a change"] + [row["worst_jump"] for row in found],
                     ["iterations in all windows"] + [row["iterations"] for row in found]])


def manufactured():
    """Largest errors of the coupled run, beside those of the paper."""
    published = {"gauss2": {"1": "1.288e-6", "2": "4.845e-7", "4": "6.666e-8", "8": "6.993e-9", "16": "6.507e-10"},
                 "gauss3": {"1": "7.129e-8", "2": "7.603e-10", "4": "5.217e-11"}}

    def cells(method, degree, windows):
        if windows not in published[method]:
            return ["", ""]
        out = program("manufactured", "--method", method, "--degree", degree, "--windows", windows)
        error = float(re.search(r"^e_A (\S+)", out, re.M).group(1))
        return [published[method][windows], re.sub(r"e-0*", "e-", "%.3e" % error)]
    return markdown(["windows", "Gauss 2, degree 3: published", "here", "Gauss 3, degree 5: published", "here"],
                    [[windows] + cells("gauss2", "3", windows) + cells("gauss3", "5", windows) for windows in ("1", "2", "4", "8", "16")])


def gark():
    """Observed orders of the step, of its pair and inside the step."""
    names_ = {"sg2": "Sandu & Günther 2015, example 6", "exim3": "Sarshar, Roberts & Sandu 2019, order 3(2)",
              "exim4": "the same, order 4(3)", "ark2": "ark2 of rk.h in this form", "ark3": "ark3", "ark4": "ark4", "ark5": "ark5"}
    body = []
    for method, name in names_.items():
        out = program("gark", "--method", method)

        def found(key):
            hit = re.search(r"^%s (\S+)" % key, out, re.M)
            return "%.2f" % float(hit.group(1)) if hit else "-"
        stages_ = re.search(r"^stages (\d+) explicit, (\d+) implicit", out, re.M)
        body.append([name, "%s, %s" % stages_.groups(), found("observed_order"), found("observed_pair"), found("observed_dense")])
    return markdown(["method", "stages E, I", "step", "pair", "inside the step"], body)


def stiff_rows():
    """The rows of make scipy: (problem, tolerance) -> table -> (f, factors, error); the lines of means."""
    table, means = {}, []
    for line in read("study", "stiff.txt").splitlines():
        word = line.split()
        if " over SciPy: " in line:
            means.append(re.match(r"(\S+) +over SciPy: evaluations (\S+) factors (\S+) error (\S+); largest error (\S+)", line).groups())
        elif word[0] != "problem":
            error = word[-1] if re.match(r"[\d.]", word[-1]) else "gives up"
            table.setdefault((word[0], "1e-%d" % -round(math.log10(float(word[2])))), {})[word[1]] = "%s, %s, %s" % (word[3], word[5], error)
    return table, means


def stiff():
    methods = ("radau5", "radau9", "esdirk3", "esdirk5", "SciPy")
    return markdown(["", *methods], [["%s, %s" % key] + [row.get(method, "-") for method in methods] for key, row in stiff_rows()[0].items()])


def stiff_means():
    return markdown(["over SciPy's Radau, geometric mean", "evaluations", "factors", "error", "largest error"],
                    [["radau5 above 1e-5, radau9 below" if mean[0] == "radau5/9" else mean[0], *mean[1:4], "gives up" if mean[4] == "inf" else mean[4]]
                     for mean in stiff_rows()[1]])


def which_rows():
    """The list "Which one" of rk.h: problem, tables."""
    with open("rk.h") as f:
        found = re.search(r"      Which one:\n(.*?)\n\n", f.read(), re.S).group(1)
    return [re.split(r"  +", line.strip(), maxsplit=1) for line in found.splitlines()]


def which():
    return markdown(["problem", "tables of rk.h"], which_rows())


MULTIRATE = (("kpr", "KPR"), ("brusselator", "Brusselator"), ("springs", "springs"), ("exchange", "exchange"), ("kpr50", "KPR, w 50, G -5"),
             ("brusselator3", "Brusselator to 3"), ("springs100", "springs, 100 rad"), ("falling", "falling"))


def multirate_cells():
    """problem -> list of (by shares, decoupled), each (error, slow, fast, order); errors of runs that give up are infinite."""
    runs, cells = {}, {}
    for line in read("study", "multirate.txt").splitlines():
        word = line.split()
        runs[tuple(word[:4])] = (float("inf"), 1, 1, 1) if word[4] == "gives-up" else tuple(float(w) for w in word[4:8])
    for (problem, coupling, tolerance, control), run in runs.items():
        if control == "shares":
            cells.setdefault(problem, []).append((run, runs[problem, coupling, tolerance, "decoupled"]))
    return cells


def at_equal_error(cells, which):
    """Geometric mean of the work over that of decoupled control; the error goes with work^-order."""
    logs = [math.log(a[which] / b[which]) + math.log(a[0] / b[0]) / a[3] for a, b in cells if 0 < a[0] < math.inf and 0 < b[0] < math.inf]
    return "%.2f" % math.exp(sum(logs) / len(logs))


def rates():
    body = []

    def row(name, cells):
        def within(k):
            errors = [cell_[k][0] for cell_ in cells]
            return "%d: %.2g to %.2g" % (sum(error <= 1 for error in errors), min(errors), max(errors))
        body.append([name, str(len(cells)), within(1), within(0), str(sum(cell_[0][0] >= 0.05 for cell_ in cells)),
                     at_equal_error(cells, 1), at_equal_error(cells, 2)])
    cells = multirate_cells()
    for key, name in MULTIRATE:
        row(name, cells[key])
    row("all but falling", [cell_ for key, _ in MULTIRATE[:-1] for cell_ in cells[key]])
    return markdown(["problem", "runs", "decoupled: at most 1; range", "by shares: at most 1; range", "at least .05", "slow work", "fast work"], body)


def rates_inside():
    """KPR, H = 1/32: errors and orders at step ends, inside by the fast solves of the stages and by one more."""
    body = []
    for method in ("KW3", "ERK22a", "ERK33a", "ERK45a", "IRK21a", "ESDIRK34a", "ESDIRK46a", "SR21", "SR32", "SR43", "MERK21", "MERK32", "MERK43", "MERK54"):
        out = program("rates", "--problem", "kpr", "--method", method, "--inside", "1", "--hs", "0.0625")
        body.append([method] + ["%.1e, %.1f" % tuple(float(x) for x in re.search(r"^%s (\S+) (\S+)" % key, out, re.M).groups())
                                for key in ("at_ends", "inside_stages", "inside_more")])
    return markdown(["KPR, H = 1/32: error, order", "at step ends", "inside, by the stages' fast solves", "by one more fast solve"], body)


def controllers():
    lines = [[part.strip() for part in line.split("|")] for line in program("peer_rk", "controllers").splitlines()[1:]]
    return markdown(["law", "evaluations", "best", "worst", "rejected", "power"], [row for row in lines if row[0] in ("PI", "I", "PID")])


blocks = {
    "extremes": extremes, "trouble-strong": trouble_strong, "trouble-windows": trouble_windows, "trouble-trials": trouble_trials,
    "machine": machine, "speed-iqn": iqn, "speed-rk": rk, "speed-waveform": waveform,
    "recommend": recommend, "speed-flags": speed_flags, "plain-double": plain_double, "rules": rules,
    "study-signals": study_signals, "knobs-waveform": knobs_waveform, "study-knobs": study_knobs, "study-squares": study_squares, "study-rk": study_rk,
    "study-bits": study_bits, "five": five, "one-sure": one_sure, "one-pulse": one_pulse, "sent": sent,
    "arena": arena, "arena-settings": arena_settings, "loops": loops, "several": several, "endings": endings, "public": public, "delayed": delayed, "tube-ways": tube_ways, "limits": limits,
    "scenes-delayed": scenes_delayed, "trapezoid": trapezoid, "delay": delay, "chain": chain, "fluxes": fluxes, "rain": rain, "windows": windows, "aquifer": aquifer, "aquifer-trials": aquifer_trials,
    "patch": patch, "tube-unknown": tube_unknown, "tube-guess": tube_guess, "tube-mean": tube_mean, "piston": piston,
    "manufactured": manufactured, "gark": gark, "rates": rates, "rates-inside": rates_inside, "stiff": stiff, "stiff-means": stiff_means, "which": which, "controllers": controllers,
    "stages": stages, "stages-linear": stages_linear, "remesh": remesh, "heat-counts": heat_counts, **card.blocks}


def write(path):
    """Whether the document is as the figures say; without --check it then is."""
    with open(path) as f:
        old = f.read()

    def block(match):
        if chosen and match.group(2) not in chosen:
            return match.group(0)
        try:
            return "%s\n%s\n<!-- end -->" % (match.group(1), "\n".join(blocks[match.group(2)]()))
        except (Missing, KeyError) as e:
            print("%s, %s: left as it is, no %s" % (path, match.group(2), e))
            return match.group(0)
    new = re.sub(r"(<!-- figures ([\w-]+) -->)\n.*?<!-- end -->", block, old, flags=re.S)
    if new == old:
        return True
    if check:
        print(path + ": its figures are not those of tests/study; make card writes them")
        return False
    with open(path, "w") as f:
        f.write(new)
    print(path + ": written")
    return True


def fresh(picture):
    """Whether a picture is drawn from the data and the script that are there."""
    with open(os.path.join("examples", picture)) as f:
        if card.stamp(picture) in f.read():
            return True
    print("examples/%s: not drawn from the data of tests/study; make card draws it" % picture)
    return False


as_said = [write(document) for document in DOCUMENTS]
if check:
    sys.exit(not all(as_said + [fresh(picture) for picture in card.PICTURES]))
