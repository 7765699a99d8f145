# SPDX-License-Identifier: MIT
"""kit_test.py - does kit.py do what its docstrings say?  A traceback where it does not."""
import ctypes

import numpy as np

import kit


def refused(kind, words, function, *arguments, **keywords):
    try:
        function(*arguments, **keywords)
    except kind as error:
        assert words in str(error), error
    else:
        raise AssertionError(f"not refused: {words}")


# A cubic is its own spline: values, derivatives, means; complex numbers; columns of a larger array.
t = np.array([0, 0.3, 0.5, 1.1, 1.6])
big = np.zeros((9, 7), complex)
w = kit.Waveform(3, 9, dtype=complex, x=big[:, 2:5])
f = lambda s: np.array([s**3, 1j * s**2, 2 - s + 1j])
for s in t:
    w.write(s, f(s))
assert np.allclose(big[:5, 2:5], [f(s) for s in t])
assert not big[:, :2].any() and not big[:, 5:].any()
assert np.allclose(w(0.7), f(0.7)) and np.allclose(w(0.7, deriv=1), [3 * 0.49, 1.4j, -1])
refused(ValueError, "fit first", w.eval, 0.7)
w.fit()
assert np.allclose(w.eval([0.7, 1.2]), [f(0.7), f(1.2)])
assert np.allclose(w.weights(0.7) @ w.samples, f(0.7)) and (w.times == t).all() and w.degree == 3
assert np.allclose(w.mean(0.2, 1.2), [(1.2**4 - 0.2**4) / 4, 1j * (1.2**3 - 0.2**3) / 3, 1.3 + 1j])
refused(kit.Error, "increase", w.push, 1.4)
assert (w.strict, w.sample_error) == (1, 0)
w.sample_error = 1e-9
assert w.sample_error == 1e-9
refused(ValueError, "fit first", w.eval, 0.7)
w.sample_error = 0
refused(ValueError, "shape", w.eval, 0.7, out=np.zeros(2, complex))
other = kit.Waveform(3, 4, dtype=complex)
for s in 0, 0.4, 0.8, 1.6:
    other.push(s)
w.resample(other)
assert np.allclose(other.samples, [f(s) for s in (0, 0.4, 0.8, 1.6)])
before = w.save()
refused(kit.Error, "outside", w, 1.7)
w.advance(history=1)
assert w.columns == 2 and w.start == 1 and np.allclose(big[1, 2:5], f(1.6))
w.restore(before)
assert w.columns == 5 and np.allclose(w(0.7), f(0.7))

# A quadratic in t, read linearly between its samples: off by (s - a)(s - b) of the largest.
line = kit.Waveform(1, 4, degree=1)
for s in 0, 1, 2, 3:
    line.write(s, [s**2])
assert np.allclose(line.error(1.5), -0.25) and np.allclose(line.error(2), 0)

w.rollback()
later = kit.Waveform(1, 4, x=np.array([[5.0], [np.nan], [np.nan], [1]]), strict=False)
later.push(0)
later.begin([1, 2])
assert (later.x[:3] == 5).all() and later.x[3] == 1 and (later.times == [0, 1, 2]).all()
assert later(3) == 5
later.x[later.push_break(2)] = 7
assert later(2) == 5 and later.columns == 4 and np.allclose(later.mean(1, 2), 5)
refused(kit.Error, "last", later.push_break, 1)

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

# What is wrong is said; the arrays stay as they were.
refused(ValueError, "type complex128", q.step, x, np.zeros(4))
refused(ValueError, "no key", q.set, typing_error=1)
refused(kit.Error, "key takes", q.set, omega=np.nan)
refused(kit.Error, "finite", q.step, x, x * np.nan)
wrong, wf_error, z = ctypes.ArgumentError, kit.wf_error, np.zeros(3)
refused(wrong, "float64", wf_error, w.handle, 3, np.zeros(3, "f4"), 3, z)
refused(wrong, "contiguous", wf_error, w.handle, 3, np.zeros(6)[::2], 3, z)
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
