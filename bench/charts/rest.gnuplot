# SPDX-License-Identifier: MIT
width = 1000
height = 1000
load "style.gnuplot"
set logscale xy
set format "10^{%T}"
set mxtics 1
set mytics 1
set key off
scenes = '"ball down a slope" "sliding block" "bouncing ball"'
# below these nothing is drawn: what is 0 stands on the lower edge
least = 1e-17
drawn(x) = abs(x) > least ? abs(x) : least
set multiplot layout 3,3 margins 0.075,0.985,0.115,0.965 spacing 0.045,0.075
do for [row = 1:3] {
  part = row == 1 ? "seen" : "lasting"
  x = row == 1 ? 6 : 5
  y = row == 3 ? 10 : 7
  if (row == 1) { set xrange [1e-6:20]; set xtics 1e-6,100,10 } else { set xrange [0.02:60]; set xtics 0.1,10,10 }
  set yrange [1e-17:(row == 3 ? 1 : 10)]
  set ytics 1e-16,1e4,1
  do for [i = 1:3] {
    scene = word(scenes, i)
    if (row == 1) { set title (i == 1 ? "ball down a slope" : i == 2 ? "block that slides to rest" : "ball that bounces to rest") offset 0,-0.6 } else { unset title }
    set xlabel (row == 1 ? "wall seconds per simulated second" : "time, s") offset 0,0.5
    set ylabel (i > 1 ? "" : row == 1 ? "error of the place at the end, m" : row == 2 ? "error of the place, steps of 10^{-3} s, m" : "error of the energy, steps of 10^{-3} s") offset 1.5,0
    head = part.",".scene.","
    plot rows(head."ODE") using x:(drawn(column(y))) with linespoints ls 2 ps 0.6, \
      rows(head."ODE quick") using x:(drawn(column(y))) with linespoints ls 3 ps 0.6, \
      rows(head."Bullet") using x:(drawn(column(y))) with linespoints ls 4 ps 0.6, \
      rows(head."MuJoCo") using x:(drawn(column(y))) with linespoints ls 5 ps 0.6, \
      rows(head."carom") using x:(drawn(column(y))) with linespoints ls 1 ps (row == 1 ? 1.4 : 0.6)
  }
}
load "legend.gnuplot"
set tmargin at screen 0.06
plot NaN with linespoints ls 1 title "carom", NaN with linespoints ls 2 title "ODE dWorldStep", \
  NaN with linespoints ls 3 title "ODE dWorldQuickStep", NaN with linespoints ls 4 title "Bullet", \
  NaN with linespoints ls 5 title "MuJoCo"
unset multiplot
