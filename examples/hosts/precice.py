# SPDX-License-Identifier: MIT
"""precice.py - this is not preCICE: a stand-in that runs solvers written for it in one process

    python3 precice.py left.py ARGUMENTS -- right.py ARGUMENTS [-- more.py ARGUMENTS]

runs the scripts unmodified: `import precice` in them means this file.  From a program of your own:
precice.run(left, right), functions, each of which makes one precice.Participant.

One solver runs at a time, as <participants> says: first, second, first ...  The first one given is
the main thread, which signal handlers need; the others are threads.  Of two that need it start what
they do after that by precice.run(a.main, b.main).  More than two: <coupling-scheme:multi>, or
several explicit schemes.  The names are those of pyprecice 3.  waveform.h interpolates and iqn.h accelerates, by kit.py.
There is no transport, and no mapping but nearest-neighbor.  What the configuration asks for beyond
_known below stops with the name of the element; elements of _ignored are named in the second line
that is printed.  examples/precice.md has the map from the configuration to the two headers."""
import re
import sys
import threading
import warnings
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

import kit

# Elements and their attributes; NAME=VALUE: no other value is supported, NAME=: it has no effect.
_measure = "limit data mesh suffices=false strict=false"
_newton = "reduced-time-grid on-bound-violation=ignore always-build-jacobian="
_known = {
    "precice-configuration": "experimental= wait-in-finalize=", "participant": "name control=",
    "data:scalar": "name waveform-degree", "data:vector": "name waveform-degree",
    "mesh": "name dimensions", "use-data": "name", "provide-mesh": "name",
    "receive-mesh": "name from api-access=false geometric-filter= safety-factor=",
    "write-data": "name mesh", "read-data": "name mesh",
    "mapping:nearest-neighbor": "direction from to constraint=consistent",
    "coupling-scheme:serial-explicit": "", "coupling-scheme:parallel-explicit": "",
    "coupling-scheme:serial-implicit": "", "coupling-scheme:parallel-implicit": "",
    "coupling-scheme:multi": "",
    "participants": "first second", "exchange": "data mesh from to initialize substeps",
    "max-time": "value", "time-window-size": "value method=fixed", "max-iterations": "value",
    "absolute-convergence-measure": _measure, "relative-convergence-measure": _measure,
    "acceleration:constant": "", "acceleration:aitken": "", "acceleration:IQN-ILS": _newton,
    "acceleration:IQN-IMVJ": _newton, "data": "name mesh", "relaxation": "value",
    "initial-relaxation": "value enforce=false", "max-used-iterations": "value",
    "time-windows-reused": "value", "preconditioner": "type update-on-threshold= freeze-after=-1",
}
_ignored = ("log", "m2n", "intra-comm", "profiling", "export", "watch-point", "watch-integral",
            "filter", "imvj-restart-mode")


class Error(RuntimeError):
    """What preCICE would end the program with, or what this stand-in does not do."""


# ---- the configuration ---------------------------------------------------------------------------


def _yes(element, name, default):
    return element.get(name, default).lower() in ("1", "true", "yes", "on")


def _check(element, ignored):
    tag = element.tag
    if tag.split(":")[0] in _ignored:
        ignored.append(f"<{tag}>")
        return
    if tag not in _known:
        raise Error(f"<{tag}> is not supported")
    known = dict(name.partition("=")[::2] for name in _known[tag].split())
    for name, value in element.attrib.items():
        if name not in known or known[name] not in ("", value.lower()):
            raise Error(f'<{tag} {name}="{value}"> is not supported')
    for child in element:
        _check(child, ignored)


def _read(file):
    text = re.sub(r"(</?[\w-]+):", r"\1..", Path(file).read_text())  # : begins a namespace
    root = ElementTree.fromstring(text.encode())
    for element in root.iter():
        element.tag = element.tag.replace("..", ":")
    ignored = []
    _check(root, ignored)
    print("precice.py: this is not preCICE, but a stand-in on waveform.h and iqn.h")
    print("precice.py: ignored:", *sorted(set(ignored)), flush=True)
    return root


def _value(element, tag, default, kind=float):
    found = element.find(tag)
    return default if found is None else kind(found.get("value"))


def _one(root, prefix, need=True):
    found = [e for e in root if e.tag.startswith(prefix)]
    if len(found) > 1 or need and not found:
        raise Error(f"{len(found)} elements <{prefix}...>: one is supported")
    return found[0] if found else None


def _meshes(root, tag, participant, data):
    """Where a participant reads or writes these data."""
    return [e.get("mesh") for p in root.iter("participant") if p.get("name") == participant
            for e in p.iter(tag) if e.get("name") == data]


# ---- what is exchanged ---------------------------------------------------------------------------


def _mapping(root, meshes, source, target):
    """The vertex of `source` for each one of `target`."""
    pairs = [(m.get("from"), m.get("to")) for m in root.iter("mapping:nearest-neighbor")]
    if source != target and (source, target) not in pairs:
        raise Error(f"no <mapping:nearest-neighbor> from {source} to {target}")
    nearest = lambda p: np.argmin(((meshes[source] - p) ** 2).sum(axis=1))
    return np.array([nearest(p) for p in meshes[target]], int)


def _room(w, columns, degree):
    """w, or a larger one with the same samples."""
    if w.x.shape[0] >= columns:
        return w
    larger = kit.Waveform(w.n, 2 * columns, degree, strict=False)
    kit.wf_copy(larger.handle, w.handle)
    return larger


class _Exchange:
    """An <exchange>: `out` is what its sender has written, `seen` what its receiver reads.  The two
    are the same where the receiver waits for the sender; else `seen` lags behind."""

    def __init__(self, root, meshes, members, element, lagged, substeps):
        self.name, self.mesh, self.lagged = element.get("data"), element.get("mesh"), lagged
        self.sender, receiver = (members[element.get(key)] for key in ("from", "to"))
        self.substeps = _yes(element, "substeps", substeps)
        data = next(d for d in root if d.get("name") == self.name and d.tag.startswith("data:"))
        self.degree = int(data.get("waveform-degree", "1"))
        written = _meshes(root, "write-data", self.sender.name, self.name)
        if not written:
            raise Error(f"{self.sender.name} has no <write-data> for {self.name}")
        self.source = self.mesh if self.mesh in written else written[0]
        self.outward = _mapping(root, meshes, self.source, self.mesh)
        for mesh in _meshes(root, "read-data", receiver.name, self.name):
            receiver._reads[mesh, self.name] = self, _mapping(root, meshes, self.mesh, mesh)
        self.d = self.sender.get_data_dimensions(self.mesh, self.name)
        self.n, self.grid = len(meshes[self.mesh]) * self.d, None
        self.out, self.seen = (kit.Waveform(self.n, 8, self.degree, strict=False) for _ in "os")
        self.push(0.0, initial=True)

    def push(self, t, initial=False):
        rows = self.sender._writes.get((self.source, self.name))
        if rows is None and not initial:
            raise Error(f"{self.sender.name} has not written {self.name} on {self.source}")
        value = np.zeros(self.n) if rows is None else rows[self.outward].ravel()
        self.out = _room(self.out, self.out.columns + 1, self.degree)
        self.out.write(t, value)
        if initial:
            self.seen.write(t, value)
            self.before = value
        if not self.lagged:
            self.seen = self.out

    def unknowns(self, first, t0, t1):
        """x and hx; in the first iteration of a window x is the constant guess that was read, on
        the sub-steps of the very first window, which `grid` keeps."""
        if first:
            times = self.out.times[1:]
            if self.grid is None:
                self.grid = (times - t0) / (t1 - t0)
            if len(times) != len(self.grid):
                times = np.append(t0 + self.grid[:-1] * (t1 - t0), t1)
            self.seen = _room(self.seen, len(times) + 1, self.degree)
            self.seen.begin(times)
        return self.seen.unknowns, self.out(self.seen.times[1:])


# ---- the coupling scheme -------------------------------------------------------------------------


class _Coupling:
    def __init__(self, count):
        self.may_run = [threading.Semaphore(i == 0) for i in range(count)]
        self.alive = [True] * count
        self.root, self.members, self.meshes, self.q = None, {}, {}, None
        self.ready = self.window = self.iteration = self.failed = 0
        self.start, self.repeat, self.counts = 0.0, False, []

    def hand_over(self, me, other):
        """Solver number `other` runs, until somebody hands over to `me`."""
        if other != me:
            if self.alive[other]:
                self.may_run[other].release()
                self.may_run[me].acquire()
            if not all(self.alive) and self.ongoing:
                raise Error("the other solver has ended too early")

    def next(self, name):
        """The number of the solver that runs after this one in a window."""
        order = self.order
        return self.members[order[(order.index(name) + 1) % len(order)]]._seat

    def read(self, file):
        self.root = _read(file)
        self.schemes = [e for e in self.root if e.tag.startswith("coupling-scheme:")]
        self.scheme = s = self.schemes[0] if self.schemes else _one(self.root, "coupling-scheme:")
        self.implicit = "explicit" not in s.tag
        if len(self.schemes) > 1 and not all("explicit" in e.tag for e in self.schemes):
            raise Error("several coupling schemes: explicit ones alone are supported")
        self.acceleration = _one(s, "acceleration:", need=False)
        both = lambda tag: [float(_one(e, tag).get("value")) for e in self.schemes]
        if len({*both("time-window-size")}) > 1 or len({*both("max-time")}) > 1:
            raise Error("several coupling schemes: windows and max-time have to be the same")
        self.size, self.max_time = both("time-window-size")[0], both("max-time")[0]
        self.most = _value(s, "max-iterations", np.inf)
        ends = [(_one(e, "participants"), "serial" in e.tag) for e in self.schemes
                if not e.tag.endswith("multi")]
        pairs = [(e.get("first"), e.get("second"), serial) for e, serial in ends]
        names = [p.get("name") for p in s.findall("participant")]  # of multi
        names += [name for pair in pairs for name in pair[:2]]
        self.order = sorted(dict.fromkeys(names), key=names.index)
        for _ in self.order:  # the first of a serial scheme runs in front of its second
            for first, second, serial in pairs:
                i, j = self.order.index(first), self.order.index(second)
                if serial and i > j:
                    self.order.insert(j, self.order.pop(i))
        if any(serial and self.order.index(a) > self.order.index(b) for a, b, serial in pairs):
            raise Error("serial coupling schemes in a circle are not supported")
        if len(self.order) != len(self.alive):
            raise Error(f"the configuration has {len(self.order)} participants, {len(self.alive)} run")

    ongoing = property(lambda self: self.max_time - self.start > 1e-10 * self.size)

    @property
    def end(self):
        t = (self.window + 1) * self.size
        return t if t < self.max_time - 1e-10 * self.size else self.max_time

    def prepare(self):
        """All solvers have called initialize."""
        self.exchanges = []
        for s in self.schemes:
            pair = s.find("participants")
            for e in s.iter("exchange"):
                lagged = not ("serial" in s.tag and e.get("from") == pair.get("first"))
                self.exchanges.append(_Exchange(self.root, self.meshes, self.members, e, lagged,
                                                "true" if self.implicit else "false"))
        for member in self.members.values():
            member._writes.clear()

    def find(self, name, mesh):
        found = [e for e in self.exchanges if (e.name, e.mesh) == (name, mesh)]
        if not found:
            raise Error(f"no <exchange> of {name} on {mesh}")
        return found[0]

    def converged(self):
        every = False
        for m in self.scheme:
            if m.tag.endswith("-measure"):
                e = self.find(m.get("data"), m.get("mesh"))
                new, old = e.out.samples[-1], e.seen.samples[-1] if e.lagged else e.before
                size = np.linalg.norm(new) if m.tag.startswith("relative") else 1
                if not np.linalg.norm(new - old) <= float(m.get("limit")) * size:
                    return False
                every = True
        return every

    def judge(self):
        """All solvers are at the window end: repeat the window, or go on."""
        self.iteration += 1
        last, good = self.iteration >= self.most, self.converged()
        self.failed += self.implicit and last and not good
        done = good or last or not self.implicit
        if self.acceleration is not None:
            self.accelerate(self.acceleration, done)
        for e in self.exchanges:
            e.before = e.out.samples[-1].copy()
            if e.lagged and (done or self.acceleration is None):
                e.seen = _room(e.seen, e.out.columns, e.degree)
                kit.wf_copy(e.seen.handle, e.out.handle)  # what was written, not the next guess
            for w in {e.out, e.seen} if done else ():
                w.advance()
            e.out.rollback()
        self.repeat = not done
        if done:
            self.start, self.window = self.end, self.window + 1
            self.counts.append(self.iteration)
            self.iteration = 0

    def accelerate(self, element, done):
        """A step of iqn.h, without limits: the last iteration takes one as well, for its pair."""
        lagged = [e for e in self.exchanges if e.lagged]
        parts = [e.unknowns(self.iteration == 1, self.start, self.end) for e in lagged]
        x, hx = (np.concatenate([part[i].ravel() for part in parts]) for i in (0, 1))
        if self.q is None:
            self.q = self.solver(element, lagged)
        self.q.step(x, hx)
        for now, _ in parts:
            now[:], x = x[: now.size].reshape(now.shape), x[now.size :]
        if done:
            self.q.commit()

    def solver(self, element, lagged):
        method = element.tag.split(":")[1]
        newton, imvj = method.startswith("IQN"), method == "IQN-IMVJ"
        listed = [self.find(d.get("name"), d.get("mesh")) for d in element.iter("data")]
        if not all(e in lagged for e in listed):
            raise Error(f"<{element.tag}>: data of the first participant in a serial scheme")
        reduced = newton and _yes(element, "reduced-time-grid", "true")
        blocks = []  # length, weight
        for e in lagged:
            front = (len(e.grid) - 1) * e.n if reduced else 0
            blocks += [(front, 0)] if front else []
            blocks += [(len(e.grid) * e.n - front, float(e in listed))]
        omega = _value(element, "initial-relaxation", 0.1 if newton else 0.5)
        columns = _value(element, "max-used-iterations", 100, int)
        lengths = [length for length, _ in blocks]
        q = kit.QN(sum(lengths), columns=columns, blocks=lengths, patience=0,
                   omega=_value(element, "relaxation", omega), method=method.replace("IQN-", ""))
        if newton:
            q.set(windows=_value(element, "time-windows-reused", 0 if imvj else 10))
        scaling = element.find("preconditioner")
        scaling = "value" if scaling is None else scaling.get("type")
        if scaling not in ("constant", "value", "residual", "residual-sum"):
            raise Error(f'<preconditioner type="{scaling}"> is not supported')
        q.set_block(-1, scaling="by_" + scaling.replace("constant", "weight").replace("-", "_"))
        for b, (_, weight) in enumerate(blocks):
            q.set_block(b, weight=weight)
        return q


_coupling = None
_seat = threading.local()


def run(*solvers):
    """Run functions, one solver each, the first in this thread.  Returns the iterations of every
    window."""
    global _coupling
    coupling, failures, count = _Coupling(len(solvers)), [], len(solvers)
    if count < 2:
        raise Error(f"two solvers or more are expected, not {count}")

    def thread(me):
        _seat.number = me
        try:
            coupling.may_run[me].acquire()
            if not failures:
                solvers[me]()
        except SystemExit as leaving:
            if leaving.code:
                failures.append(Error(f"a solver has ended with exit code {leaving.code}"))
        except BaseException as failure:
            if me > 0 and "main thread" in str(failure):
                failure = Error(f"{failure}: the first solver given is in it; where several need it, "
                                "call precice.run(a, b) with what they do after that")
            failures.append(failure)
        finally:
            coupling.alive[me] = False
            for i in range(1, count):  # whoever waits goes on, and sees that this one has ended
                if coupling.alive[(me + i) % count]:
                    coupling.may_run[(me + i) % count].release()
                    break

    _coupling = coupling
    threads = [threading.Thread(target=thread, args=(me,), daemon=True) for me in range(1, count)]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", kit.Remark)  # few samples: a lower degree, as in preCICE
        for t in threads:
            t.start()
        thread(0)
        for t in threads:
            t.join()
    _coupling = None
    if failures:
        raise failures[0]
    print(f"precice.py: {len(coupling.counts)} windows, {sum(coupling.counts)} iterations,",
          f"{coupling.failed} windows ended by max-iterations")
    return coupling.counts


# ---- the interface of pyprecice ------------------------------------------------------------------


class Participant:
    def __init__(self, solver_name, configuration_file_name, solver_process_index,
                 solver_process_size, communicator=None):
        self._all, self.name = _coupling, solver_name
        if _coupling is None:
            raise Error("all solvers run in one process: python3 precice.py a.py .. -- b.py ..")
        if solver_process_size != 1:
            raise Error("a solver of several processes is not supported")
        if self._all.root is None:
            self._all.read(configuration_file_name)
        if solver_name not in self._all.order:
            raise Error(f"{solver_name} is in no coupling scheme")
        self._root, self._all.members[self.name] = self._all.root, self
        self._seat = _seat.number
        self._time, self._reads, self._writes = 0.0, {}, {}
        self._complete = self._reading = False
        self._writing = self._all.implicit

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        if re.match("set_mesh_(edge|triangle|quad|tetra)|requires_(mesh|grad)|.*profiling", name):
            return lambda *arguments: False  # nearest-neighbor reads no connectivity, no gradients
        raise Error(f"{name} is not supported")

    def initialize(self):
        both, me = self._all, self._seat
        both.ready += 1
        if both.ready < len(both.alive):
            both.hand_over(me, (me + 1) % len(both.alive))  # who has not been here yet
        else:
            both.prepare()
            both.hand_over(me, both.members[both.order[0]]._seat)

    def advance(self, computed_timestep_length):
        both = self._all
        left, near = self.get_max_time_step_size() - computed_timestep_length, 1e-10 * both.size
        if left < -near or computed_timestep_length <= 0:
            raise Error(f"advance({computed_timestep_length}): not a step inside the window")
        self._time = both.end if left <= near else self._time + computed_timestep_length
        for e in both.exchanges:
            if e.sender is self and (left <= near or e.substeps):
                e.push(self._time)
        self._writes.clear()
        self._complete = self._reading = self._writing = False
        if left > near:
            return
        if self.name == both.order[-1]:
            both.judge()
        if both.ongoing or self.name == both.order[-1]:  # at the end, too: they end in their order
            both.hand_over(self._seat, both.next(self.name))
        self._time, self._reading, self._complete = both.start, both.repeat, not both.repeat
        self._writing = self._complete and both.implicit and both.ongoing

    def get_mesh_dimensions(self, mesh_name):
        found = [m for m in self._root if m.tag == "mesh" and m.get("name") == mesh_name]
        if not found:
            raise Error(f"no <mesh> {mesh_name}")
        return int(found[0].get("dimensions"))

    def get_data_dimensions(self, mesh_name, data_name):
        vectors = [d.get("name") for d in self._root if d.tag == "data:vector"]
        return self.get_mesh_dimensions(mesh_name) if data_name in vectors else 1

    def get_max_time_step_size(self):
        return self._all.end - self._time if self._all.ongoing else 0.0

    def requires_initial_data(self):
        return any(e.get("from") == self.name and _yes(e, "initialize", "false")
                   for s in self._all.schemes for e in s.iter("exchange"))

    finalize = lambda self: None
    is_coupling_ongoing = lambda self: self._all.ongoing
    is_time_window_complete = lambda self: self._complete
    requires_writing_checkpoint = lambda self: self._writing
    requires_reading_checkpoint = lambda self: self._reading

    def set_mesh_vertex(self, mesh_name, position):
        return int(self.set_mesh_vertices(mesh_name, [position])[0])

    def set_mesh_vertices(self, mesh_name, positions):
        rows = np.asarray(positions, float).reshape(-1, self.get_mesh_dimensions(mesh_name))
        old = self._all.meshes.get(mesh_name, rows[:0])
        self._all.meshes[mesh_name] = np.concatenate([old, rows])
        return np.arange(len(old), len(old) + len(rows), dtype=np.int32)

    def get_mesh_vertex_size(self, mesh_name):
        return len(self._all.meshes.get(mesh_name, ()))

    def write_data(self, mesh_name, data_name, vertex_ids, values):
        shape = self.get_mesh_vertex_size(mesh_name), self.get_data_dimensions(mesh_name, data_name)
        rows = self._writes.setdefault((mesh_name, data_name), np.zeros(shape))
        rows[np.asarray(vertex_ids, int)] = np.asarray(values, float).reshape(-1, shape[1])

    def read_data(self, mesh_name, data_name, vertex_ids, relative_read_time):
        if not 0 <= relative_read_time <= self.get_max_time_step_size() + 1e-10 * self._all.size:
            raise Error(f"read_data: {relative_read_time} lies outside the time window")
        if (mesh_name, data_name) not in self._reads:
            raise Error(f"read_data: {self.name} has no {data_name} on {mesh_name}")
        e, inward = self._reads[mesh_name, data_name]
        at = min(self._time + relative_read_time, max(self._time, self._all.end))
        rows = e.seen(at).reshape(-1, e.d)[inward[np.asarray(vertex_ids, int)]]
        return rows[:, 0] if e.d == 1 else rows


def _script(arguments):
    def solve():
        sys.argv = arguments
        sys.path.insert(0, str(Path(arguments[0]).resolve().parent))
        code = compile(Path(arguments[0]).read_text(), arguments[0], "exec")
        exec(code, {"__name__": "__main__", "__file__": arguments[0]})

    return solve


if __name__ == "__main__":
    arguments = sys.argv[1:]
    scripts = [[]]
    for argument in arguments:
        scripts.append([]) if argument == "--" else scripts[-1].append(argument)
    if len(scripts) < 2 or not all(scripts):
        sys.exit("usage: python3 precice.py a.py ARGUMENTS -- b.py ARGUMENTS [-- c.py ..]")
    sys.modules["precice"] = sys.modules["__main__"]
    try:
        run(*map(_script, scripts))
    except Error as error:
        sys.exit(f"precice.py: {error}")
