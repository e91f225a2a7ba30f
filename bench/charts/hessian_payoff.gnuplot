# SPDX-License-Identifier: MIT
width = 1050
height = 430
load "style.gnuplot"
set datafile separator "\t"
set logscale xy
set mxtics 1
set mytics 1
# the same quantity of two methods, one a line for each problem that both met
pairs(x, y, column) = sprintf("< awk -F, '!/^#/ { at = $1 \",\" $2; if ($6 == 1 && $5 == \"%s\") x[at] = $%d; \
  if ($6 == 1 && $5 == \"%s\") y[at] = $%d } END { for (at in x) if (at in y) print x[at] \"\\t\" y[at] }' '%s' | sort -n", x, column, y, column, csv)
of(group, method) = sprintf("< awk -F, -v OFS='\\t' '$1 == \"%s\" && $5 == \"%s\" { print $3, $8 }' '%s'", group, method, csv)
set multiplot layout 1,3 margins 0.06,0.985,0.14,0.92 spacing 0.07,0.1
set title "iterations of Ipopt" offset 0,-0.6
set xlabel "with exact second derivatives" offset 0,0.5
set ylabel "without" offset 1,0
set xrange [3:100]
set yrange [3:100]
set key right bottom
plot x with lines lc rgb "#000000" dt 3 notitle, pairs("exact", "limited memory", 7) using 1:2 with points ls 2 title "limited memory", \
  pairs("exact", "secant", 7) using 1:2 with points ls 4 pt 8 title "secant update"
set title "time of the solution, s" offset 0,-0.6
set format "10^{%T}"
set xrange [1e-3:10]
set yrange [1e-3:10]
plot x with lines lc rgb "#000000" dt 3 notitle, pairs("exact", "limited memory", 8) using 1:2 with points ls 2 title "limited memory", \
  pairs("exact", "secant", 8) using 1:2 with points ls 4 pt 8 title "secant update"
set key left top
set title "pieces, bouncing balls" offset 0,-0.6
set xlabel "controls"
set ylabel "s"
set format x "%g"
set xrange [5:250]
set yrange [*:*]
plot of("throws", "hessian") with linespoints ls 1 title "exact Hessian", of("throws", "jacobian") with linespoints ls 4 title "Jacobian", \
  of("throws", "simulation") with linespoints ls 6 title "simulation"
unset multiplot
