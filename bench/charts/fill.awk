# SPDX-License-Identifier: MIT
# For fill_documents: FIGURES DOCUMENT. A line of FIGURES is a key, a tab and its text. Prints the document filled; says
# what is wrong with its marks, by file and line, and ends with 1 then. tables: the folder of what NAME.table printed.
BEGIN { stray = "found <!--/-->, the end of a figure, without a key that begins one" }
function wrong(sentence) { print FILENAME ":" FNR ": " sentence >"/dev/stderr"; failed = 1 }
FNR == NR { figure[substr($0, 1, index($0, "\t") - 1)] = substr($0, index($0, "\t") + 1); next }

/^<!-- end of table -->$/ {
  if (!table) wrong("found the end of a table that does not begin")
  table = ""
}
table { if (/^<!-- table /) wrong("found another table, expected the end of table " table); next }
/^<!-- table [A-Za-z_0-9]+ -->$/ {
  print
  table = $3
  file = tables "/" table ".table"
  if ((getline line <file) < 0)
    wrong("found table " table ", but bench/charts has no " table ".table or docs/charts not its CSV file")
  else
    do print line; while ((getline line <file) > 0)
  close(file)
  next
}
{ print filled($0) }
END {
  if (table) wrong("found the end of the file, expected that of table " table)
  exit failed
}

function filled(rest,    done, name, end) {
  while (match(rest, /<!--[A-Za-z_0-9]+\.[A-Za-z_0-9]+-->/)) {
    if (index(substr(rest, 1, RSTART - 1), "<!--/-->")) wrong(stray)
    done = done substr(rest, 1, RSTART - 1)
    name = substr(rest, RSTART + 4, RLENGTH - 7)
    # Markdown takes a line that begins with a comment as HTML, not as part of the sentence
    if (done ~ /^[ \t>*+-]*$/) wrong("found the figure " name " as the first word of a line, expected a word before it")
    done = done substr(rest, RSTART, RLENGTH)
    rest = substr(rest, RSTART + RLENGTH)
    end = index(rest, "<!--/-->")
    if (!end || (match(rest, /<!--[A-Za-z_0-9]+\./) && RSTART < end)) {
      wrong("found the figure " name " without its end <!--/--> in the same line")
      return done rest
    }
    done = done value(name) "<!--/-->"
    rest = substr(rest, end + 8)
  }
  if (index(rest, "<!--/-->")) wrong(stray)
  return done rest
}
function value(name) {
  if (!(name in figure)) {
    wrong("found the figure " name ", which no program of bench/charts gives")
    return "?"
  }
  if (figure[name] !~ /^nan/) return figure[name]
  print FILENAME ":" FNR ": the figure " name " was not measured" >"/dev/stderr"
  return "not measured"
}
