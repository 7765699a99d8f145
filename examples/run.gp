# SPDX-License-Identifier: MIT
# The picture of make run: gnuplot -e "B='build'" examples/run.gp
set terminal svg size 960,640 font "sans,12" background rgb "white"
set output B.'/run.svg'
set datafile separator ','
set linetype 1 lc rgb "#1b5e9e"; set linetype 2 lc rgb "#c8442e"; set linetype 3 lc rgb "#2e8b57"
set linetype 4 lc rgb "#8a5fb0"; set linetype 5 lc rgb "#d98c1f"; set linetype 6 lc rgb "#222222"
set multiplot layout 2,2
set key outside right
set title "Two masses: 5 and 100 sub-steps in a window"
set xlabel "time"
set ylabel "displacement"
set xrange [0:1]
set xtics 0.2
set grid xtics lc rgb "#cccccc"
u(t) = 0.5*(cos(2*pi*t) + cos(6*pi*t))
w(t) = 0.5*(cos(2*pi*t) - cos(6*pi*t))
set samples 160
plot u(x) with lines lc rgb "#999999" title "exact", w(x) with lines lc rgb "#999999" notitle, \
     B.'/oscillator.csv' using (strcol(1) eq 'A' ? $2 : NaN):3 with points pt 7 ps 0.6 lc rgb "#c03020" title "A", \
     '' using (strcol(1) eq 'B' && int($2*500+0.5) % 20 == 0 ? $2 : NaN):3 with points pt 6 ps 0.6 lc rgb "#2050a0" title "B"
set datafile separator whitespace
set xrange [*:*]
set xtics auto
set title "Two masses: change of u2 at the window end, per window"
set xlabel "iteration"
set xtics 1
set ylabel "relative change"
set logscale y
set mytics 1
set format y "10^{%T}"
set key outside right title "window"
plot for [k=1:5] B.'/oscillator-convergence.log' using ($1 == k ? $2 : NaN):4 with linespoints pt 7 ps 0.4 title sprintf("%d", k)
set title "Elastic tube: residual of the cross section, per window"
set ylabel "residual / first residual"
set key outside right; set xtics 5
plot for [k in "1 2 3 4 10 100"] B.'/tube-convergence.log' using ($1 == k+0 ? $2 : NaN):4 with linespoints pt 7 ps 0.4 title k
unset logscale y
set format y "%g"
set title "Elastic tube: iterations in each window"
set xlabel "window"; set xtics 20
set ylabel "iterations"
set yrange [0:22]
unset key
plot B.'/tube-iterations.log' using 1:3 with steps lc rgb "#2050a0"
unset multiplot
