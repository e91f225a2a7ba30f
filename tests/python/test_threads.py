# SPDX-License-Identifier: MIT
"""Python goes on in other threads while a call computes. What two threads bring is measured by bench/python/figures.py."""

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
