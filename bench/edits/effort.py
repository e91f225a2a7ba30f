# SPDX-License-Identifier: MIT
"""Of the tasks of edits_bench: how many are met, and by the smallest change known, against the time that an edit takes.

    effort.py TASKS_CSV SLSQP_CSV SLSQP_HISTORY OUT

TASKS_CSV of edits_bench --csv gives a line for each of its configurations; SLSQP_HISTORY of slsqp.py what it had found
after so many seconds a task. SLSQP_CSV says which tasks these are: all lines are of them."""

import csv
import sys


def rows(file):
    with open(file, newline="") as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def line(way, seconds, objectives, best):
    """`objectives`: of the tasks that are met."""
    ratios = [objectives[task] / best[task] for task in objectives]
    share = 100 / len(best)
    return (f"{way},{seconds:.4g},{share * len(ratios):.1f},{share * sum(r <= 1.01 for r in ratios):.1f},"
            f"{share * sum(r <= 2 for r in ratios):.1f}")


def main():
    tasks_csv, slsqp_csv, history_csv, out = sys.argv[1:5]
    tasks, history = rows(tasks_csv), rows(history_csv)
    best = {r["task"]: float(r["best_known"]) for r in rows(slsqp_csv)}
    for r in tasks:
        if r["task"] in best:
            best[r["task"]] = min(best[r["task"]], float(r["best_known"]))
    lines = ["way,seconds,met,smallest,within_2"]
    for way in dict.fromkeys(r["configuration"] for r in tasks):
        mine = [r for r in tasks if r["configuration"] == way and r["task"] in best]
        met = {r["task"]: float(r["objective"]) for r in mine if r["met"] == "1"}
        lines.append(line(way, sum(float(r["ms"]) for r in mine) / 1e3 / len(mine), met, best))
    for seconds in (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10):
        met = {}
        for r in history:
            if float(r["seconds"]) <= seconds and r["task"] in best:
                met[r["task"]] = min(float(r["objective"]), met.get(r["task"], float("inf")))
        lines.append(line("slsqp", seconds, met, best))
    with open(out, "w") as file:
        file.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
