# SPDX-License-Identifier: MIT
width = 1000
height = 430
load "style.gnuplot"
set xlabel "impacts"
set xrange [0:21]
set multiplot layout 1,2 margins 0.07,0.98,0.13,0.95 spacing 0.09
set logscale y
set format y "10^{%T}"
set key top left
set yrange [1e-5:1e14]
set ylabel "growth; distance, m"
data = "< grep -v '^#' '".csv."'"
plot data using 1:(column("growth")) with linespoints ls 1 title "growth of small changes", \
  data using 1:(column("ODE")) with linespoints ls 2 title "ODE's distance from the path, 1e-4 s", \
  data using 1:(column("Bullet")) with linespoints ls 4 title "Bullet's", \
  data using 1:(column("MuJoCo")) with linespoints ls 5 title "MuJoCo's"
unset logscale y
set format y "%g"
set yrange [-0.05:1.05]
set ylabel "share of edits solved"
set key bottom left
plot data every ::1 using 1:(column("solved")) with linespoints ls 2 pt 6 title "met to 1e-5", \
  data every ::1 using 1:(column("solved_tight")) with linespoints ls 6 dt 3 title "met to 1e-9"
unset multiplot
