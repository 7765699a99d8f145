# SPDX-License-Identifier: MIT
"""blackbox.py - OpenFOAM and CalculiX as they come, started anew for every window

    sh examples/hosts/run.sh OpenFOAM       # INSTALL=1 before it: with the packages

(a) Fluid and structure: icoFoam's channel is pushed by a piston on a spring, which is Runge-Kutta 4
    in this file.  The fluid weighs three times what the piston does.  Exact:
    (m + rho A L) x'' + k x = 0.
(b) Conjugate heat transfer: laplacianFoam's rod, given the temperature where it ends, against
    CalculiX's, given the heat.  Its effusivity is four times that of the other; plain iteration
    diverges.  Exact: the slowest eigenmode of the two rods.

A code that is started anew for every window, in ten lines:
 1. Checkpoint: what the code restarts from, a time folder or a list of temperatures.  Keep that of
    the window start; to roll back is to start from it again.
 2. Table in: write the other side's waveform, read at this code's own step ends, with 17 digits.
 3. Run it from the window start to the window end, and look at how it ended.
 4. Log out: parse what it printed at each step, and push that at this code's own step ends.
 5. A flux or pressure of implicit Euler is a mean over the step.  Add it up, times the step; the
    other side reads the running integral with deriv 1, or the difference of two reads as a mean.
 6. Accelerate one flat array: the samples of one side in the window.
 7. Digits: what is printed with 7 digits is noise of 5e-7.  Ask for as many digits as there are;
    a tolerance below them never holds.  IQN_NOISE_LEVEL says what they are.
 8. Solvers inside: their tolerance, times what they add up, is noise as well.
 9. Accept: keep the checkpoint of the window end, advance the waveforms, commit.
10. Count runs, not seconds: a start costs more than the steps."""
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import kit


class OpenFOAM:
    """A solver of OpenFOAM on [0, 1] in `cells` cells; the left end is driven by a table in time."""

    dictionary = "FoamFile { version 2.0; format ascii; class dictionary; object x; }\n"
    numbers = """
ddtSchemes { default Euler; } gradSchemes { default Gauss linear; } divSchemes { default Gauss linear; }
laplacianSchemes { default Gauss linear corrected; } interpolationSchemes { default linear; }
snGradSchemes { default corrected; }
solvers { "p.*|T" { solver PCG; preconditioner DIC; tolerance 1e-13; relTol 0; }
          U { solver PBiCGStab; preconditioner DILU; tolerance 1e-13; relTol 0; } }
PISO { nCorrectors 3; } SIMPLE { nNonOrthogonalCorrectors 0; }
nu [0 2 -1 0 0 0 0] 1e-6; DT [0 2 -1 0 0 0 0] 1;
"""
    mesh = """scale 1;
vertices ((0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 1) (1 0 1) (1 1 1) (0 1 1));
blocks (hex (0 1 2 3 4 5 6 7) (%d 1 1) simpleGrading (1 1 1)); edges ();
boundary (left { type patch; faces ((0 4 7 3)); } right { type patch; faces ((1 2 6 5)); }
          sides { type empty; faces ((0 1 5 4) (3 7 6 2) (0 3 2 1) (4 5 6 7)); });
"""
    control = """startFrom startTime; startTime %.12g; stopAt endTime; endTime %.12g; deltaT %.17g;
writeControl timeStep; writeInterval %d; writePrecision 17; timePrecision 12;
functions { probes { type probes; libs (sampling); fields (%s);
                     probeLocations ((%.17g .5 .5) (%.17g .5 .5)); } }
"""
    field = """FoamFile { version 2.0; format ascii; class vol%sField; object x; }
dimensions [%s]; internalField %s; boundaryField { left { %s } right { %s } sides { type empty; } }
"""
    driven = """type uniformFixedValue; uniformValue tableFile; value uniform %s;
               uniformValueCoeffs { file "<constant>/table"; outOfBounds clamp; }"""

    def __init__(self, folder, solver, cells, fields, probe, entry):
        self.folder, self.solver, self.cells, self.probe, self.entry = (
            folder, solver, cells, probe, entry)
        self.runs = 0
        for part in "system", "constant", "0":
            (folder / part).mkdir(parents=True)
        for name in "system/fvSchemes", "system/fvSolution", "constant/transportProperties":
            (folder / name).write_text(self.dictionary + self.numbers)
        (folder / "system/blockMeshDict").write_text(self.dictionary + self.mesh % cells)
        for name, values in fields.items():
            (folder / "0" / name).write_text(self.field % values)
        self._control(0, 1, 1)
        self._call("blockMesh")

    def _control(self, start, end, steps):
        at = 0.5 / self.cells, 1.5 / self.cells
        text = self.control % (start, end, (end - start) / steps, steps, self.probe, *at)
        (self.folder / "system/controlDict").write_text(self.dictionary + text)

    def _call(self, program):
        where = {"WM_PROJECT_DIR": "/usr/share/openfoam", **os.environ}
        done = subprocess.run([program], cwd=self.folder, env=where, capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"{program}: {(done.stderr or done.stdout)[-400:]}")

    def window(self, times, values):
        """From times[0] to times[-1], the left end as the table says.  Returns the probes in the
        first two cells at the step ends, shape (steps, 2)."""
        rows = (f"({t:.17g} {self.entry % v})" for t, v in zip(times, values))
        (self.folder / "constant/table").write_text("(" + "\n".join(rows) + ")\n")
        shutil.rmtree(self.folder / "postProcessing", ignore_errors=True)
        self._control(times[0], times[-1], len(times) - 1)
        self._call(self.solver)
        self.runs += 1
        log, = self.folder.glob(f"postProcessing/probes/*/{self.probe}")
        return np.loadtxt(log, ndmin=2)[:, 1:]


class CalculiX:
    """Heat in the rod [0, length], conductivity, density and heat capacity 1; the right end is at 0,
    heat comes in at the left one."""

    def __init__(self, folder, length, elements, temperature):
        self.folder, self.elements, self.runs = folder, elements, 0
        self.accepted = self.end = temperature(length * np.arange(elements + 1) / elements)
        folder.mkdir()
        corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
        self.head = ["*NODE,NSET=ALL"]
        self.head += [f"{4 * i + j + 1},{length * i / elements:.17g},{y},{z}"
                      for i in range(elements + 1) for j, (y, z) in enumerate(corners)]
        self.head += ["*ELEMENT,TYPE=DC3D8,ELSET=ROD"]
        self.head += [f"{i + 1}," + ",".join(str(4 * i + j) for j in range(1, 9))
                      for i in range(elements)]
        self.head += ["*NSET,NSET=LINE", *(f"{4 * i + 1}," for i in range(elements + 1)),
                      "*MATERIAL,NAME=M", "*CONDUCTIVITY", "1.", "*SPECIFIC HEAT", "1.", "*DENSITY",
                      "1.", "*SOLID SECTION,ELSET=ROD,MATERIAL=M",
                      "*INITIAL CONDITIONS,TYPE=TEMPERATURE"]

    def window(self, step, flux):
        """From the accepted temperatures through steps of this size with these fluxes.  Returns the
        temperature of the left end at the step ends; CalculiX prints 7 digits."""
        text = self.head + [f"{4 * i + j},{T:.9g}" for i, T in enumerate(self.accepted)
                            for j in range(1, 5)]
        text += ["*AMPLITUDE,NAME=FLUX", f"0.,{flux[0]:.15g}"]
        text += [f"{(j + 1) * step:.15g},{q:.15g}" for j, q in enumerate(flux)]
        text += ["*STEP,INC=1000", "*HEAT TRANSFER,DIRECT", f"{step:.15g},{step * len(flux):.15g}",
                 "*BOUNDARY", *(f"{4 * self.elements + j},11,11,0." for j in range(1, 5)),
                 "*DFLUX,AMPLITUDE=FLUX", "1,S1,1.", "*NODE PRINT,NSET=LINE", "NT", "*END STEP"]
        (self.folder / "rod.inp").write_text("\n".join(text) + "\n")
        done = subprocess.run(["ccx", "rod"], cwd=self.folder, capture_output=True, text=True)
        rows = re.findall(r"^ +\d+ +(\S+)$", (self.folder / "rod.dat").read_text(), re.M)
        if done.returncode or len(rows) != len(flux) * (self.elements + 1):
            sys.exit("ccx: " + done.stdout[-400:])
        self.runs += 1
        printed = np.array(rows, float).reshape(len(flux), -1)
        self.end = printed[-1]
        return np.ascontiguousarray(printed[:, 0])

    def accept(self):
        self.accepted = self.end


def report(label, iterations, runs, errors):
    later = sum(iterations[1:]) / len(iterations[1:])
    cells = [label, iterations[0], f"{later:.1f}", runs, *(f"{e:.1e}" for e in errors)]
    print("| " + " | ".join(map(str, cells)) + " |", flush=True)
    return (later, *errors)


def piston(folder, label, integral=True, windows=5, **settings):
    """The table's row: iterations, runs of icoFoam, largest errors of x and v at window ends."""
    ratio, w0, dt, steps_a, steps_b = 3, 2 * math.pi, 0.05, 10, 3
    fluid = OpenFOAM(folder, "icoFoam", 20, {
        "U": ("Vector", "0 1 -1 0 0 0 0", "uniform (1 0 0)", OpenFOAM.driven % "(1 0 0)",
              "type zeroGradient;"),
        "p": ("Scalar", "0 2 -2 0 0 0 0", "uniform 0", "type fixedFluxExtrapolatedPressure;",
              "type fixedValue; value uniform 0;")}, "p", "(%.17g 0 0)")
    T, state, h = kit.Table("rk4"), np.array([0.0, 1.0]), dt / steps_b  # x and v of the piston
    # The velocity at the piston's steps; the pressure's running integral, or the pressure as printed.
    v, load = kit.Waveform(1, 2 * steps_b + 1), kit.Waveform(1, steps_a + 1)
    v.write(0, 1)
    v.restrict(3, 0)  # history for the guess, not for the spline
    load.write(0, 0)
    q, hx = kit.QN(steps_b, tol=1e-8, **settings), np.empty(steps_b)
    iterations, errors = [], np.zeros(2)
    for n in range(windows):
        times = dt * (n + np.arange(steps_a + 1) / steps_a)
        v.begin(dt * (n + np.arange(1, steps_b + 1) / steps_b), degree=2 if n else 0)
        done = False
        while not done:
            p = fluid.window(times, v.fit()(times)[:, 0]) @ [1.5, -0.5]  # the face, from two cells
            load.rollback()
            for t, value in zip(times[1:], load.x[load.start] + np.cumsum(p) * dt / steps_a
                                if integral else p):
                load.write(t, value)
            y, k, read = state, np.zeros((T.stages, 2)), load.fit()
            for j in range(steps_b):
                for i in range(T.stages):
                    z = T.stage(i, h, y, k)
                    force = ratio * read(times[0] + (j + T.c[i]) * h, int(integral))[0]
                    k[i] = z[1], -force - (1 + ratio) * w0**2 * z[0]
                y = T.finish(h, y, k)
                hx[j] = y[1]
            done = q.step(v.unknowns, hx)
        iterations.append(q.commit())
        state, end = y, w0 * times[-1]
        errors = np.maximum(errors, abs(state - [math.sin(end) / w0, math.cos(end)]))
        v.advance(steps_b)
        load.advance()
    return report(label, iterations, fluid.runs, errors)


def mode(conductivity, length):
    """The slowest mode of two rods with diffusivity 1, this conductivity on [-1, 0] and 1 on
    [0, length], ends at 0: the w of sin w (x + 1) / sin w and sin w (length - x) / sin w length."""
    a, b = math.pi / 2, math.pi / (2 * length)
    while b - a > 1e-15 * b:
        w = (a + b) / 2
        a, b = (w, b) if conductivity / math.tan(w) + 1 / math.tan(w * length) > 0 else (a, w)
    return a


def rods(folder, label, windows=5, dt=0.1, **settings):
    """The table's row: iterations, runs of each code, largest error of the interface at window ends.
    Last of what is returned: what implicit Euler does with the longer of the steps, (w^2 dt / 2) / e."""
    conductivity, length, steps_a, steps_b, cells = 4, 0.5, 10, 5, 40
    w = mode(conductivity, length)
    start = np.sin(w * (1 - (np.arange(cells) + 0.5) / cells)) / math.sin(w)
    A = OpenFOAM(folder / "a", "laplacianFoam", cells, {
        "T": ("Scalar", "0 0 0 1 0 0 0", "nonuniform List<scalar> (%s)"
              % " ".join(f"{T:.17g}" for T in start), OpenFOAM.driven % "1",
              "type fixedValue; value uniform 0;")}, "T", "%.17g")
    B = CalculiX(folder / "b", length, 20, lambda x: np.sin(w * (length - x)) / math.sin(w * length))
    T, Q = kit.Waveform(1, 2 * steps_b + 1), kit.Waveform(1, steps_a + 1)  # temperature; heat, added up
    T.write(0, 1)
    T.restrict(3, 0)
    Q.write(0, 0)
    q, iterations, error = kit.QN(steps_b, **settings), [], 0
    for n in range(windows):
        times = dt * (n + np.arange(steps_a + 1) / steps_a)
        ends = dt * (n + np.arange(steps_b + 1) / steps_b)
        T.begin(ends[1:], degree=2 if n else 0)
        done = False
        while not done:
            left = T.fit()(times)[:, 0]
            flux = conductivity * (A.window(times, left)[:, 0] - left[1:]) * 2 * cells
            Q.rollback()
            for t, heat in zip(times[1:], Q.x[Q.start] + np.cumsum(flux) * dt / steps_a):
                Q.write(t, heat)
            means = np.diff(Q.fit()(ends)[:, 0]) * steps_b / dt
            try:
                done = q.step(T.unknowns, B.window(dt / steps_b, means))
            except kit.GaveUp as end:
                print(f"| {label} | gives up {end} |")
                return None
        iterations.append(q.commit())
        B.accept()
        error = max(error, abs(T.x[T.columns - 1, 0] - math.exp(-w * w * times[-1])))
        T.advance(steps_b)
        Q.advance()
    return (*report(label, iterations, A.runs, [error]), w * w * dt / steps_b / 2 / math.e)


def main(folder):
    print("| piston in a channel, tolerance 1e-8 | first window | later | icoFoam runs | error of x "
          "| error of v |\n|---|---|---|---|---|---|")
    ils = piston(folder / "1", "IQN-ILS, integral of the pressure")
    held = piston(folder / "2", "IQN-ILS, pressure as printed", integral=False)
    aitken = piston(folder / "3", "Aitken, integral", windows=3, method="aitken", omega=0.25)
    best = piston(folder / "4", "best constant, 0.25, integral", windows=3, method="constant",
                  omega=0.25)
    print("\n| two rods | first window | later | runs of each | error |\n|---|---|---|---|---|")
    heat = rods(folder / "5", "IQN-ILS, tolerance 1e-5", tol=1e-5)
    half = rods(folder / "6", "the same, windows of half the length", windows=10, dt=0.05, tol=1e-5)
    slow = rods(folder / "7", "Aitken", windows=3, tol=1e-5, method="aitken", omega=0.2)
    const = rods(folder / "8", "best constant, 0.2", windows=3, tol=1e-5, method="constant",
                 omega=0.2)
    rods(folder / "9", "IQN-ILS, tolerance 1e-7: below the digits", tol=1e-7)
    known = rods(folder / "10", "IQN-ILS, tolerance 1e-6, IQN_NOISE_LEVEL 5e-7", tol=1e-6,
                 noise_level=5e-7)
    # Exact answers, and what an accelerator is for; iterations with room for other versions.
    return (ils[1] < 3e-6 and ils[2] < 3e-5 and held[2] > 30 * ils[2] and ils[0] < 6
            and 1.5 * ils[0] < min(aitken[0], best[0]) and 1.5 * heat[0] < min(slow[0], const[0])
            and heat[1] < heat[2] and 1.8 < heat[1] / half[1] < 2.2 and known and known[0] < 5)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as where:
        sys.exit(not main(Path(where)))
