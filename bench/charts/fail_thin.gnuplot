# SPDX-License-Identifier: MIT
methods = '"ODE" "Bullet" "MuJoCo" "carom"'
titles = '"ODE at 1e-3 s" "Bullet at 1e-3 s" "MuJoCo at 1e-3 s" "carom"'
xlog = 1
ylog = 1
set xlabel "spin, rad/s"
set ylabel "thickness, m"
set xrange [-0.09:3.09]
set yrange [-4.1:-0.9]
load "map.gnuplot"
