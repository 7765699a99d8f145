# SPDX-License-Identifier: MIT
"""host.py - waveform.h, iqn.h and rk.h from Python by ctypes; NumPy owns the arrays, nothing is copied

The three headers become a shared library by one command:

    cc -O2 -shared -fPIC -DWF_IMPLEMENTATION -DIQN_IMPLEMENTATION -DRK_IMPLEMENTATION \\
       -x c waveform.h iqn.h rk.h -x none -llapack -lblas -lm -o libkit.so

Two masses between three springs, one solver each; both read the other's waveform, quasi-Newton closes the loop:

    u1'' + 20 pi^2 u1 = 16 pi^2 u2(t)    Runge-Kutta 4, 5 steps in a window
    u2'' + 20 pi^2 u2 = 16 pi^2 u1(t)    generalized-alpha, 100 steps in a window

The answer: the largest errors published by Rodenberg and Uekermann, arXiv 2511.07616 (2025), cubic, window 0.1."""
import ctypes
import sys
from ctypes import POINTER, byref, c_char_p, c_double, c_int, c_size_t, c_ssize_t, c_void_p
from math import cos, pi

import numpy as np

kit = ctypes.CDLL(sys.argv[1] if len(sys.argv) > 1 else "./libkit.so")
array = np.ctypeslib.ndpointer(np.float64, flags="C")  # checks type and layout, passes the address


class Table(ctypes.Structure):
    _fields_ = [("name", c_char_p)] + [(i, c_int) for i in "stages order order_hat dense dense_order extra".split()]
    _fields_ += [(p, POINTER(c_double)) for p in "A b c bhat e d".split()]


def declare(result, name, *arguments):
    function = getattr(kit, name)
    function.restype, function.argtypes = result, arguments
    if result is c_int:
        message = getattr(kit, name.split("_")[0] + "_message")
        message.restype = c_char_p
        function.errcheck = lambda status, *_: status if status >= 0 else fail(message(status).decode())
    return function


def fail(message):
    raise ValueError(message)


long, table = c_ssize_t, POINTER(Table)
wf_size = declare(c_size_t, "wf_size", c_int, c_int)
wf_make = declare(c_int, "wf_make", POINTER(c_void_p), c_int, c_int, array, c_size_t)
wf_push = declare(c_int, "wf_push", c_void_p, c_double)
wf_rollback = declare(c_int, "wf_rollback", c_void_p)
wf_advance = declare(c_int, "wf_advance", c_void_p, c_int, long, array, long)
wf_start = declare(c_int, "wf_start", c_void_p)
wf_fit = declare(c_int, "wf_fit", c_void_p, long, array, long, array, long)
wf_eval = declare(c_int, "wf_eval", c_void_p, c_double, c_int, long, array, long, array)
iqn_size = declare(c_size_t, "iqn_size", long, c_int, c_int)
iqn_make = declare(c_int, "iqn_make", POINTER(c_void_p), long, c_int, c_int, array, c_size_t)
iqn_set = declare(c_int, "iqn_set", c_void_p, c_int, c_double)
iqn_step = declare(c_int, "iqn_step", c_void_p, array, array)
iqn_converged = declare(c_int, "iqn_converged", c_void_p)
iqn_commit = declare(c_int, "iqn_commit", c_void_p)
rk_find = declare(table, "rk_find", c_char_p)
rk_stage = declare(c_int, "rk_stage", table, c_int, c_double, long, array, array, long, array)
rk_finish = declare(c_int, "rk_finish", table, c_double, long, array, array, long, array, c_void_p)
IQN_OMEGA, IQN_TOL_RELATIVE = 2, 8


class Waveform:
    """A time grid and its samples: row j of x is the header's column j."""

    def __init__(self, degree, capacity, n):
        self.n, self.grid, self.memory = n, c_void_p(), np.empty(wf_size(degree, capacity) // 8 + 1)
        self.x, self.c, self.out = np.zeros((capacity, n)), np.zeros((capacity, n)), np.zeros(n)
        wf_make(byref(self.grid), degree, capacity, self.memory, self.memory.nbytes)

    def write(self, t, value):
        self.x[wf_push(self.grid, t)] = value

    def fit(self):
        wf_fit(self.grid, self.n, self.x, self.n, self.c, self.n)

    def __call__(self, t):
        wf_eval(self.grid, t, 0, self.n, self.c, self.n, self.out)
        return self.out

    def rollback(self):
        wf_rollback(self.grid)

    def advance(self):
        wf_advance(self.grid, 0, self.n, self.x, self.n)

    def unknowns(self):  # a view: what an iteration changes, all samples behind the window start
        return self.x[wf_start(self.grid) + 1 :]


k12, k = 16 * pi**2, 20 * pi**2


def off(t, sign, u):
    return abs(u - (cos(2 * pi * t) + sign * cos(6 * pi * t)) / 2)


# A solver takes its state, the largest error so far included, and returns a new one: to roll back is to forget it.
def runge_kutta(state, t0, h, steps, read, out):
    T = rk_find(b"rk4")
    y, z, slope, error = np.array(state[:2]), np.zeros(2), np.zeros((T[0].stages, 2)), state[2]
    for j in range(steps):
        for i in range(T[0].stages):
            rk_stage(T, i, h, 2, y, slope, 2, z)
            slope[i] = z[1], k12 * read(t0 + j * h + T[0].c[i] * h)[0] - k * z[0]
        rk_finish(T, h, 2, y, slope, 2, y, None)
        out.write(t0 + (j + 1) * h, y[0])
        error = max(error, off(t0 + (j + 1) * h, +1, y[0]))
    return y[0], y[1], error


def generalized_alpha(state, t0, h, steps, read, out):
    af, am = 0.4, 0.2
    gamma = 0.5 - am + af
    beta = (gamma + 0.5) / 4
    m0, m1, m2 = (1 - am) / (beta * h**2), (1 - am) / (beta * h), (1 - am - 2 * beta) / (2 * beta)
    u, v, a, error = state
    for j in range(steps):
        f = k12 * read(t0 + (j + 1 - af) * h)[0]
        un = (f - af * k * u + m0 * u + m1 * v + m2 * a) / (k * (1 - af) + m0)
        an = (un - u - h * v) / (beta * h**2) - (1 - 2 * beta) / (2 * beta) * a
        u, v, a = un, v + h * ((1 - gamma) * a + gamma * an), an
        out.write(t0 + (j + 1) * h, u)
        error = max(error, off(t0 + (j + 1) * h, -1, u))
    return u, v, a, error


windows, na, nb, iterations = 10, 5, 100, 0
window = 1 / windows
u1, u2, guess = Waveform(3, na + 1, 1), Waveform(3, nb + 1, 1), Waveform(3, nb + 1, 1)  # guess: what A reads for u2
A, B, q = (1.0, 0.0, 0.0), (0.0, 0.0, k12, 0.0), c_void_p()
memory = np.empty(iqn_size(nb, 20, 1) // 8 + 1)
iqn_make(byref(q), nb, 20, 1, memory, memory.nbytes)
iqn_set(q, IQN_OMEGA, 1)
iqn_set(q, IQN_TOL_RELATIVE, 1e-11)
for w, start in (u1, A[0]), (u2, B[0]), (guess, B[0]):
    w.write(0, start)
for n in range(windows):
    for j in range(nb):
        guess.write((n + (j + 1) / nb) * window, B[0])
    done = 0
    while not done:
        guess.fit()
        u1.rollback()
        A_end = runge_kutta(A, n * window, window / na, na, guess, u1)
        u1.fit()
        u2.rollback()
        B_end = generalized_alpha(B, n * window, window / nb, nb, u1, u2)
        iqn_step(q, guess.unknowns(), u2.unknowns())
        done = iqn_converged(q)
        if done > 1:
            fail("no convergence")
        iterations += 1
    iqn_commit(q)
    A, B = A_end, B_end
    for w in u1, u2, guess:
        w.advance()

answers = ("e_A", A[-1], 0.0003007235641515), ("e_B", B[-1], 0.0003146352046766)
for name, error, published in answers:
    print(name, float(error))
    print("published_" + name, published)
print("iterations_average", iterations / windows)
sys.exit(not all(abs(error - published) <= 1e-9 for _, error, published in answers))
