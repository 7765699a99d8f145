# SPDX-License-Identifier: MIT
"""blackbox.py - OpenFOAM and CalculiX as they are, started anew for every window, through kit.py

    INSTALL=1 sh examples/hosts/run.sh OpenFOAM     # with the packages openfoam and calculix-ccx

Fluid and structure: a piston on a spring, Runge-Kutta 4 in this file, drives the fluid of a
channel, icoFoam, which weighs three times as much.  Exact: (m + rho A L) x'' + k x = 0.

Heat: laplacianFoam's rod takes the temperature of the interface and returns the heat that leaves
it, CalculiX's rod takes the heat and returns the temperature.  Exact: an eigenmode of the two.

A code that is started anew for every window, in ten lines:
 1. Checkpoint: what the code restarts from, here a time folder or a list of temperatures.  Keep
    that of the window start until the window is accepted: to roll back is to start from it again.
 2. Table in: the waveform of the other side, read at the times of this code's own steps, with 17
    digits.  Most codes interpolate a table by straight lines: give a row for each of their steps.
 3. Run from the window start to the window end, and look whether all steps are in the log.
 4. Log out: one sample for each step, pushed at the end of the step.
 5. A flux or a pressure of implicit Euler is a mean over its step.  Push its running integral.  The
    other side reads it with deriv 1, or as a mean over its own step: a difference of two reads.
 6. x is one flat array, the samples of one side in the window; H is one run of both codes.
 7. Digits: ask for 17, and look at what is printed.  Seven digits are an error of 5e-7 at most.
 8. Noise level: tell it to iqn.h (IQN_NOISE_LEVEL) if the tolerance has to be near it.  The linear
    solvers inside have one, too: their tolerance.
 9. A tolerance below the noise is never met.  Set IQN_MAX_ITERATIONS, for a run costs a process.
10. Accept: the checkpoint of the window end becomes that of the next start; commit, advance."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from math import cos, exp, pi, sin, tan
from pathlib import Path

import numpy as np

import kit


def call(folder, *command):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True,
                          env={"WM_PROJECT_DIR": "/usr/share/openfoam", **os.environ})
    if done.returncode:
        sys.exit(f"{command[0]}: {(done.stdout + done.stderr)[-600:]}")


class OpenFOAM:
    """A solver of OpenFOAM on [0, 1], its left end driven by a table in time, two cells probed."""

    numbers = """
        ddtSchemes { default Euler; } gradSchemes { default Gauss linear; }
        divSchemes { default Gauss linear; } interpolationSchemes { default linear; }
        laplacianSchemes { default Gauss linear corrected; } snGradSchemes { default corrected; }
        solvers { "p.*|T" { solver PCG; preconditioner DIC; tolerance 1e-13; relTol 0; }
                  U { solver PBiCGStab; preconditioner DILU; tolerance 1e-13; relTol 0; } }
        PISO { nCorrectors 3; } SIMPLE { nNonOrthogonalCorrectors 0; }
        nu [0 2 -1 0 0 0 0] 1e-6; DT [0 2 -1 0 0 0 0] 1; """
    mesh = """
        scale 1; edges (); blocks (hex (0 1 2 3 4 5 6 7) (%d 1 1) simpleGrading (1 1 1));
        vertices ((0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 1) (1 0 1) (1 1 1) (0 1 1));
        boundary (left { type patch; faces ((0 4 7 3)); } right { type patch; faces ((1 2 6 5)); }
                  sides { type empty; faces ((0 1 5 4) (3 7 6 2) (0 3 2 1) (4 5 6 7)); }); """
    control = """
        startFrom startTime; startTime %s; stopAt endTime; endTime %.12g; deltaT %.17g;
        writeControl timeStep; writeInterval %d; writePrecision 17; timePrecision 12;
        functions { probes { type probes; libs (sampling); fields (%s);
                             probeLocations ((%g .5 .5) (%g .5 .5)); } } """
    field = """
        dimensions [%s]; internalField %s;
        boundaryField { left { %s } right { %s } sides { type empty; } } """
    driven = """
        type uniformFixedValue; uniformValue tableFile; value uniform %s;
        uniformValueCoeffs { file "<constant>/table"; outOfBounds clamp; } """

    def __init__(self, folder, solver, cells, probe, entry, **fields):
        self.folder, self.solver, self.cells, self.probe = folder, solver, cells, probe
        self.entry, self.runs = entry, 0
        self.start = self.end = "0"  # the checkpoint, and what may become one: folders
        for part in "system", "constant", "0":
            (folder / part).mkdir(parents=True)
        for file in "system/fvSchemes", "system/fvSolution", "constant/transportProperties":
            self._write(file, self.numbers)
        self._write("system/blockMeshDict", self.mesh % cells)
        for name, (kind, *values) in fields.items():
            self._write("0/" + name, self.field % tuple(values), kind)
        self._control(1, 1, 1)
        call(folder, "blockMesh")

    def _write(self, file, text, kind="dictionary"):
        head = "FoamFile { version 2.0; format ascii; class %s; object x; }" % kind
        (self.folder / file).write_text(head + text)

    def _control(self, end, step, steps):
        values = end, step, steps, self.probe, 0.5 / self.cells, 1.5 / self.cells
        self._write("system/controlDict", self.control % (self.start, *values))

    def window(self, times, values):
        """From times[0] to times[-1] in equal steps.  Returns the probes at the ends of the steps,
        shape (steps, 2)."""
        steps = len(times) - 1
        rows = (f"({t:.17g} {self.entry % v})" for t, v in zip(times, values))
        (self.folder / "constant/table").write_text("(" + "\n".join(rows) + ")\n")
        shutil.rmtree(self.folder / "postProcessing", ignore_errors=True)
        self._control(times[-1], (times[-1] - times[0]) / steps, steps)
        call(self.folder, self.solver)
        self.runs += 1
        folders = [f.name for f in self.folder.glob("[0-9]*")]
        self.end = min(folders, key=lambda name: abs(float(name) - times[-1]))
        log, = self.folder.glob("postProcessing/probes/*/" + self.probe)
        printed = np.loadtxt(log, ndmin=2)[:, 1:]
        if len(printed) != steps:
            sys.exit(f"{self.solver}: {len(printed)} steps of {steps}")
        return printed

    def accept(self):
        self.start = self.end


class CalculiX:
    """Heat in the rod [0, length]; conductivity, density and heat capacity are 1.  A flux enters
    its left end, the right one is at 0."""

    def __init__(self, folder, length, elements, temperature):
        self.folder, self.elements, self.runs = folder, elements, 0
        x = length * np.arange(elements + 1) / elements
        self.start = self.end = temperature(x)  # the checkpoint, and what may become one
        folder.mkdir()
        corners = list(enumerate(["0,0", "1,0", "1,1", "0,1"], 1))
        nodes = [f"{4 * i + j},{x[i]:.17g},{yz}" for i in range(elements + 1) for j, yz in corners]
        bricks = [",".join(map(str, [i + 1, *range(4 * i + 1, 4 * i + 9)]))
                  for i in range(elements)]
        self.model = ["*NODE,NSET=ALL", *nodes, "*ELEMENT,TYPE=DC3D8,ELSET=ROD", *bricks,
                      "*NSET,NSET=LINE", *(f"{4 * i + 1}," for i in range(elements + 1)),
                      "*MATERIAL,NAME=M", "*CONDUCTIVITY", "1.", "*SPECIFIC HEAT", "1.", "*DENSITY",
                      "1.", "*SOLID SECTION,ELSET=ROD,MATERIAL=M",
                      "*INITIAL CONDITIONS,TYPE=TEMPERATURE"]

    def window(self, step, flux):
        """Steps of this size with these fluxes.  Returns the temperature of the left end at the
        ends of the steps, shape (steps,).  CalculiX prints 7 digits."""
        steps, last = len(flux), range(4 * self.elements + 1, 4 * self.elements + 5)
        text = [*self.model, *(f"{4 * i + j},{T:.9g}" for i, T in enumerate(self.start)
                               for j in range(1, 5)),
                "*AMPLITUDE,NAME=FLUX", f"0.,{flux[0]:.15g}",
                *(f"{(j + 1) * step:.15g},{q:.15g}" for j, q in enumerate(flux)),
                "*STEP,INC=1000", "*HEAT TRANSFER,DIRECT", f"{step:.15g},{step * steps:.15g}",
                "*BOUNDARY", *(f"{node},11,11,0." for node in last),
                "*DFLUX,AMPLITUDE=FLUX", "1,S1,1.", "*NODE PRINT,NSET=LINE", "NT", "*END STEP"]
        (self.folder / "rod.inp").write_text("\n".join(text) + "\n")
        call(self.folder, "ccx", "rod")
        self.runs += 1
        rows = re.findall(r"^ +\d+ +(\S+)$", (self.folder / "rod.dat").read_text(), re.M)
        if len(rows) != steps * (self.elements + 1):
            sys.exit(f"ccx: {len(rows)} temperatures of {steps * (self.elements + 1)}")
        printed = np.array(rows, float).reshape(steps, -1)
        self.end = printed[-1]
        return printed[:, 0]

    def accept(self):
        self.start = self.end


def piston(folder, integral=True, windows=5, fine=10, coarse=3, **settings):
    """Returns iterations of each window, runs of icoFoam, the largest error of x and of v."""
    ratio, w, h = 3, 2 * pi, 0.25 / windows
    fluid = OpenFOAM(
        folder, "icoFoam", 20, "p", "(%.17g 0 0)",
        U=("volVectorField", "0 1 -1 0 0 0 0", "uniform (1 0 0)", OpenFOAM.driven % "(1 0 0)",
           "type zeroGradient;"),
        p=("volScalarField", "0 2 -2 0 0 0 0", "uniform 0", "type fixedFluxExtrapolatedPressure;",
           "type fixedValue; value uniform 0;"))
    rk4, state, errors = kit.Table("rk4"), np.array([0.0, 1.0]), 0  # x and v
    load, v = kit.Waveform(1, fine + 1), kit.Waveform(1, coarse + 1)
    load.write(0, 0)
    v.write(0, 1)
    q, iterations = kit.QN(fine, tol=1e-8, **settings), []

    def rate(t, y, read):
        return y[1], -ratio * read(t, deriv=int(integral))[0] - (1 + ratio) * w**2 * y[0]

    def structure(times, read, out):
        y, k, step = state, np.empty((4, 2)), times[1] - times[0]
        for t in times[:-1]:
            for i in range(4):
                k[i] = rate(t + rk4.c[i] * step, rk4.stage(i, step, y, k), read)
            y = rk4.finish(step, y, k)
            out.write(t + step, y[1])
        return y

    for n in range(windows):
        times = h * (n + np.arange(fine + 1) / fine)
        load.begin(times[1:])
        done = False
        while not done:
            v.rollback()
            end = structure(h * (n + np.arange(coarse + 1) / coarse), load.fit(), v)
            p = fluid.window(times, v(times)[:, 0]) @ [1.5, -0.5]  # at the face, from two cells
            if integral:
                p = load.x[load.start] + np.cumsum(p) * h / fine
            done = q.step(load.unknowns, p)
        iterations.append(q.commit())
        fluid.accept()
        state, angle = end, w * times[-1]
        errors = np.maximum(errors, abs(state - [sin(angle) / w, cos(angle)]))
        load.advance()
        v.advance()
    return iterations, fluid.runs, *errors


def mode(conductivity, length):
    """Of rods [-1, 0] with this conductivity and [0, length] with 1, diffusivity 1, ends at 0: the
    least w where sin w (x + 1) / sin w and sin w (length - x) / sin w length have the same flux."""
    a, b = pi / 2, pi / (2 * length)
    for _ in range(60):
        w = (a + b) / 2
        a, b = (w, b) if conductivity / tan(w) + 1 / tan(w * length) > 0 else (a, w)
    return a


def rods(folder, windows=4, fine=10, coarse=4, **settings):
    """Returns iterations of each window, runs of each code, the interface's largest error."""
    conductivity, length, cells, h, error = 4, 0.5, 40, 0.4 / windows, 0
    w = mode(conductivity, length)
    start = np.sin(w * (1 - (np.arange(cells) + 0.5) / cells)) / sin(w)
    A = OpenFOAM(
        folder / "a", "laplacianFoam", cells, "T", "%.17g",
        T=("volScalarField", "0 0 0 1 0 0 0", "nonuniform List<scalar> (%s)"
           % " ".join(f"{T:.17g}" for T in start), OpenFOAM.driven % "1",
           "type fixedValue; value uniform 0;"))
    B = CalculiX(folder / "b", length, 20, lambda x: np.sin(w * (length - x)) / sin(w * length))
    T, heat = kit.Waveform(1, coarse + 1), kit.Waveform(1, fine + 1)
    T.write(0, 1)
    heat.write(0, 0)  # that has left A since t = 0
    q, iterations = kit.QN(coarse, **settings), []
    for n in range(windows):
        times, ends = (h * (n + np.arange(m + 1) / m) for m in (fine, coarse))
        T.begin(ends[1:])
        done = False
        while not done:
            face = T(times)[:, 0]
            flux = conductivity * (A.window(times, face)[:, 0] - face[1:]) / (0.5 / cells)
            heat.rollback()
            for t, Q in zip(times[1:], heat.x[heat.start] + np.cumsum(flux) * h / fine):
                heat.write(t, Q)
            means = np.diff(heat(ends)[:, 0]) / (h / coarse)
            left = np.array(B.window(h / coarse, means))
            try:
                done = q.step(T.unknowns, left)
            except kit.GaveUp:  # as near as the digits allow
                done = True
        iterations.append(q.commit())
        A.accept()
        B.accept()
        error = max(error, abs(T(times[-1])[0] - exp(-w**2 * times[-1])))
        T.advance()
        heat.advance()
    return iterations, A.runs, error


def row(name, iterations, runs, *errors):
    """Prints a row of the table; returns the mean of all iterations, and the errors."""
    later = sum(iterations[1:]) / len(iterations[1:])
    cells = name, iterations[0], f"{later:.1f}", runs, *(f"{e:.1e}" for e in errors)
    print("|", " | ".join(map(str, cells)), "|", flush=True)
    return sum(iterations) / len(iterations), *errors


def main(folder):
    kept = iter(range(100))

    def run(name, problem, *windows, **settings):
        return row(name, *problem(folder / str(next(kept)), *windows, **settings))

    def rivals(problem, factor, **settings):
        aitken = run("Aitken", problem, method="aitken", omega=factor, **settings)
        best = f"constant {factor}, the best"
        return min(aitken[0], run(best, problem, method="constant", omega=factor, **settings)[0])

    print("| piston and channel, 3 and 10 sub-steps, tolerance 1e-8 | iterations: first window "
          "| later | runs of icoFoam | error of x | error of v |\n|---|---|---|---|---|---|")
    mean, x, v = run("iqn.h, integral of the pressure", piston)
    printed = run("iqn.h, pressure as printed", piston, integral=False)
    good = x < 3e-6 and v < 3e-5 < printed[2] / 30 and mean < 0.75 * rivals(piston, 0.25)

    print("\n| two rods, 10 and 4 sub-steps, tolerance 1e-5 | iterations: first window | later "
          "| runs of each code | error |\n|---|---|---|---|---|")
    mean, error = run("iqn.h", rods, tol=1e-5)
    _, half = run("iqn.h, windows of half the length", rods, 8, tol=1e-5)
    good = good and mean < 0.75 * rivals(rods, 0.2, tol=1e-5)
    # Implicit Euler is of order 1: in steps of zero the error is that of the meshes.
    good = good and error < 1e-2 and abs(2 * half - error) < 3e-4
    for name, settings in ("", {}), (", IQN_NOISE_LEVEL 5e-7", {"noise_level": 5e-7}):
        _, same = run("iqn.h, 1e-7: below the digits" + name, rods, tol=1e-7, **settings)
        good = good and abs(same - error) < 1e-5
    return good


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as place:
        sys.exit(not main(Path(place)))
