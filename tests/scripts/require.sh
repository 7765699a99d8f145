#!/bin/sh
# SPDX-License-Identifier: MIT
# require.sh NAME[?]... - see that the tools named are here.  With INSTALL=1 install what is missing (root or password-less
# sudo on a Debian system; a line says so before), else print the one command that does.  A name ending in ? is wanted, not needed.
set -u
cc=${CC:-cc}

links() { # links FLAGS..., with the program on standard input
    dir=$(mktemp -d) && "$cc" -x c - -o "$dir/a" "$@" >/dev/null 2>&1
    result=$?
    rm -rf "$dir"
    return $result
}

runs() { # runs FLAGS...: the program on standard input, and it returns 0
    dir=$(mktemp -d) && "$cc" -x c - -o "$dir/a" "$@" >/dev/null 2>&1 && "$dir/a" >/dev/null 2>&1
    result=$?
    rm -rf "$dir"
    return $result
}

python() { # python CODE: by the first python3, or Debian's
    python3 -c "$1" 2>/dev/null || /usr/bin/python3 -c "$1" 2>/dev/null
}

have() {
    case $1 in
    cc) command -v "$cc" >/dev/null && echo 'int main(void) { return 0; }' | links ;;
    lapack) echo 'void dgetrf_(void); int main(void) { dgetrf_(); return 0; }' | links ${LDLIBS:--llapack -lblas} ;;
    cmocka) printf '#include <stdarg.h>\n#include <stddef.h>\n#include <stdint.h>\n#include <setjmp.h>\n#include <cmocka.h>\nint main(void) { return 0; }\n' | links -lcmocka ;;
    gsl) echo 'int gsl_set_error_handler_off(void); int main(void) { gsl_set_error_handler_off(); return 0; }' | links -lgsl -lgslcblas -lm ;;
    sundials) echo 'int SUNContext_Create(void); int main(void) { return SUNContext_Create(); }' | links -lsundials_generic ;;
    numpy) python 'import numpy' ;;
    scipy) python 'import scipy' ;;
    odeint) printf '#include <boost/numeric/odeint.hpp>\nint main() { return 0; }\n' | ${CXX:-c++} -x c++ -fsyntax-only - 2>/dev/null ;;
    dolfinx) python 'import dolfinx, scipy' ;;
    gpaw) python 'import gpaw, ase' ;;
    petsc) command -v mpicc >/dev/null && command -v mpirun >/dev/null && pkg-config petsc 2>/dev/null ;;
    opencl) # a device, not only the header, which comes with other packages
        printf '#include <CL/cl.h>\nint main(void) { cl_uint n = 0; return clGetPlatformIDs(0, NULL, &n) != CL_SUCCESS || n == 0; }\n' |
            runs -DCL_TARGET_OPENCL_VERSION=120 -lOpenCL ;;
    octave) command -v mkoctfile >/dev/null && command -v octave-cli >/dev/null ;;
    venv) python 'import ensurepip, venv' ;;
    ngspice) printf '#include <stdbool.h>\n#include <ngspice/sharedspice.h>\nint main(void) { return 0; }\n' | links -lngspice ;;
    openfoam) command -v icoFoam >/dev/null && command -v blockMesh >/dev/null ;;
    calculix) command -v ccx >/dev/null ;;
    clang-runtime) for f in address,undefined memory fuzzer-no-link; do # the sanitizers' libraries are a package of their own
            echo 'int main(void) { return 0; }' | clang -x c - -o /dev/null -fsanitize=$f 2>/dev/null || return 1; done
        [ -n "$(find "$(clang -print-resource-dir)/" -name 'libclang_rt.fuzzer*.a' | head -1)" ] ;;
    lld) command -v wasm-ld >/dev/null ;;
    wasi-libc) [ -n "$(find /usr/lib/wasm32-wasi /usr/share/wasi-sysroot -name libc.a 2>/dev/null | head -1)" ] ;;
    nodejs) command -v node >/dev/null ;;
    chromium) chromium --version >/dev/null 2>&1 ;;
    openblas) echo 'int openblas_get_num_threads(void); int main(void) { return openblas_get_num_threads() < 1; }' | links -lopenblas ;;
    blis) echo 'void bli_init(void); int main(void) { bli_init(); return 0; }' | links -lblis ;;
    mpi) command -v mpicc >/dev/null && command -v mpirun >/dev/null ;;
    *) command -v "$1" >/dev/null ;;
    esac
}

package() {
    case $1 in
    cc) echo gcc libc6-dev ;;
    c++) echo g++ ;;
    lapack) echo liblapack-dev libblas-dev ;;
    cmocka) echo libcmocka-dev ;;
    gnuplot) echo gnuplot-nox ;;
    prove) echo perl ;;
    gsl) echo libgsl-dev ;;
    sundials) echo libsundials-dev ;;
    numpy) echo python3-numpy ;;
    scipy) echo python3-scipy ;;
    odeint) echo libboost-dev ;;
    dolfinx) echo python3-dolfinx python3-scipy ;;
    petsc) echo petsc-dev pkg-config openmpi-bin ;;
    octave) echo octave-dev ;;
    venv) echo python3-venv ;;
    ngspice) echo libngspice0-dev ;;
    opencl) echo pocl-opencl-icd ocl-icd-opencl-dev ;;
    calculix) echo calculix-ccx ;;
    clang-runtime) echo clang libclang-rt-dev ;;
    openblas) echo libopenblas-dev ;;
    blis) echo libblis-dev ;;
    mpi) echo libopenmpi-dev openmpi-bin ;;
    *) echo "$1" ;;
    esac
}

missing='' needed=''
for name; do
    plain=${name%\?}
    have "$plain" && continue
    missing="$missing $(package "$plain")"
    [ "$name" = "$plain" ] && needed="$needed $plain"
done
[ -z "$missing" ] && exit 0

install="apt-get install -y --no-install-recommends$missing"
if command -v apt-get >/dev/null; then
    if [ "${INSTALL:-}" != 1 ]; then sudo=no
    elif [ "$(id -u)" = 0 ]; then sudo=''
    elif sudo -n true 2>/dev/null; then sudo='sudo -n'
    else sudo=no; fi
    if [ "$sudo" != no ]; then
        echo "installing with apt-get:$missing"
        { $sudo apt-get update -qq && DEBIAN_FRONTEND=noninteractive $sudo $install -qq; } >/dev/null 2>&1 ||
            echo "could not install$missing; try by hand: $install"
    else
        echo "not here:$missing; install with: sudo $install"
    fi
else
    echo "missing; the packages are called in Debian:$missing"
fi
for name in $needed; do
    have "$name" || { echo "cannot go on without $name"; exit 1; }
done
exit 0
