#!/bin/sh
# SPDX-License-Identifier: MIT
# anyblas.sh - the tests of the scenes with each BLAS and LAPACK of this machine (reference, OpenBLAS with the kernels of five
# processors, BLIS) and with inputs moved by 1e-13 in three ways: no verdict may hang on last bits.  Reads B.
set -u
B=${B:-build}
lib=/usr/lib/$(cc -dumpmachine 2>/dev/null | sed 's/^x86_64.*/x86_64-linux-gnu/; s/^aarch64.*/aarch64-linux-gnu/')
work=$B/anyblas
mkdir -p "$work"
failed=0 runs=0 begun=''

begin() { # begin NAME [VARIABLE=VALUE...]: one run of all tests of the scenes, in a folder of its own
    name=$1
    shift
    folder=$work/$(echo "$name" | tr -c 'a-zA-Z0-9.,\n-' '_')
    mkdir -p "$folder"
    for scene in examples/*.c; do
        scene=$(basename "$scene" .c)
        [ ! -x "$B/$scene" ] || ln -sf "../../$scene" "$folder/"
    done
    env B="$folder" "$@" sh tests/scripts/scenes.sh >"$folder/log" 2>&1 &
    begun="$begun $folder"
    [ "$begun" = "${begun% * *}" ] || finish
}

finish() { # two at a time
    wait
    for folder in $begun; do
        name=$(basename "$folder" | tr '_' ' ')
        runs=$((runs + 1))
        bad=$(grep '^not ok' "$folder/log" | grep -vc '# TODO$') # what is open counts nowhere
        if [ "$bad" = 0 ] && grep -q '^1\.\.[1-9]' "$folder/log"; then
            echo "ok       $name"
        else
            echo "FAILED   $name: $bad tests"
            grep '^not ok' "$folder/log" | grep -v '# TODO$' | sed 's/^/           /'
            failed=$((failed + 1))
        fi
    done
    begun=''
}

installed() { # installed NAME FOLDERS PACKAGE: whether the first of the folders is here
    [ -d "${2%%:*}" ] && return 0
    echo "skipped  $1: not here (Debian: $3)"
    return 1
}

reference=$lib/blas:$lib/lapack
installed 'reference BLAS' "$reference" 'libblas3 liblapack3' && begin 'reference BLAS' LD_LIBRARY_PATH="$reference"
openblas=$lib/openblas-pthread
if installed OpenBLAS "$openblas" libopenblas0-pthread; then
    for core in Haswell Zen SkylakeX Prescott Nehalem; do
        if [ $core = SkylakeX ] && ! grep -q avx512f /proc/cpuinfo; then
            echo "skipped  OpenBLAS, SkylakeX: this processor has no AVX-512"
            continue
        fi
        begin "OpenBLAS, $core" LD_LIBRARY_PATH="$openblas" OPENBLAS_CORETYPE=$core OPENBLAS_NUM_THREADS=1
    done
fi
blis=$lib/blis-openmp:$lib/lapack
installed BLIS "$blis" libblis4-openmp && begin BLIS LD_LIBRARY_PATH="$blis" BLIS_NUM_THREADS=1
for way in 1 2 3; do begin "inputs moved by 1e-13, way $way" SCENE_PERTURB=$way; done
finish

echo "$((runs - failed)) of $runs passed"
[ "$failed" = 0 ]
