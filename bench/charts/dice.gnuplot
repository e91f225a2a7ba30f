# SPDX-License-Identifier: MIT
width = 900
height = 420
load "style.gnuplot"
set logscale xy
set key off
set multiplot layout 1,2 margins 0.08,0.98,0.14,0.93 spacing 0.1,0.1
set xlabel "impacts of a die"
set ylabel "ms"
set title "simulation" offset 0,-0.6
plot csv using 6:($2*1e3) with points ls 1 pt 6 ps 0.4
set ylabel "gradient over simulation"
set title "gradient of the place of rest" offset 0,-0.6
plot csv using 6:($3/$2) with points ls 1 pt 6 ps 0.4, 4 with lines ls 6
unset multiplot
