# SPDX-License-Identifier: MIT
width = 900
height = 440
load "style.gnuplot"
set multiplot layout 1,2
set style fill solid 0.8 noborder
set boxwidth 0.35
set xtics rotate by -35
set key outside bottom center horizontal
set title "An update of a drag, ms"
set logscale y
set yrange [0.05:50]
plot csv every ::1 using ($0-0.19):6:xtic(1) with boxes lc rgb "#4477aa" title "median", \
     "" every ::1 using ($0+0.19):7 with boxes lc rgb "#66ccee" title "95 of 100", \
     "" every ::1 using 0:10:(0.4) with xerrorbars pt 0 lw 2 lc "gray30" title "limit"
unset logscale
set title "Updates at the target, %"
set yrange [0:105]
plot csv every ::1 using 0:(100*$12/$11):xtic(1) with boxes lc rgb "#4477aa" title "of targets not behind a wall"
unset multiplot
