# SPDX-License-Identifier: MIT
# Draws a map in four panels. The caller sets `methods` and `titles` (of the panels), xlog, ylog, labels and ranges (in
# powers of ten on a logarithmic axis), and may set `overlay`, plotted over every panel.
width = 1000
height = 820
load "style.gnuplot"
set datafile separator whitespace
outcomes = "right close wrong missed gains blows_up says_so"
colors = "#1b7837 #a6dba0 #fee08b #d73027 #7b3294 #000000 #92c5de"
meanings = '"right to 1e-9" "within 1 %" "off by more than 1 %" "missed, or passed through" "gains energy" "blows up" "says that it cannot"'
boxes(method, outcome) = sprintf("< awk -F, -v method='%s' -v outcome='%s' -v xlog=%d -v ylog=%d -f boxes.awk '%s'", method, outcome, xlog, ylog, csv)
if (!exists("xstep")) { xstep = 1 }
if (xlog) { set format x "10^{%g}"; set xtics xstep }
if (ylog) { set format y "10^{%g}"; set ytics 1 }
if (!exists("overlay")) { overlay = "NaN notitle" }
set key off
unset grid
set tics out nomirror
set style fill solid noborder
set multiplot layout 2,2 margins 0.085,0.98,0.17,0.96 spacing 0.1,0.12
do for [panel=1:4] {
  set title word(titles, panel) offset 0,-0.6
  plot for [i=1:7] boxes(word(methods, panel), word(outcomes, i)) using (0.5*($1+$2)):(0.5*($3+$4)):1:2:3:4 with boxxyerror lc rgb word(colors, i), \
    @overlay
}
load "legend.gnuplot"
set key maxcols 4
plot for [i=1:7] NaN with boxes lc rgb word(colors, i) title word(meanings, i)
unset multiplot
