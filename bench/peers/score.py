# SPDX-License-Identifier: MIT
"""Judges the answers of the peers and writes the CSV file: score.py ANSWERS_FOLDER OUT.csv MACHINE_LINE.

ANSWERS_FOLDER has, for each peer that ran, PEER.jsonl (its answers, see peer.py), PEER.name, PEER.package and
PEER.version (all packages that it was given).
"""

import datetime
import json
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import problems

COLUMNS = "problem peer version method step seconds cold_start quantity error outcome".split()


def number(x):
    return "nan" if x is None or math.isnan(x) else f"{x:.6g}"


def cell(text):
    """One line without commas, short enough to be read in a table."""
    return " ".join(str(text).replace(",", ";").replace('"', "'").split())[:160]


def errors(problem, line, exact):
    """(quantity, error, outcome) of the state, of each quantity's derivatives, and of all that the peer gives."""
    state, jacobian = exact
    yield "state", problems.worst(problem, line["state"], state)
    by_quantity = {}
    for k, (_, _, quantity) in enumerate(problem.parameters):
        column = [row[k] for row in line["jacobian"]]
        missing = all(x is None for x in column)
        by_quantity.setdefault(quantity, []).append(
            None if missing else problems.worst(problem, column, [row[k] for row in jacobian]))
    given = []
    for quantity, found in by_quantity.items():
        if None in found:
            yield quantity, None
            continue
        given += found
        yield quantity, math.nan if any(map(math.isnan, found)) else max(found)
    if given:
        yield "all", math.nan if any(map(math.isnan, given)) else max(given)


def rows(name, version, lines, exact):
    for line in lines:
        start = [line["problem"], name, version, line.get("method", ""), number(line.get("step")),
                 number(line.get("seconds")), number(line.get("cold_start"))]
        if "outcome" in line:
            yield [*start, "all", "nan", cell(line["outcome"])]
            continue
        problem = next(p for p in problems.PROBLEMS if p.name == line["problem"])
        for quantity, error in errors(problem, line, exact[problem.name]):
            outcome = "not available: no derivative by it" if error is None else "nan" if math.isnan(error) else "ok"
            yield [*start, quantity, number(error), outcome]


def main():
    answers, out, machine = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3]
    exact = {p.name: problems.truth(p) for p in problems.PROBLEMS}
    text = [f"# {machine}"]
    table = []
    for file in sorted(answers.glob("*.jsonl")):
        name, version = ((file.with_suffix(end)).read_text().strip() for end in (".name", ".version"))
        lines = [json.loads(line) for line in file.read_text().splitlines() if line.startswith("{")]
        text.append(f"# {name}: {version}")
        package = file.with_suffix(".package").read_text().strip()
        own = next((word for word in version.split() if word.split("==")[0] == package), version)
        table += rows(name, cell(own.replace("==", " ")), lines, exact)
    text += [f"# measured on {datetime.datetime.now(datetime.timezone.utc):%Y-%m-%d}"]
    text += [f"# {p.name}: {p.text}, after {p.duration:g} s" for p in problems.PROBLEMS]
    text += ["# error: of the worst entry of a state or a derivative: over the entry; at least 1e-2 of its vector's largest",
             "# exact answers: closed forms and Taylor series in 45 digits; quantity: what was derived by; all: all given",
             "# step: of time, in s; of those that choose their steps themselves the tolerance; nan: neither",
             "# seconds: a motion with all of its derivatives; cold_start: the same with start, imports and compilation"]
    text.append(",".join(COLUMNS))
    text += [",".join(row) for row in sorted(table, key=lambda row: [p.name for p in problems.PROBLEMS].index(row[0]))]
    out.write_text("\n".join(text) + "\n")


main()
