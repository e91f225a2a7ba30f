# SPDX-License-Identifier: MIT
"""Threads, progress, and Ctrl-C."""

import _thread
import sys
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


def in_time(work):
    """Runs each in a thread of its own; that one does not end is a deadlock."""
    raised = []

    def run(one):
        try:
            one()
        except BaseException as error:
            raised.append(error)

    threads = [threading.Thread(target=run, args=[one], daemon=True) for one in work]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(120)
        assert not thread.is_alive(), "two threads wait for each other"
    assert not raised


def test_callbacks_that_wait_for_other_threads(ball, crowd):
    """A callback has the GIL, and gives it away while it waits for a thread that simulates, differentiates and edits."""

    def other():
        motion = carom.simulate(ball)
        carom.adjoint(motion, carom.Seed("ball", 1.0, position=(1, 0, 0)))
        program = carom.Edit(ball).evaluator()
        program.at(program.start)

    def waits(*_):
        in_time([other])
        return False

    def height(motion):
        in_time([other])
        return carom.Reading(motion.state_at("ball", 0.4).position[2], [carom.Seed("ball", 0.4, position=(0, 0, 1))])

    def solves():
        edit = carom.Edit(ball)
        edit.vary(carom.velocity("ball"))
        edit.require("height", height, 0.9, until=0.4)
        assert edit.solve(effort="fast", threads=2).solved

    def drags():
        session = carom.EditSession(ball)
        session.set_controls([carom.velocity("ball")])
        session.grab("ball", 0.3)
        session.drag_to((0.7, 0.1, 1.0))
        session.dwell(waits)
        session.release()

    in_time([lambda: carom.simulate(crowd, impact_limit=10**9, progress=waits), solves, drags, solves])


def test_threads_differentiate_one_motion(ball):
    motion = carom.simulate(ball)
    seed = carom.Seed("ball", 1.0, position=(1, 0, 0))
    along = carom.SceneTangent(ball, velocity={"ball": (1, 2, 3)})
    expected = carom.adjoint(motion, seed).velocity.tobytes()

    def rates(states):
        time.sleep(0.001)  # without the GIL, in the middle of a derivative that others wait for
        return [carom.Seed("ball", 1.0)]

    def first():
        for _ in range(20):
            assert carom.adjoint(motion, seed).velocity.tobytes() == expected

    def second():
        for _ in range(20):
            assert carom.second_order(motion, seed, [along], seed_rates=rates).gradient.velocity.tobytes() == expected

    def third():
        for _ in range(20):
            carom.tangent(motion, along).at("ball", 0.5)

    in_time([first, second, third, first])


def calls_that_compute(ball):
    thrown, small = carom.simulate(ball), carom.Edit(ball)
    small.vary(carom.velocity("ball"))
    small.nail("ball", 1.0).position(2.1, 0.1, None)
    crowd = carom.Scene(crowd_of(4))
    text = crowd.to_text()
    motion = carom.simulate(crowd, 20.0)
    seed = carom.Seed("ball 000", 15.0, position=(1, 0, 0))
    along = carom.SceneTangent(crowd, velocity={"ball 000": (1, 2, 3)})
    rates = carom.tangent(motion, along)
    edit = carom.Edit(crowd, 20.0)
    edit.vary(carom.velocity("ball 000"))
    edit.nail("ball 000", 15.0).position(0.5, None, None)
    program = edit.evaluator()
    point = program.at(program.start)
    session = carom.EditSession(crowd, 20.0)
    session.set_controls([carom.velocity("ball 000")])
    nail = session.nail_as_it_is("ball 000", 0.0)
    yield "Scene", lambda: carom.Scene(text)
    yield "to_text", lambda: program.scene_at(program.start).to_text()
    yield "simulate", lambda: carom.simulate(crowd, 20.0)
    yield "sample", lambda: motion.sample(range(6, 70), [1.0, 2.0, 3.0] * 10)
    yield "signature", motion.signature
    yield "describe_events", motion.describe_events
    yield "contacts", lambda: motion.contacts
    yield "text", lambda: thrown.text("csv")
    yield "adjoint", lambda: carom.adjoint(motion, seed)
    yield "tangent", lambda: carom.tangent(motion, along)
    yield "rates", lambda: [rates.at("ball 000", 0.5) for _ in range(100)]
    yield "second_order", lambda: carom.second_order(motion, seed, [along])
    yield "Edit", lambda: carom.Edit(program.scene_at(program.start), 20.0)
    yield "evaluator", edit.evaluator
    yield "at", lambda: program.at(program.start)
    yield "jacobian", point.jacobian
    yield "hessian", lambda: point.hessian(1, [1.0])
    yield "hessian_times", lambda: point.hessian_times(1, [1.0], [1.0, 0, 0])
    yield "motion", lambda: point.motion
    yield "solve", lambda: small.solve(effort="fast")
    yield "check", lambda: carom.check_motion_function(
        crowd, lambda motion: carom.Reading(0.0, [carom.Seed("ball 000", 0.1, position=(1, 0, 0))]),
        [carom.velocity("ball 000", components=["x"])], duration=1.0, until=0.1)
    yield "EditSession", lambda: carom.EditSession(crowd, 20.0)
    yield "set_controls", lambda: session.set_controls([carom.velocity("ball 000")])
    yield "set_nail_on", lambda: session.set_nail_on(nail, True)
    yield "nails", lambda: session.nails
    yield "numbers", lambda: session.numbers
    yield "unnail", lambda: session.unnail(session.nail_as_it_is("ball 000", 0.0))
    yield "set_content", lambda: session.set_content(crowd, "again")
    yield "undo", lambda: (session.undo(), session.redo())
    yield "scene", lambda: session.scene
    yield "session motion", lambda: session.motion


def test_the_gil_is_free_in_every_call_that_computes(ball):
    """Nobody is made to give the GIL away: another thread gets on only in a call that does so by itself."""
    interval = sys.getswitchinterval()
    got_on, ended = [0], threading.Event()

    def other():
        while not ended.is_set():
            got_on[0] += 1
            time.sleep(0)

    thread = threading.Thread(target=other)
    calls = list(calls_that_compute(ball))
    sys.setswitchinterval(1e6)
    thread.start()
    try:
        for name, call in calls:
            for _ in range(3000):
                before = got_on[0]
                call()
                if got_on[0] > before:
                    break
            else:
                pytest.fail(f"{name} has the GIL while it computes")
    finally:
        ended.set()
        sys.setswitchinterval(interval)
        thread.join(120)
