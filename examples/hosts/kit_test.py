# SPDX-License-Identifier: MIT
"""kit_test.py - does kit.py do what its docstrings say?  A traceback where it does not."""
import ctypes
import warnings

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

# The core with vectors that Python keeps: the iterations of QN; in float32, in a metric.
one = np.arange(1.0, 201) / 200
kernel = 0.495 / 200 * one[:, None] / (one[:, None] + one)
for kind, metric in (float, None), ("f4", None), (float, lambda a: one * a):
    runs = [(kit.QN(200, tol=1e-6), np.ones(200)),
            (kit.Core(200, tol=1e-6, dtype=kind, metric=metric), np.ones(200, kind))]
    for mine, y in runs:
        while not mine.step(y, 1 / (1 - kernel.astype(y.dtype) @ y)):
            pass
    assert np.allclose(runs[0][1], runs[1][1], rtol=1e-4), kind
    assert abs(runs[0][0].iterations - runs[1][0].iterations) <= 1, kind

# What is wrong is said; the arrays stay as they were.
refused(ValueError, "type complex128", q.step, x, np.zeros(4))
refused(ValueError, "no key", q.set, typing_error=1)
refused(kit.Error, "key takes", q.set, omega=np.nan)
refused(kit.Error, "finite", q.step, x, x * np.nan)
wrong, wf_read = ctypes.ArgumentError, kit.wf_read
refused(wrong, "float64", wf_read, w.handle, 0.5, 0, np.zeros(3, "f4"))
refused(wrong, "contiguous", wf_read, w.handle, 0.5, 0, np.zeros(6)[::2])
refused(TypeError, "no table", kit.Table, "rk5")
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

# Every table by its name; a step and its dense output.
tables, names = kit.rk_tables(), []
while tables[len(names)].name:
    names.append(tables[len(names)].name.decode())
assert len(names) == 37 and "dp5" in names
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
