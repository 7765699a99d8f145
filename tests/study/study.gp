# SPDX-License-Identifier: MIT
# The pictures of make study: gnuplot -e "T='build/study'" tests/study/study.gp
set datafile separator ','
set datafile missing '-'
set key font ",9" samplen 1.5 spacing 0.9
set tics font ",10"
set title font ",12" offset 0,-0.6
set style data lines; set mxtics 1; set mytics 1
set pointsize 0.35
set linetype 1 lc rgb "#1b5e9e"; set linetype 2 lc rgb "#c8442e"; set linetype 3 lc rgb "#2e8b57"; set linetype 4 lc rgb "#8a5fb0"
set linetype 5 lc rgb "#d98c1f"; set linetype 6 lc rgb "#4aa5b8"; set linetype 7 lc rgb "#7a7a7a"; set linetype 8 lc rgb "#222222"
set linetype 9 lc rgb "#e377c2"; set linetype 10 lc rgb "#111111"
row(file, pattern) = sprintf("< grep -E '%s' %s/%s", pattern, T, file)

# ---- waveforms
set terminal svg size 860,640 font "sans,11" background rgb "white"
set output T.'/waveform.svg'
set multiplot layout 2,2
set logscale xy; set format y "10^{%T}"; set xtics (2,3,4,6,9,13,21,33,65,129)
set xlabel "samples in the window"; set ylabel "error, where the data reach 1"; set key outside right; set xrange [1.8:140]
set title "Smooth data: largest error"
plot for [p in "0 1 2 3 5 9"] row('waveform-error.csv', '^smooth,uniform,'.p.',') using 4:($5 > 0 ? $5 : NaN) title "degree ".p
set title "A kink: largest error"
plot for [p in "0 1 2 3 5 9"] row('waveform-error.csv', '^kinked,uniform,'.p.',') using 4:($5 > 0 ? $5 : NaN) lw (p eq "2" ? 6 : 1.5) lc rgb word("#1b5e9e #c8442e #b5ddc5 #8a5fb0 #d98c1f #4aa5b8", p + 1 > 5 ? (p + 1 > 6 ? 6 : 5) : p + 1) dt p eq "5" ? 3 : p eq "3" ? 2 : 1 title "degree ".p
set title "Electrocardiogram, every other value kept"
set ylabel "rms error, over the range of the data"
set yrange [1e-3:1e-1]
plot for [p in "0 1 2 3 5 9"] row('waveform-error.csv', '^rough,uniform,'.p.',') using 4:($5 > 0 ? $5 : NaN) title "degree ".p
unset logscale x; set autoscale; set xtics auto; set xlabel "degree"; set key inside top left
set title "300000 numbers, 21 samples: what it costs"; set yrange [0.3:3000]; set format y "%g"; set ylabel "time, over that of a copy"
plot row('waveform-cost.csv', '^300000,21,') using 3:5 title "fit / copy of all samples", '' using 3:6 title "evaluate / copy of one sample", \
     '' using 3:7 title "evaluate from the samples, no fit"
unset multiplot; unset logscale; set autoscale

# ---- quasi-Newton
set output T.'/iqn.svg'
set multiplot layout 2,2
set logscale xy; set format xy "10^{%T}"; set key inside top left; set xlabel "condition number of the secant pairs"; set ylabel "excess of the residual; the optimum is 10^{-3}"
set title "Least squares of a step: excess, where above 10^{-17}"
plot for [c=2:3] T.'/iqn-levels.csv' using 1:(column(c) > 1.1e-17 ? column(c) : NaN) with linespoints pt 7 title word("x iqn.h Householder",c)
unset logscale y; set format y "%g"; set yrange [780:1100]; set ylabel "iterations in 100 windows"; set xlabel "limit of the filter, IQN\\_FILTER\\_LIMIT"; set key inside top center
set title "Tube, 100 windows: iterations in all"
plot row('iqn-knobs.csv', '^tube 100 windows,filter QR2,') using 3:4 title 'QR2, reuse 8', row('iqn-knobs.csv', '^tube.*QR2 default reuse,') using 3:4 title 'QR2, default reuse'
set format x "%g"; unset logscale x; set xrange [0:50]; set xlabel "windows reused, or columns stored: pairs"; set key inside top right
set title "Tube, 100 windows: what is kept (limit 1e-3)"
plot row('iqn-knobs.csv', '^tube.*windows,reuse,') using ($3 >= 0 ? $3 : NaN):4 title "windows reused", '' using ($3 < 0 ? 50 : NaN):4:(-50):(0) with vectors nohead dt 2 lc 3 title "reuse -1, the default", row('iqn-knobs.csv', '^tube.*,columns,') using 3:4 title "columns stored"
set autoscale; set xlabel "columns stored"; set ylabel "iterations in a window"; set title "Heat, implicit Euler, 5/5 sub-steps"
plot for [w in "2 10 50"] row('iqn-knobs.csv', '^heat '.w.' windows,columns,') using 3:4 title w." windows"
unset multiplot; unset logscale; set autoscale

# ---- Runge-Kutta: error against evaluations
set terminal svg size 860,640 font "sans,11" background rgb "white"
set output T.'/rk.svg'
set multiplot layout 2,2
set logscale xy; set format xy "10^{%T}"; set xlabel "evaluations of the right-hand side f"; set ylabel "error at the end of the run"; set key outside right
e = "heun bs3 rk4 dp5 tsit5 verner6 dop853"
i = "beuler sdirk2 esdirk3 esdirk4 esdirk5 wso3 radauIIA3 gauss3"
set yrange [1e-13:10]
set title "Brusselator, explicit tables: the steps"
plot for [t in e] row('rk-work.csv', '^Brusselator,'.t.',') using 5:($6 > 0 ? $6 : NaN) title t
set ylabel "largest error inside the steps"
set title "Brusselator, explicit tables: dense output"
plot for [t in e] row('rk-work.csv', '^Brusselator,'.t.',') using 5:($7 > 0 ? $7 : NaN) title t
set xlabel "evaluations of f, also in Newton's iterations (its Jacobians apart)"; set ylabel "error at the end of the run"
set title "van der Pol, eps = 10^{-3}, implicit tables: the steps"
plot for [t in i] row('rk-work.csv', '^van der Pol,'.t.',') using 5:($6 > 0 ? $6 : NaN) title t
set ylabel "largest error inside the steps"
set title "Prothero-Robinson, 10^6, implicit tables: dense output"
plot for [t in i] row('rk-work.csv', '^Prothero-Robinson,'.t.',') using 5:($7 > 0 ? $7 : NaN) title t
unset multiplot; set autoscale

# ---- end to end
set terminal svg size 860,380 font "sans,11" background rgb "white"
set output T.'/coupled.svg'
set datafile separator whitespace
set multiplot layout 1,2
set key outside right; set yrange [1e-13:1]; set ylabel "largest error, where the masses move by 1"
set xlabel "evaluations of both sides, all iterations"; set title "Two masses: the best of all set-ups, by degree"
d = "1 2 3 5 7 9"
plot T.'/front-oscillator.dat' index 0 with steps lw 6 lc rgb "#dddddd" title "best", for [p in d] '' index (p+1) with steps lt p title "degree ".p
set ylabel "error of the temperature"; set xlabel "implicit stages solved on both sides, all iterations"; set title "Heat, implicit tables: the same"
d = "1 2 3 5"
plot T.'/front-heat.dat' index 0 with steps lw 6 lc rgb "#dddddd" title "best", for [p in d] '' index (p+1) with steps lt p title "degree ".p
unset multiplot; set autoscale; unset logscale; set datafile separator ','

# ---- maps: iterations per window, grey where it diverges or does not converge
# Every cell is drawn as 12 x 12 pixels: viewers smooth an image as they please.
cells(file, m, ny) = sprintf("< awk -F, 'BEGIN { n = 0 } $1 == \"%s\" { x[n] = log($2) / log(10); y[n] = log($3) / log(10); v[n++] = $4 } \
    END { for (i = 0; i < n; i += %d) for (a = -11; a < 12; a += 2) for (j = i; j < i + %d; j++) for (b = -11; b < 12; b += 2) \
    print x[j] + a / 48 \",\" y[j] + b / 48 \",\" v[j] }' %s/%s", m, ny, ny, T, file)
set terminal svg size 760,920 font "sans,11" background rgb "white"
set object 1 rectangle from graph 0,0 to graph 1,1 behind fc rgb "#bbbbbb" fs solid noborder
set palette maxcolors 24 defined (0 "#ffffd9", 0.3 "#c7e9b4", 0.5 "#41b6c4", 0.75 "#225ea8", 1 "#081d58")
unset key; set cblabel "iterations in a window" offset -1,0; set logscale cb; set mcbtics 1; set format xy "%g"
set output T.'/map-tube.svg'
set cbrange [3:300]; set xtics 2; set ytics 1; set xrange [-2.25:4.25]; set yrange [-4.5:0.2]
set multiplot layout 4,2 margins 0.09,0.89,0.07,0.965 spacing 0.07,0.07
set colorbox user origin 0.91,0.3 size 0.02,0.4
m7 = "defaults-area"; m8 = "defaults-pressure"
m1 = "constant"; m2 = "Aitken"; m3 = "IQN-ILS"; m4 = "IQN-IMVJ"; m5 = "IQN-ILS-damped"; m6 = "IQN-IMVJ-damped"
do for [k=1:8] {
    m = value(sprintf("m%d", k))
    set title (k == 1 ? "constant, omega 0.01" : k < 5 ? m : k < 7 ? word("IQN-ILS IQN-IMVJ", k-4).", mixing 0.05" : \
        "defaults of iqn.h, x: the ".word("areas pressures", k-6))
    if (k == 2) { set colorbox } else { unset colorbox }
    if (k > 6) { set xlabel "wall stiffness, over that of the scene, log_{10}" } else { unset xlabel }
    if (k % 2 == 1) { set ylabel "log_{10} of the time step, s" offset 1,0 } else { unset ylabel }
    if (k == 1) { set label 1 "grey: no convergence\nin 400 iterations" at graph 0.05, graph 0.85 front } else { unset label 1 }
    plot cells('map-tube.csv', m, 9) using 1:2:($3 > 0 ? $3 : NaN) with image notitle
}
unset multiplot
set terminal svg size 760,480 font "sans,11" background rgb "white"
set output T.'/map-heat.svg'
set cbrange [2:100]; set xtics 3; set ytics 3; set xrange [-6.25:6.25]; set yrange [-6.25:6.25]
set multiplot layout 2,2 margins 0.09,0.89,0.12,0.94 spacing 0.07,0.12
do for [k=1:4] {
    m = value(sprintf("m%d", k))
    set title (k == 1 ? "constant, omega 0.5" : m)
    if (k == 2) { set colorbox } else { unset colorbox }
    if (k > 2) { set xlabel "conductivity of D over that of N, log_{10}" } else { unset xlabel }
    if (k % 2 == 1) { set ylabel "heat capacity of D / of N, log_{10}" offset 1,0 } else { unset ylabel }
    if (k == 1) { set label 1 "grey: no convergence\nin 100 iterations; D is given\ntemperatures, N heat fluxes" at graph 0.05, graph 0.88 front } else { unset label 1 }
    plot cells('map-heat.csv', m, 25) using 1:2:($3 > 0 ? $3 : NaN) with image notitle
}
unset multiplot; unset logscale; set autoscale; unset object 1

# ---- stability regions
set xtics auto; set ytics auto; set format xy '%g'
# |R(z)| = 1, upper half plane
set terminal svg size 860,340 font "sans,11" background rgb "white"
set output T.'/stability.svg'
set datafile separator whitespace
set contour base; set cntrparam levels discrete 1; unset surface; set view map; unset clabel
tables = "heun bs3 rk4 dp5 tsit5 verner6 dop853 ssp104"
do for [t in tables] {
    set table T.'/contour-'.t.'.dat'
    splot T.'/region-'.t.'.dat' using 1:2:3 with lines
    unset table
}
unset contour; set surface
set multiplot layout 1,2
set key outside right; set xlabel "real part of h lambda (no unit)"; set ylabel "imaginary part of h lambda"; set xrange [-8:1]; set yrange [0:6]; set grid lc rgb "#dddddd"
set title "Stability regions of explicit tables"
plot for [t in tables] T.'/contour-'.t.'.dat' using 1:2 with lines title t
set autoscale; unset grid; set datafile separator ','; set ylabel "largest error inside the steps"
set logscale xy; set format xy "10^{%T}"; set yrange [1e-16:10]; set xrange [5e2:1e5]; set xlabel "evaluations of the right-hand side"
set title "Chain of 256 masses: error of the dense output"
plot for [t in tables] row('rk-work.csv', '^chain,'.t.',') using 5:($7 > 0 ? $7 : NaN) with linespoints pt 7 title t
unset multiplot
