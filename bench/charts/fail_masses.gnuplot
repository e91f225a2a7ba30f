# SPDX-License-Identifier: MIT
methods = '"ODE" "Bullet" "MuJoCo" "carom"'
titles = '"ODE" "Bullet" "MuJoCo" "carom (has no steps)"'
xlog = 1
ylog = 1
set xlabel "mass ratio"
set ylabel "step, s"
set xrange [-0.05:8.28]
set yrange [-3.625:-0.875]
load "map.gnuplot"
