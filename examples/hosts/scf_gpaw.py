# SPDX-License-Identifier: MIT
"""scf_gpaw.py - a density mixer for GPAW: iqn.h through kit.py in the place of Pulay mixing

    x = H(x):  x: the density that GPAW's Hamiltonian is made from
               H(x): the density of its wave functions

Block 0 of x is the density on the grid, block 1 the atomic density matrices, which only follow
(weight 0).  The words of the field: mixing beta is IQN_MIXING, and IQN_OMEGA of the first step; the
history is the number of secant pairs; Pulay mixing is IQN_ILS without what keeps it stable; GPAW's
damping of long waves (Kerker's aim, by a metric) is the metric of the inner product.

An SCF loop has nothing to put back: one window, no commit.  GPAW decides when it has converged."""
import sys

import numpy as np
from ase.build import bulk, fcc100, molecule
from gpaw import GPAW, KohnShamConvergenceError
from gpaw.mixer import BaseMixer, SeparateSpinMixerDriver

import kit


class QuasiNewton(BaseMixer):
    """Mixes all spins at once: x is (densities, atomic density matrices)."""

    name = "iqn"

    def reset(self):
        self.q = None

    def mix_single_density(self, nt_sG, D_ap):
        hx = nt_sG.copy(), np.concatenate([D.ravel() for D in D_ap])
        if self.q is None:  # the first density is an input, not yet an answer
            self.q = kit.Core(columns=self.nmaxold, blocks=["density", "matrices"], patience=0,
                              omega=self.beta, mixing=self.beta,
                              metric=[self.long_waves_first, None])
            self.q.set_block("matrices", weight=0)
            self.x = hx
            return np.inf
        r = hx[0] - self.x[0]
        self.x = self.q.step(self.x, hx)
        nt_sG[:] = self.x[0]
        for D, part in zip(D_ap, np.split(self.x[1], np.cumsum([D.size for D in D_ap])[:-1])):
            D[:] = part.reshape(D.shape)
        return self.calculate_charge_sloshing(r.sum(axis=0) if r.ndim > 3 else r)

    def long_waves_first(self, a):
        """GPAW's metric times densities: the longest waves weigh `weight` times the others."""
        a = a.copy()
        for part in a.reshape(-1, *a.shape[-3:]) if self.metric else ():
            self.metric(part.copy(), self.mR_G)
            part[:] = self.mR_G
        return a


class Together(SeparateSpinMixerDriver):
    name = "together"

    def get_basemixers(self, nspins):
        return [self.basemixerclass(self.beta, self.nmaxold, self.weight)]

    def mix(self, basemixers, nt_sG, D_asp):
        return basemixers[0].mix_single_density(nt_sG, list(D_asp.values()))


def water():
    atoms = molecule("H2O")
    atoms.center(vacuum=3)
    return atoms, (1, 1, 1)


def salt():
    return bulk("NaCl", "rocksalt", a=5.64), (2, 2, 2)


def iron(k):
    atoms = bulk("Fe", "bcc", a=2.87)
    atoms.set_initial_magnetic_moments([2.3])
    return atoms, (k, k, k)


def slab():
    atoms = fcc100("Al", (1, 1, 6), a=4.05)
    atoms.center(vacuum=4, axis=2)
    return atoms, (2, 2, 1)


def solve(atoms, kpts, mixer):
    """(energy, iterations); (NaN, MOST) where it does not converge"""
    atoms.calc = GPAW(mode="lcao", basis="sz(dzp)", xc="LDA", h=0.3, kpts=kpts, mixer=mixer,
                      maxiter=MOST, txt=None,
                      convergence=dict(density=1e-7, energy=1e-8))
    try:
        return atoms.get_potential_energy(), atoms.calc.get_number_of_iterations()
    except KohnShamConvergenceError:
        return np.nan, MOST


def table():
    systems = [("H2O, molecule", water), ("NaCl, bulk", salt),
               ("Fe, metal with spin, 4 x 4 x 4", lambda: iron(4)),
               ("Fe, 2 x 2 x 2, coarse", lambda: iron(2)), ("Al(100), slab of 6 layers", slab)]
    ours = dict(method=Together, backend=QuasiNewton)
    aggressive = dict(beta=1, nmaxold=20, weight=1)
    print(f"| iterations, at most {MOST} | Pulay, GPAW's defaults "
          "| iqn.h, the same beta and history | Pulay, beta 1, 20 old | iqn.h, the same "
          "| lowest energy, eV |")
    print("|---|---|---|---|---|---|")
    ok = True
    for name, system in systems:
        mixers = [dict(how, **mixer) for how in ({}, aggressive) for mixer in ({}, ours)]
        runs = [solve(*system(), mixer) for mixer in mixers]
        lowest = np.nanmin([energy for energy, _ in runs])
        other = [" (another state)" if e > lowest + 1e-5 else "" for e, _ in runs]
        say = ["no convergence" if np.isnan(e) else f"{n}{o}" for (e, n), o in zip(runs, other)]
        print(f"| {name} |", " | ".join(say), f"| {lowest:.6f} |", flush=True)
        for (_, pulay), (energy, quasi) in zip(runs[::2], runs[1::2]):
            ok = ok and energy < lowest + 1e-5 and quasi <= pulay + 2
    return ok


MOST = 80
if __name__ == "__main__":
    sys.exit(not table())
