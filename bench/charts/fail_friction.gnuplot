# SPDX-License-Identifier: MIT
methods = '"ODE" "Bullet" "MuJoCo" "carom"'
titles = '"ODE at 1e-3 s" "Bullet at 1e-3 s" "MuJoCo at 1e-3 s" "carom"'
xlog = 1
ylog = 1
set xlabel "velocity along the floor over velocity towards it"
set ylabel "friction"
set xrange [-2.07:2.07]
set yrange [-2.07:1.07]
# sticks above, slides below: 2/7 slope = mu (1 + e)
overlay = 'x + log10(2.0/7/1.5) with lines lw 2 dt 2 lc rgb "#000000"'
load "map.gnuplot"
