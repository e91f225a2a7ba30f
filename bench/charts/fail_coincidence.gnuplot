# SPDX-License-Identifier: MIT
xstep = 2
methods = '"ODE" "Bullet" "MuJoCo" "carom"'
titles = '"ODE at 1e-3 s" "Bullet at 1e-3 s" "MuJoCo at 1e-3 s" "carom; light blue: solved as one, and says so"'
xlog = 1
ylog = 0
set xlabel "time between the two impacts, s"
set ylabel "elasticity"
set xrange [-14.17:-1.83]
set yrange [0.025:1.025]
load "map.gnuplot"
