# SPDX-License-Identifier: MIT
# Read before every NAME.table and NAME.figures (see fill_documents): skips comments and headings, so that what follows
# sees rows only, and gives them words. Cells are without commas. machine: the first line, what was measured on.
FNR == 1 { named = 0; machine = substr($0, 3) }
/^#/ { next }
!named {
  split("", column)
  for (i = 1; i <= NF; ++i) column[$i] = i
  named = 1
  next
}

# The cell of this row under a heading; without the quotes that may be around it.
function c(heading,    value) {
  if (!(heading in column)) {
    print FILENAME ": found no column \"" heading "\"" >"/dev/stderr"
    exit 1
  }
  value = $column[heading]
  if (value ~ /"/) gsub(/"/, "", value)  # a number stays one
  return value
}

# Keeps the least and the most of the values given under a name; "nan" and "" are none.
function keep(name, value) {
  if (value == "nan" || value == "") return
  value += 0
  if (!(name in lowest) || value < lowest[name]) lowest[name] = value
  if (!(name in highest) || value > highest[name]) highest[name] = value
}
function least(name) { return name in lowest ? lowest[name] : "nan" }
function most(name) { return name in highest ? highest[name] : "nan" }

# Of list[1] ... list[n], which it sorts.
function median(list, n,    i, j, v) {
  for (i = 2; i <= n; ++i) {
    v = list[i]
    for (j = i - 1; j > 0 && list[j] > v; --j) list[j + 1] = list[j]
    list[j + 1] = v
  }
  return n ? (list[int((n + 1) / 2)] + list[int(n / 2) + 1]) / 2 : "nan"
}

function over(a, b) { return a == "nan" || b == "nan" || b + 0 == 0 ? "nan" : a / b }
function percent(part, whole) { return whole + 0 == 0 ? "nan" : sprintf("%.0f %%", 100 * part / whole) }

# Decimal exponent: 10^exponent <= |x| < 10^(exponent + 1).
function exponent(x) { split(sprintf("%.15e", x), halves, "e"); return halves[2] + 0 }
# A number in n digits: 1.3, 240, 2.4e-13.
function digits(x, n,    e) {
  if (x == "nan") return x
  if (x + 0 == 0) return "0"
  x = sprintf("%." (n - 1) "e", x) + 0
  e = exponent(x)
  if (e < -3 || e > 5) return sprintf("%." (n - 1) "e", x)
  return sprintf("%." (e < n - 1 ? n - 1 - e : 0) "f", x)
}
# One digit, away from what it bounds: at most up(x), at least down(x).
function up(x,    e, k) {
  if (x == "nan" || x + 0 <= 0) return x
  e = exponent(x); k = int(x / 10 ^ e)
  if (k * 10 ^ e < x * (1 - 1e-12)) ++k
  return digits(k * 10 ^ e, 1)
}
function down(x) {
  if (x == "nan" || x + 0 <= 0) return x
  return digits(int(x / 10 ^ exponent(x) * (1 + 1e-12)) * 10 ^ exponent(x), 1)
}
# Seconds and bytes in the unit that suits them.
function time(seconds) {
  if (seconds == "nan") return seconds
  if (seconds < 9.95e-4) return digits(seconds * 1e6, 2) " us"
  return seconds < 0.995 ? digits(seconds * 1e3, 2) " ms" : digits(seconds, 2) " s"
}
function size(bytes) {
  if (bytes == "nan") return bytes
  if (bytes < 1000) return digits(bytes, 2) " B"
  return bytes < 1e6 ? digits(bytes / 1e3, 2) " kB" : digits(bytes / 1e6, 2) " MB"
}
# A name as part of a key: "two boxes" is two_boxes.
function key(name) { gsub(/[^A-Za-z0-9]+/, "_", name); sub(/_$/, "", name); return name }
