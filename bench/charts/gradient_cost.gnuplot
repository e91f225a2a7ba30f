# SPDX-License-Identifier: MIT
width = 1000
height = 760
load "style.gnuplot"
set logscale xy
set format "10^{%T}"
set mxtics 1
set mytics 1
of(part, scene, method) = sprintf("< awk -F, '$1 == \"%s\" && $2 == \"%s\" && $6 == \"%s\"' '%s'", part, scene, method, csv)
set multiplot layout 2,2 margins 0.09,0.98,0.1,0.95 spacing 0.1,0.13
set key left top
set title "one quantity by many controls: 200 balls, 1000 impacts" offset 0,-0.6
set xlabel "controls" offset 0,0.5
set ylabel "time over that of one simulation" offset 1,0
set yrange [0.05:*]
plot of("controls", "balls", "differences") using 3:9 with linespoints ls 2 title "central differences", \
  of("controls", "balls", "tangent") using 3:9 with linespoints ls 4 title "tangent passes", \
  of("controls", "balls", "adjoint") using 3:9 with linespoints ls 1 title "adjoint pass"
unset logscale y
set format y "%g"
set yrange [0:*]
set title "adjoint pass: more impacts of 20 bodies" offset 0,-0.6
set xlabel "impacts" offset 0,0.5
plot of("impacts", "balls", "adjoint") using 4:9 with linespoints ls 1 title "balls", \
  of("impacts", "boxes", "adjoint") using 4:9 with linespoints ls 4 title "boxes with friction"
set title "adjoint pass: more bodies, 1000 impacts" offset 0,-0.6
set xlabel "bodies" offset 0,0.5
set key right top
plot of("bodies", "balls", "adjoint") using 5:9 with linespoints ls 1 title "balls", \
  of("bodies", "boxes", "adjoint") using 5:9 with linespoints ls 4 title "boxes with friction"
set logscale y
set format y "10^{%T}"
set yrange [*:*]
set key right bottom
set title "memory, 20 bodies" offset 0,-0.6
set xlabel "impacts" offset 0,0.5
set ylabel "bytes"
plot of("impacts", "balls", "adjoint") using 4:10 with linespoints ls 1 title "balls: motion and tape", \
  of("impacts", "balls", "motion") using 4:10 with linespoints ls 1 pt 6 dt 2 title "balls: motion", \
  of("impacts", "boxes", "adjoint") using 4:10 with linespoints ls 4 title "boxes: motion and tape", \
  of("impacts", "boxes", "motion") using 4:10 with linespoints ls 4 pt 8 dt 2 title "boxes: motion"
unset multiplot
