# SPDX-License-Identifier: MIT
"""Two threads compute as much as two processes, which share nothing: neither the GIL nor a lock nor an allocator holds them up.
bench/python/figures.py measures it."""

import subprocess
import sys

import pytest
from conftest import ROOT

SETUP = """
import os, statistics, sys, threading, time
sys.path.insert(0, "tests/python")
import carom
from conftest import BALL
scene = carom.Scene(BALL)
seed = carom.Seed("ball", 2.0, position=(1, 0, 0))
motion = carom.simulate(scene)
times = [0.001 * k for k in range(1000)]
edit = carom.Edit(scene)
edit.vary(carom.velocity("ball"))
edit.nail("ball", 1.0).position(2, 0, None)
evaluator = edit.evaluator()
"""
RACE = """
def work():
    for _ in range(CALLS):
        call()

def by_threads():
    workers = [threading.Thread(target=work) for _ in range(2)]
    began = time.perf_counter()
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    return time.perf_counter() - began

def by_processes():
    began = time.perf_counter()
    children = []
    for _ in range(2):
        child = os.fork()
        if child == 0:
            work()
            os._exit(0)
        children.append(child)
    for child in children:
        os.waitpid(child, 0)
    return time.perf_counter() - began

work()
ratios, before = [], by_threads()
while len(ratios) < 90:
    alone, after = by_processes(), by_threads()
    ratios.append(2 * alone / (before + after))
    before = after
    if len(ratios) >= 15 and statistics.median(ratios) >= 0.95:
        break
print(statistics.median(ratios), len(ratios))
"""


@pytest.mark.parametrize(("call", "calls"), [
    ("carom.adjoint(carom.simulate(scene), seed)", 1000),
    ("carom.simulate(scene).sample('ball', times)", 150),
    ("evaluator.at(evaluator.start).jacobian()", 500),
])
def test_two_threads_do_as_much_as_two_processes(call, calls):
    """The median of rounds in turns, each between two of the other kind. On a busy machine a thread that is taken off its
    core while it has the GIL holds the other one up (0.94 was seen at a load of 18); what keeps the GIL does half, and 0.75
    at such a load."""
    code = SETUP + f"CALLS = {calls}\ncall = lambda: {call}\n" + RACE
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT)
    assert run.returncode == 0, run.stderr
    ratio, rounds = run.stdout.split()
    assert float(ratio) >= 0.85, f"two threads did {ratio} times the work of two processes, in {rounds} rounds"
