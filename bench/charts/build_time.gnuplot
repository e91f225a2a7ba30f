# SPDX-License-Identifier: MIT
width = 760
height = 270
load "style.gnuplot"
bars = "< awk -F, '!/^#/ && $1 != \"way\" { printf \"\\\"%s, %s\\\",%s,%s\\n\", $2, $1, $3, $4 }' '".csv."'"
set yrange [*:*] reverse
set offsets 0,0,0.6,0.6
set xrange [0:*]
set xlabel "minutes, on two cores; only the second clone finds a filled compiler cache"
set lmargin 44
set key outside top center horizontal
plot bars using ($2/60):0:ytic(1) with points ls 1 ps 1.3 title "wall time", bars using ($3/60):0 with points ls 4 ps 1.2 title "processor time"
