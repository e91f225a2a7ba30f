# SPDX-License-Identifier: MIT
"""Threads, progress, and Ctrl-C."""

import _thread
import threading
import time

import pytest

import carom

def crowd_of(count):
    """A scene whose motion takes minutes: a frictionless cube of balls that hit one another for a long time."""
    return {
        "carom": 1,
        "gravity": [0, 0, 0],
        "duration": 1e6,
        "materials": {"ideal": {"elasticity": 1, "friction": 0}},
        "bodies": [
            {"name": f"wall {axis}{side}", "fixed": True, "material": "ideal",
             "shape": {"plane": {"normal": [side * -(axis == k) for k in range(3)], "offset": -0.5 - count / 2}}}
            for axis in range(3) for side in (-1, 1)
        ] + [
            {"name": f"ball {i}{j}{k}", "material": "ideal", "mass": 1, "shape": {"sphere": {"radius": 0.1}},
             "position": [i - (count - 1) / 2, j - (count - 1) / 2, k - (count - 1) / 2],
             "velocity": [1 + 0.1 * i, 0.3 * j - 0.2, 0.7 - 0.4 * k]}
            for i in range(count) for j in range(count) for k in range(count)
        ],
    }


@pytest.fixture(scope="module")
def crowd():
    return carom.Scene(crowd_of(3))


def test_ctrl_c_ends_a_simulation(crowd):
    threading.Timer(0.2, _thread.interrupt_main).start()  # how soon it ends is measured by bench/python/figures.py
    with pytest.raises(KeyboardInterrupt):
        carom.simulate(crowd, impact_limit=10**9, record_events=False)


def test_progress_stops_and_raises(crowd):
    seen = []

    def progress(at):
        seen.append((at.time, at.impacts, at.steps))
        return len(seen) < 3

    motion = carom.simulate(crowd, impact_limit=10**9, progress=progress)
    assert motion.status == "stopped" and len(seen) == 3
    assert seen == sorted(seen) and seen[0] < seen[-1] and motion.end > 0

    def failing(at):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        carom.simulate(crowd, impact_limit=10**9, progress=failing)
    assert carom.simulate(crowd, 0.5, progress=lambda at: None).status == "complete"


def test_a_callback_may_simulate(crowd, ball):
    ends = []

    def progress(at):
        ends.append(carom.simulate(ball).end)
        return False

    assert carom.simulate(crowd, impact_limit=10**9, progress=progress).status == "stopped"
    assert ends == [2.0]


def test_threads_share_a_scene(ball):
    expected = carom.simulate(ball).sample("ball", [2.0]).position.tobytes()
    wrong = []

    def work():
        for _ in range(300):
            if carom.simulate(ball).sample("ball", [2.0]).position.tobytes() != expected:
                wrong.append(1)

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
        assert not thread.is_alive(), "a thread waits for another one"
    assert not wrong


def test_other_threads_run_meanwhile(crowd):
    """The GIL is free during a simulation: a counter in Python goes on."""
    counted = 0

    def simulate():
        carom.simulate(crowd, impact_limit=10**9, record_events=False, step_limit=300_000)

    thread = threading.Thread(target=simulate)
    thread.start()
    began = time.monotonic()
    while thread.is_alive():
        counted += 1
        time.sleep(0.001)
    assert counted > 5 and time.monotonic() - began > 0.01
