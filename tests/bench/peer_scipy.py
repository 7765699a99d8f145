# SPDX-License-Identifier: MIT
# peer_scipy.py anderson N M | rk N | spline N M fit|eval - laps of bench.h by SciPy
import statistics
import sys
import time

import numpy as np
import scipy

wanted = processor = 0
laps = []
begun = 0.0


def wait():
    global wanted, processor
    line = sys.stdin.readline().split()
    if len(line) != 2:
        sys.exit(0)
    wanted, processor = int(line[0]), int(line[1])
    laps.clear()


def begin():
    global begun
    begun = time.process_time() if processor else time.perf_counter()


def end(times=1):
    laps.append(((time.process_time() if processor else time.perf_counter()) - begun) / times)
    if len(laps) >= wanted:
        print(statistics.median(laps), flush=True)
        wait()


def hello():
    print("SciPy " + scipy.__version__, flush=True)
    wait()


def repeat(call, times):
    hello()
    while True:
        begin()
        for _ in range(times):
            call()
        end(times)


what, n = sys.argv[1], int(sys.argv[2])
random = np.random.default_rng(1)
if what == "anderson":
    from scipy.optimize import anderson
    called = False

    def residual(x):
        global called
        if called:
            end()
        else:
            hello()
        called = True
        h = random.uniform(-1, 1, n)
        begin()
        return h - x
    anderson(residual, np.zeros(n), M=int(sys.argv[3]), maxiter=10**9, f_tol=1e-300, line_search=None, tol_norm=lambda r: 1)
elif what == "rk":
    from scipy.integrate import RK45
    solver = RK45(lambda t, y: -y, 0, np.ones(n), 1e30, rtol=1e-3, atol=1e9, max_step=1e-7)
    repeat(solver.step, 1)
elif what == "spline":
    from scipy.interpolate import make_interp_spline
    m = int(sys.argv[3])
    t, x = np.linspace(0, 1, m), random.uniform(-1, 1, (m, n))
    s = make_interp_spline(t, x, k=3)
    repeat(lambda: make_interp_spline(t, x, k=3, check_finite=False) if sys.argv[4] == "fit" else s(0.47), 1)
