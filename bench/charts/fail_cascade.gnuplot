# SPDX-License-Identifier: MIT
methods = '"ODE" "Bullet" "MuJoCo" "carom"'
titles = '"ODE" "Bullet" "MuJoCo" "carom (has no steps)"'
xlog = 1
ylog = 1
set xlabel "e / (1 - e)"
set ylabel "step, s"
set xrange [-3.17:6.17]
set yrange [-3.625:-1.875]
load "map.gnuplot"
