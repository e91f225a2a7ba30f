# SPDX-License-Identifier: MIT
"""Gradients and tangents: against each other, against closed forms, with the bodies in reverse order."""

import copy
import gc
import threading

import numpy as np
import pytest
from conftest import BALL, SCENES

import carom

VECTORS = ("position", "orientation", "velocity", "angular_velocity")
SURFACES = ("surface_velocity", "surface_angular_velocity")
FIELDS = (*VECTORS, *SURFACES, "inertia", "mass", "density", "elasticity", "friction", "tangential_elasticity", "gravity", "tilts")

# A box that tumbles over a floor: every parameter matters.
BOX = copy.deepcopy(BALL)
BOX["duration"] = 0.8
BOX["bodies"][1] = {
    "name": "box", "material": "rubber", "mass": 0.3, "shape": {"box": {"size": [0.2, 0.15, 0.1]}},
    "position": [0, 0, 0.6], "orientation": [0.9, 0.3, 0.2, 0.244948974278317808], "velocity": [1, 0.2, 0.3],
    "angular_velocity": [3, 5, -2]}

# The same on a belt that turns.
BELT = copy.deepcopy(BOX)
BELT["bodies"][0].update(surface_velocity=[1.2, -0.4, 0], surface_angular_velocity=[0.1, 0, 0.8])


def random_direction(scene, random):
    moving = [name for name in scene.bodies if name != "floor"]
    return carom.SceneTangent(
        scene,
        **{name: {body: random.standard_normal(3) for body in moving} for name in VECTORS},
        **{name: {"floor": random.standard_normal(3)} for name in SURFACES},
        mass={body: random.standard_normal() for body in moving},
        elasticity={"rubber": random.standard_normal()},
        friction={"rubber": random.standard_normal()},
        gravity=random.standard_normal(3),
    )


def random_seed(body, instant, random):
    weights = {name: random.standard_normal(3) for name in (*VECTORS, "center_of_mass")}
    return carom.Seed(body, **instant, **weights, time=random.standard_normal(), mass=random.standard_normal())


def products(gradient, direction):
    """Of all fields, entry by entry: their sum is gradient.dot(direction)."""
    of_fields = [(getattr(gradient, name) * getattr(direction, name)).ravel() for name in FIELDS]
    return np.concatenate(of_fields + [a * b for a, b in zip(gradient.size, direction.size, strict=True)])


def close(a, b, tolerance):
    return abs(a - b) <= tolerance * max(1, abs(a), abs(b))  # False for NaN


@pytest.mark.parametrize("document", [BALL, BOX, BELT], ids=["ball", "box", "belt"])
def test_tangent_and_adjoint_agree(document):
    scene = carom.Scene(document)
    motion = carom.simulate(scene)
    body = scene.bodies[1]
    random = np.random.default_rng(5)
    instants = [{"at": 0.1}, {"at": motion.end}, {"before": motion.events[1]}, {"after": 1}]
    for instant in instants:
        seed = random_seed(body, instant, random)
        gradient = carom.adjoint(motion, seed)
        assert gradient.reliability.reliable and gradient.reliability.unreliable_for == []
        for _ in range(5):
            direction = random_direction(scene, random)
            at = {("t" if key == "at" else key): value for key, value in instant.items()}
            forward = carom.tangent(motion, direction).at(body, **at).dot(seed)
            error = abs(gradient.dot(direction) - forward)
            assert error <= 1e-13 * sum(abs(products(gradient, direction))), instant


def test_the_sum_of_fields_is_the_dot_product():
    scene = carom.Scene(BOX)
    random = np.random.default_rng(7)
    gradient = carom.adjoint(carom.simulate(scene), [random_seed("box", {"at": 0.7}, random)])
    direction = random_direction(scene, random)
    total = products(gradient, direction).sum()
    assert close(total, gradient.dot(direction), 1e-14)


def test_a_bounce_by_closed_form(ball):
    """Height after one bounce of a ball on a plane, by hand."""
    motion = carom.simulate(ball)
    t = motion.events[0].time + 0.05
    (ht, vt), (e, g, r) = (1.0, 1.0), (0.8, 9.81, 0.03)
    ti = (vt + np.sqrt(vt**2 + 2 * g * (ht - r))) / g
    vi = vt - g * ti  # just before the impact, < 0
    # z(t) = r - e vi (t - ti) - g (t - ti)^2 / 2; dti/dh = -1 / vi, dvi/dh = g / vi, dti/dv = -ti / vi, dvi/dv = 1 + g ti / vi
    slope = -e * vi - g * (t - ti)
    by_h = slope / vi - e * (g / vi) * (t - ti)
    by_v = slope * ti / vi - e * (1 + g * ti / vi) * (t - ti)
    gradient = carom.adjoint(motion, carom.Seed("ball", t, position=(0, 0, 1)))
    assert close(gradient.position[1, 2], by_h, 1e-13)
    assert close(gradient.velocity[1, 2], by_v, 1e-13)
    assert close(gradient.elasticity[0], -vi * (t - ti), 1e-13)
    assert gradient.position.shape == (2, 3) and gradient.elasticity.shape == (1,) and gradient.tilts.shape == (0, 2)
    assert gradient.size[1].shape == (1,)
    time = carom.adjoint(motion, carom.Seed("ball", before=0, time=1))
    assert close(time.position[1, 2], -1 / vi, 1e-13)
    direction = carom.SceneTangent(ball, position={"ball": (0, 0, 1)})
    assert close(carom.tangent(motion, direction).event_time(0), -1 / vi, 1e-13)


def test_a_belt_by_closed_form(ball):
    """What falls without spin on a belt and sticks gets 2/7 of the belt's velocity."""
    document = copy.deepcopy(BALL)
    document["bodies"][0]["surface_velocity"] = [1.5, 0, 0]
    document["materials"]["rubber"]["friction"] = 5
    document["bodies"][1].update(velocity=[0, 0, 1], angular_velocity=[0, 0, 0])
    scene = carom.Scene(document)
    assert scene.to_dict()["bodies"][0]["surface_velocity"] == [1.5, 0, 0]
    motion = carom.simulate(scene)
    first = motion.events[0]
    assert first.mode == "stick" and np.allclose(abs(first.contacts[0].surface_velocity), [1.5, 0, 0], rtol=0, atol=1e-15)
    t = first.time + 0.05
    assert close(motion.state_at("ball", t).velocity[0], 2 / 7 * 1.5, 1e-13)
    gradient = carom.adjoint(motion, carom.Seed("ball", t, velocity=(1, 0, 0)))
    assert np.allclose(gradient.surface_velocity, [[2 / 7, 0, 0], [0, 0, 0]], rtol=0, atol=1e-13)
    edit = carom.Edit(scene, t)
    edit.vary(carom.surface_velocity("floor", components=["x"]))
    edit.nail("ball", t).velocity(0.9, None, None)
    result = edit.solve()
    assert result.solved and close(result.changed[0].after, 0.9 * 7 / 2, 1e-9)
    with pytest.raises(carom.InputError, match="impacts move body 'ball'"):
        edit = carom.Edit(scene, t)
        edit.vary(carom.surface_angular_velocity("ball"))
        edit.nail("ball", t).velocity(0.9, None, None)
        edit.solve()


def test_bodies_in_reverse_order():
    reverse = copy.deepcopy(BOX)
    reverse["bodies"].reverse()
    gradients = []
    for document in (BOX, reverse):
        scene = carom.Scene(document)
        motion = carom.simulate(scene)
        gradient = carom.adjoint(motion, carom.Seed("box", 0.75, position=(1, 2, 3), angular_velocity=(0.1, 0.2, 0.3)))
        gradients.append((gradient, scene.bodies.index("box")))
    (a, i), (b, j) = gradients
    for name in (*VECTORS, "inertia"):
        x, y = getattr(a, name)[i], getattr(b, name)[j]
        assert all(close(p, q, 1e-10) for p, q in zip(x, y, strict=True)), name
    assert close(a.friction[0], b.friction[0], 1e-10) and close(a.elasticity[0], b.elasticity[0], 1e-10)


def test_differentiating_changes_nothing(ball):
    motion = carom.simulate(ball)
    before = motion.sample("ball", np.linspace(0, 2, 50)).position.tobytes()
    carom.adjoint(motion, carom.Seed("ball", 1.9, position=(1, 1, 1)))
    assert motion.sample("ball", np.linspace(0, 2, 50)).position.tobytes() == before


def test_what_is_marked_is_shown():
    """A ball that does not slip where it is without friction: the derivative with respect to that is one-sided."""
    document = copy.deepcopy(BALL)
    document["materials"]["rubber"]["friction"] = 0
    document["bodies"][1].update(velocity=[0, 0, 1], angular_velocity=[0, 0, 0])
    motion = carom.simulate(carom.Scene(document))
    gradient = carom.adjoint(motion, carom.Seed("ball", 1.9, position=(1, 0, 0)))
    reliability = gradient.reliability
    assert reliability.unreliable_for == ["friction of 'rubber'"] and len(reliability.sentences) == 1
    assert "friction of 'rubber'" in repr(reliability) and "see reliability" in repr(gradient)
    assert reliability.events >= 1 and 0 < reliability.smallest_margin <= 1


def test_settling(ball):
    motion = carom.simulate(ball, 30)
    captures = [event for event in motion.events if event.kind == "capture"]
    (capture,) = captures
    gradient = carom.settles_at_gradient(motion, capture)
    direction = carom.SceneTangent(ball, elasticity={"rubber": 1.0}, velocity={"ball": (0, 0, 0.5)})
    assert close(gradient.dot(direction), carom.settles_at_rate(motion, direction, capture), 1e-13)
    # t = t1 + 2 e / (1 - e) |v1| / g, at the first bounce
    first = motion.state_before(0, "ball").velocity[2]
    assert close(capture.settles_at, motion.events[0].time + 2 * 0.8 / 0.2 * -first / 9.81, 1e-12)
    with pytest.raises(carom.InputError):
        carom.settles_at_gradient(motion, 0)


def test_results_outlive_their_motion(ball):
    tangent = carom.tangent(carom.simulate(ball), carom.SceneTangent(carom.Scene(BALL), gravity=(0, 0, 1)))
    gradient = carom.adjoint(carom.simulate(ball), carom.Seed("ball", 1.0, position=(0, 0, 1)))
    gc.collect()
    again = carom.tangent(carom.simulate(ball), carom.SceneTangent(ball, gravity=(0, 0, 1)))
    assert tangent.at("ball", 1.5).position.tolist() == again.at("ball", 1.5).position.tolist()
    gravity = gradient.gravity
    del gradient
    gc.collect()
    assert np.isfinite(gravity).all()
    with pytest.raises(ValueError, match="read-only"):
        gravity[0] = 1


def test_one_motion_in_many_threads():
    motion = carom.simulate(carom.Scene(BOX))
    times = np.linspace(0.05, 0.8, 40)
    expected = [carom.adjoint(carom.simulate(motion.scene), carom.Seed("box", t, position=(1, 1, 1))).velocity.tobytes()
                for t in times]
    wrong = []

    def work():
        for t, bits in zip(times, expected, strict=True):
            if carom.adjoint(motion, carom.Seed("box", t, position=(1, 1, 1))).velocity.tobytes() != bits:
                wrong.append(t)

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
        assert not thread.is_alive()
    assert not wrong


def test_bad_seeds_and_directions(ball):
    motion = carom.simulate(ball)
    for wrong in ({}, {"at": 0.1, "before": 0}, {"at": 0.1, "position": (1, 2)}, {"at": 0.1, "position": "x"},
                  {"at": 0.1, "inertia": np.zeros((2, 3))}):
        with pytest.raises(carom.InputError):
            carom.Seed("ball", **wrong)
    for wrong in ({"at": -1}, {"at": 3}, {"before": 99}, {"after": -1}, {"at": 0.1, "position": (np.nan, 0, 0)}):
        with pytest.raises(carom.InputError):
            carom.adjoint(motion, carom.Seed("ball", **wrong))
    with pytest.raises(carom.InputError, match="bal"):
        carom.adjoint(motion, carom.Seed("bal", 0.1))
    with pytest.raises(carom.InputError, match="another motion"):
        carom.adjoint(motion, carom.Seed("ball", before=carom.simulate(ball).events[0]))
    with pytest.raises(carom.InputError):
        carom.SceneTangent(ball, velocity={"bal": (0, 0, 0)})
    with pytest.raises(carom.InputError):
        carom.SceneTangent(ball, velocity={"ball": (0, 0)})
    with pytest.raises(carom.InputError):
        carom.SceneTangent(ball, size={"ball": (0, 0)})
    other = carom.SceneTangent(carom.Scene.read(SCENES / "rack-of-fifteen.json"), gravity=(0, 0, 1))
    with pytest.raises(carom.InputError):
        carom.tangent(motion, other)
    with pytest.raises(carom.InputError):
        carom.adjoint(motion, carom.Seed("ball", 0.1)).dot(other)
    with pytest.raises(carom.InputError):
        carom.tangent(motion, carom.SceneTangent(ball, gravity=(0, 0, np.nan)))
    with pytest.raises(carom.InputError):
        carom.adjoint(carom.simulate(ball, record_events=False), carom.Seed("ball", 0.1))
    assert repr(carom.Seed("ball", before=2)) == "<Seed of 'ball' before event 2>"
