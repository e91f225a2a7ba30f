# SPDX-License-Identifier: MIT
width = 900
height = 420
load "style.gnuplot"
set terminal svg size width,height dynamic noenhanced font "sans-serif,13" background "white"  # names have underscores
set multiplot layout 1,2
set grid ytics
set xtics rotate by -30
set style fill solid 0.7 noborder
set style data histograms
set style histogram clustered gap 1
set key outside bottom horizontal
set ylabel "edits met, %"
set yrange [0:100]
plot csv using "met":xtic(1) lc "#4477aa" title "all", \
     "" using "same_sequence" lc "#66ccee" title "same impacts", \
     "" using "other_sequence" lc "#ee6677" title "other impacts needed"
set ylabel "time of an edit, ms"
set logscale y
set yrange [1:3000]
plot csv using "median_ms":xtic(1) lc "#4477aa" title "median", \
     "" using "p95_ms" lc "#66ccee" title "95th percentile"
unset multiplot
