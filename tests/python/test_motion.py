# SPDX-License-Identifier: MIT
"""Motions: states, samples, events and contacts, the same numbers as those of the command."""

import json
import math
import os
import pickle
import subprocess

import numpy as np
import pytest
from conftest import SCENES

import carom

QUANTITIES = ("position", "orientation", "velocity", "angular_velocity")
LONG = {"pen_500"}  # takes seconds; the command's own tests have it


def command(*arguments):
    program = os.environ.get("CAROM_COMMAND") or pytest.skip("CAROM_COMMAND names no command")
    return json.loads(subprocess.run([program, *map(str, arguments)], capture_output=True, check=True, text=True).stdout)


@pytest.mark.parametrize("path", sorted(p for p in SCENES.glob("*.json") if p.stem not in LONG), ids=lambda p: p.stem)
def test_the_bits_are_those_of_the_command(path):
    answer = command("simulate", path, "--json")
    motion = carom.simulate(carom.Scene.read(path))
    assert (motion.status, motion.message, motion.end) == (answer["status"], answer["message"], answer["end"])
    (states,) = answer["states"]
    for body, state in states["bodies"].items():
        mine = motion.state_at(body, states["time"])
        for quantity in QUANTITIES:
            assert getattr(mine, quantity).tolist() == state[quantity], (body, quantity)
    assert len(motion.events) == len(answer["events"])
    for mine, event in zip(motion.events, answer["events"], strict=True):
        assert (mine.time, mine.kind, mine.counts) == (event["time"], event["kind"], event["counts"])
        assert mine.contacts[0].point.tolist() == event["point"]
        assert mine.contacts[0].normal.tolist() == event["normal"]
        assert list(mine.contacts[0].bodies) == event["bodies"]
    assert len(motion.contacts) == len(answer["contacts"])
    for mine, contact in zip(motion.contacts, answer["contacts"], strict=True):
        assert [mine.body, mine.with_] == contact["bodies"]
        assert (mine.kind, mine.from_, mine.to, mine.features) == (
            contact["kind"], contact["from"], contact["to"], contact["features"])


def test_states_by_closed_form(ball):
    motion = carom.simulate(ball, 0.4)
    assert (motion.status, motion.message, motion.end, motion.duration) == ("complete", "complete", 0.4, 0.4)
    state = motion.state_at("ball", 0.3)
    np.testing.assert_allclose(state.position, [0.6, 0, 1 + 0.3 - 0.5 * 9.81 * 0.09], rtol=1e-15, atol=1e-15)
    np.testing.assert_allclose(state.velocity, [2, 0, 1 - 9.81 * 0.3], rtol=1e-15, atol=1e-15)
    np.testing.assert_allclose(state.orientation, [math.cos(1.5), 0, math.sin(1.5), 0], rtol=1e-14, atol=1e-15)
    assert motion.state_at(1, 0.3).position.tolist() == state.position.tolist()


def test_samples_are_states(ball):
    motion = carom.simulate(ball)
    times = np.array([0.0, 1.9, 0.5, motion.events[0].time, 2.0])
    states = motion.sample(["ball", "floor"], times)
    assert states.position.shape == (2, 5, 3) and states.orientation.shape == (2, 5, 4)
    assert states.velocity.shape == states.angular_velocity.shape == (2, 5, 3)
    assert states.times.tolist() == times.tolist()
    for b, body in enumerate(["ball", "floor"]):
        alone = motion.sample(body, list(times))
        assert alone.position.shape == (5, 3)
        for k, time in enumerate(times):
            for quantity in QUANTITIES:
                expected = getattr(motion.state_at(body, time), quantity).tolist()
                assert getattr(states, quantity)[b, k].tolist() == expected
                assert getattr(alone, quantity)[k].tolist() == expected
    assert motion.sample([], times).position.shape == (0, 5, 3)
    assert motion.sample(["ball"], []).position.shape == (1, 0, 3)
    assert motion.sample(1, np.arange(3)).position.shape == (3, 3)
    states.position[:] = 0  # it is the caller's
    assert motion.sample("ball", [0.5]).position[0].tolist() == motion.state_at("ball", 0.5).position.tolist()


def test_events(ball):
    motion = carom.simulate(ball)
    events = motion.events
    assert len(events) == motion.impacts == motion.event_count == len(list(events)) > 1
    assert events.time.tolist() == [event.time for event in events]
    assert events.kind == ["impact"] * len(events) and events.mode == [event.mode for event in events]
    assert [event.time for event in events[1:]] == events.time[1:].tolist()
    assert [event.time for event in events[::-1]] == events.time[::-1].tolist() and events[9:] == []
    first = events[0]
    fall = (1 + math.sqrt(1 + 2 * 9.81 * 0.97)) / 9.81
    assert abs(first.time - fall) < 1e-15
    assert events[-1].time == events.time[-1] and first.bodies == ["ball"] and first.index == 0
    (contact,) = first.contacts
    assert contact.bodies == ("floor", "ball") and contact.elasticity == 0.8 and contact.counted
    before, after = motion.state_before(0, "ball"), motion.state_after(first, "ball")
    np.testing.assert_allclose(after.velocity[2], -0.8 * before.velocity[2], rtol=1e-15)
    # the momentum that the contact gives: its impulse is on the first of the bodies, the floor
    np.testing.assert_allclose(-contact.impulse, 0.06 * (after.velocity - before.velocity), rtol=1e-13, atol=1e-16)
    assert motion.find_impact("ball", 2).index == 1 and motion.find_impact("ball", 2, "floor").time == events[1].time
    assert motion.find_impact("ball", 99) is None
    assert "ball" in str(first) and motion.describe_events()[0] == str(first)
    assert motion.signature(1) == carom.simulate(ball, first.time + 1e-6).signature()
    with pytest.raises(IndexError):
        events[len(events)]
    with pytest.raises(carom.InputError):
        motion.state_before(99, "ball")
    with pytest.raises(carom.InputError, match="another motion"):
        motion.state_before(carom.simulate(ball).events[0], "ball")


def test_persistent_contacts_and_overlaps():
    motion = carom.simulate(carom.Scene.read(SCENES / "die-at-rest.json"))
    assert motion.contacts and {contact.body for contact in motion.contacts} == {"die"}
    assert all(0 <= contact.from_ <= contact.to <= motion.end and contact.features for contact in motion.contacts)
    scene = carom.Scene({
        "carom": 1, "duration": 0.1,
        "bodies": [{"name": "a", "fixed": True, "shape": {"box": {"size": [1, 1, 1]}}},
                   {"name": "b", "mass": 1, "shape": {"sphere": {"radius": 0.5}}, "position": [0, 0, 0.9]}]})
    (overlap,) = carom.simulate(scene).overlaps
    assert (overlap.a, overlap.b) == ("a", "b") and abs(overlap.depth - 0.1) < 1e-12 and "overlap" in str(overlap)
    with pytest.raises(carom.InputError):
        carom.simulate(scene, refuse_overlaps=True)


def test_a_motion_that_ends_early_says_why(ball):
    motion = carom.simulate(ball, step_limit=3)
    assert motion.status == "step_limit" and motion.end < 2 and motion.message
    assert motion.message in repr(motion) and "step_limit" in repr(motion)
    assert carom.simulate(ball, impact_limit=2).status == "impact_limit"
    with pytest.raises(carom.InputError):
        motion.state_at("ball", 2)


def test_options(ball):
    bare = carom.simulate(ball, record_events=False)
    assert not bare.has_events and len(bare.events) == 0 and bare.impacts == carom.simulate(ball).impacts
    with pytest.raises(carom.InputError):
        bare.contacts
    assert carom.simulate(ball, lowest_bounce=0).lowest_bounce == 0
    assert carom.simulate(ball, duration=0.5).end == 0.5


@pytest.mark.parametrize("duration", [-1.0, math.nan, 1e10])
def test_bad_durations(ball, duration):
    with pytest.raises(carom.InputError):
        carom.simulate(ball, duration)


@pytest.mark.parametrize("times", [[-0.1], [2.1], [math.nan], [[0.1]], 0.5, "now", [1j], [None], [True], object()])
def test_bad_times(ball, times):
    with pytest.raises(carom.InputError):
        carom.simulate(ball).sample("ball", times)


def test_bad_bodies(ball):
    motion = carom.simulate(ball)
    for body in ("bal", -1, 2):
        with pytest.raises(carom.InputError):
            motion.state_at(body, 0.1)
    with pytest.raises(carom.InputError, match="ball"):
        motion.sample(["ball", "bal"], [0.1])
    with pytest.raises(TypeError):
        motion.state_at(None, 0.1)
    with pytest.raises(carom.InputError):
        motion.find_impact("ball", 0)


def test_a_motion_is_not_pickled(ball):
    with pytest.raises(TypeError, match="pickle its scene"):
        pickle.dumps(carom.simulate(ball))


def test_reprs(ball):
    motion = carom.simulate(ball)
    assert repr(motion) == f"<Motion 2.0 s, {motion.impacts} impacts, complete>"
    assert repr(motion.sample("ball", [0, 1])) == "<States of shape (2, 3)>"
    assert repr(motion.state_at("floor", 0)).startswith("<BodyState position=[0.0, 0.0, 0.0] orientation=[1.0,")
    assert repr(motion.events).endswith("events>") and repr(motion.events[0]).startswith("<Event 0: ")
    assert repr(motion.events[0].contacts[0]).startswith("<Contact of 'floor' and 'ball', ")


@pytest.mark.parametrize("ending", ["glb", "gltf", "py", "csv", "svg"])
def test_export(ball, tmp_path, ending):
    path = tmp_path / f"motion.{ending}"
    motion = carom.simulate(ball)
    motion.export(path, before=motion)
    assert path.stat().st_size > 500
    assert len(motion.text(ending, before=motion)) > 500
    assert motion._repr_svg_().startswith("<svg") or "<svg" in motion._repr_svg_()[:200]
    with pytest.raises(carom.InputError, match="motion.xyz"):
        motion.export(tmp_path / "motion.xyz")
