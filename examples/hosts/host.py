# SPDX-License-Identifier: MIT
"""host.py - two Python solvers coupled with waveform.h, iqn.h and rk.h through kit.py

Two masses between three springs, one solver each; both read the other's waveform, quasi-Newton
closes the loop:

    u1'' + 20 pi^2 u1 = 16 pi^2 u2(t)    Runge-Kutta 4, 5 steps in a window
    u2'' + 20 pi^2 u2 = 16 pi^2 u1(t)    generalized-alpha, 100 steps in a window

The answer: the largest errors published by Rodenberg and Uekermann, arXiv 2511.07616 (2025)."""
import sys
from math import cos, pi

import numpy as np

import kit

k12, k = 16 * pi**2, 20 * pi**2


def off(t, sign, u):
    return abs(u - (cos(2 * pi * t) + sign * cos(6 * pi * t)) / 2)


# A solver takes its state, the largest error so far included, and returns a new one: to roll back
# is to forget it.
def runge_kutta(state, t0, h, steps, read, out):
    T = kit.Table("rk4")
    y, slope, error = np.array(state[:2]), np.zeros((T.stages, 2)), state[2]
    for j in range(steps):
        for i in range(T.stages):
            z = T.stage(i, h, y, slope)
            slope[i] = z[1], k12 * read(t0 + j * h + T.c[i] * h)[0] - k * z[0]
        T.finish(h, y, slope, out=y)
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
u1, u2 = kit.Waveform(1, na + 1), kit.Waveform(1, nb + 1)
guess = kit.Waveform(1, nb + 1)  # what A reads in place of u2
q = kit.QN(nb, tol=1e-11, omega=1)
A, B = (1.0, 0.0, 0.0), (0.0, 0.0, k12, 0.0)
for w, start in (u1, A[0]), (u2, B[0]), (guess, B[0]):
    w.write(0, start)
for n in range(windows):
    guess.begin([(n + (j + 1) / nb) * window for j in range(nb)])
    done = False
    while not done:
        u1.rollback()
        A_end = runge_kutta(A, n * window, window / na, na, guess.fit(), u1)
        u2.rollback()
        B_end = generalized_alpha(B, n * window, window / nb, nb, u1.fit(), u2)
        done = q.step(guess.unknowns, u2.unknowns)
    iterations += q.commit()
    A, B = A_end, B_end
    for w in u1, u2, guess:
        w.advance()

answers = ("e_A", A[-1], 0.0003007235641515), ("e_B", B[-1], 0.0003146352046766)
for name, error, published in answers:
    print(name, float(error))
    print("published_" + name, published)
print("iterations_average", iterations / windows)
sys.exit(not all(abs(error - published) <= 1e-9 for _, error, published in answers))
