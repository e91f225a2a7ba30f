# SPDX-License-Identifier: MIT
"""Objects keep what they show: nothing dangles, nothing can be overwritten, nothing is leaked."""

import gc
import itertools
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


def arrays_of_everything():
    """A name and a function that gives an array of an object that nothing else refers to."""
    scene = carom.Scene(BALL)
    seed = carom.Seed("ball", 1.0, position=(1, 0, 0))

    def edit():
        made = carom.Edit(scene)
        made.vary(carom.velocity("ball"))
        made.nail("ball", 0.5).position(1, None, None)
        return made

    def point():
        program = edit().evaluator()
        return program.at(program.start)

    def session():
        made = carom.EditSession(scene)
        made.set_controls([carom.velocity("ball")])
        made.grab("ball", 0.3, orientation=True)
        return made

    def tangent():
        return carom.tangent(carom.simulate(scene), carom.SceneTangent(scene, velocity={"ball": (1, 2, 3)}))

    def second():
        return carom.second_order(carom.simulate(scene), seed, [carom.SceneTangent(scene, velocity={"ball": (1, 2, 3)})])

    owners = {
        "scene": lambda: carom.Scene(BALL),
        "state": lambda: carom.simulate(scene).state_at("ball", 0.5),
        "states": lambda: carom.simulate(scene).sample("ball", [0.1, 0.5]),
        "events": lambda: carom.simulate(scene).events,
        "contact": lambda: carom.simulate(scene).events[0].contacts[0],
        "gradient": lambda: carom.adjoint(carom.simulate(scene), seed),
        "direction": lambda: carom.SceneTangent(scene, velocity={"ball": (1, 2, 3)}, gravity=(1, 2, 3)),
        "rate": lambda: tangent().at("ball", 0.7),
        "rate of second order": lambda: second().gradient_rates[0],
        "program": lambda: edit().evaluator(),
        "point": point,
        "jacobian": lambda: point().jacobian(),
        "gradient of the objective": lambda: point().gradient(),
        "certificate": lambda: edit().solve(effort="fast").certificate,
        "session": session,
    }
    for name, made in owners.items():
        kind = type(made())
        for attribute in dir(kind):
            if not attribute.startswith("_") and isinstance(getattr(kind, attribute), property):
                yield f"{name}.{attribute}", made, attribute


def test_every_array_keeps_what_it_shows():
    seen = []
    for name, made, attribute in arrays_of_everything():
        value = getattr(made(), attribute)
        arrays = value if isinstance(value, list) else [value]
        if not arrays or not all(isinstance(array, np.ndarray) for array in arrays):
            continue
        expected = [array.tolist() for array in (value if isinstance(value, list) else [getattr(made(), attribute)])]
        gc.collect()
        junk = [np.full(size, 7.0) for size in range(1, 60)]  # takes memory that was given back
        junk += [carom.simulate(carom.Scene(BALL), 0.1 * k) for k in range(5)]
        assert [array.tolist() for array in arrays] == expected, name
        assert len(junk) == 64
        seen.append(name)
    for name in ("scene.gravity", "state.orientation", "states.velocity", "events.time", "contact.impulse", "gradient.velocity",
                 "gradient.gravity", "gradient.size", "direction.gravity", "rate.position", "rate.inertia", "point.values",
                 "jacobian.entries", "certificate.signature_step", "session.grabbed_place"):
        assert name in seen
    assert len(seen) > 60


def test_what_is_made_from_a_motion_outlives_it():
    scene = carom.Scene(BALL)
    tangent = carom.tangent(carom.simulate(scene), carom.SceneTangent(scene, velocity={"ball": (1, 2, 3)}))
    replayed = carom.simulate(scene)
    event, gradient = replayed.events[1], carom.adjoint(replayed, carom.Seed("ball", before=replayed.events[1], time=1))
    del scene, replayed
    gc.collect()
    assert np.isfinite(tangent.at("ball", 1.5).position).all() and np.isfinite(tangent.event_time(1))
    assert np.isfinite(gradient.velocity).all() and gradient.reliability.reliable and event.contacts[0].features


def test_objects_go_in_any_order():
    """The tape goes before its motion, a motion before its scene, contact sources before what lent them, whoever is last."""
    for order in itertools.permutations(range(4)):
        scene = carom.Scene(BALL)
        motion = carom.simulate(scene)
        gradient = carom.adjoint(motion, carom.Seed("ball", 1.0, position=(1, 0, 0)))
        edit = carom.Edit(scene)
        edit.vary(carom.velocity("ball"))
        kept = [scene, motion, (gradient, edit.evaluator()), edit]
        del scene, motion, gradient, edit
        for index in order:
            kept[index] = None
        gc.collect()


def test_callbacks_may_keep_and_drop_what_they_are_given(ball):
    kept = []
    edit = carom.Edit(ball)
    edit.vary(carom.velocity("ball"))

    def height(motion):
        kept.append(motion.sample("ball", [0.1]).position)
        kept.append(motion)
        if len(kept) > 6:
            del kept[:3]
            gc.collect()
        return carom.Reading(motion.state_at("ball", 0.4).position[2], [carom.Seed("ball", 0.4, position=(0, 0, 1))])

    edit.require("height", height, 0.9, until=0.4)
    program = edit.evaluator()
    point = program.at(program.start)
    del edit, program
    assert edit_is_solved(ball, height)
    gc.collect()
    assert np.isfinite(point.jacobian().entries).all() and all(np.isfinite(one).all() for one in kept if isinstance(one, np.ndarray))


def edit_is_solved(scene, function):
    edit = carom.Edit(scene)
    edit.vary(carom.velocity("ball"))
    edit.require("height", function, 0.9, until=0.4)
    return edit.solve(effort="fast", threads=2).solved
