#!/bin/sh
# SPDX-License-Identifier: MIT
# study.sh - make study: measure every knob that trades speed for accuracy; CSV and pictures in $B/study, the small
# pictures kept in tests/study.   study.sh table: print the recommendations again, as Markdown; pictures: draw them again;
# guesses: WF_AUTO beside fixed degrees; knobs: those of iqn.h in two scenes; speed: what the flags of the processor buy.
set -eu
B=${B:-build}
CC=${CC:-cc}
here=$(dirname "$0")
out=$B/study
mkdir -p "$out"
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 BLIS_NUM_THREADS=1 LC_ALL=C

table() {
    for problem in oscillator heat; do
        [ -f "$out/recommend-$problem.md" ] || continue
        echo
        [ $problem = oscillator ] && echo 'Two masses, Runge-Kutta on both sides:' || echo 'Heat with a known answer, implicit Runge-Kutta on both sides:'
        echo
        cat "$out/recommend-$problem.md"
    done
}
pictures() {
    if command -v gnuplot >/dev/null; then
        gnuplot -e "T='$out'" "$here/study.gp"
        for picture in "$out"/*.svg; do # without defaults, unused definitions and empty groups
            sed -i 's/ font-family="sans"  */ /g; s/ stroke-width="1.00" stroke-linecap="butt" stroke-linejoin="miter"//
                s/<image /<image style="image-rendering:pixelated" /; s/<svg $/<svg font-family="sans"/
                /^$/d; s/^\t*//' "$picture"
            grep -q "href='#gpPt" "$picture" || sed -i '/<defs>/,/<\/defs>/d' "$picture" # the shapes of points
            sed -i -z 's/<g [^>]*>\n<\/g>\n//g' "$picture"
            [ "$(wc -c <"$picture")" -lt 60000 ] && cp "$picture" "$here"
        done
        echo; echo "pictures: $out/*.svg, the small ones also in $here"
    else
        echo; echo 'no pictures: install gnuplot-nox for them'
    fi
}


# Iterations of the tube with the degree of the first guess by WF_AUTO, over those of the best of the degrees 0 to 4 at the
# same wall: means of groups of walls.  Walls at which one of them does not converge are left out.
guesses() {
    for inlet in sine step; do
        for dt in 0.02 0.01 0.005; do
            for walls in '0.5 0.6 0.7 0.8 0.9 0.95' '0.97 0.98 0.99 1 1.01 1.02 1.03 1.05' '1.1 1.2 1.35 1.5 1.75 2 2.5' \
                '2.9 2.95 3 3.05 3.1 4 5 6'; do
                for wall in $walls; do
                    for degree in 0 1 2 3 4 auto; do
                        echo "$wall $degree $("$B/tube" --settings kit --inlet $inlet --dt $dt --wall $wall --predict $degree 2>/dev/null |
                            awk '$1 == "total" { n = $2 } $1 == "unconverged" { bad = $2 } END { print n == "" || bad ? 0 : n }')"
                    done
                done | awk -v name="$inlet, window $dt, walls ${walls%% *} to ${walls##* }" '
                    !$3 { open[$1] = 1 }
                    $2 == "auto" { auto[$1] = $3; next }
                    !($1 in best) || $3 < best[$1] { best[$1] = $3 }
                    END { for (w in auto) if (!open[w]) { r = auto[w] / best[w]; sum += r; n++; if (r > worst) worst = r }
                          if (n) printf "  %-40s mean %.3f, worst %.3f of %d\n", name, sum / n, worst, n }'
            done
        done
    done | awk '{ print; m = $0; sub(/.*mean /, "", m); m += 0; all += m; n++; over += m > 1.03; if (m > most) most = m }
        END { printf "first guesses by WF_AUTO over the best of degrees 0 to 4 at each wall: mean %.3f, worst group %.3f, over 1.03 %d of %d groups\n", all / n, most, over, n }'
}

progress() { printf '\r\033[K  %s' "$*" >&2; }
section() { printf '\r\033[K' >&2; printf '\n== %s\n' "$*"; }

# count PROGRAM OPTIONS...: iterations in all (tube), on average (heat); "-" where a window did not converge
count() {
    "$@" 2>/dev/null | awk '$1 == "total" || ($1 == "iterations") { n = $2 } $1 == "unconverged" && $2 > 0 { bad = 1 }
        END { print n == "" || bad ? "-" : n }'
}

# sweep PROBLEM KNOB "VALUES" COMMAND...: one row of counts; the value is the last argument
sweep() {
    problem=$1 knob=$2 values=$3
    shift 3
    row=$(printf '%-34s' "$problem: $knob")
    for value in $values; do
        progress "$problem, $knob $value"
        n=$(count "$@" "$value")
        row="$row $value:$n"
        echo "$problem,$knob,$(echo "$value" | tr , /),$n" >>"$out/iqn-knobs.csv"
    done
    printf '\r\033[K' >&2
    echo "$row"
}

knobs() {
    echo 'problem,knob,value,iterations' >"$out/iqn-knobs.csv"
    tube=$B/tube heat=$B/manufactured
    t='tube 100 windows'
    sweep "$t" 'filter QR2' '1e-1 3e-2 1e-2 3e-3 1e-3 1e-4 1e-6 1e-8' "$tube" --filter
    sweep "$t" 'filter QR2 default reuse' '1e-1 3e-2 1e-2 3e-3 1e-3 1e-4 1e-6 1e-8' "$tube" --reuse -1 --filter
    sweep "$t" 'noise level, defaults' '1e-15 1e-13 1e-12 1e-10 1e-8' "$tube" --settings kit --noise
    sweep "$t" 'growth, defaults' '0 3 10 30' "$tube" --settings kit --growth
    sweep "$t" reuse '1 2 3 4 6 8 12 16 -1' "$tube" --reuse
    sweep "$t" columns '12 15 20 25 30 40 50 100' "$tube" --columns
    sweep "$t" mixing '0.05 0.1 0.3 0.5 0.8 1 1.1' "$tube" --mixing
    sweep "$t" 'first omega' '0.001 0.01 0.1' "$tube" --omega
    sweep "$t" 'method with filter 1e-2' 'ils imvj' "$tube" --columns 900 --filter 1e-2 --reuse -1 --method
    sweep "$t" 'steps, all weighted' '1,1 1,2 1,4 1,8 1,16 1,50' "$tube" --settings kit --steps
    sweep "$t" 'steps, end weighted' '1,1 1,2 1,4 1,8 1,16 1,50' "$tube" --settings kit --weigh end --steps
    sweep "$t" 'IMVJ, 60 columns, merged' '0 1 4 8' "$tube" --method imvj --filter 1e-2 --reuse 0 --columns 60 --merge
    set -- "$tube" --settings kit --unknown pressure
    sweep 'tube by pressure' 'columns, defaults' '15 20 25 30 40 50 100' "$@" --columns
    set -- "$@" --windows 10 --most 120 --steps 2,2
    for columns in 50 150; do
        sweep 'tube by pressure, 10 windows of 2,2' "delayed pairs in windows, $columns columns" '0 1 2 5 10' "$@" --columns $columns --delay
    done
    for windows in 2 10 50; do
        t="heat $windows windows"
        set -- "$heat" --m 10 --T 10 --g sin --method euler --degree 1 --tolerance 1e-5 --windows $windows
        sweep "$t" mode 'full reduced end relaxation' "$@" --mode
        sweep "$t" reuse '0 1 2 4 8' "$@" --columns 40 --reuse
        sweep "$t" 'filter QR2' '1e-1 1e-2 1e-3 1e-6' "$@" --filter
        sweep "$t" 'filter QR2 default reuse' '1e-1 1e-2 1e-3 1e-4 1e-6' "$@" --reuse -1 --filter
        sweep "$t" columns '2 3 4 5 7 10 20' "$@" --columns
    done
}

# Every compiler and flag against the first; the headers' own arithmetic only (study_flags.c)
flags() {
    echo 'compiler,call,last_places' >"$out/flags.csv"
    first=
    for compiler in gcc clang; do
        command -v $compiler >/dev/null || continue
        for flag in '-std=c99 -O0' '-std=c99 -O2' '-std=gnu11 -O2' '-std=gnu11 -O3 -march=native' '-std=gnu11 -Ofast -march=native'; do
            progress "$compiler $flag"
            # shellcheck disable=SC2086
            $compiler $flag -w -I. -o "$out/flags" "$here/study_flags.c" -lm || continue
            [ -n "$first" ] || "$out/flags" write "$out/flags.bin"
            first=done
            "$out/flags" compare "$out/flags.bin" | sed "s/, /; /g; s/^/$compiler $flag,/" >>"$out/flags.csv"
        done
    done
    progress
    awk -F, 'NR > 1 { if (!($2 in seen)) { seen[$2] = 1; call[++n] = $2 } if (!($1 in set)) { set[$1] = 1; flag[++m] = $1 } v[$1, $2] = $3 }
        END { for (i = 1; i <= m; i++) { printf "%-38s", flag[i]; for (j = 1; j <= n; j++) printf " %5s", v[flag[i], call[j]]; print "" }
              for (j = 1; j <= n; j++) printf "  column %d: %s\n", j, call[j] }' "$out/flags.csv"
    rm -f "$out/flags" "$out/flags.bin"
}

# What the flags of the one file with the implementations buy: least times of four rounds in turn
speed() {
    rm -f "$out/speed.csv"
    for i in 1 2 3; do
        flag=$(echo '-O2 | -O2 -march=native | -O3 -march=native' | cut -d'|' -f$i)
        # shellcheck disable=SC2086
        $CC -std=c99 $flag -w -I. -o "$out/speed-$i" "$here/study_flags.c" -lm
    done
    for round in 1 2 3 4; do
        for i in 1 2 3; do
            progress "speed, round $round"
            "$out/speed-$i" time | sed "s/, / /; s/^/$i,/" >>"$out/speed.csv"
        done
    done
    progress
    awk -F, '{ key = $2 "," $3 } !(key in seen) { seen[key] = 1; row[++n] = key } !(($1, key) in t) || $4 < t[$1, key] { t[$1, key] = $4 }
        END { for (j = 1; j <= n; j++) { split(row[j], part, ",")
              printf "%-20s %7d  -O2 %10.3f us; over that with -march=native %5.2f; -O3 -march=native %5.2f\n",
                     part[1], part[2], t[1, row[j]], t[1, row[j]] / t[2, row[j]], t[1, row[j]] / t[3, row[j]] } }' "$out/speed.csv"
    rm -f "$out"/speed-[123]
}

# The scenes on other BLAS and LAPACK libraries, where Debian has them
blas() {
    lib=/usr/lib/$(cc -dumpmachine 2>/dev/null | sed 's/-pc//; s/x86_64-linux-gnu.*/x86_64-linux-gnu/')
    for dirs in "$lib/blas:$lib/lapack" "$lib/openblas-pthread" "$lib/openblas-serial" "$lib/blis-openmp:$lib/lapack" "$lib/blis-serial:$lib/lapack"; do
        [ -d "${dirs%%:*}" ] || continue
        progress "$dirs"
        n=$(LD_LIBRARY_PATH=$dirs count "$B/tube")
        e=$(LD_LIBRARY_PATH=$dirs "$B/manufactured" --m 10 --method gauss2 --windows 8 | awk '$1 == "e_A" || $1 == "iterations" { printf "%s %s  ", $1, $2 }')
        printf '\r\033[K' >&2
        printf '%-28s tube, iterations in all %s; heat %s\n' "$(basename "${dirs%%:*}")" "$n" "$e"
    done
}

case ${1:-all} in table | guesses | knobs | pictures | speed) "$1"; exit ;; esac

{
    section 'Waveforms'
    /usr/bin/python3 -c 'from scipy.misc import electrocardiogram as e
print(*e()[:20000], sep="\n")' >"$out/ecg.txt" 2>/dev/null || : >"$out/ecg.txt"
    "$B/study_waveform" "$out" "$out/ecg.txt"
    "$B/study_signals" "$out"
    section 'First guesses: the tube, WF_AUTO beside fixed degrees'
    guesses
    section 'Quasi-Newton'
    knobs
    "$B/study_iqn" "$out"
    "$B/study_promises" dev
    section 'Runge-Kutta'
    "$B/study_rk" "$out"
    "$B/study_dense" | tee "$out/dense.txt"
    sh "$here/multirate.sh" >"$out/multirate.txt"
    section 'Bits under other flags: "same", or units in the last place of the largest number'
    flags
    section 'What the flags of the processor buy'
    speed
    section 'Other BLAS'
    blas
    section 'End to end'
    "$B/study_coupled" "$out" "$B/manufactured"
} | tee "$out/summary.txt"

pictures
echo "numbers: $out/*.csv   summary: $out/summary.txt   recommendations as Markdown: B=$B sh $here/study.sh table"
