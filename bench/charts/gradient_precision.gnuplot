# SPDX-License-Identifier: MIT
width = 1050
height = 760
load "style.gnuplot"
set logscale xy
set format "10^{%T}"
set yrange [1e-14:1e7]
set ytics 1e-16,1e3,1
set mxtics 1
set mytics 1
set key off
of(scene, method) = sprintf("< awk -F, -v OFS=, '$1 == \"%s\" && $2 == \"%s\" && $5 == \"%s\"' '%s'; echo nan,nan,nan,nan,nan,nan", \
  scene, method, method[1:12] eq "MuJoCo steps" ? "velocity" : "all", csv)
set multiplot layout 2,2 margins 0.08,0.985,0.19,0.95 spacing 0.08,0.12
do for [i = 1:4] {
  scene = i < 3 ? "box" : "two boxes"
  by = i % 2 ? 3 : 4
  set title (i < 3 ? "tumbling box, three impacts" : "two boxes meet in the air") offset 0,-0.6
  set xlabel (by == 3 ? "step of the differences" : "wall seconds of all derivatives together") offset 0,0.5
  set ylabel "worst relative error of an entry" offset 1,0
  set xrange [(by == 3 ? 1e-15 : 1e-5):(by == 3 ? 1 : 100)]
  plot of(scene, "differences") using by:6 with linespoints ls 6 lw 2, \
    of(scene, "ODE at 0.001") using by:6 with linespoints ls 2, of(scene, "ODE at 0.0001") using by:6 with points ls 2 pt 4 ps 1.3, \
    of(scene, "Bullet at 0.001") using by:6 with linespoints ls 4, \
    of(scene, "Bullet at 0.0001") using by:6 with points ls 4 pt 8 ps 1.3, \
    of(scene, "MuJoCo at 0.001") using by:6 with linespoints ls 5, \
    of(scene, "MuJoCo steps at 0.001") using by:6 with points ls 7 pt 2 ps 1.3, \
    of(scene, "adjoint") using (by == 3 ? 1e-15 : $4):6:(by == 3 ? 1 : 0):(0) with vectors nohead ls 1, \
    of(scene, "adjoint") using (by == 3 ? NaN : $4):6 with points ls 1 ps 1.3, \
    of(scene, "tangent") using (by == 3 ? NaN : $4):6 with points ls 1 pt 6 ps 1.3
}
load "legend.gnuplot"
set tmargin at screen 0.11
set key maxcols 4 width -2 font ",11"
plot NaN with linespoints ls 1 title "adjoint", NaN with points ls 1 pt 6 ps 1.3 title "tangent", \
  NaN with linespoints ls 6 lw 2 title "carom differences", NaN with linespoints ls 2 title "ODE at 1e-3 s", \
  NaN with points ls 2 pt 4 ps 1.3 title "ODE at 1e-4 s", NaN with linespoints ls 4 title "Bullet at 1e-3 s", \
  NaN with points ls 4 pt 8 ps 1.3 title "Bullet at 1e-4 s", NaN with linespoints ls 5 title "MuJoCo at 1e-3 s", \
  NaN with points ls 7 pt 2 ps 1.3 title "MuJoCo step by step"
unset multiplot
