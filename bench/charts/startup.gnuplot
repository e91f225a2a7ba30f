# SPDX-License-Identifier: MIT
width = 760
height = 300
load "style.gnuplot"
bars = "< awk -F, '!/^#/ && $1 != \"call\"' '".csv."'"
set yrange [*:*] reverse
set offsets 0,0,0.6,0.6
set logscale x
set xrange [0.3:100]
set xlabel "wall time of the whole process, ms (median and least)"
set lmargin 26
set arrow from 5, graph 0 to 5, graph 1 nohead lc rgb "#000000" dt 3
set label "aim" at 5.2, graph 0.06
unset key
plot bars using (1e3*$2):0:ytic(1) with points ls 1 ps 1.3, bars using (1e3*$4):0 with points ls 6 ps 1.2
