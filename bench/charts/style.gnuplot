# SPDX-License-Identifier: MIT
# What all charts share; `csv` and `svg` are set by bench/charts/make.
set terminal svg size width,height dynamic enhanced font "sans-serif,13" background "white"
set output svg
set datafile separator ","
set grid lc rgb "#dddddd"
set style line 1 lc rgb "#000000" lw 2 pt 7   # carom
set style line 2 lc rgb "#d55e00" lw 2 pt 5   # ODE
set style line 3 lc rgb "#e69f00" lw 2 pt 4 dt 2   # ODE quick
set style line 4 lc rgb "#0072b2" lw 2 pt 9   # Bullet
set style line 5 lc rgb "#009e73" lw 2 pt 11  # MuJoCo
set style line 6 lc rgb "#999999" lw 1.5 pt 1
set style line 7 lc rgb "#cc79a7" lw 1.5 pt 2
set style line 8 lc rgb "#56b4e9" lw 1.5 pt 3
set style line 9 lc rgb "#8c6d31" lw 1.5 pt 8
# rows of the CSV file that begin with these words; none of them: a point that is not drawn
rows(words) = sprintf("< grep '^%s,' '%s' || echo '%s,nan,nan,nan,nan,nan,nan,nan'", words, csv, words)
