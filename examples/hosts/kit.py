# SPDX-License-Identifier: MIT
"""kit.py - waveform.h, iqn.h and rk.h for Python: NumPy owns the arrays, nothing is copied

    import kit
    q = kit.QN(n, tol=1e-8)                # quasi-Newton on x = H(x), n numbers
    while not q.step(x, H(x)): pass        # x becomes the next input, and at last the answer
    q.commit()                             # the next time window, or step
    kit.plot(q)                            # iterations and residuals, from q.history

    kit.fixed_point(H, x0, tol=1e-8)       # the loop above, and kit.root(F, x0): as SciPy has them
    q = kit.Core(tol=1e-6)                 # the same for arrays of CuPy, Torch, JAX, float, complex
    w = kit.Waveform(n, columns=50)  # cubic B-splines in time: w.x[j] is the sample at w.times[j]
    T = kit.Table("dp5")                   # Runge-Kutta tables, T.A, T.b, T.c, with dense output

Copy this file and the three headers into one folder; libm and NumPy are all they need.  An import
compiles headers that are new with $CC (cc) into ~/.cache/waveform_iqn_rk, or below $XDG_CACHE_HOME.
The environment variable KIT_LIBRARY names a library that exists already, made by

    cc -O2 -shared -fPIC -DWF_IMPLEMENTATION -DIQN_IMPLEMENTATION -DRK_IMPLEMENTATION \\
       -x c waveform.h iqn.h rk.h -x none -lm -o libkit.so

A wheel has it inside: make wheel, pip install, import waveform_iqn_rk as kit.

The classes own their memory and check shapes; pickle and copy.deepcopy take all of an object; threads
may share one, a call waits for the other.  Every function, struct and constant of the headers
is here under its C name, too: kit.wf_push, with its prototype in __doc__.  There an array is one of
float64 whose last axis is contiguous (column j of a header is row j): its address is passed, its
size is yours to get right, NULL is None, and complex128 passes as twice as many real numbers.

A negative status becomes a kit.Error with the header's sentence; others are returned.  In the
classes a remark becomes a warning, kit.Remark, once for each kind and object; what a step of QN
was, its history says."""
import collections
import copy
import ctypes
import functools
import hashlib
import os
import platform
import re
import shlex
import subprocess
import tempfile
import threading
import warnings
from ctypes import POINTER, byref, c_char_p, c_double, c_int, c_size_t, c_ssize_t, c_void_p
from pathlib import Path

import numpy as np

# made from the headers: begin
_versions = "waveform.h 300, iqn.h 300, rk.h 300"
_constants = """
WF_REMARK 1000000000, WF_OK 0, WF_ALLNAN 1000000106, WF_EXTRAP 1000000110, WF_NOISY 1000000109,
WF_LOWERED 1000000108, WF_SLIVER 1000000107, WF_EARG -101, WF_EMEM -102, WF_EORDER -103,
WF_ENULL -104, WF_EOVERLAP -106, WF_EFULL -110, WF_EFEW -111, WF_ERANGE -112, WF_EEXTRAP -113,
WF_ENOISY -114, WF_ETWICE -115, WF_ESTALE -116, WF_ESPENT -117, WF_ESLOPE -118, WF_ENOSLOPE -119,
WF_EDEGREE -120, WF_MAX_DEGREE 15, WF_SLOPE 1, WF_BREAK 2, WF_BEHIND 1024, WF_AUTO -1,
WF_MISSES 80, IQN_REMARK 200, IQN_OK 0, IQN_SOLVED 201, IQN_RELAXED 202, IQN_DROPPED 203,
IQN_WITHDRAWN 204, IQN_STALLED 206, IQN_NOISE 207, IQN_DIVERGED 208, IQN_EXPLORED 209,
IQN_UNCOMMITTED 210, IQN_NOPAIR 211, IQN_NOTBEST 212, IQN_EARG -201, IQN_EMEM -202,
IQN_EORDER -203, IQN_ENULL -204, IQN_ENAN -205, IQN_EOVERLAP -206, IQN_EKEY -210,
IQN_EVALUE -211, IQN_ELENGTH -212, IQN_ESUM -213, IQN_EDOTS -214, IQN_EHOST -215, IQN_METHOD 1,
IQN_OMEGA 2, IQN_FILTER_LIMIT 4, IQN_WINDOWS 5, IQN_TOL_ABSOLUTE 7, IQN_TOL_RELATIVE 8,
IQN_TOL_REDUCTION 9, IQN_MAX_ITERATIONS 11, IQN_PATIENCE 12, IQN_MIXING 14, IQN_NOISE_LEVEL 21,
IQN_GROWTH 22, IQN_MERGE 23, IQN_PRODUCT_ERROR 24, IQN_LENGTH 51, IQN_SCALING 52, IQN_WEIGHT 53,
IQN_LOWER 55, IQN_UPPER 56, IQN_RESIDUAL 101, IQN_VALUE 102, IQN_RELATIVE 103, IQN_REDUCTION 104,
IQN_BEST_RELATIVE 105, IQN_PAIRS 106, IQN_ITERATIONS 107, IQN_OMEGA_NOW 108, IQN_PREDICTED 109,
IQN_NSTEPS 151, IQN_NSUMS 152, IQN_NDROPPED 153, IQN_NFULL 154, IQN_NZERO 155, IQN_NRELAXED 156,
IQN_NWITHDRAWN 157, IQN_NREFUSED 159, IQN_NSTALLED 160, IQN_NEXPLORED 161, IQN_ILS 0, IQN_IMVJ 1,
IQN_AITKEN 2, IQN_CONSTANT 3, IQN_BY_WEIGHT 0, IQN_BY_VALUE 1, IQN_BY_RESIDUAL 2,
IQN_BY_RESIDUAL_SUM 3, IQN_HOST -2, IQN_DOT_RR 0, IQN_DOT_HH 1, IQN_DOT_VV 2, IQN_DOT_VR 3,
IQN_DOT_SS 4, IQN_DOT_SV 5, IQN_DOTS 6, RK_REMARK 300, RK_OK 0, RK_NONFINITE 302, RK_ROWSUM 303,
RK_LESS 304, RK_REJECT 305, RK_UNBOUNDED 306, RK_PASSED 307, RK_EXTRAP 310, RK_EARG -301,
RK_EMEM -302, RK_ENULL -304, RK_ENAN -305, RK_EOVERLAP -306, RK_ETIMES -310, RK_ENAME -311,
RK_ENODENSE -312, RK_ENOPAIR -313, RK_ETABLE -314, RK_ESTEP -315, RK_EPAIR -316, RK_EDENSE -317,
RK_ETINY -318, RK_EOTHER -319, RK_EEXPLICIT -320, RK_EFAILURES -321, RK_EXPLICIT 1,
RK_SEQUENTIAL 2, RK_STIFFLY_ACCURATE 3, RK_FSAL 4, RK_GAUSS 1, RK_RADAU_IIA 2, RK_LOBATTO_IIIA 3,
RK_LOBATTO_IIIB 4, RK_LOBATTO_IIIC 5, RK_FROM_LAST 0, RK_FROM_START 1, RK_GROUPS 2, RK_RELAXED 3
"""
_declarations = """
struct rk_table {const char *name; int stages; int order, order_hat; int powers; int dense_order;
int extra; const double *A; const double *b, *c; const double *bhat; const double *e;
const double *d; const double *e3; int dense_stiff;}; struct rk_step {const rk_table *T;
double h; ptrdiff_t n; const double *y, *k; ptrdiff_t ldk;}; struct rk_control {double k[5];
double safety; double grow, first; double shrink, again; double accept; double least;
double stop, start; double smallest, largest; int order; double wanted, cut; double e[2], h[2];
int steps, rejected;}; struct rk_coupling {const char *name; int form; int stages, order,
order_hat; int powers; const double *c; const double *W; const double *G;
const signed char *groups;}; size_t wf_size(ptrdiff_t n, int degree, int capacity);
int wf_make(wf **w, ptrdiff_t n, int degree, int capacity, void *mem, size_t bytes);
int wf_push(wf *w, double t, int what); double *wf_column(const wf *w, int j);
int wf_begin(wf *w, int degree, int count, const double *t, int what); int wf_read(wf *w,
double t, int deriv, double *out); int wf_mean(wf *w, double a, double b, double *out);
int wf_advance(wf *w, int history); int wf_rollback(wf *w); int wf_pop(wf *w);
int wf_columns(const wf *w); int wf_start(const wf *w); int wf_degree(wf *w);
double wf_time(const wf *w, int j); int wf_what(const wf *w, int j);
double wf_next_break(const wf *w, double t); int wf_strict(wf *w, int level);
int wf_restrict(wf *w, int degree, int history); double wf_valid_from(const wf *w);
int wf_monotone(wf *w); int wf_copy(wf *to, const wf *from); int wf_resample(wf *from, wf *to);
int wf_fit(wf *w, double *c); int wf_eval(const wf *w, double t, int deriv, const double *c,
double *out); int wf_weights(wf *w, double t, int deriv, double *weight);
int wf_weights_mean(wf *w, double a, double b, double *weight); int wf_predict(const wf *w,
int degree, double t, double *weight); int wf_combine(int count, int columns,
const double *weight, ptrdiff_t n, const double *x, ptrdiff_t ldx, double *y, ptrdiff_t ldy);
int wf_foretell(const wf *w, double *squares); int wf_error(wf *w, wf *other, double *out);
int wf_choose(wf *w, wf *other, double *estimate); int wf_quality(wf *w, double *noise);
int wf_linked_version(void); const char *wf_message(int status); size_t iqn_size(ptrdiff_t n,
int columns, int blocks); int iqn_make(iqn **q, ptrdiff_t n, int columns, int blocks, void *mem,
size_t bytes); int iqn_set(iqn *q, int key, double value); int iqn_set_block(iqn *q, int block,
int key, double value); double iqn_get(const iqn *q, int key); double iqn_get_block(const iqn *q,
int block, int key); int iqn_step(iqn *q, double *x, const double *hx); int iqn_halve(iqn *q,
double *x); int iqn_best(iqn *q, double *x, double *hx); int iqn_converged(const iqn *q);
int iqn_commit(iqn *q); int iqn_discard(iqn *q); const char *iqn_message(int status);
int iqn_linked_version(void); int iqn_changed(iqn *q); typedef int iqn_sum(double *v, int count,
void *ctx); int iqn_set_sum(iqn *q, iqn_sum *sum, void *ctx); int iqn_push(iqn *q,
const double *v, const double *w); int iqn_pair(const iqn *q, int j, double *v, double *w);
int iqn_delay(iqn *q); int iqn_ask(iqn *q, int *slot); int iqn_weights(iqn *q, const double *dot,
double *weight, int *store); int iqn_push_dots(iqn *q, const double *dot);
const rk_table *rk_find(const char *name); int rk_is(const rk_table *T, int property);
int rk_stage(const rk_table *T, int i, double h, ptrdiff_t n, const double *y, const double *k,
ptrdiff_t ldk, double *z); int rk_update(const rk_table *T, double h, ptrdiff_t n,
const double *y, const double *k, ptrdiff_t ldk, double *ynew, double *err);
int rk_dense(const rk_step *s, double theta, int deriv, double *out); int rk_norm(double rtol,
double atol, const double *size, ptrdiff_t n, const double *v, const double *y0,
const double *y1, double sum[2]); double rk_rms(const double sum[2]);
int rk_control_make(rk_control *C, const char *method, const rk_table *T);
int rk_control_step(rk_control *C, double error, double *t, double *h);
int rk_control_stop(rk_control *C, double stop, double t, double *h);
double rk_time(const rk_control *C, double node, double t, double h);
double rk_first_step(int order, double length, double d0, double d1, double d2);
const char *rk_message(int status); const rk_table *rk_tables(void);
int rk_collocation(rk_table *T, int family, int stages, void *mem, size_t bytes);
size_t rk_collocation_size(int stages); int rk_stages(const rk_table *T, double h, ptrdiff_t n,
const double *y, const double *k, ptrdiff_t ldk, double *z, ptrdiff_t ldz);
int rk_combine(double h, int slopes, const double *weight, ptrdiff_t n, const double *y,
const double *k, ptrdiff_t ldk, double *out); int rk_dense_many(const rk_step *s, int deriv,
int count, const double *theta, double *out, ptrdiff_t ldout); int rk_weights(const rk_table *T,
double theta, int deriv, double *weight); double rk_combined_error(double error, double third);
int rk_error_order(const rk_table *T); int rk_control_order(rk_control *C, const char *method,
int order); const rk_coupling *rk_coupling_find(const char *name);
const rk_coupling *rk_couplings(void); int rk_coupling_from(const rk_coupling *C, int i);
double rk_coupling_time(const rk_coupling *C, int i);
int rk_coupling_forcing(const rk_coupling *C, int i, double *w);
int rk_coupling_jump(const rk_coupling *C, int i, double *g); int rk_mis(rk_coupling *C,
const rk_table *T, int form, void *mem, size_t bytes); size_t rk_mis_size(int stages);
int rk_linked_version(void);
"""
# made from the headers: end


class Error(ValueError):
    """A negative status; str() is the header's sentence."""

    def __init__(self, function, status, sentence):
        super().__init__(f"{function}: {sentence}")
        self.status = status


class Remark(UserWarning):
    """A call is done, with a remark; str() is the header's sentence."""


class GaveUp(ArithmeticError):
    """No progress for `patience` iterations, or max_iterations: commit all the same, or discard and
    repeat the window from restored states.  x is the next input."""


# ---- the library: compiled once, for these very headers ------------------------------------------


def _folder():
    """Where compiled libraries are kept, or a temporary folder where there is no home."""
    cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "waveform_iqn_rk"
    try:
        cache.mkdir(parents=True, exist_ok=True, mode=0o700)
    except OSError:
        pass
    return cache if os.access(cache, os.W_OK) else Path(tempfile.mkdtemp(prefix="kit-"))


# wf_eval at many times, in one call from Python; eval is wf_eval
_many = """
#include <stddef.h>
typedef int eval(const void *w, double t, int deriv, const double *c, double *out);
int kit_many(eval *one, const void *w, ptrdiff_t count, const double *t, int deriv, const double *c,
             double *out, ptrdiff_t n);
int kit_many(eval *one, const void *w, ptrdiff_t count, const double *t, int deriv, const double *c,
             double *out, ptrdiff_t n)
{
    int remark = 0;
    ptrdiff_t k;
    for (k = 0; k < count; k++) {
        const int status = one(w, t[k], deriv, c, out + k * n);
        if (status < 0) return status;
        if (status > remark) remark = status;
    }
    return remark;
}
"""


def _build():
    names = "waveform.h", "iqn.h", "rk.h"
    here = Path(__file__).resolve().parent
    made = here / "libkit.so"  # in a wheel
    if made.exists():
        return str(made)
    found = [p for p in (here, *here.parents[1:2]) if all((p / n).exists() for n in names)]
    if not found:
        raise ImportError(f"kit: waveform.h, iqn.h, rk.h are not in {here}; KIT_LIBRARY is not set")
    headers = [str(found[0] / n) for n in names]
    command = shlex.split(os.environ.get("CC", "cc")) + ["-O2", "-shared", "-fPIC", "-x", "c"]
    command += [f"-D{h}_IMPLEMENTATION" for h in ("WF", "IQN", "RK")] + headers
    text = b"".join(Path(header).read_bytes() for header in headers) + _many.encode()
    stamp = hashlib.sha256(" ".join([*command, platform.machine()]).encode() + text)
    library = _folder() / f"libkit-{stamp.hexdigest()[:16]}.so"
    command += ["-", "-x", "none", "-lm", "-o"]  # -: _many
    if not library.exists():
        new = library.with_suffix(f".{os.getpid()}")
        try:
            subprocess.run([*command, str(new)], input=_many, check=True, capture_output=True,
                           text=True)
        except (OSError, subprocess.CalledProcessError) as error:
            said = getattr(error, "stderr", error)
            raise ImportError(f"kit: {shlex.join(command)} failed\n{said}") from None
        os.replace(new, library)  # in one step: another process sees all of it or nothing
    return str(library)


# ---- C declarations to ctypes --------------------------------------------------------------------


class _Array:
    """double *: the address of a NumPy array; const double *: of one that may be read-only."""

    def __init__(self, written):
        self.written = written

    def from_param(self, a):
        if a is None:
            return None
        if not isinstance(a, np.ndarray) or a.dtype not in (np.float64, np.complex128):
            _refuse(f"an array of float64 or complex128 is expected, not {getattr(a, 'dtype', a)}")
        if a.ndim > 0 and a.shape[-1] > 1 and a.strides[-1] != a.itemsize or not a.flags.aligned:
            _refuse("the last axis of an array has to be contiguous")
        if self.written and not a.flags.writeable:
            _refuse("the array is read-only")
        return c_void_p(a.__array_interface__["data"][0])


class _Text:
    @staticmethod
    def from_param(text):
        return c_char_p(text.encode() if isinstance(text, str) else text)


def _refuse(sentence):
    raise ValueError(sentence)


_plain = {"int": c_int, "double": c_double, "size_t": c_size_t, "ptrdiff_t": c_ssize_t,
          "signed": ctypes.c_byte}
_types = {}  # structs and the types of callbacks, by name


def _type(text, argument=False):
    """The ctypes type of `const double *x` and its like."""
    base = re.sub(r"\bconst\b|\bstruct\b", "", text).split()[0]
    stars = text.count("*") + text.count("[")
    if base in _types and not isinstance(_types[base], type(ctypes.Structure)):
        return _types[base]  # a callback
    if stars == 0:
        return _plain[base]
    if base == "char":
        return _Text if argument else c_char_p
    if argument and stars == 1 and (base == "double" or base == "void" and "mem" in text):
        return _Array("const" not in text)
    if base in ("void", "wf", "iqn"):
        return c_void_p if stars == 1 else POINTER(c_void_p)
    inner = _types.get(base) or _plain[base]
    return POINTER(inner) if stars == 1 else POINTER(POINTER(inner))


def _struct(name, members):
    fields = []
    for member in re.findall(r"[^;]+", members):
        base = re.match(r"\s*((?:const |signed )*\w+)", member).group(1)
        for item in member.replace(base, "", 1).split(","):
            length = re.search(r"\[(\d+)\]", item)
            kind = _type(base + " " + re.sub(r"[^*\[]", "", item))
            kind = kind._type_ * int(length.group(1)) if length else kind
            fields.append((re.search(r"\w+", item).group(), kind))
    _types[name] = globals()[name] = type(name, (ctypes.Structure,), {"_fields_": fields})


def _function(result, name, arguments):
    function = getattr(_library, name)
    function.__doc__ = f"{result}{name}({arguments})"
    inputs = [] if arguments.strip() == "void" else arguments.split(",")
    function.argtypes = [_type(a, argument=True) for a in inputs]
    function.restype = _type(result)
    if function.restype is c_char_p:
        function.errcheck = lambda text, *_: text.decode()
    elif function.restype is c_int:
        function.errcheck = _check
    globals()[name] = function


def _check(status, function, arguments):
    if status < 0:
        name = function.__name__
        raise Error(name, status, globals()[name.split("_")[0] + "_message"](status))
    return status


def _declare():
    for name, value in re.findall(r"(\w+)\s(-?\d+)", _constants):
        globals()[name] = int(value)
    text = " ".join(_declarations.split())
    for name, members in re.findall(r"struct (\w+) \{([^}]*)\}", text):
        _struct(name, members)
    for result, name, arguments in re.findall(r"typedef (\w+ )(\w+)\(([^)]*)\);", text):
        types = [_type(a) for a in [result, *arguments.split(",")]]
        _types[name] = globals()[name] = ctypes.CFUNCTYPE(*types)
    for function in re.findall(r"(?:^|; )((?:const )?\w+ \*?)((?:wf|iqn|rk)_\w+)\(([^)]*)\)", text):
        _function(*function)


def _compare(name):
    """Are the headers in the library those that this file was made from?"""
    dotted = lambda v: f"{v // 10000}.{v // 100 % 100}.{v % 100}"
    for header, version in re.findall(r"(\w+\.h) (\d+)", _versions):
        prefix = {"waveform.h": "wf"}.get(header, header[:-2])
        found = getattr(_library, prefix + "_linked_version", lambda: 0)()
        if found != int(version):
            raise ImportError(f"kit: this file is made for {header} {dotted(int(version))}, and {name} "
                              f"has {dotted(found)}: take kit.py and the headers from one version")


_name = os.environ.get("KIT_LIBRARY") or _build()
_library = ctypes.CDLL(_name)
_compare(_name)
_declare()


# ---- classes -------------------------------------------------------------------------------------


def _vector(a, n, dtype=np.float64):
    if a is None:
        return np.empty(n, dtype)
    if a.shape != (n,) or a.dtype != dtype:
        raise ValueError(f"an array of shape ({n},) and type {np.dtype(dtype)} is expected")
    return a


def _memory(size):
    return np.empty(size // 8 + 1) if size else _refuse("kit: an argument is out of range")


class _Telling:
    """What the classes share: remarks, refused attributes, copies, one call at a time."""

    _ready = False  # from then on attributes that do not exist are refused

    def _tell(self, status):
        told = self.__dict__.setdefault("_told", set())
        if status > globals()[self._header.upper() + "_REMARK"] and status not in told:
            told.add(status)
            warnings.warn(globals()[self._header + "_message"](status), Remark, stacklevel=4)
        return status

    def __setattr__(self, name, value):
        known = name.startswith("_") or name in self.__dict__ or hasattr(type(self), name)
        if self._ready and not known and type(self).__module__ == __name__:
            raise AttributeError(f"{type(self).__name__} has no attribute {name}")
        super().__setattr__(name, value)

    def __getstate__(self):
        out = "handle", "x", "_lock", "_sum"  # what lies at addresses, or is made again
        state = {name: value for name, value in self.__dict__.items() if name not in out}
        return dict(state, _memory=self._memory.copy())

    def __setstate__(self, state):
        self.__dict__.update(state, _ready=False)
        self._lock, self.handle = threading.RLock(), c_void_p(self._memory.ctypes.data)
        self._again()
        self._ready = True

    def _again(self):
        """After a copy: what __getstate__ has left out."""

    def __copy__(self):
        return copy.deepcopy(self)


def _alone(cls):
    """Public methods of an object run one after the other: ctypes lets other threads run meanwhile."""

    def alone(function):
        @functools.wraps(function)
        def call(self, *arguments, **keywords):
            with self._lock:
                return function(self, *arguments, **keywords)

        return call

    for name, function in list(vars(cls).items()):
        if name == "__call__" or not name.startswith("_") and hasattr(function, "__code__"):
            setattr(cls, name, alone(function))
    return cls


@_alone
class Waveform(_Telling):
    """n numbers that depend on time: samples at the sub-steps of a window, the spline through them.

    x       samples, shape (columns, n), a view of the object's memory that stays where it is: row j
            belongs to times[j].  You write to it, at the row that push returns.
    n       0: times alone, for weights
    dtype   complex: n complex numbers
    strict  level of wf_strict: True, a read beyond the stored times is an Error; False, it
            continues the spline; 2, amplified noise is an Error, too

    columns are those of the history, the start and the sub-steps; twice as many with slopes."""

    _header = "wf"

    def __init__(self, n, columns, degree=3, dtype=float, strict=True):
        self.n, self.dtype, self._lock = n, np.dtype(dtype), threading.RLock()
        reals = n * self.dtype.itemsize // 8
        self._memory, self.handle = _memory(wf_size(reals, degree, columns)), c_void_p()
        wf_make(byref(self.handle), reals, degree, columns, self._memory, self._memory.nbytes)
        self._work = columns, degree
        self._again()
        self.x[:] = 0
        wf_strict(self.handle, int(strict))
        self._ready = True

    def _again(self):
        columns, start = self._work[0], self._memory.ctypes.data
        first = (ctypes.cast(wf_column(self.handle, 0), c_void_p).value or start) - start
        rows = self._memory[first // 8 :][: columns * self.n * self.dtype.itemsize // 8]
        self.x = rows.view(self.dtype).reshape(columns, self.n)

    def push(self, t, what=0):
        """A sub-step ends at time t.  Returns the row of x to write its sample to; WF_SLOPE: and
        its time derivative to the next row; WF_BREAK: the row for the value after a jump at t."""
        return wf_push(self.handle, t, what)

    def write(self, t, value, slope=None, jump=False):
        """push, and the sample written, with its slope if there is one; jump: it is that after."""
        j = self.push(t, WF_SLOPE * (slope is not None) | WF_BREAK * jump)
        self.x[j] = value
        if slope is not None:
            self.x[j + 1] = slope

    def begin(self, times, degree=0, what=0):
        """Open a window: push its times (one given twice is a break), fill their rows of x with a
        first guess of that degree, or kit.WF_AUTO."""
        t = np.ascontiguousarray(times, float)
        return self._tell(wf_begin(self.handle, degree, t.size, t, what))

    def rollback(self):
        """Back to the window start: forget every later row."""
        return wf_rollback(self.handle)

    def advance(self, history=0):
        """Next window: the last sample becomes the start, up to `history` older ones stay."""
        return wf_advance(self.handle, history)

    def restrict(self, degree, history):
        """At most this degree, and at most `history` older samples in the spline; first guesses
        still use all."""
        return wf_restrict(self.handle, degree, history)

    def copy(self, other):
        """Take over times and samples of `other`."""
        return self._tell(wf_copy(self.handle, other.handle))

    columns = property(lambda self: wf_columns(self.handle), doc="rows in use")
    degree = property(lambda self: wf_degree(self.handle), doc="working degree")
    start = property(lambda self: wf_start(self.handle), doc="row of the window start")
    samples = property(lambda self: self.x[: self.columns], doc="view of the rows in use")
    unknowns = property(lambda self: self.samples[self.start + 1 :],
                        doc="view of the rows after the window start: what an iteration changes")
    times = property(lambda self: np.array([wf_time(self.handle, j) for j in range(self.columns)]),
                     doc="of the rows in use; those before the window start are history")

    whats = property(lambda self: [wf_what(self.handle, j) for j in range(self.columns)],
                     doc="of the rows in use: 0 a value, WF_SLOPE, WF_BREAK after a jump, or both")
    valid_from = property(lambda self: wf_valid_from(self.handle),
                          doc="the time from which on the spline is made of samples")

    def next_break(self, t):
        """The first jump or kink later than t; inf: none.  An integrator that reads stops there."""
        return wf_next_break(self.handle, t)

    def monotone(self):
        """Write the slopes of the window, at degree 2, so that the spline stays between samples."""
        return wf_monotone(self.handle)

    def __call__(self, t, deriv=0, out=None):
        """The value at any time t, shape (n,), or its time derivative, from the samples as they
        are; t may be an array: shape (len(t), n)."""
        if np.ndim(t):
            return self.fit()(t, deriv)
        out = _vector(out, self.n, self.dtype)
        self._tell(wf_read(self.handle, t, deriv, out))
        return out

    def fit(self):
        """The spline through the samples as they are now, for many reads: spline(t, deriv)."""
        return Spline(self)

    def resample(self, other):
        """Write to the samples of `other` (the same n) what this spline is at its times."""
        return self._tell(wf_resample(self.handle, other.handle))

    def mean(self, a, b, out=None):
        """The mean over the times a to b, shape (n,); the integral is (b - a) times it."""
        out = _vector(out, self.n, self.dtype)
        self._tell(wf_mean(self.handle, a, b, out))
        return out

    def weights(self, t, deriv=0):
        """The row of weights of a read: value = weights @ samples, shape (columns,)."""
        row = np.empty(self.columns)
        self._tell(wf_weights(self.handle, t, deriv, row))
        return row

    def predict(self, t, degree=2):
        """A guess of the value at t, in the next window, by a polynomial through old samples."""
        row = np.empty(self.columns)
        self._tell(wf_predict(self.handle, degree, t, row))
        return row @ self.samples

    def error(self):
        """Estimate of the largest interpolation error in this window, shape (n,)."""
        return self._estimate(wf_error, self.n * self.dtype.itemsize // 8).view(self.dtype)

    def choose(self):
        """restrict to the degree with the least estimated error; returns the estimates."""
        return self._estimate(wf_choose, self._work[1] + 1)

    def _estimate(self, function, count):
        columns, degree = self._work
        out, other = np.empty(count), Waveform(0, columns, min(degree + 2, WF_MAX_DEGREE))
        self._tell(function(self.handle, other.handle, out))
        return out

    def save(self):
        """A checkpoint: all that restore needs."""
        return self._memory.copy()

    def restore(self, checkpoint):
        self._memory[:] = checkpoint


@_alone
class Spline(_Telling):
    """What a Waveform was when fit was called: its times, and c, the coefficients.  It does not
    change when the waveform does."""

    _header = "wf"

    def __init__(self, waveform):
        self._memory, self._lock = waveform.save(), threading.RLock()
        self.handle, self.n = c_void_p(self._memory.ctypes.data), waveform.n
        self.c = np.empty((waveform.columns, waveform.n), waveform.dtype)
        self._told = waveform.__dict__.setdefault("_told", set())  # a remark of both is one
        self._tell(wf_fit(self.handle, self.c))
        self._ready = True

    def __call__(self, t, deriv=0):
        """The value at t, shape (n,), or its time derivative; an array t: shape (len(t), n)."""
        t = np.array(t, float, order="C")
        out = np.empty((*t.shape, self.n), self.c.dtype)
        if hasattr(_library, "kit_many"):
            reals, address = out.itemsize // 8 * self.n, lambda a: c_void_p(a.ctypes.data)
            self._tell(_check(_library.kit_many(
                _library.wf_eval, self.handle, c_ssize_t(t.size), address(t), int(deriv),
                address(self.c), address(out), c_ssize_t(reals)), wf_eval, None))
        else:  # a library that KIT_LIBRARY names
            for i in np.ndindex(t.shape):
                self._tell(wf_eval(self.handle, t[i], deriv, self.c, out[i]))
        return out


class Step(collections.namedtuple("Step", "window iteration residual relative parts pairs status")):
    """residual |r|, relative |r| / |hx|, parts: the latter of each block; pairs: secant pairs."""

    what = property(lambda self: iqn_message(self.status), doc="what the step was, a sentence")


@_alone
class QN(_Telling):
    """Quasi-Newton acceleration of x = H(x) on n numbers, in `columns` secant pairs.

    tol       converged when |H(x) - x| <= tol |H(x)|
    blocks    lengths of the parts of x that have limits, weights or scalings of their own;
              dict(Force=3, Motion=6) gives them names
    dtype     complex: n complex numbers, taken as 2n real ones
    log       "NAME" writes precice-NAME-iterations.log and -convergence.log, as preCICE has them
    settings  every key of iqn_set by its name: omega=0.5, tol_absolute=1e-6, method="imvj"

    history   a Step for each call of step: window, iteration, residuals, pairs, what it was
    Every key of iqn_get is an attribute, q.iterations, q.residual, q.relative, q.ndropped; those of
    iqn_set may be written: q.tol_relative = 1e-3."""

    _header = "iqn"

    def __init__(self, n, tol=None, columns=20, blocks=None, dtype=float, log=None, **settings):
        self.n, self.dtype = n, np.dtype(dtype)
        reals = self.dtype.itemsize // 8
        lengths = [n] if blocks is None else blocks
        lengths = lengths if isinstance(lengths, dict) else dict(enumerate(lengths))
        self._make(n * reals, columns, lengths, tol, log, settings)
        for name, length in lengths.items():
            self.set_block(name, length=length * reals)
        self._ready = True

    def _make(self, n, columns, names, tol, log, settings):
        self.names, count, self._lock, self._function = list(names), len(names), threading.RLock(), None
        self.history, self.window, self.status, self.log, self._gone = [], 1, 0, log, (0, 0)
        self._memory, self.handle = _memory(iqn_size(n, columns, count)), c_void_p()
        iqn_make(byref(self.handle), n, columns, count, self._memory, self._memory.nbytes)
        self._print("iterations", "  TimeWindow  TotalIterations  Iterations  Convergence"
                    "  QNColumns  DeletedQNColumns  DroppedQNColumns", "w")
        heads = ["  TimeWindow  Iteration", *(f"ResRel({name})" for name in self.names)]
        self._print("convergence", "  ".join(heads), "w")
        self.set(**({} if tol is None else {"tol_relative": tol}), **settings)

    def _print(self, kind, line, mode="a"):
        if self.log:
            with open(f"precice-{self.log}-{kind}.log", mode) as file:
                print(line, file=file)

    def set(self, **settings):
        """set(omega=0.5, method="aitken"): keys and values of iqn_set, a word for a constant."""
        for key, value in settings.items():
            iqn_set(self.handle, _key(key), _value(key, value))

    def set_block(self, block, **settings):
        """The same for one block, -1 for all: weight=0, scaling="by_value", tol_relative=1e-6."""
        for key, value in settings.items():
            place = self.names.index(block) if block in self.names else block
            if not isinstance(place, (int, np.integer)):
                raise ValueError(f"no block {block!r}: they are {self.names}")
            iqn_set_block(self.handle, place, _key(key), _value(key, value))

    def get_block(self, block, key):
        return iqn_get_block(self.handle, self.names.index(block), _key(key))

    def __setattr__(self, name, value):
        if self._ready and name not in self.__dict__ and "IQN_" + name.upper() in globals():
            self.set(**{name: value})
        else:
            super().__setattr__(name, value)

    def __getattr__(self, key):
        if key.startswith("_") or key == "handle" or "IQN_" + key.upper() not in globals():
            raise AttributeError(key)
        value = iqn_get(self.handle, _key(key))
        return int(value) if value.is_integer() else value

    def _again(self):
        if self._function:
            self.set_sum(self._function)

    def set_sum(self, function):
        """In a parallel run: function(v) adds v, shape (count,), over all ranks in place."""

        def add(v, count, _):
            try:
                function(np.ctypeslib.as_array(v, (count,)))
            except Exception:  # must not cross C: the step fails with IQN_ESUM
                return 1
            return 0

        self._sum, self._function = iqn_sum(add), function  # kept as long as the handle may call it
        return iqn_set_sum(self.handle, self._sum, None)

    def step(self, x, hx):
        """In: x and hx = H(x), contiguous, n numbers each in any shape.  Out: x is the next input
        (False) or the answer (True).  Raises GaveUp."""
        for a in x, hx:
            if not isinstance(a, np.ndarray):
                raise TypeError(f"x and hx: NumPy arrays are expected, not {type(a).__name__}")
            if a.size != self.n or a.dtype != self.dtype or not a.flags.c_contiguous:
                raise ValueError(f"x and hx: contiguous, {self.n} numbers of type {self.dtype}")
        self.status = iqn_step(self.handle, x, hx)
        return self._end()

    converged = property(lambda self: iqn_converged(self.handle) == 1, doc="the last step has")

    def _end(self):
        keys, q = (IQN_ITERATIONS, IQN_RESIDUAL, IQN_RELATIVE, IQN_PAIRS), self.handle
        k, residual, relative, pairs = (iqn_get(q, key) for key in keys)
        parts = [iqn_get_block(q, b, IQN_RELATIVE) for b in range(len(self.names))]
        step = self.window, int(k), residual, relative, tuple(parts), int(pairs), self.status
        self.history.append(Step(*step))
        if self.log:
            row = [f"{i:6d}" for i in step[:2]] + [f"{a:15.8e}" for a in parts]
            self._print("convergence", "  ".join(row))
        end = iqn_converged(self.handle)
        if end > 1:
            stalled = IQN_STALLED <= self.status <= IQN_DIVERGED
            why = iqn_message(self.status) if stalled else "not converged before max_iterations"
            raise GaveUp(f"after {self.iterations} iterations: {why}")
        return end == 1

    def commit(self):
        """The window is accepted.  Returns its number of iterations."""
        iterations, gone = self.iterations, (self.ndropped, self.nfull)
        row = (self.window, self.nsteps, iterations, self.converged, self.pairs,
               *(now - before for now, before in zip(gone, self._gone)))
        self._print("iterations", "  ".join(f"{i:6d}" for i in row))
        self._gone, self.window = gone, self.window + 1
        iqn_commit(self.handle)
        return iterations

    def discard(self):
        """The window is repeated: its pairs are forgotten."""
        return iqn_discard(self.handle)

    def changed(self):
        """You have put another x in the place of the one that step gave."""
        return iqn_changed(self.handle)

    def halve(self, x):
        """H failed at x: x goes half of the way back, in place."""
        return iqn_halve(self.handle, x)

    def push(self, v, w):
        """Store a pair: H(x) changes by w when H(x) - x changes by v, shape (n,)."""
        v, w = (_vector(a, self.n, self.dtype) for a in (v, w))
        return self._tell(iqn_push(self.handle, v, w))

    def pair(self, j):
        """Pair j, 0 the newest, as (v, w)."""
        v, w = np.empty(self.n, self.dtype), np.empty(self.n, self.dtype)
        iqn_pair(self.handle, j, v, w)
        return v, w

    def save(self):
        """A checkpoint for restore, of the same object."""
        return self._memory.copy(), len(self.history), self.window, self._gone

    def restore(self, checkpoint):
        self._memory[:], steps, self.window, self._gone = checkpoint
        del self.history[steps:]


@_alone
class Core(QN):
    """QN for vectors of any kind that have @ (with another one), + and * (by a number): arrays of
    NumPy, CuPy, Torch, JAX, real or complex, single or double, on their device.  The core of iqn.h
    gets products and gives weights; no vector is changed in place.

        q = kit.Core(tol=1e-6)
        while not q.converged:
            x = q.step(x, H(x))

    blocks    above 1: x is a tuple of so many vectors; or their names
    inner     inner(a, b) in place of a.conj() @ b, of all entries
    metric    of the inner product <a, b> = a' M b: metric(a) returns M a; or one for each block
    allreduce allreduce(v) adds v, an array of numbers, over all ranks in place

    tol, columns, log, settings as in QN; single precision sets noise_level, product_error."""

    def __init__(self, tol=None, columns=20, blocks=1, inner=None, metric=None, allreduce=None,
                 log=None, **settings):
        names = range(blocks) if isinstance(blocks, int) else blocks
        self._make(IQN_HOST, columns, names, tol, log, settings)
        self.count, self.slots = len(names), columns + 2
        self.V, self.W = ([None] * self.slots for _ in "VW")
        self.metric = metric if isinstance(metric, (list, tuple)) else [metric] * self.count
        self.inner, self.allreduce = inner or _inner, allreduce or _nothing
        self._given, self.x, self._ready = settings, None, True

    def __getstate__(self):
        return dict(super().__getstate__(), x=self.x)

    def _split(self, x):
        parts = (x,) if self.count == 1 else tuple(x)
        if len(parts) != self.count:
            raise ValueError(f"x and hx: {self.count} vectors each")
        return parts

    def _ask(self):
        slot = (c_int * self.slots)()
        pairs = iqn_ask(self.handle, slot)
        return slot[0], slot[1], slot[2 : 2 + pairs]

    def step(self, x, hx):
        """x and hx = H(x) stay as they are; returns the next input, or the answer, which is q.x,
        too.  Raises GaveUp."""
        x, h = self._split(x), [1.0 * a for a in self._split(hx)]
        if not self.history and re.search("32$|complex64$", str(getattr(x[0], "dtype", ""))):
            self.set(**{"noise_level": 1e-7, "product_error": 5e-7, **self._given})
        now, base, pairs = self._ask()
        self.V[now], self.W[now] = list(map(_less, h, x)), h
        v, w, dot = [None] * self.count, [None] * self.count, []
        if base >= 0:
            v, w = (list(map(_less, of[now], of[base])) for of in (self.V, self.W))
        for b in range(self.count):
            dot += self._products(b, h[b], v[b], w[b], now, pairs)
        dot = np.array([complex(a).real for a in dot])
        self.allreduce(dot)
        weight, store = np.empty(2 * self.slots), c_int()
        self.status = iqn_weights(self.handle, dot, weight, byref(store))
        if store.value >= 0:
            self.V[store.value], self.W[store.value] = v, w
        used = [(a, of) for a, of in zip(weight.tolist(), self.V + self.W) if a != 0]
        terms = [[a * of[b] for a, of in used] for b in range(self.count)]
        x = [sum(rest, first) for first, *rest in terms]
        self.x = tuple(x) if self.count > 1 else x[0]
        self._end()
        return self.x

    def _products(self, b, h, v, w, now, pairs):
        r, M = self.V[now][b], self.metric[b] or (lambda a: a)
        Mr, olds = M(r), [self.V[j][b] for j in pairs]
        dot = [self.inner(r, Mr), self.inner(h, M(h))]
        if v is None:
            return dot + [0.0] * 4 + [a for p in olds for a in (self.inner(p, Mr), 0.0)]
        s, Mv = _less(w, v), M(v)
        dot += [self.inner(v, Mv), self.inner(v, Mr), self.inner(s, M(s)), self.inner(s, Mv)]
        return dot + [self.inner(p, a) for p in olds for a in (Mr, Mv)]

    def halve(self, x):
        """H failed at x: returns what is half of the way back."""
        iqn_halve(self.handle, None)
        base, half = self._ask()[1], lambda a, h, r: 0.5 * a + 0.5 * _less(h, r)
        x = tuple(map(half, self._split(x), self.W[base], self.V[base]))
        return x if self.count > 1 else x[0]

    def save(self):
        return super().save(), list(self.V), list(self.W)

    def restore(self, checkpoint):
        super().restore(checkpoint[0])
        self.V, self.W = list(checkpoint[1]), list(checkpoint[2])


def _nothing(v):
    pass


def _less(a, b):
    return a + -1.0 * b


def _inner(a, b):
    xp = a.__array_namespace__() if hasattr(a, "__array_namespace__") else None
    if getattr(a, "ndim", 1) > 1:
        a, b = (xp.reshape(v, (-1,)) if xp else v.reshape(-1) for v in (a, b))
    if "complex" in str(getattr(a, "dtype", "")):
        a = xp.conj(a) if xp else a.conj()
    return a @ b


def plot(*runs, labels=None, file=None):
    """The figure of matplotlib: iterations of each window, |r| / |hx| of each iteration, of one QN
    or Core or several; saved to a file, too."""
    from matplotlib import pyplot

    figure, (left, right) = pyplot.subplots(1, 2, figsize=(10, 4), layout="tight")
    for q, label in zip(runs, labels or range(len(runs))):
        most = {s.window: s.iteration for s in q.history}
        left.plot(list(most), list(most.values()), ".-", label=label)
        right.semilogy([s.relative for s in q.history], ".-", label=label)
    left.set(xlabel="window", ylabel="iterations", ylim=(0, None))
    right.set(xlabel="iteration of the run", ylabel="|r| / |H(x)|")
    left.legend()
    if file:
        figure.savefig(file)
    return figure


def _key(name):
    try:
        return globals()["IQN_" + name.upper()]
    except KeyError:
        raise ValueError(f"iqn.h has no key {name}") from None


def _value(key, value):
    if isinstance(value, str):
        value = globals().get("IQN_" + value.upper(), value)
    if isinstance(value, (str, bytes)) or not np.isscalar(value) or np.iscomplexobj(value):
        raise ValueError(f"{key}: a number, or a word that iqn.h has for it, not {value!r}")
    return value


class Result(dict):
    """What fixed_point and root return, as SciPy's OptimizeResult: x, fun, success, status,
    message, nfev, nit, and q, the QN."""

    def __getattr__(self, name):
        if name in self:
            return self[name]
        raise AttributeError(name)

    __dir__ = dict.keys
    __repr__ = lambda self: "\n".join(f"{k:>8}: {v!r}" for k, v in self.items() if k != "q")


def fixed_point(H, x0, args=(), tol=1e-8, maxiter=500, callback=None, **settings):
    """x = H(x, *args), from x0, an array of any shape, real or complex, or a number.  Returns a
    Result: x, or where it gives up the x of the least |H(x) - x|; fun = H(x) - x at the last input
    of H, or at this one.

    tol       success when |H(x) - x| <= tol |H(x)|
    callback  callback(x, H(x) - x) after each call of H; StopIteration ends the search
    settings  of QN: omega=0.5, columns=50, method="aitken"

    Where H returns NaN or Inf, x goes half of the way back, up to ten times in a row."""
    start = np.asarray(x0)
    dtype = complex if np.iscomplexobj(start) else float
    x, least, calls, bad = np.array(start, dtype).reshape(-1), np.inf, 0, 0
    q = QN(x.size, tol=tol, dtype=dtype, **{"max_iterations": maxiter, **settings})
    best, shaped = (x.copy(), x * np.nan), lambda a: a.reshape(start.shape)[()]
    done, message = False, ""
    while not done:
        at = x.copy()
        hx = np.array(H(shaped(at), *args), dtype).reshape(-1)
        calls, r = calls + 1, hx - at
        if np.isfinite(r).all():
            bad, size = 0, np.linalg.norm(r)
            if size < least:
                least, best = size, (at, r)
        else:
            bad += 1
        try:
            if callback is not None:
                callback(shaped(at), shaped(r))
            if bad == 0:
                done = q.step(x, hx)
            elif bad > 10 or q.iterations == 0 or calls >= maxiter:
                raise GaveUp(f"after {calls} calls: H is not finite")
            else:
                q.halve(x)
        except (GaveUp, StopIteration) as reason:
            message, (x, r) = str(reason) or "ended by the callback", best
            break
    return Result(x=shaped(x), fun=shaped(r), success=done, status=q.status,
                  message=message or iqn_message(q.status), nfev=calls, nit=q.nsteps, q=q)


def root(F, x0, args=(), tol=1e-8, alpha=None, maxiter=500, callback=None, **settings):
    """F(x, *args) = 0 as the fixed point of x + alpha F(x); Result, callback, settings as there, but
    fun is F(x), x its argument.

    tol       success when |F(x)| <= tol |F(x0)|
    alpha     1 / alpha is a size of F's derivative, with the sign that makes x + alpha F(x) the
              better one; None: max(|x0|, 1) / (2 |F(x0)|), as in SciPy's anderson"""
    if alpha is None:
        size = np.linalg.norm(F(np.asarray(x0)[()], *args))
        alpha = 0.5 * max(np.linalg.norm(x0), 1) / size if size > 0 else 1.0
    told = callback and (lambda x, r: callback(x, r / alpha))
    H = lambda x: x + alpha * np.asarray(F(x, *args))
    found = fixed_point(H, x0, (), None, maxiter, told, tol_reduction=tol, **settings)
    if found.success:
        found["x"] = found.x - found.fun
    found["fun"] = found.fun / alpha
    return found


@_alone
class Table(_Telling):
    """A Runge-Kutta table by its name, Table("dp5"), or generated, Table("radau_iia", 3).

    A (m, m), b, c, bhat, e (m,), d (m, dense): views of the table, read-only; None what it has not.
    stages, order, order_hat, dense, dense_order, extra as in rk.h; m = stages + extra.
    In the calls below y has shape (n,), and k, the slopes, shape (m, n)."""

    _header = "rk"

    def __init__(self, name, stages=0):
        if stages:
            self._memory, self.handle = _memory(rk_collocation_size(stages)), rk_table()
            family = globals().get("RK_" + name.upper()) or _refuse(f"rk.h has no family {name}")
            rk_collocation(self.handle, family, stages, self._memory, self._memory.nbytes)
        else:
            found = rk_find(name) or _refuse(f"rk.h has no table {name}")
            self.handle = found.contents

        self._lock, self._made_from, self._ready = threading.RLock(), (name, stages), True

    def __reduce__(self):
        return Table, self._made_from

    def __getattr__(self, name):
        if name == "handle" or name not in dict(rk_table._fields_):
            raise AttributeError(name)
        value = getattr(self.handle, name)
        m = self.handle.stages + self.handle.extra
        shape = {"A": (m, m), "d": (m, self.handle.powers)}.get(name, (m,))
        if isinstance(value, (bytes, int)):
            return value.decode() if isinstance(value, bytes) else value
        if not value:
            return None
        view = np.ctypeslib.as_array(value, shape)
        view.flags.writeable = False
        return view

    def stage(self, i, h, y, k, out=None):
        """z = y + h sum_{j<i} a_ij k_j.  With a_ii != 0 the stage is implicit: solve
        k_i = f(t + c_i h, z + h a_ii k_i)."""
        out = _vector(out, y.size)
        self._tell(rk_stage(self.handle, i, h, y.size, y, k, self._ldk(y, k), out))
        return out

    def finish(self, h, y, k, out=None, err=None):
        """y + h sum b_j k_j; out may be y; err takes the estimate h sum (b_j - bhat_j) k_j."""
        out = _vector(out, y.size)
        self._tell(rk_update(self.handle, h, y.size, y, k, self._ldk(y, k), out, err))
        return out

    def eval(self, theta, h, y, k, deriv=0, out=None):
        """Dense output at t + theta h, or its deriv-th derivative in time."""
        out = _vector(out, y.size)
        at = [a.ctypes.data_as(POINTER(c_double)) for a in (y, k)]
        step = rk_step(ctypes.pointer(self.handle), h, y.size, *at, self._ldk(y, k))
        self._tell(rk_dense(step, theta, deriv, out))
        return out

    def _ldk(self, y, k):
        rows = self.handle.stages
        if k.ndim != 2 or len(k) < rows or k.shape[1] != y.size or k.dtype != float:
            raise ValueError(f"k: shape ({rows + self.handle.extra}, {y.size}), float64")
        return k.strides[0] // 8
