# SPDX-License-Identifier: MIT
# peer_stiff.py - `stiff .. | python3 peer_stiff.py`: SciPy's Radau on the problems of examples/stiff.c that have no mass
# matrix, at the same tolerances.  Rows of both (f: without the differences of J; factors: a complex factorization counts as
# four), then for each table the geometric means over the cells that SciPy has: evaluations, factors and errors over SciPy's
# (of the errors the floor is .01 tolerances), and the largest error.  Exit 1: the goals of Radau IIA are missed.
import sys
import numpy as np
from scipy.integrate import solve_ivp


def vdpol(t, y):
    return [y[1], ((1 - y[0] ** 2) * y[1] - y[0]) / 1e-6]


def robertson(t, y):
    a, c = -.04 * y[0] + 1e4 * y[1] * y[2], 3e7 * y[1] ** 2
    return [a, -a - c, c]


def hires(t, y):
    r = 280 * y[5] * y[7]
    return [-1.71 * y[0] + .43 * y[1] + 8.32 * y[2] + .0007, 1.71 * y[0] - 8.75 * y[1], -10.03 * y[2] + .43 * y[3] + .035 * y[4],
            8.32 * y[1] + 1.71 * y[2] - 1.12 * y[3], -1.745 * y[4] + .43 * (y[5] + y[6]),
            -r + .69 * y[3] + 1.71 * y[4] - .43 * y[5] + .69 * y[6], r - 1.81 * y[6], 1.81 * y[6] - r]


rate = [.35, 26.6, 1.23e4, 8.6e-4, 8.2e-4, 1.5e4, 1.3e-4, 2.4e4, 1.65e4, 9e3, .022, 1.2e4, 1.88, 1.63e4, 4.8e6, 3.5e-4, .0175, 1e8,
        4.44e11, 1240, 2.1, 5.78, .0474, 1780, 3.12]
of = [(1,), (2, 4), (5, 2), (7,), (7,), (7, 6), (9,), (9, 6), (11, 2), (11, 1), (13,), (10, 2), (14,), (1, 6), (3,), (4,), (4,), (16,),
      (16,), (17, 6), (19,), (19,), (1, 4), (19, 1), (20,)]
by = [(-1, -10, -14, -23, -24, 2, 3, 9, 11, 12, 22, 25), (-2, -3, -9, -12, 1, 21), (-15, 1, 17, 19, 22), (-2, -16, -17, -23, 15),
      (-3, 4, 4, 6, 7, 13, 20), (-6, -8, -14, -20, 3, 18, 18), (-4, -5, -6, 13), (4, 5, 6, 7), (-7, -8), (-12, 7, 9), (-9, -10, 8, 11),
      (9,), (-11, 10), (-13, 12), (14,), (-18, -19, 16), (-20,), (20,), (-21, -22, -24, 23, 25), (-25, 24)]
S = np.zeros((20, 25))
for i, row in enumerate(by):
    for j in row:
        S[i, abs(j) - 1] += np.sign(j)


def pollution(t, y):
    return S @ np.array([c * np.prod([y[j - 1] for j in o]) for c, o in zip(rate, of)])


problems = {
    "vdpol": (vdpol, 2, 1, [2, 0], [1.706167732170483, -.8928097010247975]),
    "robertson": (robertson, 1e11, 1e-6, [1, 0, 0], [.2083340149701255e-7, .8333360770334713e-13, .9999999791665050]),
    "hires": (hires, 321.8122, 1e-2, [1, 0, 0, 0, 0, 0, 0, .0057], [.7371312573325668e-3, .1442485726316185e-3,
              .5888729740967575e-4, .1175651343283149e-2, .2386356198831331e-2, .6238968252742796e-2, .2849998395185769e-2,
              .2850001604814231e-2]),
    "pollution": (pollution, 60, 1e-3, [0, .2, 0, .04, 0, 0, .1, .3, .01] + 7 * [0] + [.007, 0, 0, 0],
                  [.5646255480022769e-1, .1342484130422339, .4139734331099427e-8, .5523140207484359e-2, .2018977262302196e-6,
                   .1464541863493966e-6, .7784249118997964e-1, .3245075353396018, .7494013383880406e-2, .1622293157301561e-7,
                   .1135863833257075e-7, .2230505975721359e-2, .2087162882798630e-3, .1396921016840158e-4, .8964884856898295e-2,
                   .4352846369330103e-17, .6899219696263405e-2, .1007803037365946e-3, .1772146513969984e-5,
                   .5682943292316392e-4])}


def scipy_row(name, rtol):
    f, end, scale, y0, exact = problems[name]
    s = solve_ivp(f, (0, end), y0, method="Radau", rtol=rtol, atol=rtol * scale)
    exact = np.array(exact)
    error = np.max(np.abs(s.y[:, -1] - exact) / (rtol * (scale + np.abs(exact))))
    return s.nfev, s.njev, 5 * s.nlu // 2, len(s.t) - 1, error


theirs, cells, worst = {}, {}, {}
for line in sys.stdin:
    print(line, end="")
    word = line.split()
    if word[0] == "problem":
        continue
    name, table, rtol = word[0], word[1], float(word[2])
    try:
        error = float(word[8])
    except ValueError:
        error = float("inf")  # a message
    worst[table, rtol] = max(worst.get((table, rtol), 0), error)
    if name not in problems:
        continue
    if (name, rtol) not in theirs:
        theirs[name, rtol] = scipy_row(name, rtol)
    f, _, factors, _, e = theirs[name, rtol]
    cells.setdefault(table, {})[name, rtol] = (int(word[3]) / f, int(word[5]) / factors, max(error, .01) / max(e, .01))
for (name, rtol), row in theirs.items():
    print("%-10s %-8s %-6g %8d %6d %8d %6d %9s %9.2g" % (name, "SciPy", rtol, *row[:4], "", row[4]))
if "radau5" in cells and "radau9" in cells:
    cells["radau5/9"] = {c: cells["radau9" if c[1] < 1e-5 else "radau5"][c] for c in cells["radau5"]}
    for rtol in {rtol for _, rtol in theirs}:
        worst["radau5/9", rtol] = worst["radau9" if rtol < 1e-5 else "radau5", rtol]
mean = {}
for table, found in cells.items():
    mean[table] = np.exp(np.mean(np.log(np.array(list(found.values()))), axis=0))
    print("%-8s over SciPy: evaluations %.2f factors %.2f error %.2f; largest error %.2g" %
          (table, *mean[table], max(w for (t, _), w in worst.items() if t == table)))
if "radau5/9" in mean:
    sys.exit(mean["radau5"][0] > 1 or mean["radau5/9"][0] > .8 or max(w for (t, _), w in worst.items() if t in ("radau5", "radau5/9")) > 3)
