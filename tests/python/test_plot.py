# SPDX-License-Identifier: MIT
"""carom.plot draws what the motion has."""

import numpy as np
import pytest
from conftest import SCENES

import carom

matplotlib = pytest.importorskip("matplotlib", reason="left out: matplotlib is not installed; scripts/setup frameworks")
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

import carom.plot  # noqa: E402


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


def test_paths(ball):
    motion = carom.simulate(ball)
    axes = carom.plot.paths(motion, "xz")
    path, impacts = axes.get_lines()
    assert path.get_label() == "ball"  # the floor does not move
    x, z = path.get_data()
    for event in motion.events:
        place = motion.state_at("ball", event.time).position
        assert ((x == place[0]) & (z == place[2])).any()
    assert len(impacts.get_xdata()) == motion.impacts == 3
    assert carom.plot.paths(motion, "yx", bodies=["floor"], before=motion, ax=axes) is axes
    assert axes.get_xlabel() == "y (m)" and axes.get_lines()[-1].get_linestyle() == "--"


def test_histories_jump_at_impacts(ball):
    motion = carom.simulate(ball)
    line, = carom.plot.histories(motion, "velocity", "z").get_lines()
    times, values = line.get_data()
    assert (np.diff(times) >= 0).all()
    for event in motion.events:
        at = times == event.time
        expected = [motion.state_before(event, "ball").velocity[2], motion.state_after(event, "ball").velocity[2]]
        assert values[at].tolist() == expected
    before = carom.simulate(ball, 1.0)
    lines = carom.plot.histories(motion, before=before).get_lines()
    assert [one.get_linestyle() for one in lines] == ["-", "--"] and lines[1].get_xdata()[-1] == 1.0


def test_what_is_wrong_is_said(ball):
    motion = carom.simulate(ball)
    for arguments, where in [({"plane": "xx"}, "plane"), ({"plane": "xw"}, "plane"), ({"bodies": ["egg"]}, "bodies"),
                             ({"samples": 1}, "samples")]:
        with pytest.raises(carom.InputError) as error:
            carom.plot.paths(motion, **arguments)
        assert error.value.where == where
    for arguments, where in [({"quantity": "colour"}, "quantity"), ({"component": "w"}, "component")]:
        with pytest.raises(carom.InputError) as error:
            carom.plot.histories(motion, **arguments)
        assert error.value.where == where


def test_a_rest_is_drawn():
    scene = carom.Scene.read(SCENES / "curling.json")
    assert [line.get_label() for line in carom.plot.histories(carom.simulate(scene)).get_lines()] == ["stone"]
