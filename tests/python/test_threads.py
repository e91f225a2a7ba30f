# SPDX-License-Identifier: MIT
"""Python goes on in other threads while a call computes. What two threads bring is measured by bench/python/figures.py."""

import pathlib
import resource
import subprocess
import sys
import threading
import time
from collections.abc import Callable

import pytest
from test_interrupt import crowd_of

import carom

BODY = "ball 000"
CROWD = {**crowd_of(3), "duration": 5}
SCENE = carom.Scene(CROWD)
MOTION = carom.simulate(SCENE)
SEED = carom.Seed(BODY, 5.0, position=(1, 0, 0))
DIRECTION = carom.SceneTangent(SCENE)
TIMES = [0.005 * k for k in range(1000)]


def an_edit() -> carom.Edit:
    edit = carom.Edit(SCENE)
    edit.vary(carom.velocity(BODY))
    x, y, _ = MOTION.state_at(BODY, 0.3).position
    edit.nail(BODY, 0.3).position(x + 0.01, y, None)
    return edit


EVALUATOR = an_edit().evaluator()
CALLS = {
    "simulate": lambda: carom.simulate(SCENE),
    "adjoint": lambda: carom.adjoint(MOTION, SEED),
    "tangent": lambda: carom.tangent(MOTION, DIRECTION),
    "sample": lambda: MOTION.sample([body["name"] for body in CROWD["bodies"]], TIMES),
    "jacobian": lambda: EVALUATOR.at(EVALUATOR.start).jacobian(),
    "solve": lambda: an_edit().solve(),
}


def is_seen_inside(call: Callable[[], object], tries: int) -> bool:
    """Whether this thread runs while another one is inside the call. With a switch interval of an hour a thread has the GIL
    until it gives it away, so what keeps it is never seen."""
    inside, seen, ended = [False], [False], [False]

    def calls():
        for _ in range(tries):
            inside[0] = True
            call()
            inside[0] = False
            if seen[0]:
                break
        ended[0] = True

    call()  # what it raises is raised here
    interval = sys.getswitchinterval()
    sys.setswitchinterval(3600)
    try:
        thread = threading.Thread(target=calls)
        thread.start()
        while not ended[0]:
            time.sleep(0.0002)  # gives the GIL away
            seen[0] = seen[0] or inside[0]
        thread.join()
    finally:
        sys.setswitchinterval(interval)
    return seen[0]


@pytest.mark.parametrize("call", CALLS)
def test_python_goes_on_while_a_call_computes(call):
    assert is_seen_inside(CALLS[call], tries=1000)


def test_what_keeps_the_gil_is_not_seen():
    assert not is_seen_inside(lambda: sorted(range(10000, 0, -1)), tries=20)


def test_short_calls_do_not_wait_for_each_other(ball):
    """To be put to sleep for the GIL and woken takes longer than these calls: two threads were slower than one."""
    calls, seed = 10000, carom.Seed("ball", 1.0, position=(1, 0, 0))

    def work():
        for _ in range(calls):
            carom.adjoint(carom.simulate(ball), seed)

    threads = [threading.Thread(target=work) for _ in range(2)]
    waits = -resource.getrusage(resource.RUSAGE_SELF).ru_nvcsw
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    waits += resource.getrusage(resource.RUSAGE_SELF).ru_nvcsw
    assert waits < 0.02 * 2 * calls  # where two processors are free a third of the calls waited


# Threads in short calls, in a long one that looks for Ctrl-C, in an edit, and in callbacks of all of these.
ENDS = """
import sys, threading, time
import carom
from conftest import BALL
from test_interrupt import crowd_of

ball, crowd = carom.Scene(BALL), carom.Scene(crowd_of(3))

def short():
    while True:
        carom.adjoint(carom.simulate(ball), carom.Seed("ball", 1.0, position=(1, 0, 0)))

def long(progress=None):
    carom.simulate(crowd, impact_limit=10**9, record_events=False, progress=progress)

def row(motion):
    time.sleep(0.001)
    return carom.Reading(motion.state_at("ball", 0.4).position[2], [carom.Seed("ball", 0.4, position=(0, 0, 1))])

def edits():
    while True:
        edit = carom.Edit(ball)
        edit.vary(carom.velocity("ball"))
        edit.require("height", row, 0.9, until=0.4)
        edit.solve(effort="fast", progress=lambda at: time.sleep(0.001))

for work in (short, short, long, lambda: long(lambda at: time.sleep(0.001)), edits):
    threading.Thread(target=work, daemon=True).start()
time.sleep(0.3)
"""


@pytest.mark.parametrize("_", range(3))
def test_a_program_ends_while_its_threads_compute(_):
    """Python ends threads by unwinding them, which C++ answered with an abort."""
    path = [str(pathlib.Path(__file__).parent), str(pathlib.Path(carom.__file__).parents[1])]
    run = subprocess.run([sys.executable, "-c", f"import sys; sys.path[:0] = {path}\n{ENDS}"], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
