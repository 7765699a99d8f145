#!/bin/sh
# SPDX-License-Identifier: MIT
# run.sh [WORD...] - build and run the hosts whose names hold one of the words, or every host, as far
# as this machine has the tools.  Each ends with its exact or published answer and fails if it is
# off.  A host without its tools is skipped, naming the Debian packages; with words and INSTALL=1
# they are installed first.  Prints TAP, the hosts' last lines as comments.  Reads CC, CXX, FC,
# CFLAGS, CXXFLAGS, FFLAGS, PYTHON and the build directory B.
set -u
cc=${CC:-cc} cxx=${CXX:-c++} fc=${FC:-gfortran} cflags=${CFLAGS:--O2}
warn='-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror'
here=$(cd "$(dirname "$0")" && pwd)
top=$here/../..
mkdir -p "${B:-build}/hosts" && cd "${B:-build}/hosts" || exit 1
dir=$(pwd)
count=0 failed=0 words=$*

if [ "$words" ] && [ "${INSTALL:-}" = 1 ]; then
    packages=$(INSTALL=look B=${dir%/hosts} sh "$here/run.sh" "$@")
    sudo=''
    [ "$(id -u)" = 0 ] || sudo='sudo -n'
    [ -z "$packages" ] || { echo "# apt-get install $packages" && $sudo apt-get update -qq &&
        DEBIAN_FRONTEND=noninteractive $sudo apt-get install -qq -y --no-install-recommends \
            $packages; } >&2 || exit 1
fi

wanted() { # wanted NAME: does it hold one of the words?
    [ "$words" ] || return 0
    for word in $words; do
        echo "$1" | grep -qi -e "$word" && return 0
    done
    return 1
}

run() { # run NAME COMMAND...
    name=$1
    shift
    [ "${INSTALL:-}" != look ] && wanted "$name" || return 0
    count=$((count + 1))
    if "$@" >log 2>&1; then
        echo "ok $count - $name"
        grep -E '^[A-Za-z_0-9]+ +[^ ]+$|^\||^skipped|^$' log | sed 's/^/#   /'
    else
        echo "not ok $count - $name"
        failed=1
        head -40 log | sed 's/^/#   /'
    fi
}

skip() { # skip NAME PACKAGES
    wanted "$1" || return 0
    [ "${INSTALL:-}" != look ] || { echo "$2" && return 0; }
    count=$((count + 1))
    echo "ok $count - $1 # SKIP not here; Debian has it in $2"
}

has() { # has HEADER LIBRARY
    printf '#include <stdbool.h>\n#include <%s>\nint main(void) { return 0; }\n' "$1" |
        $cc -x c - -o probe -l"$2" >/dev/null 2>&1
}
tool() { command -v "$1" >/dev/null; }

# The headers compiled as C, once: a shared library for every other language.
library() {
    $cc $cflags -shared -fPIC -DWF_IMPLEMENTATION -DIQN_IMPLEMENTATION -DRK_IMPLEMENTATION \
        -x c "$top/waveform.h" "$top/iqn.h" "$top/rk.h" -x none -lm -o libkit.so
}
use="-L. -Wl,-rpath,$dir -lkit"
[ -z "$words" ] || [ "${INSTALL:-}" = look ] || library >/dev/null 2>&1
run 'a shared library from the three headers, by one command' library

cplusplus() {
    $cxx -std=c++17 $warn -Wmissing-declarations -Wold-style-cast -I"$top" ${CXXFLAGS:--O2} "$here/host.cc" $use \
        -o host_cc && ./host_cc
}
if tool "$cxx"; then run 'C++17' cplusplus; else skip 'C++17' g++; fi

fortran() {
    $fc ${FFLAGS:--O2 -std=f2008 -Wall -Wextra -Werror} "$here/kit.f90" "$here/host.f90" $use \
        -o host_f90 && ./host_f90
}
fields() {
    $fc ${FFLAGS:--O2 -std=f2008 -Wall -Wextra -Werror} "$here/kit.f90" "$here/core.f90" $use \
        -o core_f90 && ./core_f90
}
if tool "$fc"; then
    run 'Fortran 2008' fortran
    run 'Fortran: fields with ghosts' fields
else
    skip 'Fortran 2008' gfortran
fi

with() { # with MODULES: the python3 that has them; Debian's, where another is first
    for p in "${PYTHON:-python3}" /usr/bin/python3; do
        if "$p" -c "import $1" >/dev/null 2>&1; then
            echo "$p"
            return
        fi
    done
}
python=$(with numpy)
export PYTHONDONTWRITEBYTECODE=1 XDG_CACHE_HOME="$dir/cache" KIT_LIBRARY="$dir/libkit.so"
export PYTHON="${python:-none}"
run 'kit.f90 and kit.py say what the headers say' env CC="$cc" FC="$fc" sh "$here/kit.sh"
if [ "$python" ]; then
    run 'kit.py does what it says' "$python" "$here/kit_test.py"
    first_use() {
        env -u KIT_LIBRARY CC="$cc" "$python" "$here/kit_test.py" && ls "$dir"/cache/*/libkit*.so
    }
    run 'kit.py makes its own library' first_use
    run 'Python and NumPy' "$python" "$here/host.py"
    if "$python" -c 'import ensurepip, venv' >/dev/null 2>&1; then
        run 'a wheel in a virtual environment' env -u KIT_LIBRARY CC="$cc" "$python" "$here/wheel.py" "$dir" --test
    else
        skip 'a wheel in a virtual environment' python3-venv
    fi
else
    skip 'Python and NumPy' 'python3-numpy python3-venv'
fi

# Solvers written for preCICE on its stand-ins.
precice() {
    $cxx -std=c++17 $warn -Wmissing-declarations -Wold-style-cast -I"$top" ${CXXFLAGS:--O2} "$here/precice_test.cc" \
        $use -pthread -o precice_cc && ./precice_cc "$here/precice.xml"
}
if [ "$python" ]; then
    run 'preCICE solvers in Python' "$python" "$here/precice_test.py"
else
    skip 'preCICE solvers in Python' python3-numpy
fi
if tool "$cxx"; then run 'preCICE solvers in C++' precice; else skip 'preCICE solvers in C++' g++; fi

host() { # host PROGRAM COMPILER FLAGS...: a C program of its own
    program=$1 compiler=$2
    shift 2
    $compiler -std=c99 $warn -Wmissing-prototypes $cflags -I"$top" "$here/$program.c" "$@" -lm -o "$program" &&
        "./$program"
}
if has cvode/cvode.h sundials_cvode && has gsl/gsl_odeiv2.h gsl; then
    run 'SUNDIALS CVODE and GSL' host sundials_gsl "$cc" -lsundials_cvode -lsundials_nvecserial \
        -lgsl -lgslcblas
else
    skip 'SUNDIALS CVODE and GSL' 'libsundials-dev libgsl-dev'
fi

sundials=/usr/share/doc/libsundials-dev/examples # left out where dpkg installs no documents
if has sundials/sundials_nonlinearsolver.h sundials_ida && [ -d "$sundials/cvode/serial" ]; then
    run 'SUNDIALS: a SUNNonlinearSolver in its own examples' env CC="$cc" CFLAGS="$cflags" \
        sh "$here/sundials_iqn.sh" "$sundials"
else
    skip 'SUNDIALS: a SUNNonlinearSolver in its own examples' 'libsundials-dev' # with its documents
fi

if tool mpicc && tool pkg-config && pkg-config petsc; then
    export OMPI_CC="$cc" MPICH_CC="$cc"
    run 'PETSc TS' host petsc mpicc $(pkg-config --cflags --libs petsc) -llapack
else
    skip 'PETSc TS' 'petsc-dev pkg-config'
fi

if tool mpicc && tool mpirun && tool pkg-config && pkg-config petsc; then
    distributed() { # the same iterations on 1, 2 and 4 ranks
        mpicc -std=c99 $warn -Wno-pedantic $cflags -I"$top" "$here/petsc_vec.c" \
            $(pkg-config --cflags --libs petsc) -lm -o petsc_vec || return 1
        as_root=''
        [ "$(id -u)" = 0 ] && mpirun --version | grep -q 'Open MPI' && as_root=--allow-run-as-root
        for ranks in 1 2 4; do
            OMPI_MCA_rmaps_base_oversubscribe=1 mpirun $as_root -n $ranks ./petsc_vec || return 1
        done >out
        awk '!seen[$0]++' out
        [ "$(awk -F '|' '/^. [0-9]/ { print $3 }' out | sort -u | wc -l)" = 1 ]
    }
    run 'PETSc Vec on 1, 2 and 4 ranks' distributed
else
    skip 'PETSc Vec' 'petsc-dev pkg-config openmpi-bin'
fi

tutorials=$(find /usr/share/petsc/ "${PETSC_DIR:-/usr/lib/petsc}/src" -path '*snes/tutorials/ex19.c' 2>/dev/null | head -1)
if tool mpicc && tool mpirun && tool pkg-config && pkg-config petsc && [ "$tutorials" ]; then
    run 'PETSc SNES: -snes_type iqn in its own tutorials' env CFLAGS="$cflags" sh "$here/petsc_snes.sh" \
        "${tutorials%/*}"
else
    skip 'PETSc SNES: -snes_type iqn in its own tutorials' 'petsc-dev pkg-config openmpi-bin'
fi

device() { # OpenCL has one; the header alone comes with other packages
    printf '#include <CL/cl.h>\nint main(void) { cl_uint n = 0; return clGetPlatformIDs(0, NULL, &n) != 0 || n == 0; }\n' |
        $cc -DCL_TARGET_OPENCL_VERSION=120 -x c - -o probe -lOpenCL >/dev/null 2>&1 && ./probe
}
if device; then
    run 'OpenCL: vectors on a device' host opencl "$cc" -lOpenCL
else
    skip 'OpenCL: vectors on a device' 'pocl-opencl-icd ocl-icd-opencl-dev'
fi

numbers() { # the core with numbers of these types
    for type in float double 'float complex' 'double complex'; do
        case $type in *complex) complex=-DCOMPLEX ;; *) complex='' ;; esac
        host numbers "$cc" $complex "-DNUMBER=$type" || return 1
    done >out
    awk '!seen[$0]++' out
}
run 'vectors of float, double and complex numbers' numbers

run 'FMI 3.0 and 2.0: an algebraic loop, events, a controller' env CC="$cc" CFLAGS="$cflags" \
    sh "$here/fmi.sh"

if has ngspice/sharedspice.h ngspice; then
    run 'ngspice' host ngspice "$cc" -lngspice
else
    skip 'ngspice' libngspice0-dev
fi

if [ "$python" ] && tool icoFoam && tool blockMesh && tool ccx; then
    run 'OpenFOAM and CalculiX, a process a window' env OMP_NUM_THREADS=1 "$python" \
        "$here/blackbox.py"
else
    skip 'OpenFOAM and CalculiX, a process a window' 'openfoam calculix-ccx python3-numpy'
fi

octave() {
    CC=$cc CFLAGS="$cflags $warn -Wno-pedantic" mkoctfile --mex -I"$top" "$here/octave_iqn.c" -o iqn.mex &&
        octave-cli -qf "$here/octave_iqn.m"
}
if tool mkoctfile && tool octave-cli; then
    run 'Octave: a MEX function beside fsolve' octave
else
    skip 'Octave: a MEX function beside fsolve' octave-dev
fi

script() { # script NAME MODULES PACKAGES FILE
    p=$(with "$2")
    if [ "$p" ]; then run "$1" env OMP_NUM_THREADS=1 "$p" "$here/$4"; else skip "$1" "$3"; fi
}
script 'dolfinx: two finite-element plates' dolfinx,scipy 'python3-dolfinx python3-scipy' \
    heat_dolfinx.py
script 'GPAW: a density mixer' gpaw gpaw scf_gpaw.py

run 'two vendored versions in one program' env CC="$cc" sh "$here/versions.sh"
[ "${INSTALL:-}" = look ] && exit 0
if [ $count = 0 ]; then
    echo "not ok 1 - no host has one of the words in its title: $words"
    count=1 failed=1
fi
echo "1..$count"
exit $failed
