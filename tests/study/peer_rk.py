# SPDX-License-Identifier: MIT
# peer_rk.py - `peer_rk | python3 peer_rk.py`: SciPy's RK23, RK45 and DOP853 on the same problems at the same tolerances.
# Prints evaluations and errors of both, the ratio of evaluations for each pair of problem and table, summed over the tolerances.
import sys
import numpy as np
from scipy.integrate import solve_ivp

def brusselator(t, y):
    return [1 + y[0] * y[0] * y[1] - 4 * y[0], 3 * y[0] - y[0] * y[0] * y[1]]

def arenstorf(t, y):
    mu = 0.012277471
    nu = 1 - mu
    d = ((y[0] + mu) ** 2 + y[1] ** 2) ** 1.5
    e = ((y[0] - nu) ** 2 + y[1] ** 2) ** 1.5
    return [y[2], y[3], y[0] + 2 * y[3] - nu * (y[0] + mu) / d - mu * (y[0] - nu) / e,
            y[1] - 2 * y[2] - nu * y[1] / d - mu * y[1] / e]

def vanderpol(t, y):
    return [y[1], 5 * (1 - y[0] * y[0]) * y[1] - y[0]]

def hires(t, y):
    r = 280 * y[5] * y[7]
    return [-1.71 * y[0] + 0.43 * y[1] + 8.32 * y[2] + 0.0007, 1.71 * y[0] - 8.75 * y[1],
            -10.03 * y[2] + 0.43 * y[3] + 0.035 * y[4], 8.32 * y[1] + 1.71 * y[2] - 1.12 * y[3],
            -1.745 * y[4] + 0.43 * y[5] + 0.43 * y[6],
            -r + 0.69 * y[3] + 1.71 * y[4] - 0.43 * y[5] + 0.69 * y[6], r - 1.81 * y[6], -r + 1.81 * y[6]]

closed = [0.994, 0, 0, -2.00158510637908252240537862224]
problems = {
    'brusselator': (brusselator, 20, [1.5, 3], [0.498637071268347848649856, 4.59678034945201118320174]),
    'arenstorf': (arenstorf, 17.0652165601579625588917206249, closed, closed),
    'vanderpol': (vanderpol, 20, [2, 0], [-1.60129687954285390882168437713, 0.198326676338662084549513629203]),
    'hires': (hires, 321.8122, [1, 0, 0, 0, 0, 0, 0, 0.0057],
              [0.7371312573325668e-3, 0.1442485726316185e-3, 0.5888729740967575e-4, 0.1175651343283149e-2,
               0.2386356198831331e-2, 0.6238968252742796e-2, 0.2849998395185769e-2, 0.2850001604814231e-2]),
}
methods = {'bs3': 'RK23', 'dp5': 'RK45', 'dop853': 'DOP853'}
sums = {}
print('%-12s %-7s %-6s | rk.h %8s %9s | SciPy %8s %9s | ratio' % ('problem', 'table', 'tol', 'evals', 'error', 'evals', 'error'))
for line in sys.stdin:
    name, table, tol, evaluations, steps, rejected, error = line.split()
    f, end, y0, exact = problems[name]
    s = solve_ivp(f, (0, end), y0, method=methods[table], rtol=float(tol), atol=float(tol))
    theirs = np.max(np.abs(s.y[:, -1] - exact))
    print('%-12s %-7s %-6s | %13s %9s | %14d %9.3e | %.3f' % (name, table, tol, evaluations, error, s.nfev, theirs, int(evaluations) / s.nfev))
    a, b = sums.get((name, table), (0, 0))
    sums[name, table] = a + int(evaluations), b + s.nfev
worst = 0
for (name, table), (a, b) in sums.items():
    print('%-12s %-7s all tolerances: evaluations / SciPy %.3f' % (name, table, a / b))
    worst = max(worst, a / b)
print('largest ratio %.3f' % worst)
sys.exit(worst > 1.05)
