# SPDX-License-Identifier: MIT
# Makes room for one legend below the plots of a multiplot; the next `plot NaN ... title` fills it.
unset title
unset border
unset tics
unset xlabel
unset ylabel
unset grid
unset logscale
set xrange [0:1]
set yrange [0:1]
set lmargin at screen 0.02
set rmargin at screen 0.98
set bmargin at screen 0.0
set tmargin at screen 0.09
set key center center horizontal maxcols 5 width 2
