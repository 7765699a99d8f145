# SPDX-License-Identifier: MIT
# The picture of make onenumber: gnuplot -e "T='build/study'" tests/study/one_number.gp
set terminal svg size 860,1140 font "sans,11" background rgb "white"
set output T.'/one-number.svg'
set datafile separator ','
set tics font ",9"; set mxtics 1; set mytics 1; set title font ",12" offset 0,-0.6; set key font ",9" samplen 1.5
set multiplot layout 4,3
set logscale xy; set format xy "10^{%T}"; set xrange [1e2:3e5]; set yrange [1e-12:1]
set xlabel "evaluations of both sides"; set ylabel "error" offset 1,0
problems = "masses damped load pol stiff heat switch duffing relay tube rates"
do for [p in problems] {
    set title p
    if (p eq "masses") { set key font ",8" at graph 1.02, graph 1.0 right top samplen 1 opaque } else { unset key }
    plot T.'/one-number-'.p.'-all.csv' using 1:2 with dots lc rgb "#888888" lw 2 title "fixed set-ups", \
         T.'/one-number-'.p.'.csv' using 3:2 skip 1 with linespoints pt 7 ps 0.5 lc rgb "#c8442e" title "one number", \
         '' using ($4 > 0 ? $4 : NaN):1 skip 1 with points pt 6 ps 0.6 lc rgb "#1b5e9e" title "best fixed, for the error wanted"
}
unset logscale x; set xrange [*:*]; set yrange [*:*]; set format x "%g"; set xlabel "time"; set ylabel "length"; set key default; set key font ",8" bottom right samplen 1
do for [p in "pol"] {
    set title p.", 1e-6: window, steps of A and B"
    plot T.'/one-number-'.p.'-6.csv' using 1:2 skip 1 with steps lc rgb "#222222" title "window", \
         '' using 1:($2/$3) skip 1 with points pt 7 ps 0.3 lc rgb "#c8442e" title "A", \
         '' using 1:($2/$4) skip 1 with points pt 6 ps 0.3 lc rgb "#1b5e9e" title "B"
}
unset multiplot
