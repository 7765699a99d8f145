# SPDX-License-Identifier: MIT
# The pictures of the card: gnuplot -e "T='build/study/card'; problems='masses ..'; per_decade='1.5'" tests/study/card.gp
# Their data are those that card.py has written to T.
set datafile separator ','
set datafile missing '-'
set key font ",10" samplen 2 spacing 1.1
set tics font ",10"
set title font ",13" offset 0,-0.4
set mxtics 1; set mytics 1
grey = "#b0b0b0"; blue = "#1b5e9e"; red = "#c8442e"
n = words(problems)

# ---- trade.svg: what a digit costs; what is asked for and what comes
set terminal svg size 860,360 font "sans,12" background rgb "white"
set output out.'/trade.svg'
set multiplot layout 1,2
set logscale xy; set format xy "%g"; set xrange [2e-2:5e-11]
set xtics ("1e-2" 1e-2, "1e-4" 1e-4, "1e-6" 1e-6, "1e-8" 1e-8, "1e-10" 1e-10)
set title "What a digit costs"
set xlabel "error wanted, over the largest value"; set ylabel "work, over that for 1e-2"
set format y "%g"; set yrange [0.8:60]; set ytics (1,2,5,10,20,50); set grid ytics lc rgb "#e4e4e4"
set key top left reverse Left
plot for [k=1:n] T.'/digit.csv' using 1:k+1 with lines lw 1 lc rgb grey title (k == 1 ? "each of ".n." problems" : ""), \
     '' using 1:n+2 with linespoints lw 3 pt 7 ps 0.7 lc rgb blue title "median: ".per_decade." per digit"
set title "A run that takes one number, the accuracy"
set xlabel "accuracy asked for"; set ylabel "error reached, over the largest value"
set yrange [1e-13:1e-1]; set ytics ("1e-2" 1e-2, "1e-4" 1e-4, "1e-6" 1e-6, "1e-8" 1e-8, "1e-10" 1e-10, "1e-12" 1e-12); set key bottom left noreverse Left
plot T.'/asked.csv' using 1:1 with lines lw 2 dt 2 lc rgb red title "what was asked for", \
     for [k=1:n] '' using 1:k+1 with lines lw 1 lc rgb grey title (k == 1 ? "each of ".n." problems" : ""), \
     '' using 1:n+2 with linespoints lw 3 pt 7 ps 0.7 lc rgb blue title "median"
unset multiplot

# ---- one-number.svg: the same runs, cell by cell
set terminal svg size 860,400 font "sans,12" background rgb "white"
set output out.'/one-number.svg'
unset logscale; unset grid; unset key; set autoscale; set format xy "%g"; set ylabel ""
set xtics ("1e-2" 0, "1e-3" 1, "1e-4" 2, "1e-5" 3, "1e-6" 4, "1e-7" 5, "1e-8" 6, "1e-9" 7, "1e-10" 8) scale 0
set ytics () scale 0
set for [k=1:n] ytics add (word(problems, k) n - k)
set xrange [-0.5:8.5]; set yrange [-0.5:n - 0.5]
set xlabel "accuracy asked for"
set multiplot layout 1,2
set lmargin 8; set rmargin 2
unset colorbox
set title "Error reached, over the accuracy asked for (below 1: met)"
set palette defined (-3 "#1b7a5a", -1 "#a9d5c2", 0 "#ffffff", 0.02 "#c8442e"); set cbrange [-3:0.02]
plot T.'/cells.csv' using 1:2:(log10($3)) with image pixels, '' using 1:2:(sprintf("%.2g", $3)) with labels font ",9"
set title "Work, over that of the best fixed set-up (none: none got there)"
set palette defined (0 "#1b7a5a", 1 "#ffffff", 3 "#c8442e"); set cbrange [0:3]
plot T.'/cells.csv' using 1:2:($4 > 0 ? $4 : NaN) with image pixels, \
     '' using 1:2:($4 > 0 ? sprintf("%.2g", $4) : "none") with labels font ",9"
unset multiplot

# ---- converges.svg: the tube, iterations in a window
set terminal svg size 860,380 font "sans,12" background rgb "white"
set output out.'/converges.svg'
set lmargin -1; set rmargin -1; set autoscale; set format xy "10^{%T}"; set logscale xy
set xrange [0.0086:116]; set yrange [2e-4:0.47]; set xtics 10 scale 0.5; set ytics 10 scale 0.5
set object 1 rectangle from graph 0,0 to graph 1,1 behind fc rgb "#c4c4c4" fs solid noborder
set palette maxcolors 20 defined (0 "#ffffd9", 0.3 "#c7e9b4", 0.5 "#41b6c4", 0.75 "#225ea8", 1 "#081d58")
set logscale cb; set cbrange [3:60]; set cbtics (3, 5, 10, 20, 40, 60); set cblabel "iterations in a window" offset -0.5,0
set multiplot layout 1,3 margins 0.08,0.89,0.16,0.87 spacing 0.02,0.1
titles = "'x: the areas, fluid first' 'instead x: the pressures' 'and 400 pairs, 400 iterations'"
half = 10 ** 0.125
do for [k=1:3] {
    set title word(titles, k) font ",12"
    if (k == 1) { set ylabel "length of a time window, s" } else { unset ylabel; set format y "" }
    if (k == 2) { set xlabel "stiffness of the wall, over that of the scene (left: soft, added mass strong)" } else { unset xlabel }
    if (k == 3) { set colorbox user origin 0.905,0.16 size 0.018,0.71 } else { unset colorbox }
    if (k < 3) { set label 1 "grey:\nit gives up" at graph 0.05, graph 0.2 front font ",11" } else { unset label 1 }
    plot T.'/converges.csv' using 1:2:($1 / half):($1 * half):($2 / half):($2 * half):k + 2 with boxxyerror fs solid 1 noborder lc palette notitle
}
unset multiplot
