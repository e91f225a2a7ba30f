# SPDX-License-Identifier: MIT
# Cells of a map with one outcome as boxes for gnuplot, neighbours in a row joined: x low, x high, y low, y high, in
# powers of ten where an axis is logarithmic.
#   awk -F, -v method=ODE -v outcome=missed -v xlog=1 -v ylog=0 -f boxes.awk MAP.csv
function place(value, logarithmic) { return logarithmic ? log(value) / log(10) : value + 0 }
/^#/ { next }
!named { named = 1; next }
$1 != method { next }
{
  x = place($2, xlog); y = place($3, ylog)
  if (!(x in xs)) { xs[x]; column[nx++] = x }
  if (!(y in ys)) { ys[y]; line[ny++] = y }
  at[x, y] = $4
}
function sort(list, n,    i, j, v) {
  for (i = 1; i < n; ++i) {
    v = list[i]
    for (j = i - 1; j >= 0 && list[j] > v; --j) list[j + 1] = list[j]
    list[j + 1] = v
  }
}
END {
  if (nx < 2 || ny < 2) { print "nan nan nan nan"; exit }
  sort(column, nx); sort(line, ny)
  dx = (column[nx - 1] - column[0]) / (nx - 1) / 2
  dy = (line[ny - 1] - line[0]) / (ny - 1) / 2
  for (j = 0; j < ny; ++j)
    for (i = 0; i < nx; ++i) {
      if (at[column[i], line[j]] != outcome) continue
      for (k = i; k + 1 < nx && at[column[k + 1], line[j]] == outcome; ++k);
      print column[i] - dx, column[k] + dx, line[j] - dy, line[j] + dy
      any = 1
      i = k
    }
  if (!any) print "nan nan nan nan"
}
