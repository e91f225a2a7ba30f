# SPDX-License-Identifier: MIT
width = 900
height = 620
load "style.gnuplot"
set datafile separator "\t"
bars = "< awk -F, '!/^#/ && $1 != \"info\" && NR > 1 && $3 != \"model\" { if ($8 == 1) { first = $3; next } \
  printf \"%s: %s\\t%s\\t%s\\n\", $2, $3, $8, $10 }' '".csv."'"
set yrange [*:*] reverse
set offsets 0,0,0.6,0.6
set logscale x 2
set xrange [0.4:8]
set xtics ("1/2" 0.5, "1" 1, "2" 2, "4" 4, "8" 8)
set xlabel "time over that of the model chosen"
set lmargin 44
set arrow from 1, graph 0 to 1, graph 1 nohead lc rgb "#000000" dt 3
set key outside top center horizontal
plot bars using 2:0:ytic(1) with points ls 1 ps 1.3 title "simulation", bars using 3:0 with points ls 4 ps 1.2 title "gradient"
