# SPDX-License-Identifier: MIT
"""Edits that nobody has seen: makes them from a seed, solves them with `carom edit`, simulates every answer again and compares it with
what was asked.

    run.py CAROM [--seed S] [--count N] [--only FAMILY] [--seconds T] [--effort E] [--csv FILE] [--keep FOLDER]

The family of the i-th edit is the i-th in turn, so that a part of a run has them all. FILE has one line an edit: what it ended as, whether that is
right, processor seconds. Exits with 1 if an answer is false: solved and not met, or infeasible and met by the hidden motion."""

import argparse
import csv
import json
import math
import os
import pathlib
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time

from impossible import HARD, PROVABLE
from scenes import NoMotion, impacts, simulate
from tasks import FEASIBLE

TOLERANCE = 1e-6  # m, m/s, rad: what a fresh simulation may be off


def turned(q, p):
    """The angle between two orientations."""
    return 2 * math.acos(min(1.0, abs(sum(a * b for a, b in zip(q, p)))))


def off(value, wanted):
    if wanted is None:
        return 0.0
    if isinstance(wanted, dict):
        return max(wanted.get("min", -math.inf) - value, value - wanted.get("max", math.inf), 0.0)
    return abs(value - wanted)


def errors(carom, scene, constraint):
    """By how much the motion of the scene misses a constraint; infinity if an impact or a rest is missing."""
    if "sequence" in constraint:
        wanted = [set(pair.split()) for pair in constraint["sequence"]]
        counts = set.union(*wanted) | {b["name"] for b in scene["bodies"] if not b.get("fixed")}  # as docs/scenes.md says
        first = constraint["sequence"][0].split()[0]
        met = [set(e["bodies"]) for e in impacts(simulate(carom, scene), first) if set(e["bodies"]) <= counts]
        return 0.0 if met[:len(wanted)] == wanted else math.inf
    if "hits" in constraint:
        return 0.0 if impacts(simulate(carom, scene), constraint["body"], constraint["hits"]) else math.inf
    when, name = constraint["at"], constraint["body"]
    if isinstance(when, dict) and when.get("rest"):
        state = simulate(carom, scene, [scene["duration"]])["states"][0]["bodies"][name]
        if any(state["velocity"]) or any(state["angular_velocity"]):
            return math.inf
    else:
        if isinstance(when, dict):
            found = impacts(simulate(carom, scene), name, when.get("with"))
            if len(found) < when["impact"]:
                return math.inf
            when = found[when["impact"] - 1]["time"]
        state = simulate(carom, scene, [when])["states"][0]["bodies"][name]
    miss = 0.0
    for quantity, wanted in constraint.items():
        if quantity == "orientation":
            miss = max(miss, turned(state["orientation"], wanted))
        elif quantity == "speed":
            miss = max(miss, off(math.sqrt(sum(v * v for v in state["velocity"])), wanted))
        elif quantity in ("position", "velocity", "angular_velocity"):
            miss = max([miss] + [off(v, w) for v, w in zip(state[quantity], wanted)])
        elif quantity not in ("body", "at"):
            raise ValueError(quantity)
    return miss


def used_by(pid):
    """Processor seconds of a process so far."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def solve(carom, task, effort, seconds):
    """The answer, processor seconds, and the edited scene where the answer says that it meets the constraints. After so many of them a search is interrupted as by Ctrl-C: its best point
    is still verified and written. So the outcome does not depend on what else the machine does."""
    with tempfile.TemporaryDirectory() as folder:
        scene, out, answer = (pathlib.Path(folder, name) for name in ("scene.json", "out.json", "answer.json"))
        scene.write_text(json.dumps(task))
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        with answer.open("w") as to, subprocess.Popen([carom, "edit", str(scene), "--json", "--effort", effort, "-o", str(out)],
                                                      stdout=to, stderr=subprocess.DEVNULL) as process:
            interrupted = False
            while process.poll() is None:
                time.sleep(0.02)
                if not interrupted and used_by(process.pid) > seconds:
                    process.send_signal(signal.SIGINT)
                    interrupted = True
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        said = json.loads(answer.read_text())
        return said, used, json.loads(out.read_text()) if said["met"] else None


def make(seed, index, families, carom):
    """The family of the i-th edit and its document. Scenes that do not serve are drawn anew."""
    name, family = list(families.items())[index % len(families)]
    for attempt in range(200):
        try:
            return name, family(random.Random(f"{seed}.{index}.{attempt}"), carom)
        except NoMotion:
            continue
    raise RuntimeError(f"{name}: no scene in 200 attempts (seed {seed}, edit {index})")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("carom")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--only")
    parser.add_argument("--seconds", type=float, default=30, help="processor time of an edit")
    parser.add_argument("--effort", default="normal")
    parser.add_argument("--csv", default="-")
    parser.add_argument("--keep", help="folder for the documents of edits that did not end as they should")
    a = parser.parse_args()
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell ignores it in the background, and so would the edits
    families = {**FEASIBLE, **PROVABLE, **HARD}
    out = sys.stdout if a.csv == "-" else open(a.csv, "w", newline="")
    lines = csv.writer(out, lineterminator="\n")
    lines.writerow(["edit", "family", "status", "right", "error", "cpu_s", "message"])
    false_answers = 0
    for i in range(a.count):
        name, task = make(a.seed, i, families, a.carom)
        if a.only and name != a.only:
            continue
        answer, used, edited = solve(a.carom, task, a.effort, a.seconds)
        status, miss = answer["status"], ""
        if edited is not None:
            miss = max(errors(a.carom, edited, c) for c in task["constraints"])
        lies = edited is not None and not miss <= TOLERANCE or name in FEASIBLE and status == "infeasible"
        right = not lies and (edited is not None if name in FEASIBLE else edited is None and (status == "infeasible" or name in HARD))
        false_answers += lies
        lines.writerow([i, name, status, "false" if lies else "yes" if right else "no", miss, f"{used:.2f}", answer["message"]])
        out.flush()
        if a.keep and (not right or used > 10):
            pathlib.Path(a.keep).mkdir(parents=True, exist_ok=True)
            pathlib.Path(a.keep, f"{name}-{a.seed}-{i}.json").write_text(json.dumps(task, indent=1))
    sys.exit(1 if false_answers else 0)


if __name__ == "__main__":
    main()
