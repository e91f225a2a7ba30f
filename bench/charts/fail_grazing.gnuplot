# SPDX-License-Identifier: MIT
methods = '"ODE" "Bullet" "MuJoCo" "carom gradient"'
titles = '"ODE at 1e-3 s" "Bullet at 1e-3 s" "MuJoCo at 1e-3 s" "carom; light blue: motion right, gradient marked unreliable"'
xlog = 1
ylog = 0
set xlabel "angle between velocity and tangent, rad"
set ylabel "elasticity"
set xrange [-7.1:0.3]
set yrange [-0.025:1.025]
load "map.gnuplot"
