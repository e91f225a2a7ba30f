# SPDX-License-Identifier: MIT
width = 640
height = 420
load "style.gnuplot"
set logscale xy
set format "10^{%T}"
set xlabel "h_c, m"
set ylabel "off the place of rest, m"
set xrange [5e-13:2e-5]
set key top left
plot csv using 1:2:4 with filledcurves fc rgb "#dddddd" title "eight of ten dice", \
  csv using 1:3 with linespoints ls 1 title "median", \
  3e-3*sqrt(x) with lines ls 6 title "root of h_c"
