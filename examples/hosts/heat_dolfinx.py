# SPDX-License-Identifier: MIT
"""heat_dolfinx.py - two finite-element plates of dolfinx, coupled in time by kit.py

    u_t = u_xx + u_yy + f on two unit squares that meet at x = 1
    u = 1 + g(t) x^2 + 3 y^2 + 1.2 t, exact in P2

    D, left:   reads the temperature of the interface, writes the heat flux into N
    N, right:  reads the flux, writes the temperature, on which the iteration works

The set-up is that of the preCICE tutorial "partitioned-heat-conduction": 8 x 8 x 2 triangles of
degree 2, windows of 0.1, f and the outer boundary from the exact solution.  The flux is the
tutorial's projected gradient, or the residual: what the weak form of D lacks at the nodes of the
interface.  Time: Radau IIA of rk.h, all stages solved together, 7 steps in a window of D, 4 of N,
unless said otherwise.  What is compared at the end is the error of coupling and time integration
alone.

To repeat a window a plate has to put back its temperatures and their last slope: two arrays."""
import sys

import numpy as np
import ufl
from dolfinx import fem, mesh
from mpi4py import MPI
from scipy.sparse import csr_matrix, identity, kron
from scipy.sparse.linalg import splu

import kit


def matrix(form):
    A = fem.petsc.assemble_matrix(fem.form(form))
    A.assemble()
    return csr_matrix(A.getValuesCSR()[::-1], A.getSize())


class Plate:
    """Temperatures y and slopes on one square; `inner`: its free nodes, `edge`: the interface's."""

    def __init__(self, left, cells, g, dg, T, dirichlet, projected=False):
        domain = mesh.create_rectangle(MPI.COMM_SELF, [[left, 0], [left + 1, 1]], [cells, cells])
        V = fem.FunctionSpace(domain, ("Lagrange", 2))
        u, v = ufl.TrialFunction(V), ufl.TestFunction(V)
        self.x, self.z = V.tabulate_dof_coordinates()[:, 0], V.tabulate_dof_coordinates()[:, 1]
        self.M, self.K = (matrix(a * ufl.dx) for a in (u * v, ufl.dot(ufl.grad(u), ufl.grad(v))))
        self.g, self.dg, self.T, self.solver = g, dg, T, {}
        self.dirichlet, self.projected = dirichlet, projected
        outer = (self.z < 1e-9) | (self.z > 1 - 1e-9) | (abs(self.x - 1) > 1 - 1e-9)
        edge = np.flatnonzero((abs(self.x - 1) < 1e-9) & ~outer)
        self.edge = edge[np.argsort(self.z[edge])]
        given = outer.copy()
        given[self.edge] = dirichlet
        self.given, self.inner = np.flatnonzero(given), np.flatnonzero(~given)
        self.y, self.slope = self.exact(0), dg(0) * self.x**2 + 1.2
        S = fem.FunctionSpace(domain, ("Lagrange", 1))
        p, q, vertical = ufl.TrialFunction(S), ufl.TestFunction(S), abs(ufl.FacetNormal(domain)[0])
        self.project = splu(matrix(p * q * ufl.dx).tocsc()), matrix(u.dx(0) * q * ufl.dx)
        at_edge = abs(S.tabulate_dof_coordinates()[:, 0] - 1) < 1e-9
        self.tested = matrix(p * v * vertical * ufl.ds)[self.edge].multiply(at_edge).tocsr()
        self.mass = matrix(u * v * vertical * ufl.ds)[self.edge][:, self.edge]  # of the interface

    def exact(self, t):
        return 1 + self.g(t) * self.x**2 + 3 * self.z**2 + 1.2 * t

    def load(self, t):  # f = u_t - u_xx - u_yy, tested with every node
        return self.M @ (self.dg(t) * self.x**2 + 1.2 - 2 * self.g(t) - 6)

    def flux(self, t, y, slope):
        """u_x, tested with the nodes of the interface: residual, or the tutorial's projection."""
        if self.projected:
            solver, u_x = self.project
            return self.tested @ solver.solve(u_x @ y)
        return (self.M @ slope + self.K @ y - self.load(t))[self.edge]

    def factors(self, h):
        if h not in self.solver:
            M, K = (a[self.inner][:, self.inner] for a in (self.M, self.K))
            both = kron(identity(self.T.stages), M) + kron(h * self.T.A, K)
            self.solver[h] = splu(both.tocsc())
        return self.solver[h]

    def step(self, t, h, y, read):
        """One step of u' = M^-1 (f - K u + flux) from y: its stages k, shape (stages, nodes)."""
        times = t + self.T.c * h
        stage = np.array([self.exact(s) for s in times])
        if self.dirichlet:
            stage[:, self.edge] = [read(s) for s in times]
        k = np.zeros((self.T.stages, y.size))
        k[:, self.given] = np.linalg.solve(self.T.A, stage[:, self.given] - y[self.given]) / h
        loads = np.array([self.load(s) for s in times])
        rest = loads - k @ self.M - (y + h * self.T.A @ k) @ self.K
        if not self.dirichlet:
            rest[:, self.edge] -= [read(s) for s in times]
        solved = self.factors(h).solve(rest[:, self.inner].ravel())
        k[:, self.inner] = solved.reshape(self.T.stages, -1)
        return k

    def window(self, t0, t1, steps, read, out):
        """Solve the window, write a sample at each step's end; returns the state at its end."""
        y, h = self.y, (t1 - t0) / steps
        for j in range(steps):
            k = self.step(t0 + j * h, h, y, read)
            y, end = self.T.finish(h, y, k), t1 if j == steps - 1 else t0 + (j + 1) * h
            out.write(end, self.flux(end, y, k[-1]) if self.dirichlet else y[self.edge])
        return y, k[-1]


def couple(g, dg, stages, degree, steps=(7, 4), windows=10, end=1.0, cells=8, projected=False,
           metric=False, **settings):
    """(largest error at the nodes and window ends, iterations per window, those of the first)"""
    T = kit.Table("radau_iia", stages)
    D, N = Plate(0, cells, g, dg, T, True, projected), Plate(1, cells, g, dg, T, False)
    n, count, error = D.edge.size, [], 0
    flux, answer, guess = (kit.Waveform(n, m + 1, degree) for m in (steps[0], steps[1], steps[1]))
    if metric:  # the norm of the mass matrix, of every sample
        q = kit.Core(metric=lambda a: a @ N.mass, **settings)
    else:
        q = kit.QN(steps[1] * n, **settings)
    flux.write(0, D.flux(0, D.y, D.slope))
    for w in answer, guess:
        w.write(0, N.y[N.edge])
    for i in range(windows):
        t0, t1 = i * end / windows, (i + 1) * end / windows
        guess.begin(np.append(t0 + np.arange(1, steps[1]) * (t1 - t0) / steps[1], t1))
        while not q.converged:
            for w in flux, answer:
                w.rollback()
            D_end = D.window(t0, t1, steps[0], guess, flux)
            N_end = N.window(t0, t1, steps[1], flux, answer)
            if metric:
                guess.unknowns[:] = q.step(guess.unknowns, answer.unknowns)
            else:
                q.step(guess.unknowns, answer.unknowns)
        count.append(q.commit())
        (D.y, D.slope), (N.y, N.slope) = D_end, N_end
        for w in flux, answer, guess:
            w.advance()
        error = max(error, *(abs(p.y - p.exact(t1)).max() for p in (D, N)))
    return error, np.mean(count), count[0]


def relaxed(method):
    return dict(method=method, omega=0.5, patience=0)


def tables():
    one, ok = (lambda t: 1.0, lambda t: 0.0), True
    print("| accelerator (g = 1, implicit Euler, 10 and 10 sub-steps, tolerance 1e-10) | flux "
          "| error | iterations (first) |")
    print("|---|---|---|---|")
    for flux in "projected", "residual":
        for name, how in (("constant 0.5", relaxed("constant")), ("Aitken", relaxed("aitken")),
                          ("iqn.h, defaults", {})):
            how = dict(how, projected=flux == "projected", tol=1e-10)
            error, mean, first = couple(*one, 1, 1, (10, 10), **how)
            print(f"| {name} | {flux} | {error:.1e} | {mean:.1f} ({first}) |")
            ok = ok and error < 1e-8  # the tutorial's own check
        ok = ok and mean < 5

    print("\n| exact for (1+t)^q: error, iterations | degree 1 | degree 2 | degree 3 |")
    print("|---|---|---|---|")
    for q, stages in (1, 1), (1, 2), (2, 2), (2, 3), (3, 2), (3, 3):
        g, dg = lambda t: (1 + t) ** q, lambda t: q * (1 + t) ** (q - 1)
        row = [couple(g, dg, stages, p, tol=1e-12) for p in (1, 2, 3)]
        say = [f"{e:.1e}, {mean:.1f}" for e, mean, _ in row]
        print(f"| q = {q}, {stages} stages |", " | ".join(say), "|")
        exact = [p >= q and stages >= q for p in (1, 2, 3)]
        ok = ok and all(e < 1e-10 if x else e > 1e-8 for (e, _, _), x in zip(row, exact))

    print("\n| g = sin + cos, 3 stages | error in 2, 4, 8, 16 windows | order |")
    print("|---|---|---|")
    for p in 1, 2, 3:
        g = lambda t: np.sin(t) + np.cos(t), lambda t: np.cos(t) - np.sin(t)
        e = [couple(*g, 3, p, windows=m, tol=1e-11)[0] for m in (2, 4, 8, 16)]
        order = np.log2(e[2] / e[3])
        print(f"| degree {p} |", " ".join(f"{x:.1e}" for x in e), f"| {order:.1f} |")
        ok = ok and order > p + 0.6  # p + 1 in the limit

    print("\n| mesh (g = (1+t)^2, 2 stages, degree 2, tolerance 1e-8) "
          "| 8 x 8 | 16 x 16 | 32 x 32 |")
    print("|---|---|---|---|")
    g = lambda t: (1 + t) ** 2, lambda t: 2 * (1 + t)
    for flux in "projected", "residual":
        for norm in "Euclid's", "mass matrix":
            how = dict(windows=4, tol=1e-8)
            how.update(projected=flux == "projected", metric=norm == "mass matrix")
            means = [couple(*g, 2, 2, cells=m, **how)[1] for m in (8, 16, 32)]
            say = " | ".join(f"{m:.1f}" for m in means)
            print(f"| iterations, {flux} flux, norm: {norm} | {say} |")
            ok = ok and max(means) - min(means) <= 1
    return ok


if __name__ == "__main__":
    sys.exit(not tables())
