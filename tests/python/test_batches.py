# SPDX-License-Identifier: MIT
"""Many points of an evaluator at once, and states with their pullback."""

import os
import signal
import threading
import time

import numpy as np
import pytest

import carom
from carom import batches


@pytest.fixture
def evaluator(ball):
    edit = carom.Edit(ball)
    edit.vary(carom.velocity("ball"), carom.elasticity("rubber"))
    edit.nail("ball", 2.0).position(3, 0, None)
    return edit.evaluator()


def around(evaluator, count):
    return evaluator.start + 0.01 * np.random.default_rng(1).standard_normal((count, len(evaluator.variables)))


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_rows_at_many_points(evaluator, threads):
    xs = around(evaluator, 33)
    values, jacobian = evaluator.rows_at(xs, jacobian=True, threads=threads)
    assert values.shape == (33, 2) and jacobian.shape == (33, 2, 4) and values.flags.writeable
    for i, x in enumerate(xs):
        point = evaluator.at(x)
        assert np.array_equal(values[i], point.values) and np.array_equal(jacobian[i], point.jacobian().entries)
    again, none = evaluator.rows_at(xs, threads=threads)
    assert np.array_equal(again, values) and none is None
    assert evaluator.rows_at(np.empty((0, 4)), jacobian=True)[1].shape == (0, 2, 4)


def test_the_first_point_that_fails_is_named(ball):
    edit = carom.Edit(ball)
    edit.vary(carom.velocity("ball", components=["z"]))
    edit.nail("ball", carom.nth_impact(3)).position(3, None, None)
    evaluator = edit.evaluator()
    xs = np.array([[1.0], [1.0], [9.0], [1.0], [9.0]])
    for threads in (1, 3):
        with pytest.raises(carom.NotComputable, match="point 2: Impact 3 of 'ball' does not come within 2 s"):
            evaluator.rows_at(xs, threads=threads)
    with pytest.raises(carom.InputError, match=r"x: .*\(5, 2\)"):
        evaluator.rows_at(np.ones((5, 2)))
    with pytest.raises(carom.InputError, match="finite"):
        evaluator.rows_at([[np.nan]])
    with pytest.raises(carom.InputError, match="threads: found 0"):
        evaluator.rows_at(xs, threads=0)


def test_rows_of_python_are_called_from_many_threads(ball):
    def height(motion):
        seen.add(threading.get_ident())
        return carom.Reading(motion.state_at("ball", 1.0).position[2], [carom.Seed("ball", 1.0, position=(0, 0, 1))])

    def fails(motion):
        raise KeyError("of my own")

    seen: set[int] = set()
    edit = carom.Edit(ball)
    edit.vary(carom.velocity("ball"))
    edit.require("height", height, 0.5, until=1.0)
    evaluator = edit.evaluator()
    values, jacobian = evaluator.rows_at(around(evaluator, 40), jacobian=True, threads=4)
    assert np.array_equal(values[0], evaluator.at(around(evaluator, 40)[0]).values) and jacobian.shape == (40, 1, 3)
    assert len(seen) >= 1
    edit = carom.Edit(ball)
    edit.vary(carom.velocity("ball"))
    edit.minimise("fails", fails, until=1.0)
    with pytest.raises(KeyError, match="of my own"):
        edit.evaluator().rows_at(np.ones((8, 3)), threads=4)


def test_ctrl_c_ends_a_batch(evaluator):
    xs = np.broadcast_to(evaluator.start, (400_000, 4))
    threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
    began = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        evaluator.rows_at(xs, jacobian=True, threads=2)
    assert time.perf_counter() - began < 2  # all take ten seconds


def test_states_and_their_pullback(ball):
    times = np.linspace(0, 2, 9)
    states = batches.States(ball, [carom.velocity("ball"), carom.elasticity("rubber")], ["floor", "ball"], times, threads=2)
    xs = states.evaluator.start + 0.01 * np.random.default_rng(2).standard_normal((6, 4))
    values = states.values(xs)
    assert values.shape == (6, 2, 9, 13)
    weights = np.random.default_rng(3).standard_normal(values.shape)
    gradients = states.pullback(xs, weights)
    for x, own, weight, gradient in zip(xs, values, weights, gradients, strict=True):
        motion = carom.simulate(states.evaluator.scene_at(x))
        sampled = motion.sample(["floor", "ball"], times)
        assert np.array_equal(own[..., 3:7], sampled.orientation) and np.array_equal(own[..., 7:10], sampled.velocity)
        direction = carom.SceneTangent(motion.scene, velocity={"ball": (0.3, -0.2, 0.5)}, elasticity={"rubber": 0.7})
        rate = carom.tangent(motion, direction)
        expected = 0.0
        for b, body in enumerate(["floor", "ball"]):
            for t, at in enumerate(times):
                of = rate.at(body, at)
                w, (q0, *q) = of.orientation, sampled.orientation[b, t]
                turned = 0.5 * np.array([-np.dot(w, q), *(q0 * w + np.cross(w, q))])
                expected += weight[b, t] @ np.concatenate([of.position, turned, of.velocity, of.angular_velocity])
        assert not abs(gradient @ [0.3, -0.2, 0.5, 0.7] - expected) > 1e-13 * np.abs(weight).sum()
    assert np.array_equal(states.pullback(xs[0], np.zeros((2, 9, 13))), np.zeros(4))
    with pytest.raises(carom.InputError, match="weights"):
        states.pullback(xs[0], weights)
