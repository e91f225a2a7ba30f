# SPDX-License-Identifier: MIT
"""Objects keep what they show: nothing dangles, nothing can be overwritten, nothing is leaked."""

import gc
import resource

import numpy as np
import pytest

import carom
from conftest import BALL


def test_parts_outlive_their_motion():
    motion = carom.simulate(carom.Scene(BALL))
    event = motion.events[0]
    contact = event.contacts[0]
    point, impulse, times = contact.point, contact.impulse, motion.events.time
    expected = (point.tolist(), impulse.tolist(), times.tolist(), str(event))
    del motion, event, contact
    gc.collect()
    junk = [carom.simulate(carom.Scene(BALL), 0.1 * k) for k in range(20)]
    assert (point.tolist(), impulse.tolist(), times.tolist()) == expected[:3] and len(junk) == 20

    scene = carom.simulate(carom.Scene(BALL)).scene
    gc.collect()
    assert carom.simulate(scene).impacts > 1
    gravity = carom.Scene(BALL).gravity
    gc.collect()
    assert gravity.tolist() == [0, 0, -9.81]
    states = carom.simulate(carom.Scene(BALL)).sample("ball", [0.5])
    position = states.position
    del states
    gc.collect()
    assert position.shape == (1, 3) and np.isfinite(position).all()


def test_attributes_cannot_be_written(ball):
    motion = carom.simulate(ball)
    arrays = [ball.gravity, motion.state_at("ball", 0).position, motion.events.time, motion.events[0].contacts[0].point]
    for array in arrays:
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1
    with pytest.raises(AttributeError):
        motion.status = "complete"
    with pytest.raises(AttributeError):
        ball.duration = 3


def test_many_simulations_leak_nothing(ball):
    def memory():
        gc.collect()
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    def work(count):
        for _ in range(count):
            motion = carom.simulate(ball)
            motion.sample("ball", [0.1, 0.2])
            motion.events[0].contacts[0].point.sum()

    work(2000)
    before = memory()
    work(10000)
    assert memory() - before < 2000  # kB; a motion of this scene takes more than 2 kB
