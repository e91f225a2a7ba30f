# SPDX-License-Identifier: MIT
width = 900
height = 420
load "style.gnuplot"
set multiplot layout 1,2
set logscale x
set xlabel "balls in the pen"
set xrange [7:15000]
set key bottom left
set ylabel "impacts per second"
set yrange [0:*]
plot rows("balls") using 2:3 with linespoints ls 1 title "with events", \
     rows("balls_paths_only") using 2:3 with linespoints ls 4 title "paths only", \
     200000 with lines dt 2 lc "gray" title "aim at 1000"
set ylabel "bytes per impact (peak)"
plot rows("balls") using 2:5 with linespoints ls 1 title "with events", \
     rows("balls_paths_only") using 2:5 with linespoints ls 4 title "paths only"
unset multiplot
