#!/bin/sh
# SPDX-License-Identifier: MIT
# bench.sh [iqn] [rk] [waveform] [host] [threads] [size] - the benches one after the other, all if none is named; then the goals that
# are not met.  Results in $B/bench: log as printed, rows and goals as tables.
set -u
B=${B:-build}
out=$B/bench
mkdir -p "$out"
export BENCH_BIN="$B" BENCH_NOTES="$out" OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 BLIS_NUM_THREADS=1 LC_ALL=C
[ $# -gt 0 ] || set -- iqn rk waveform host threads size

# One processor for all contenders: two of them are seldom equally fast while other jobs run.  And the same addresses in each
# process: at random ones a call of 50 ns took 0.7 to 1.3 of the time of the same program.
pin=
command -v taskset >/dev/null && pin="taskset -c $(($(getconf _NPROCESSORS_ONLN) - 1))"
setarch -R true 2>/dev/null && pin="setarch -R $pin"

processor=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo 2>/dev/null | head -1)
family=$(awk -F '[[:space:]]*: *' '$1 == "cpu family" { f = $2 } $1 == "model" { print " (family " f ", model " $2 ")"; exit }' /proc/cpuinfo 2>/dev/null)
machine="${processor:-$(uname -m)}$family, $(getconf _NPROCESSORS_ONLN 2>/dev/null || echo '?') cores; $(${CC:-cc} --version | head -1) ${CFLAGS:--O2}"
{
    echo "$(date -u '+%Y-%m-%d %H:%M') UTC; $machine; load $(cut -d' ' -f1 /proc/loadavg 2>/dev/null)"
    for what; do
        case $what in
        size) sh tests/bench/size.sh ;;
        threads) if [ -x "$B/bench_threads" ]; then "$B/bench_threads"; else echo 'threads: no compiler with -fopenmp (Debian: libgomp1)'; fi ;;
        *) $pin "$B/bench_$what" || echo "bench_$what failed" ;;
        esac
    done
    sh tests/bench/goals.sh "$out"
} 2>&1 | tee "$out/log"
date -u +%Y-%m-%d >"$out/date"
echo "$machine" >"$out/machine"
