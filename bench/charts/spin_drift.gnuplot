# SPDX-License-Identifier: MIT
width = 1000
height = 480
load "style.gnuplot"
set logscale xy
set format "10^{%T}"
set xrange [0.7:1.5e6]
set yrange [3e-18:1]
set ytics 1e-16,1e4,1
set xtics 1,10,1e6
set mxtics 1
set mytics 1
set key off
set multiplot layout 1,3 margins 0.08,0.985,0.31,0.93 spacing 0.06,0.1
do for [i = 1:3] {
  top = i == 2 ? "middle axis" : "box"
  column = i == 3 ? 5 : 4
  set title word('"box: energy" "nearly the middle axis: energy" "box: angular momentum"', i) offset 0,-0.6
  set xlabel "revolutions" offset 0,0.5
  set ylabel (i == 1 ? "relative change since the start" : "") offset 1,0
  plot rows(top.",RK4") using 3:column with linespoints ls 6, \
    rows(top.",Euler RK4") using 3:column with linespoints ls 5, \
    rows(top.",Lie group 4") using 3:column with linespoints ls 8, \
    rows(top.",splitting 2") using 3:column with linespoints ls 9, \
    rows(top.",Dormand-Prince 5(4)") using 3:column with linespoints ls 4, \
    rows(top.",Fehlberg 7(8)") using 3:column with linespoints ls 7, \
    rows(top.",elliptic functions") using 3:column with linespoints ls 2, \
    rows(top.",carom") using 3:column with linespoints ls 1
}
load "legend.gnuplot"
set tmargin at screen 0.17
plot NaN with linespoints ls 1 title "carom", NaN with linespoints ls 2 title "elliptic functions", \
  NaN with linespoints ls 7 title "Fehlberg 7(8)", NaN with linespoints ls 4 title "Dormand-Prince 5(4)", \
  NaN with linespoints ls 6 title "RK4", NaN with linespoints ls 5 title "RK4, Euler's equations", \
  NaN with linespoints ls 8 title "Lie group 4", NaN with linespoints ls 9 title "splitting 2"
unset multiplot
