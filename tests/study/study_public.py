#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""study_public.py LIBRARY [OLD] - fixed points from papers and public examples: the defaults of iqn.h beside those of others.

LIBRARY is public_rivals.c, built (make public); OLD: the same with another version of iqn.h.  Every accelerator starts from the
same x; counted are evaluations of g until |g(x) - x| is 1e-8 of the first, at most 500.  iqn.h has 20 columns.  Rivals: Anderson's
method in numpy with a memory of 5 and 20, KINSOL (KIN_FP, the same), PETSc (SNES anderson and ngmres, 30), SciPy (anderson,
broyden1), cvxgrp/aa (types II and I, its safeguard); those that are not installed are left out.
Goal: within 1.1 of the best rival's default on 80 of 100 problems, and none given up that a rival's default answers.

The problems are written anew from: Chandrasekhar, Toth and Kelley 2015 (H-equation, convection); Fang and Saad 2009 (Bratu, SCF);
Walker and Ni 2011 (mixtures, NMF, domain decomposition as Jacobi); Evans, Pollock, Rebholz and Xiao 2020 (p-Laplacian, cavity);
Zhang, O'Donoghue and Boyd 2020 (ISTA, splitting, value iteration, logistic regression); Lott et al. 2012 (Richards); Hasselblad
1969, Varadhan and Roland 2008 (deaths); Murphy, Sherali and Soyster 1982 (oligopoly); SUNDIALS' kinAnalytic_fp (three equations)."""
import ctypes
import sys
import warnings

import numpy as np
import scipy.fft
import scipy.linalg
import scipy.optimize
import scipy.sparse as sparse
import scipy.sparse.linalg

LIMIT, MOST, COLUMNS = 1e-8, 500, 20
PROBLEMS = {}


def problem(*cases):
    """Decorator: one entry of PROBLEMS for every case, (name, arguments ...)."""
    def add(make):
        for name, *arguments in cases:
            PROBLEMS[name] = (make, arguments)
        return make
    return add


def random(seed):
    return np.random.RandomState(seed)


# ---- grids

def poisson(m):
    """Solver of -u_xx - u_yy = f on m x m points inside the unit square, u = 0 outside."""
    k = np.arange(1, m + 1)
    wave = 4 * (m + 1) ** 2 * np.sin(k * np.pi / 2 / (m + 1)) ** 2
    return lambda f: scipy.fft.idstn(scipy.fft.dstn(f.reshape(m, m), 1) / (wave[:, None] + wave), 1).ravel()


def slopes(m):
    """Central differences on the same grid."""
    one = sparse.diags([-1, 1], [-1, 1], shape=(m, m)) * ((m + 1) / 2)
    eye = sparse.identity(m)
    return sparse.kron(eye, one).tocsr(), sparse.kron(one, eye).tocsr()


@problem(("Bratu, 6.7", 6.7), ("Bratu, 5", 5.0))
def bratu(strength):
    solve = poisson(31)
    return lambda u: strength * solve(np.exp(u)), np.zeros(31 * 31)


@problem(("H-equation .9", .9), ("H-equation .9999", .9999), ("H-equation 1", 1.0))
def h_equation(c):
    mu = (np.arange(100) + .5) / 100
    A = c / 200 * mu[:, None] / (mu[:, None] + mu)
    return lambda h: 1 / (1 - A @ h), np.ones(100)


@problem(("convection", 20.))
def convection(strength):
    m = 31
    solve, (dx, dy) = poisson(m), slopes(m)
    s = np.arange(1, m + 1) / (m + 1)
    u = 10 * np.outer(s * (1 - s), s * (1 - s) * np.exp(s ** 4.5)).ravel()  # Kelley's solution
    wave = scipy.fft.dstn
    k = np.arange(1, m + 1)
    scale = 4 * (m + 1) ** 2 * np.sin(k * np.pi / 2 / (m + 1)) ** 2
    laplace = lambda v: scipy.fft.idstn(wave(v.reshape(m, m), 1) * (scale[:, None] + scale), 1).ravel()
    f = laplace(u) + strength * u * (dx @ u + dy @ u)
    return lambda v: solve(f - strength * v * (dx @ v + dy @ v)), np.zeros(m * m)


def divergence_form(m, conduct, f):
    """v -> solution of -div(k(v) grad u) = f, k given by conduct(v, squared slope) at faces, u = 0 outside."""
    def g(v):
        U = np.pad(v.reshape(m, m), 1)
        h = m + 1
        kx = conduct((U[1:, 1:-1] + U[:-1, 1:-1]) / 2, ((U[1:, 1:-1] - U[:-1, 1:-1]) * h) ** 2)
        ky = conduct((U[1:-1, 1:] + U[1:-1, :-1]) / 2, ((U[1:-1, 1:] - U[1:-1, :-1]) * h) ** 2)
        diagonal = (kx[1:] + kx[:-1] + ky[:, 1:] + ky[:, :-1]).ravel()
        down = kx[1:-1].ravel()
        right = ky[:, 1:].copy()
        right[:, -1] = 0
        right = right.ravel()[:-1]
        A = sparse.diags([diagonal, -down, -down, -right, -right], [0, m, -m, 1, -1], format="csc") * h ** 2
        return sparse.linalg.spsolve(A, f)
    return g


@problem(("p-Laplacian 1.5", 1.5), ("p-Laplacian 4", 4.0))
def p_laplacian(p):
    m = 16
    return divergence_form(m, lambda u, s: (s + 1e-4) ** ((p - 2) / 2), np.ones(m * m)), .1 * np.ones(m * m)


@problem(("conduction, 1 + u^3", 3))
def conduction(power):
    m = 16
    return divergence_form(m, lambda u, s: 1 + np.abs(u) ** power, 60 * np.ones(m * m)), np.zeros(m * m)


@problem(("Poisson-Boltzmann", 2.0))
def boltzmann(charge):
    n = 100
    h = 10. / (n + 1)
    A = np.zeros((3, n))
    A[0, 1:] = A[2, :-1] = -1 / h ** 2
    A[1] = 2 / h ** 2 + 1
    source = charge * np.exp(-(np.linspace(-5, 5, n)) ** 2)
    return lambda u: scipy.linalg.solve_banded((1, 1), A, u - np.sinh(u) + source), np.zeros(n)


@problem(("cavity, Re 100", 100.), ("cavity, Re 1000", 1000.))
def cavity(reynolds):
    """Vorticity and stream function: the vorticity is carried by the velocity of the last iterate; x: stream function."""
    m = 16
    h = 1. / (m + 1)
    solve, (dx, dy) = poisson(m), slopes(m)
    D = sparse.diags([-1, 2, -1], [-1, 0, 1], shape=(m, m)) / h ** 2
    laplace = (sparse.kron(sparse.identity(m), D) + sparse.kron(D, sparse.identity(m))).tocsr()

    def g(psi):
        P = psi.reshape(m, m)
        right = np.zeros((m, m))
        wall = 2 / h ** 2  # Thom: vorticity at a wall, lid at the top with velocity 1
        for side, lid in (((0, slice(None)), 0), ((-1, slice(None)), 1), ((slice(None), 0), 0), ((slice(None), -1), 0)):
            right[side] += (-wall * P[side] - 2 * lid / h) / h ** 2
        A = laplace / reynolds + sparse.diags(dy @ psi) @ dx - sparse.diags(dx @ psi) @ dy
        return solve(sparse.linalg.spsolve(A.tocsc(), right.ravel() / reynolds))
    return g, np.zeros(m * m)


@problem(("obstacle", 16))
def obstacle(m):
    s = np.linspace(-1, 1, m)
    bump = (.6 - 2 * (s[:, None] ** 2 + s ** 2)).ravel()

    def g(u):
        U = np.pad(u.reshape(m, m), 1)
        return np.maximum((U[2:, 1:-1] + U[:-2, 1:-1] + U[1:-1, 2:] + U[1:-1, :-2]).ravel() / 4 - .002, bump)
    return g, np.zeros(m * m)


@problem(("Jacobi, Poisson", 12))
def jacobi(m):
    f = random(3).randn(m * m) / m ** 2

    def g(u):
        U = np.pad(u.reshape(m, m), 1)
        return (U[2:, 1:-1] + U[:-2, 1:-1] + U[1:-1, 2:] + U[1:-1, :-2]).ravel() / 4 + f
    return g, np.zeros(m * m)


@problem(("Richards, one step", 40))
def richards(n):
    dz, dt, alpha, old = 2. / n, .05, 3.0, -1.5 * np.ones(n)
    theta = lambda h: np.where(h < 0, .05 + .35 / (1 + np.abs(alpha * np.minimum(h, 0)) ** 2) ** .5, .4)
    conduct = lambda h: 1 / (1 + np.abs(alpha * np.minimum(h, 0)) ** 2) ** 1.5

    def g(h):
        slope = (theta(h + 1e-6) - theta(h - 1e-6)) / 2e-6 + 1e-4
        k = conduct(h)
        face = np.concatenate([[0], (k[1:] + k[:-1]) / 2, [k[-1]]])
        A = np.zeros((3, n))
        A[1] = slope * dz / dt + (face[:-1] + face[1:]) / dz
        A[1, -1] -= face[-1] / dz
        A[0, 1:] = A[2, :-1] = -face[1:-1] / dz
        b = (slope * h - theta(h) + theta(old)) * dz / dt + face[:-1] - face[1:]
        b[0] += .5
        return scipy.linalg.solve_banded((1, 1), A, b)
    return g, old


# ---- few numbers

@problem(("three equations",))
def three():
    def g(v):
        x, y, z = v
        return np.array([np.cos((y - 1) * z) / 3 + 1 / 6, np.sqrt(np.maximum(x * x + np.sin(z) + 1.06, 0)) / 9 + .9,
                         -np.exp(-x * (y - 1)) / 20 - (10 * np.pi - 3) / 60])
    return g, np.array([.1, .1, -.1])


@problem(("Kepler, .95", .95))
def kepler(e):
    mean = np.linspace(.1, 3, 8)
    return lambda E: mean + e * np.sin(E), mean.copy()


@problem(("cosine",))
def cosine():
    return lambda x: np.cos(x), np.array([.3])


@problem(("Colebrook",))
def colebrook():
    return lambda x: -2 * np.log10(1e-3 / 3.7 + 2.51 * np.abs(x) / np.array([4e3, 1e5, 1e7])), np.ones(3) * 5


@problem(("oligopoly",))
def oligopoly():
    """Five firms, price (5000 / Q)^(1/1.1); each goes a way down its marginal loss."""
    c, K, beta = np.array([10, 8, 6, 4, 2.]), 5., np.array([1.2, 1.1, 1, .9, .8])

    def g(q):
        q = np.maximum(q, 1e-3)
        Q = q.sum()
        price = (5000 / Q) ** (1 / 1.1)
        return np.maximum(q + .5 * (price - price / 1.1 * q / Q - c - (q / K) ** (1 / beta)), 0)
    return g, 10 * np.ones(5)


@problem(("stiff stage", 5.0))
def stiff_stage(dt):
    """Implicit Euler of Van der Pol's equation, mu = 5, by the Jacobian of another place."""
    old = np.array([1.5, -.3])
    f = lambda y: np.array([y[1], 5 * (1 - y[0] ** 2) * y[1] - y[0]])
    J = np.eye(2) - .05 * dt * np.array([[0, 1], [-1, 5 * (1 - 4)]])
    return lambda y: y - np.linalg.solve(J, y - old - .05 * dt * f(y)), old


# ---- optimisation

def regression(rows, n, seed):
    r = random(seed)
    A = r.randn(rows, n) / np.sqrt(rows)
    x = np.where(r.rand(n) < .1, r.randn(n) * 3, 0)
    return A, A @ x + .05 * r.randn(rows)


def soft(z, t):
    return np.sign(z) * np.maximum(np.abs(z) - t, 0)


@problem(("lasso, ISTA", .1, 0.), ("elastic net, ISTA", .02, .05))
def ista(price, ridge):
    A, b = regression(60, 120, 1)
    step = 1 / (np.linalg.norm(A, 2) ** 2 + ridge)
    return lambda x: soft(x - step * (A.T @ (A @ x - b) + ridge * x), step * price), np.zeros(120)


@problem(("lasso, splitting",))
def lasso_splitting():
    A, b = regression(60, 120, 1)
    inverse = np.linalg.inv(np.eye(120) + A.T @ A)

    def g(z):
        x = soft(z, .1)
        return z + inverse @ (2 * x - z + A.T @ b) - x
    return g, np.zeros(120)


@problem(("LP, splitting", 5), ("LP 2, splitting", 9))
def program(seed):
    r = random(seed)
    A, inside = r.randn(12, 30), np.abs(r.randn(30))
    b, c = A @ inside, r.rand(30) + A.T @ r.randn(12) * .2
    pseudo = np.linalg.pinv(A)

    def g(z):
        x = np.maximum(z, 0)
        y = 2 * x - z - .3 * c
        return z + y - pseudo @ (A @ y - b) - x
    return g, np.zeros(30)


@problem(("QP, ADMM",))
def admm():
    r = random(7)
    G = r.randn(40, 40)
    Q, c = G @ G.T / 40 + .1 * np.eye(40), r.randn(40)
    inverse = np.linalg.inv(Q + np.eye(40))

    def g(s):  # s = z + u
        z = np.clip(s, -.5, .5)
        x = inverse @ (2 * z - s - c)
        return x + s - z
    return g, np.zeros(40)


@problem(("logistic regression",))
def logistic():
    r = random(8)
    A = r.randn(100, 20) * np.logspace(0, -1, 20)
    y = np.sign(A @ r.randn(20) + .5 * r.randn(100))
    step = 4 / (np.linalg.norm(A, 2) ** 2 + 4 * .1)
    return lambda x: x + step * (A.T @ (y / (1 + np.exp(y * (A @ x)))) - .1 * x), np.zeros(20)


@problem(("tomography, SIRT",))
def sirt():
    r = random(9)
    A = (r.rand(80, 64) < .15) * r.rand(80, 64)
    b = A @ np.abs(r.randn(64)) + .01 * r.randn(80)
    rows, columns = np.maximum(A.sum(1), 1e-3), np.maximum(A.sum(0), 1e-3)
    return lambda x: x + 1.5 * (A.T @ ((b - A @ x) / rows)) / columns, np.zeros(64)


@problem(("NMF",))
def nmf():
    V = random(10).rand(20, 15)
    W, H = random(11).rand(20, 3), random(12).rand(3, 15)

    def g(x):
        W, H = np.abs(x[:60]).reshape(20, 3), np.abs(x[60:]).reshape(3, 15)
        H = H * (W.T @ V) / (W.T @ W @ H + 1e-9)
        W = W * (V @ H.T) / (W @ H @ H.T + 1e-9)
        return np.concatenate([W.ravel(), H.ravel()])
    return g, np.concatenate([W.ravel(), H.ravel()])


@problem(("MDP, .95", .95), ("MDP, .99", .99))
def decisions(discount):
    r = random(13)
    P = r.rand(4, 60, 60) ** 8
    P /= P.sum(2)[:, :, None]
    reward = r.rand(4, 60)
    return lambda v: np.max(reward + discount * (P @ v), 0), np.zeros(60)


@problem(("PageRank, .85", .85), ("PageRank, .99", .99))
def pagerank(damping):
    r = random(14)
    A = (r.rand(200, 200) < .02).astype(float)
    A[:100, 100:] *= r.rand(100, 100) < .05
    A += 1e-9
    A /= A.sum(0)
    return lambda x: damping * (A @ x) + (1 - damping) / 200, np.ones(200) / 200


@problem(("Sinkhorn, .02", .02))
def sinkhorn(warm):
    a, b = np.sort(random(15).rand(40)), np.sort(random(16).rand(40))
    K = np.exp(-(a[:, None] - b) ** 2 / warm)
    mass = random(17).rand(40) + .1
    mass /= mass.sum()

    def g(x):
        u = np.log(mass) - np.log(K @ (1 / 40 / (K.T @ np.exp(x))))
        return u - u[0]
    return g, np.zeros(40)


# ---- statistics and electrons

@problem(("EM, deaths",))
def deaths():
    """Deaths of women over 80 in The Times, 1910 to 1912: a mixture of two Poisson distributions."""
    count = np.array([162, 267, 271, 185, 111, 61, 27, 8, 3, 1.])
    k = np.arange(10)

    def g(v):
        p, a, b = v
        first = p * np.exp(-a) * np.abs(a) ** k
        part = first / (first + (1 - p) * np.exp(-b) * np.abs(b) ** k)
        n = (count * part).sum()
        return np.array([n / count.sum(), (count * part * k).sum() / n, (count * (1 - part) * k).sum() / (count.sum() - n)])
    return g, np.array([.3, 1., 2.5])


@problem(("EM, two normals", 1.5), ("EM, apart", 3.0))
def normals(apart):
    """Means alone, as Walker and Ni."""
    r = random(18)
    data = np.concatenate([r.randn(300), r.randn(200) + apart, r.randn(500) + 2 * apart])
    share = np.array([.3, .2, .5])

    def g(m):
        part = share * np.exp(-(data[:, None] - m) ** 2 / 2)
        part /= part.sum(1)[:, None]
        return (part * data[:, None]).sum(0) / part.sum(0)
    return g, np.array([-.5, .5 * apart, 1.5 * apart])


def scf(n, filled, strength, warm):
    site = random(19).randn(n)
    hop = -(np.eye(n, k=1) + np.eye(n, k=-1))

    def g(density):
        energy, states = np.linalg.eigh(hop + np.diag(site + strength * density))
        level = scipy.optimize.brentq(lambda e: (1 / (1 + np.exp(np.clip((energy - e) / warm, -200, 200)))).sum() - filled,
                                      energy[0] - 50, energy[-1] + 50, xtol=1e-15, rtol=1e-15)
        return (states ** 2) @ (1 / (1 + np.exp(np.clip((energy - level) / warm, -200, 200))))
    return g, filled / n * np.ones(n)


@problem(("SCF, weak", 1.0), ("SCF, strong", 6.0))
def electrons(strength):
    return scf(20, 8, strength, .1)


@problem(("Gross-Pitaevskii", 50.0))
def gross_pitaevskii(strength):
    n = 101
    x = np.linspace(-8, 8, n)
    h = x[1] - x[0]

    def g(u):
        A = np.zeros((3, n))
        A[0, 1:] = A[2, :-1] = -.5 / h ** 2
        A[1] = 1 / h ** 2 + x ** 2 / 2 + strength * u ** 2 + 10
        v = scipy.linalg.solve_banded((1, 1), A, u)
        return v / np.sqrt(h * (v ** 2).sum())
    u = np.exp(-x ** 2 / 8)
    return g, u / np.sqrt(h * (u ** 2).sum())


@problem(("mean field, ferromagnet", 0), ("mean field, glass", 1))
def mean_field(glassy):
    r = random(20)
    n = 40
    J = r.randn(n, n)
    J = (J + J.T) / np.sqrt(2 * n) if glassy else np.ones((n, n)) / n + .2 * (J + J.T) / n
    field = .1 * r.randn(n)
    return lambda m: np.tanh(1.3 * (J @ m + field)), .1 * np.ones(n)


@problem(("power flow, ring",))
def power_flow():
    """Gauss's loop by the bus admittances of a ring of 12; bus 0 is the slack."""
    r = random(21)
    n = 12
    y = 1 / (.02 + .06j + .02 * r.rand(n))
    Y = np.zeros((n, n), complex)
    for i in range(n):
        j = (i + 1) % n
        Y[i, i] += y[i]
        Y[j, j] += y[i]
        Y[i, j] -= y[i]
        Y[j, i] -= y[i]
    load = -(.15 + .1 * r.rand(n)) - .05j
    split = lambda v: np.concatenate([v.real, v.imag])

    def g(x):
        v = np.concatenate([[1], x[:n - 1] + 1j * x[n - 1:]])
        for i in range(1, n):
            v[i] = (np.conj(load[i] / v[i]) - Y[i] @ v + Y[i, i] * v[i]) / Y[i, i]
        return split(v[1:])
    return g, split(np.ones(n - 1, complex))


# What the sources print, to the digits they print: the problems here are theirs.
PUBLISHED = {
    "three equations": ([.5, 1, -np.pi / 6], 1e-6),
    "cosine": ([.7390851332], 1e-9),
    "EM, deaths": ([.3599, 1.2561, 2.6634], 1e-4),
    "oligopoly": ([36.9325, 41.8181, 43.7066, 42.6592, 39.1790], 2e-4),
}


# ---- accelerators

class Enough(Exception):
    pass


class Counter:
    """g, counted; .reached: evaluations until the limit, 0: not reached."""

    def __init__(self, make, arguments):
        self.g, x0 = make(*arguments)
        self.x0 = np.array(x0, float)
        self.count = self.reached = 0
        self.over = False

    def __call__(self, x):
        x = np.array(x, float)
        if self.over:
            return x
        self.count += 1
        with np.errstate(all="ignore"), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                hx = np.asarray(self.g(x), float)
            except (ValueError, RuntimeError, np.linalg.LinAlgError):
                hx = np.full(x.shape, np.nan)
        r = np.linalg.norm(hx - x)
        if self.count == 1:
            self.first = r
        if r <= LIMIT * self.first:
            self.reached, self.over, self.answer = self.count, True, hx
        self.over = self.over or self.count >= MOST or not np.isfinite(r)
        return hx if np.isfinite(r) else x

    def stopping(self, x):
        hx = self(x)
        if self.over:
            raise Enough
        return hx


MAP = ctypes.CFUNCTYPE(None, ctypes.POINTER(ctypes.c_double), ctypes.POINTER(ctypes.c_double))


def compiled(library, name, *arguments):
    def run(g):
        n = len(g.x0)
        x = np.array(g.x0)

        def H(px, ph):
            np.ctypeslib.as_array(ph, (n,))[:] = g(np.ctypeslib.as_array(px, (n,)))
        callback = MAP(H)
        getattr(library, name)(n, *arguments, callback, x.ctypes.data_as(ctypes.POINTER(ctypes.c_double)))
    return run


def iqn(library, columns, omega):
    return compiled(library, "run_iqn", columns, ctypes.c_double(omega), ctypes.c_double(LIMIT), 10 * MOST)


def anderson(memory):
    """Type II as in its papers: the first step is plain, least squares by lstsq."""
    def run(g):
        x = np.array(g.x0)
        X, R = [], []
        while not g.over:
            h = g(x)
            X, R = (X + [h])[-memory - 1:], (R + [h - x])[-memory - 1:]
            if len(R) > 1:
                dR, dX = np.diff(np.array(R), axis=0).T, np.diff(np.array(X), axis=0).T
                h = h - dX @ np.linalg.lstsq(dR, R[-1], rcond=None)[0]
            x = h
    return run


def scipy_way(method):
    def run(g):  # what it raises where it gives up has no public name in every version
        try:
            method(lambda x: g.stopping(x) - x, g.x0, f_tol=1e-200, maxiter=10 * MOST)
        except Exception:
            pass
    return run


def accelerators(paths):
    library = ctypes.CDLL(paths[0])
    mine = {"iqn.h": iqn(library, COLUMNS, 0), "omega 1": iqn(library, COLUMNS, 1), "50 columns": iqn(library, 50, 0)}
    if len(paths) > 1:
        old = ctypes.CDLL(paths[1])
        mine["old"] = iqn(old, COLUMNS, 0)
        mine["old, 1"] = iqn(old, COLUMNS, 1)
    rivals = {"Anderson 5": anderson(5), "Anderson 20": anderson(20)}
    if hasattr(library, "run_kinsol"):
        rivals["KINSOL 5"] = compiled(library, "run_kinsol", 5, 10 * MOST)
        rivals["KINSOL 20"] = compiled(library, "run_kinsol", 20, 10 * MOST)
    if hasattr(library, "run_petsc"):
        for name in ("anderson", "ngmres"):
            rivals["PETSc " + name] = compiled(library, "run_petsc", ctypes.c_char_p(name.encode()), 10 * MOST)
    rivals["SciPy anderson"] = scipy_way(scipy.optimize.anderson)
    rivals["SciPy broyden1"] = scipy_way(scipy.optimize.broyden1)
    if hasattr(library, "run_aa"):
        rivals["aa II"] = compiled(library, "run_aa", 0, 10 * MOST)
        rivals["aa I"] = compiled(library, "run_aa", 1, 10 * MOST)
    return mine, rivals


def main():
    mine, rivals = accelerators(sys.argv[1:])
    for name, there in (("KINSOL", "KINSOL 5" in rivals), ("PETSc", "PETSc anderson" in rivals), ("cvxgrp/aa", "aa II" in rivals)):
        if not there:
            print("%s is left out: it is not installed, or its sources are not given" % name)
    counts, met = {}, 0
    print("evaluations, -: not within %d, or given up\n%-24s%s  best default of the others" % (MOST, "", "".join("%11s" % m for m in mine)))
    for name, (make, arguments) in PROBLEMS.items():
        for way, run in {**mine, **rivals}.items():
            g = Counter(make, arguments)
            run(g)
            counts[name, way] = g.reached
            if name in PUBLISHED and way == "iqn.h" and g.reached:
                value, digits = PUBLISHED[name]
                met += bool(np.all(np.abs(g.answer - value) <= digits))
        answered = [(counts[name, way], way) for way in rivals if counts[name, way]]
        print("%-24s%s  %s" % (name, "".join("%11s" % (counts[name, m] or "-") for m in mine),
                               "%d %s" % min(answered) if answered else "-"), flush=True)
    print()
    for way in mine:
        within, behind, given_up, asked = 0, [], [], 0
        for name in PROBLEMS:
            answered = [counts[name, rival] for rival in rivals if counts[name, rival]]
            if not answered and not counts[name, way]:
                continue
            asked += 1
            best = min(answered, default=MOST)
            ok = counts[name, way] and counts[name, way] <= 1.1 * best
            within += bool(ok)
            if not counts[name, way]:
                given_up.append(name)
            elif not ok:
                behind.append("%s %.2f" % (name, counts[name, way] / best))
        print("public problems, %-10s within 1.1 of the best rival: %d of %d (%.0f %%); given up that a rival answers: %d%s\n    behind: %s" % (
            way, within, asked, 100 * within / asked, len(given_up), " (%s)" % "; ".join(given_up) if given_up else "", "; ".join(behind)))
    print("published answers met: %d of %d" % (met, len(PUBLISHED)))
    for way in rivals:
        both = [np.log(counts[name, way] / counts[name, "iqn.h"]) for name in PROBLEMS if counts[name, way] and counts[name, "iqn.h"]]
        print("public problems, %-14s fails in %d, evaluations over those of iqn.h where both converge %.3f" % (
            way, sum(counts[name, way] == 0 for name in PROBLEMS), np.exp(np.mean(both))))


if __name__ == "__main__":
    main()
