# SPDX-License-Identifier: MIT
width = 1000
height = 900
load "style.gnuplot"
set logscale xy
set format "10^{%T}"
set xrange [5e-7:100]
set yrange [1e-17:10]
set mxtics 1
set mytics 1
set xlabel "wall seconds per simulated second"
set ylabel "error at the end, m"
set key off
set multiplot layout 2,2 margins 0.08,0.98,0.17,0.96 spacing 0.09,0.11
do for [scene in '"ball" "box" "two boxes" "pool break"'] {
  set title (scene eq "ball" ? "ball, three bounces" : scene eq "box" ? "tumbling box, three impacts" : \
    scene eq "two boxes" ? "two boxes meet in the air" : "pool break, 30 impacts") offset 0,-0.6
  plot rows(scene.",RK4") using 4:5 with linespoints ls 6, \
    rows(scene.",Fehlberg 7(8)") using 4:5 with linespoints ls 7, \
    rows(scene.",Lie group 4") using 4:5 with linespoints ls 8, \
    rows(scene.",splitting 2") using 4:5 with linespoints ls 9, \
    rows(scene.",ODE") using 4:5 with linespoints ls 2, \
    rows(scene.",ODE quick") using 4:5 with linespoints ls 3, \
    rows(scene.",Bullet") using 4:5 with linespoints ls 4, \
    rows(scene.",MuJoCo") using 4:5 with linespoints ls 5, \
    rows(scene.",carom") using 4:5 with points ls 1 ps 1.4, \
    rows(scene.",carom along") using 4:5 with points ls 1 pt 6 ps 1.4
}
load "legend.gnuplot"
plot NaN with linespoints ls 6 title "RK4", NaN with linespoints ls 7 title "Fehlberg 7(8)", \
  NaN with linespoints ls 8 title "Lie group 4", NaN with linespoints ls 9 title "splitting 2", \
  NaN with points ls 1 ps 1.4 title "carom", NaN with linespoints ls 2 title "ODE dWorldStep", \
  NaN with linespoints ls 3 title "ODE dWorldQuickStep", NaN with linespoints ls 4 title "Bullet", \
  NaN with linespoints ls 5 title "MuJoCo", NaN with points ls 1 pt 6 ps 1.4 title "carom, impacts known"
unset multiplot
