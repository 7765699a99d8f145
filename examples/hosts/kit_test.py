# SPDX-License-Identifier: MIT
"""kit_test.py - does kit.py do what its docstrings say?  A traceback where it does not."""
import copy
import ctypes
import os
import pickle
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import warnings
from pathlib import Path

import numpy as np

import kit


def refused(kind, words, function, *arguments, **keywords):
    try:
        function(*arguments, **keywords)
    except kind as error:
        assert words in str(error), error
    else:
        raise AssertionError(f"not refused: {words}")


# A cubic is its own spline: values, derivatives, means; complex numbers.
t = np.array([0, 0.3, 0.5, 1.1, 1.6])
w = kit.Waveform(3, 9, dtype=complex)
f = lambda s: np.array([s**3, 1j * s**2, 2 - s + 1j])
for s in t:
    w.write(s, f(s))
x = w.x  # stays where it is
assert np.allclose(x[:5], [f(s) for s in t]) and not x[5:].any()
assert np.allclose(w(0.7), f(0.7)) and np.allclose(w(0.7, deriv=1), [3 * 0.49, 1.4j, -1])
assert np.allclose(w([0.7, 1.2]), [f(0.7), f(1.2)])
assert np.allclose(w.weights(0.7) @ w.samples, f(0.7)) and (w.times == t).all() and w.degree == 3
assert np.allclose(w.mean(0.2, 1.2), [(1.2**4 - 0.2**4) / 4, 1j * (1.2**3 - 0.2**3) / 3, 1.3 + 1j])
refused(kit.Error, "increase", w.push, 1.4)
refused(ValueError, "shape", w, 0.7, out=np.zeros(2, complex))
other = kit.Waveform(3, 4, dtype=complex)
for s in 0, 0.4, 0.8, 1.6:
    other.push(s)
w.resample(other)
assert np.allclose(other.samples, [f(s) for s in (0, 0.4, 0.8, 1.6)])
before = w.save()
refused(kit.Error, "outside", w, 1.7)
w.advance(history=1)
assert w.columns == 2 and w.start == 1 and np.allclose(x[1], f(1.6))
w.restore(before)
assert w.columns == 5 and np.allclose(w(0.7), f(0.7))

# No coefficients are stale: a read sees what was written, a spline is what it was.
spline = w.fit()
x[2] += 1
assert np.allclose(spline(0.5), f(0.5)) and np.allclose(spline([0.5, 0.7]), [f(0.5), f(0.7)])
assert np.allclose(w(0.5), f(0.5) + 1) and np.allclose(w([0.5]), [f(0.5) + 1])
w.rollback()
assert np.allclose(spline(0.7, deriv=1), [3 * 0.49, 1.4j, -1])
raw, c = kit.Waveform(1, 4), np.empty(4)
for s in 0, 1, 2:
    raw.push(s)
kit.wf_fit(raw.handle, c)
raw.push(3)
refused(kit.Error, "changed", kit.wf_eval, raw.handle, 0.5, 0, c, np.empty(1))

# A quadratic in t, read linearly between its samples: off by a quarter.
line = kit.Waveform(1, 9, degree=1)
for s in range(9):
    line.write(s, [s**2])
assert np.allclose(line.error(), 0.25, rtol=0.5)
alone = kit.Waveform(0, 2, degree=1)
alone.push(0), alone.push(2)
assert np.allclose(alone.weights(0.5), [0.75, 0.25])

later = kit.Waveform(1, 4, strict=False)
later.write(0, 5)
later.begin([1, 2])
assert (later.samples == 5).all() and (later.times == [0, 1, 2]).all()
later.write(2, 7, jump=True)
assert later(2) == 5 and later.columns == 4 and np.allclose(later.mean(1, 2), 5)
refused(kit.Error, "last", later.push, 1, kit.WF_BREAK)

# Samples with slopes: two of them make a cubic.  Remarks are warnings, once for each kind.
bent = kit.Waveform(1, 4, strict=False)
bent.write(0, 0, slope=0)
bent.write(2, 8, slope=12)
with warnings.catch_warnings(record=True) as told:
    warnings.simplefilter("always")
    assert np.allclose(bent(0.7), 0.7**3) and np.allclose(bent([1.1]), 1.1**3) and not told
    assert np.allclose([bent(3)[0], bent(4)[0]], [27, 64]) and np.allclose(bent([3, 5]), [[27], [125]])
    assert [w.category for w in told] == [kit.Remark] and "outside" in str(told[0].message)
    kit.QN(2).push(np.zeros(2), np.ones(2))
    T, y = kit.Table("dp5"), np.ones(1)
    for _ in range(2):
        T.eval(1.5, 0.1, y, np.zeros((T.stages, 1)))
    assert len(told) == 3 and {w.category for w in told} == {kit.Remark}, told

# A history for guesses alone; a copy; the degree with the least estimated error.
w = kit.Waveform(1, 40)
for s in np.linspace(0, 2, 21):
    w.write(s, np.sin(s))
w.advance(12)
w.begin(np.linspace(2.1, 3, 10), degree=kit.WF_AUTO)
w.unknowns[:, 0] = np.sin(w.times[w.start + 1 :])
twin = kit.Waveform(1, 40)
twin.copy(w)
w.restrict(2, 0)
assert (twin.samples == w.samples).all() and (w.degree, twin.degree) == (2, 3)
x = w.x[0].copy()
w.x[0] += 1
assert w(2.55) == w(2.55) and np.allclose(w(2.5), np.sin(2.5), atol=1e-3)
before = w(2.55)
w.x[0] = x
assert w(2.55) == before  # no older sample takes part
estimates = twin.choose()
assert len(estimates) == 4 and twin.degree == estimates.argmin()

# A complex affine map of 4 numbers, 8 real ones: at most 8 + 2 evaluations; what was committed
# helps the second time.
rng = np.random.default_rng(1)
G = 0.2 * (rng.normal(size=(4, 4)) + 1j * rng.normal(size=(4, 4)))
exact = np.linalg.solve(np.eye(4) - G, np.ones(4))
q = kit.QN(4, tol=1e-12, dtype=complex, method="ils")
x = np.zeros(4, complex)
while not q.step(x, G @ x + 1):
    pass
assert np.allclose(x, exact, atol=1e-9)
assert q.iterations <= 10 and q.relative <= 1e-12, (q.iterations, q.relative)
v, u = q.pair(0)
assert np.allclose(u, G @ np.linalg.solve(G - np.eye(4), v)) and q.commit() <= 10
saved, x[:] = q.save(), exact + 1
while not q.step(x, G @ x + 1):
    pass
again = q.iterations
q.restore(saved)
assert again <= 4 and q.iterations == 0 and np.allclose(x, exact, atol=1e-9), again

# Limits of every kind, over all and for blocks: each ends at the first step that meets it.
A, b = np.diag([0.9, -2, 0.5, 0.3, -0.7]) + 0.1, np.arange(1.0, 6)
for limits, blocks, met in (
        (dict(tol=1e-6), {}, lambda q: q.relative <= 1e-6),
        (dict(tol_absolute=1e-3), {}, lambda q: q.residual <= 1e-3),
        (dict(tol_reduction=1e-4), {}, lambda q: q.reduction <= 1e-4),
        ({}, dict(A=dict(tol_relative=1e-7), B=dict(tol_absolute=1e-2)),
         lambda q: q.get_block("A", "relative") <= 1e-7 and q.get_block("B", "residual") <= 1e-2)):
    q, x = kit.QN(5, blocks=dict(A=1, B=4), **limits), np.zeros(5)
    for name, limit in blocks.items():
        q.set_block(name, **limit)
    kept = []
    while not q.step(x, A @ x + b):
        kept.append(met(q))
    assert met(q) and q.converged and len(kept) > 2 and not any(kept), (limits, blocks)

# What the steps were, as records, in the log files that preCICE has, and in a picture.
folder = tempfile.TemporaryDirectory()
os.chdir(folder.name)
q, x = kit.QN(5, tol=1e-9, blocks=dict(Force=2, Motion=3), log="Solid"), np.zeros(5)
q.set_block("Motion", scaling="by_value")
runs = []
for window in 1, 2:
    start = q.save()
    while not q.step(x, A @ x + window * b):
        pass
    if window == 2:  # the window again, as if it had not been
        steps = len(q.history)
        q.restore(start)
        assert (len(q.history), q.window, q.iterations) == (runs[0], 2, 0)
        q.step(x, A @ x + window * b)
    runs.append(q.commit())
steps = [(s.window, s.iteration) for s in q.history]
assert steps == [(1, k + 1) for k in range(runs[0])] + [(2, 1)] and runs[0] <= 7
last = q.history[runs[0] - 1]
assert last.what == "converged: x = hx" and last.relative <= 1e-9 < q.history[1].relative
assert len(last.parts) == 2 and min(last.parts) <= last.relative <= max(last.parts)
assert [s.pairs for s in q.history][:3] == [0, 1, 2] and "relaxed" in q.history[0].what
iterations, convergence = (Path(f"precice-Solid-{name}.log").read_text().splitlines()
                           for name in ("iterations", "convergence"))
assert iterations[0].split() == ["TimeWindow", "TotalIterations", "Iterations", "Convergence",
                                 "QNColumns", "DeletedQNColumns", "DroppedQNColumns"]
assert iterations[1].startswith("     1  %6d  %6d       1  " % (runs[0], runs[0])), iterations
assert [len(line.split()) for line in iterations] == [7, 7, 7] and len(convergence) > runs[0] + 2
assert convergence[0] == "  TimeWindow  Iteration  ResRel(Force)  ResRel(Motion)"
assert np.allclose([float(c) for c in convergence[runs[0]].split()], [1, runs[0], *last.parts])
try:
    import matplotlib
except ImportError:
    matplotlib = None
if matplotlib:
    matplotlib.use("svg")
    left, right = kit.plot(q, labels=["tube"], file="run.svg").axes
    assert list(left.lines[0].get_ydata()) == runs and os.path.getsize("run.svg") > 1000
    assert np.allclose(right.lines[0].get_ydata(), [s.relative for s in q.history])

# A solver that fails: half of the way back.
for make in kit.QN, kit.Core:
    q, x, hx = make(*[2] * (make is kit.QN), omega=1), np.zeros(2), np.array([4.0, 8.0])
    x = q.step(x, hx) if make is kit.Core else (q.step(x, hx), x)[1]
    y = q.halve(x.copy())
    assert np.allclose(x, hx) and (make is kit.QN or np.allclose(y, [2, 4]))


# The core, for vectors that Python keeps: the iterations of QN for arrays of one and two axes, in
# float32, in a metric, complex, in blocks, and for a class that has @, + and * alone.
class Only:
    __slots__ = ("_a",)

    def __init__(self, a):
        self._a = a

    def __add__(self, other):
        return Only(self._a + other._a)

    def __rmul__(self, number):
        assert type(number) is float
        return Only(number * self._a)

    def __matmul__(self, other):
        return float(self._a @ other._a)


def run(q, H, x):
    while not q.converged:
        x = q.step(x, H(x))
    return x


one = np.arange(1.0, 201) / 200
kernel = 0.495 / 200 * one[:, None] / (one[:, None] + one)
H = lambda y: 1 / (1 - kernel.astype(y.dtype) @ y)
q, exact = kit.QN(200, tol=1e-6), np.ones(200)
while not q.step(exact, H(exact)):
    pass
alike = {
    "double": (kit.Core(tol=1e-6), H, np.ones(200)),
    "float32": (kit.Core(tol=1e-6), H, np.ones(200, "f4")),
    "metric": (kit.Core(tol=1e-6, metric=lambda a: one * a), H, np.ones(200)),
    "two axes": (kit.Core(tol=1e-6), lambda x: H(x.ravel()).reshape(10, 20), np.ones((10, 20))),
    "inner": (kit.Core(tol=1e-6, inner=lambda a, b: (a * b).sum()), H, np.ones(200)),
    "ranks": (kit.Core(tol=1e-6, inner=lambda a, b: 0.5 * (a @ b),
                       allreduce=lambda v: np.multiply(v, 2, out=v)), H, np.ones(200)),
    "only": (kit.Core(tol=1e-6), lambda x: Only(H(x._a)), Only(np.ones(200))),
}
with warnings.catch_warnings():  # arrays that have no more than the standard asks for
    warnings.simplefilter("ignore")
    try:
        import numpy.array_api as strict  # NumPy 1.22 to 1.26
    except ImportError:
        strict = None
if strict:
    alike["array API"] = (kit.Core(tol=1e-6), lambda x: strict.reshape(strict.asarray(
        H(np.asarray(strict.reshape(x, (-1,))._array))), (10, 20)), strict.ones((10, 20)))
for name, (mine, function, x) in alike.items():
    x = run(mine, function, x)
    x = getattr(x, "_a", getattr(x, "_array", x))
    assert np.allclose(np.ravel(x), exact, rtol=1e-4), name
    assert abs(mine.iterations - q.iterations) <= 1, (name, mine.iterations, q.iterations)
    assert name == "metric" or np.isclose(mine.history[0].residual, q.history[0].residual), name
assert alike["float32"][0].x.dtype == np.float32
assert alike["float32"][0].noise_level == 1e-7 and alike["double"][0].noise_level < 1e-12

# Complex numbers and two blocks, beside the same in QN; a window after a commit, a checkpoint.
exact = np.linalg.solve(np.eye(4) - G, np.ones(4))
q = kit.Core(tol=1e-12, blocks=["Force", "Motion"])
H = lambda x: tuple(np.split(G @ np.concatenate(x) + 1, [1]))
q.set_block("Motion", weight=2)
x = run(q, H, (np.zeros(1, complex), np.zeros(3, complex)))
assert np.allclose(np.concatenate(x), exact, atol=1e-9) and q.iterations <= 10
assert len(q.history[-1].parts) == 2 and q.commit() <= 10
saved = q.save()
x = run(q, H, (x[0] + 1, x[1]))
first = q.iterations
q.restore(saved)
y = run(q, H, (exact[:1] + 1, exact[1:]))
assert q.iterations <= first + 1 and np.allclose(np.concatenate(y), exact, atol=1e-9)
refused(ValueError, "2 vectors", q.step, (x[0],), (x[0],))
refused(kit.Error, "finite", q.step, x, (x[0] * np.nan, x[1]))

# What is wrong is said; the arrays stay as they were.
q, x = kit.QN(4, dtype=complex), np.ones(4, complex)
refused(ValueError, "type complex128", q.step, x, np.zeros(4))
refused(ValueError, "no key", q.set, typing_error=1)
refused(kit.Error, "key takes", q.set, omega=np.nan)
refused(kit.Error, "finite", q.step, x, x * np.nan)
wrong, wf_read = ctypes.ArgumentError, kit.wf_read
refused(wrong, "float64", wf_read, w.handle, 0.5, 0, np.zeros(3, "f4"))
refused(wrong, "contiguous", wf_read, w.handle, 0.5, 0, np.zeros(6)[::2])
refused(ValueError, "no table", kit.Table, "rk5")
refused(ValueError, "out of range", kit.QN, -5)
stuck, x = kit.QN(1, tol=1e-9, patience=5), np.ones(1)
try:
    for i in range(20):
        stuck.step(x, x + 1 + 0.1 * (-1.0) ** i)
    raise AssertionError("not given up")
except kit.GaveUp as error:
    assert "iterations" in str(error) and "IQN_PATIENCE" in str(error)
few, x = kit.QN(1, tol=1e-9, max_iterations=2), np.ones(1)
try:
    for i in range(3):
        few.step(x, 1 - 0.5 * np.sin(x) ** 2)
    raise AssertionError("not given up")
except kit.GaveUp as error:
    assert "max_iterations" in str(error)
two, sums = kit.QN(2, blocks=[1, 1], tol=1e-9), []
two.set_block(1, weight=0)
assert two.get_block(1, "weight") == 0 and two.get_block(0, "weight") == 1
two.set_sum(lambda total: sums.append(len(total)))
two.step(np.zeros(2), np.ones(2))
assert sums and two.iterations == 1

# Attributes that do not exist are refused; keys are set; words and types have sentences.
q = kit.QN(3, tol=1e-10)
q.tol_relative = 1e-3
assert q.tol_relative == 1e-3 == kit.iqn_get(q.handle, kit.IQN_TOL_RELATIVE)
q.method = "aitken"
assert q.method == kit.IQN_AITKEN
for thing, name in (q, "tolrelative"), (w, "degre"), (w.fit(), "y"), (kit.Table("dp5"), "B"), (kit.Core(), "omga"):
    refused(AttributeError, f"no attribute {name}", setattr, thing, name, 1)
refused(kit.Error, "no such key", setattr, q, "pairs", 1)
refused(ValueError, "tol_relative: a number, or a word", kit.QN, 3, tol="small")
refused(ValueError, "not 'fast'", q.set, method="fast")
refused(ValueError, "no block 'Force'", q.set_block, "Force", weight=0)
refused(TypeError, "not list", q.step, [0.0] * 3, np.zeros(3))


class Mine(kit.QN):  # a class of a user's own has attributes of its own
    def __init__(self):
        super().__init__(2)
        self.name = "mine"


assert Mine().name == "mine"

# All of an object can be copied and kept in a file; copies go on with the same bits.
for q in kit.QN(5, columns=9, blocks=dict(A=1, B=4)), kit.Core(columns=9):
    x = np.zeros(5)
    take = (lambda q, x: q.step(x, A @ x + b)) if type(q) is kit.QN else (
        lambda q, x: np.copyto(x, q.step(x.copy(), A @ x + b)))
    for _ in range(3):
        take(q, x)
    twins = [copy.copy(q), copy.deepcopy(q), pickle.loads(pickle.dumps(q))]
    xs = [x.copy() for _ in twins]
    take(q, x)
    for twin, y in zip(twins, xs):
        assert twin.iterations == 3
        take(twin, y)
        assert (x == y).all() and twin.history == q.history and twin.handle.value != q.handle.value
q = kit.QN(2)
q.set_sum(np.negative)  # a function with a name can be pickled
assert pickle.loads(pickle.dumps(q))._function is np.negative
line = kit.Waveform(1, 9, degree=1)
line.write(0, 0), line.write(1, 3)
twin, spline = pickle.loads(pickle.dumps(line)), copy.deepcopy(line.fit())
line.x[1] = 5
assert line(0.5) == 2.5 and twin(0.5) == 1.5 and spline(0.5) == 1.5
twin.write(2, 9)
assert twin.columns == 3 and line.columns == 2
assert (pickle.loads(pickle.dumps(kit.Table("radau_iia", 3))).A == kit.Table("radau_iia", 3).A).all()

# Many times are one call.
smooth, times = kit.Waveform(3, 40), np.linspace(0, 3, 4001)
for s in np.linspace(0, 3, 31):
    smooth.write(s, np.sin(s + np.arange(3)))
spline = smooth.fit()
assert np.allclose(spline(times), np.sin(times[:, None] + np.arange(3)), atol=1e-5)
assert spline(times.reshape(-1, 1)[::2]).shape == (2001, 1, 3) and (spline(times[::-1]) == spline(times)[::-1]).all()
refused(kit.Error, "outside", spline, [0.5, 3.5])
if hasattr(kit._library, "kit_many"):
    with smooth._lock:
        calls = lambda: [kit.wf_eval(spline.handle, t, 0, spline.c, np.empty(3)) for t in times]
        spent = []
        for function in (lambda: spline(times)), calls:
            start = time.perf_counter()
            function()
            spent.append(time.perf_counter() - start)
    print(f"a read of many times: {spent[0] / spent[1]:.3f} of single calls")

# Threads that share an object wait for each other: no step is lost, none refused.
q, shared, lost = kit.QN(1000, tol=0, columns=20, patience=0), np.zeros(1000), []


def many():
    try:
        for _ in range(50):
            y = np.random.default_rng().normal(size=1000)
            q.step(y, 0.5 * np.cos(y))
            q.iterations, q.get_block(0, "relative"), q.save()
    except Exception as error:
        lost.append(error)


threads = [threading.Thread(target=many) for _ in range(4)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
assert not lost and q.nsteps == 200 == len(q.history), (lost, q.nsteps)

# SciPy's calling convention; beside SciPy itself, where it is.
found = kit.fixed_point(np.cos, 1.0, tol=1e-12)
assert found.success and abs(found.x - 0.7390851332151607) < 1e-11 and found.nfev == found.nit < 9
assert np.ndim(found.x) == 0 and "converged" in found.message and abs(found.fun) < 1e-11
seen = []
found = kit.fixed_point(lambda x, c: G @ x + c, np.zeros((2, 2), complex).reshape(4), (1,),
                        callback=lambda x, r: seen.append(np.linalg.norm(r)))
assert np.allclose(found.x, exact, atol=1e-6) and len(seen) == found.nfev and seen[-1] < 1e-7
found = kit.fixed_point(lambda x: x + 1 + 0.1 * np.cos(37 * x), np.ones(2), patience=5)
assert not found.success and "IQN_PATIENCE" in found.message
found = kit.fixed_point(lambda x: np.where(x > 3, np.nan, 2 * np.sqrt(x)), np.array([1.0]), omega=9)
assert found.success or found.nfev < 500  # NaN on the way: it goes back, or says so
with np.errstate(invalid="ignore"):
    logarithm = kit.fixed_point(lambda x: 3 + np.log(x), np.array([8.0]), omega=3)
assert logarithm.success and abs(logarithm.x[0] - 4.505241495792883) < 1e-6  # through NaN


def enough(x, r):
    raise StopIteration


stopped = kit.fixed_point(np.cos, 1.0, callback=enough)
assert not stopped.success and stopped.nfev == 1 and stopped.x == 1
chandrasekhar = lambda y: y - 1 / (1 - 0.5 * 2 * kernel @ y)
found = kit.root(chandrasekhar, np.ones(200), alpha=-1, tol=1e-10)
assert found.success and np.linalg.norm(chandrasekhar(found.x)) <= 1e-9
assert (found.fun == chandrasekhar(found.x)).all() or np.allclose(found.fun, chandrasekhar(found.x), atol=1e-14)
try:
    from scipy import optimize
except ImportError:
    optimize = None
if optimize:
    print("| SciPy: calls of H to 1e-8 | kit.fixed_point | fixed_point | kit.root | anderson | broyden1 |")
    print("|---|---|---|---|---|---|")
    m = (np.arange(200) + 0.5) / 200
    dense = 0.4975 / 200 * m[:, None] / (m[:, None] + m)
    laplace = lambda x: 0.5 * (np.roll(x, 1) + np.roll(x, -1)) * np.r_[0, np.ones(38), 0]
    problems = {"cos": (np.cos, np.array([1.0])),
                "H equation": (lambda y: 1 / (1 - dense @ y), np.ones(200)),
                "diffusion": (lambda x: laplace(x) + 0.01 * np.cos(x), np.zeros(40))}
    for name, (function, start) in problems.items():
        row, count, limit = [name], [0], 1e-8

        def H(x):
            count[0] += 1
            return function(x)

        answers = []
        for solve in (lambda: kit.fixed_point(H, start, tol=limit).x,
                      lambda: optimize.fixed_point(H, start, xtol=limit, maxiter=500),
                      lambda: kit.root(lambda x: H(x) - x, start, alpha=1, tol=limit).x,
                      lambda: optimize.anderson(lambda x: H(x) - x, start, f_tol=limit, maxiter=500),
                      lambda: optimize.broyden1(lambda x: H(x) - x, start, f_tol=limit, maxiter=500)):
            count[0] = 0
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    answers.append(solve())
                row.append(str(count[0]))
            except Exception:
                row.append("fails")
        print("|", " | ".join(row), "|")
        assert all(np.allclose(a, answers[0], rtol=1e-5, atol=1e-5) for a in answers)
        assert int(row[1]) <= min(int(c) for c in row[4:] if c != "fails") + 2, row

# Headers of another version are refused by name; so is a library made of them.
other = Path(folder.name) / "other"
other.mkdir()
headers = Path(kit.__file__).resolve().parents[2]
if (headers / "iqn.h").exists():
    shutil.copy(kit.__file__, other / "kit.py")
    for name in "waveform.h", "rk.h":
        shutil.copy(headers / name, other)
    text = (headers / "iqn.h").read_text()
    (other / "iqn.h").write_text(re.sub(r"(_VERSION (!= )?)\d+", r"\g<1>40000", text))
    said = subprocess.run([sys.executable, "-c", "import kit"], cwd=other, text=True, capture_output=True,
                          env={k: v for k, v in os.environ.items() if k != "KIT_LIBRARY"}).stderr
    assert "made for iqn.h" in said and "has 4.0.0" in said, said

# Every table by its name; a step and its dense output.
tables, names = kit.rk_tables(), []
while tables[len(names)].name:
    names.append(tables[len(names)].name.decode())
assert len(names) == 39 and "dp5" in names
assert all(np.isclose(kit.Table(name).b.sum(), 1) for name in names)
radau = kit.Table("radau_iia", 2)
assert np.allclose(radau.A, [[5 / 12, -1 / 12], [3 / 4, 1 / 4]])
assert radau.order == 3 and radau.bhat is None
T = kit.Table("dp5")
y, k, err = np.array([1.0]), np.zeros((T.stages, 1)), np.empty(1)
for i in range(T.stages):
    k[i] = -T.stage(i, 0.1, y, k)
assert abs(T.finish(0.1, y, k, err=err)[0] - np.exp(-0.1)) < 1e-8 > abs(err[0])
assert abs(T.eval(0.5, 0.1, y, k)[0] - np.exp(-0.05)) < 1e-7
assert kit.rk_combine.__doc__.startswith("int rk_combine(double h, int slopes")
print("checks passed")

# What is written can be asked; monotone slopes keep a positive flux positive.
q = kit.Waveform(1, 20, degree=2)
for s, v in ((0, 0), (1, 0), (1.5, 4), (4, 4.1)):
    q.write(s, v, slope=0)
assert q.monotone() == 0 and q(np.linspace(0, 4, 99), 1).min() > -1e-12 and q.x[3] == 0
q.write(4, 9, slope=0, jump=True)
assert q.next_break(1) == 4 and q.next_break(4) == np.inf and q.valid_from == 0
assert q.whats[-2:] == [kit.WF_BREAK, kit.WF_BREAK | kit.WF_SLOPE] and q.whats[:2] == [0, kit.WF_SLOPE]
squares = np.empty(kit.WF_MISSES)
assert kit.wf_foretell(q.handle, squares) == 0
