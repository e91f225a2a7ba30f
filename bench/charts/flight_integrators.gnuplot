# SPDX-License-Identifier: MIT
width = 1150
height = 1150
load "style.gnuplot"
set logscale xy
set format "10^{%T}"
set yrange [1e-17:10]
set ytics 1e-16,1e4,1
set xtics 1e-6,10,10
set mxtics 1
set mytics 1
set key off
title_of(top) = top eq "symmetric" ? "symmetric, 1000 rad/s" : top eq "near-symmetric" ? "symmetric but for 10^{-6}, 1000 rad/s" : \
  top eq "box slow" ? "box, 1 rad/s" : top eq "box fast" ? "box, 1000 rad/s" : \
  top eq "strongly triaxial" ? "strongly triaxial, 1000 rad/s" : \
  top eq "middle axis" ? "middle axis, 100 rad/s for 10 s" : top eq "needle" ? "needle, 1000 rad/s" : \
  top eq "disc" ? "disc, 1000 rad/s" : "box, 8 rad/s for 0.4 s, read 16 times"
set multiplot layout 3,3 margins 0.06,0.985,0.13,0.97 spacing 0.055,0.07
do for [i = 1:9] {
  top = word('"symmetric" "near-symmetric" "box slow" "box fast" "strongly triaxial" "middle axis" "needle" "disc" "short flight"', i)
  set title title_of(top) offset 0,-0.6
  set xlabel (i > 6 ? "wall seconds of the flight" : "") offset 0,0.5
  set ylabel (i % 3 == 1 ? "error of the orientation, rad" : "") offset 1,0
  set xrange [2e-8:1]
  plot rows(top.",rounding of the start") using (2e-8):5:(1):(0) with vectors nohead lw 1 dt 3 lc rgb "#000000", \
    rows(top.",RK4") using 4:5 with linespoints ls 6, \
    rows(top.",Euler RK4") using 4:5 with linespoints ls 5, \
    rows(top.",Lie group 4") using 4:5 with linespoints ls 8, \
    rows(top.",splitting 2") using 4:5 with linespoints ls 9, \
    rows(top.",Dormand-Prince 5(4)") using 4:5 with linespoints ls 4, \
    rows(top.",Fehlberg 7(8)") using 4:5 with linespoints ls 7, \
    rows(top.",elliptic functions") using 4:5 with points ls 2 ps 1.2, \
    rows(top.",Taylor series") using 4:5 with points ls 3 ps 1.2, \
    rows(top.",triaxial tier") using 4:5 with points ls 1 pt 6 ps 1.4, \
    rows(top.",carom") using 4:5 with points ls 1 ps 1.4
}
load "legend.gnuplot"
set tmargin at screen 0.07
plot NaN with points ls 1 ps 1.4 title "carom", NaN with points ls 2 ps 1.2 title "elliptic functions alone", \
  NaN with points ls 3 ps 1.2 title "Taylor series alone", \
  NaN with points ls 1 pt 6 ps 1.4 title "triaxial tier forced", NaN with linespoints ls 7 title "Fehlberg 7(8)", \
  NaN with linespoints ls 4 title "Dormand-Prince 5(4)", NaN with linespoints ls 6 title "RK4", \
  NaN with linespoints ls 5 title "RK4, Euler's equations", NaN with linespoints ls 8 title "Lie group 4", \
  NaN with linespoints ls 9 title "splitting 2", NaN with lines lw 1 dt 3 lc rgb "#000000" title "rounding of the start"
unset multiplot
