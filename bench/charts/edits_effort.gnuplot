# SPDX-License-Identifier: MIT
# Of bench/edits/compare_slsqp.
width = 900
height = 420
load "style.gnuplot"
set multiplot layout 1,2
set logscale x
set xlabel "time of an edit, mean, s"
set yrange [0:100]
set key bottom right
set ylabel "met, % of all tasks"
plot rows("slsqp") using 2:3 with linespoints ls 2 title "SLSQP from many starts", \
  rows("fast") using 2:3 with points ls 1 pt 6 ps 1.4 title "carom, fast", \
  rows("search") using 2:3 with points ls 1 ps 1.4 title "normal", \
  rows("thorough") using 2:3 with points ls 1 pt 5 ps 1.4 title "thorough"
set ylabel "met by at most 1.01 times the smallest change known, %"
set key off
plot rows("slsqp") using 2:4 with linespoints ls 2, rows("fast") using 2:4 with points ls 1 pt 6 ps 1.4, \
  rows("search") using 2:4 with points ls 1 ps 1.4, rows("thorough") using 2:4 with points ls 1 pt 5 ps 1.4
unset multiplot
