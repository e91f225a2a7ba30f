# SPDX-License-Identifier: MIT
# of the optional comparison, bench/peers/run
width = 1150
height = 800
load "style.gnuplot"
set logscale xy
set format "10^{%T}"
set yrange [1e-17:1e8]
set ytics 1e-16,1e4,1e4
set xrange [1e-6:1e3]
set mxtics 1
set mytics 1
set key off
of(problem, peer, quantity) = sprintf("< awk -F, '$1 == \"%s\" && $2 == \"%s\" && $8 == \"%s\"' '%s'; " . \
  "echo nan,nan,nan,nan,nan,nan,nan,nan,nan,nan", problem, peer, quantity, csv)
array problems[3] = ["ball", "top", "two balls"]
array titles[3] = ["ball, three bounces", "free triaxial body", "two balls, oblique hit"]
set multiplot layout 2,3 margins 0.075,0.985,0.16,0.95 spacing 0.055,0.11
do for [row = 1:2] {
  do for [i = 1:3] {
    quantity = row == 1 ? "state" : "all"
    set title (row == 1 ? titles[i] : "") offset 0,-0.6
    set xlabel (row == 1 ? "" : "wall seconds, motion with all derivatives") offset 0,0.5
    set ylabel (i > 1 ? "" : row == 1 ? "relative error of the state at the end" : \
      "worst relative error of a derivative") offset 1,0
    p = problems[i]
    plot of(p, "MJX", quantity) using 6:9 with linespoints ls 5 lw 1.5, \
      of(p, "nimblephysics", quantity) using 6:9 with linespoints ls 2 lw 1.5, \
      of(p, "Warp (Newton)", quantity) using 6:9 with linespoints ls 4 lw 1.5, \
      of(p, "torchdiffeq", quantity) using 6:9 with linespoints ls 7 lw 1.5 pt 13, \
      of(p, "diffsol", quantity) using 6:9 with linespoints ls 9 lw 1.5 pt 8, \
      of(p, "carom", quantity) using 6:9 with points ls 1 ps 1.5
  }
}
load "legend.gnuplot"
set tmargin at screen 0.075
set key maxcols 6 width 0 font ",12"
plot NaN with points ls 1 ps 1.5 title "carom", NaN with linespoints ls 5 title "MJX", \
  NaN with linespoints ls 2 title "nimblephysics", \
  NaN with linespoints ls 4 title "Warp (Newton)", NaN with linespoints ls 7 pt 13 title "torchdiffeq", \
  NaN with linespoints ls 9 pt 8 title "diffsol"
unset multiplot
