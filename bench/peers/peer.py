# SPDX-License-Identifier: MIT
"""What every peer's program shares: it times, and prints one answer a line in JSON, as soon as there is one."""

import json
import math
import os
import sys
import time

_ready = None  # seconds from the start of the process until everything was imported
BUDGET = 2.0  # seconds of repetitions
LONG = 5.0  # s: a first call that takes longer is not repeated, start-up is little of it


def ready():
    """To be called once the peer is imported: what was needed until then counts as cold start."""
    global _ready
    _ready = time.time() - float(os.environ.get("PEER_START", time.time()))


def answer(**line):
    def plain(x):
        if isinstance(x, list):
            return [plain(y) for y in x]
        return None if isinstance(x, float) and not math.isfinite(x) else x
    print(json.dumps({key: plain(value) for key, value in line.items()}), flush=True)


def say(sentence):
    print(sentence, file=sys.stderr, flush=True)


def cannot(problem, reason):
    answer(problem=problem.name, outcome="not available: " + reason)


def measure(problem, step, run, method="", compiling=0.0):
    """`run()` gives (state, jacobian): lists of numbers, the rows of the jacobian in the order of the components. A None
    in place of a column's number is a derivative that the peer does not give. The first call is the cold start (with
    imports and compilation; `compiling` are seconds that were spent on it before); the time is the best of some more."""
    start = time.perf_counter()
    try:
        state, jacobian = run()
    except Exception as error:  # noqa: BLE001: whatever a peer fails with is its outcome
        answer(problem=problem.name, step=step, method=method, outcome=f"failed: {type(error).__name__}: {error}")
        return None
    first = time.perf_counter() - start
    best, spent, runs = math.inf, 0.0, 0
    if first > LONG:
        best, spent, runs = first, first, 1
    while runs < 1 or (spent < BUDGET and runs < 200):
        start = time.perf_counter()
        run()
        once = time.perf_counter() - start
        best, spent, runs = min(best, once), spent + once, runs + 1
    answer(problem=problem.name, step=step, method=method, seconds=best, cold_start=(_ready or 0.0) + compiling + first,
           state=[float(x) for x in state],
           jacobian=[[None if x is None else float(x) for x in row] for row in jacobian])
    return best
