# SPDX-License-Identifier: MIT
"""Second derivatives of a motion, against differences of its gradients."""

import numpy as np
import pytest
from conftest import BALL

import carom

SEED = [carom.Seed("ball", 1.7, position=(1, 0, 2), velocity=(0, 1, 0.3))]


def moved(h):
    document = dict(BALL, bodies=[BALL["bodies"][0], dict(BALL["bodies"][1])])
    ball = document["bodies"][1]
    ball["velocity"] = (np.array(ball["velocity"]) + h * np.array([0.3, 0.2, 1.0])).tolist()
    ball["angular_velocity"] = (np.array(ball["angular_velocity"]) + h * np.array([1.0, -2.0, 0.5])).tolist()
    return carom.Scene(document)


def gradient_at(h):
    return carom.adjoint(carom.simulate(moved(h)), SEED)


def fields(gradient):
    return np.concatenate([gradient.velocity[1], gradient.angular_velocity[1], gradient.position[1], gradient.gravity,
                           gradient.elasticity, gradient.friction])


def direction(scene):
    return carom.SceneTangent(scene, velocity={"ball": (0.3, 0.2, 1.0)}, angular_velocity={"ball": (1.0, -2.0, 0.5)})


def test_against_differences(ball):
    motion = carom.simulate(ball)
    assert motion.impacts > 1 and carom.has_second_order(motion)
    second = carom.second_order(motion, SEED, [direction(ball)])
    assert fields(second.gradient).tolist() == fields(carom.adjoint(motion, SEED)).tolist()
    assert second.gradient.reliability.reliable

    def central(h):
        return (fields(gradient_at(h)) - fields(gradient_at(-h))) / (2 * h)

    expected = (4 * central(1e-3) - central(2e-3)) / 3
    wrong = ~(np.abs(fields(second.gradient_rates[0]) - expected) <= 1e-7 * np.abs(expected).max())
    assert not wrong.any(), (fields(second.gradient_rates[0]), expected)
    assert repr(second) == "<SecondOrder along 1 directions>"


def test_it_is_symmetric(ball):
    motion = carom.simulate(ball)
    a, b = direction(ball), carom.SceneTangent(ball, position={"ball": (1, 2, 3)}, elasticity={"rubber": 0.1})
    second = carom.second_order(motion, SEED, [a, b])
    ab, ba = second.gradient_rates[0].dot(b), second.gradient_rates[1].dot(a)
    assert abs(ab - ba) <= 1e-12 * abs(ab)


def test_weights_and_times_that_vary(ball):
    """Of 1/2 |v|^2 in free flight before the first impact: its second derivatives are known."""
    motion = carom.simulate(ball)
    velocity = motion.state_at("ball", 0.1).velocity
    seed = carom.Seed("ball", 0.1, velocity=velocity)
    along = carom.SceneTangent(ball, velocity={"ball": (1, 0, 2)})
    seen = []

    def rates(states):
        seen.append(states[0].velocity.tolist())
        return [carom.Seed("ball", 0.1, velocity=states[0].velocity)]

    second = carom.second_order(motion, seed, [along, carom.ReadingDirection(along, [0.5])], seed_rates=rates)
    gravity = np.array([0, 0, -9.81])
    assert np.allclose(seen, [[1, 0, 2], np.array([1, 0, 2]) + 0.5 * gravity], rtol=1e-14)
    assert np.allclose(second.gradient_rates[0].velocity[1], [1, 0, 2], rtol=1e-13, atol=1e-13)
    assert np.allclose(second.gradient_rates[1].velocity[1], np.array([1, 0, 2]) + 0.5 * gravity, rtol=1e-13, atol=1e-13)
    assert np.allclose(second.time_rates[0], [[1, 0, 2] @ gravity], rtol=1e-13)


def test_what_is_refused(ball):
    motion = carom.simulate(ball)
    along = direction(ball)
    for wrong in (lambda: carom.second_order(motion, carom.Seed("bal", 1), [along]),
                  lambda: carom.second_order(motion, SEED, [carom.ReadingDirection(along, [1, 2])]),
                  lambda: carom.second_order(motion, SEED, [carom.ReadingDirection(along, [float("nan")])]),
                  lambda: carom.ReadingDirection(along, [[1.0]])):
        with pytest.raises(carom.InputError):
            wrong()
    for wrong in (lambda rates: None, lambda rates: 3, lambda rates: [1]):
        with pytest.raises(TypeError):
            carom.second_order(motion, SEED, [along], seed_rates=wrong)
    with pytest.raises(TypeError):
        carom.second_order(motion, SEED, [along], seed_rates=3)
    with pytest.raises(ZeroDivisionError):
        carom.second_order(motion, SEED, [along], seed_rates=lambda rates: 1 / 0)
    with pytest.raises(RuntimeError, match="same motion"):
        carom.second_order(motion, SEED, [along], seed_rates=lambda rates: carom.adjoint(motion, SEED))
    other = carom.simulate(ball)  # another motion may be differentiated meanwhile, and this one afterwards

    def good(rates):
        carom.adjoint(other, SEED)
        return [carom.Seed("ball", 1.7)]

    assert carom.second_order(motion, SEED, [along], seed_rates=good).gradient_rates
    slides = carom.Scene({"carom": 1, "duration": 0.2, "materials": {"m": {"friction": 0.3}}, "bodies": [
        {"name": "floor", "fixed": True, "material": "m", "shape": {"plane": {"normal": [0, 0, 1], "offset": 0}}},
        {"name": "box", "mass": 1, "material": "m", "shape": {"box": {"size": [0.2, 0.2, 0.2]}},
         "position": [0, 0, 0.1], "velocity": [1, 0, 0]}]})
    motion = carom.simulate(slides)
    if not carom.has_second_order(motion):
        with pytest.raises(carom.NotComputable):
            carom.second_order(motion, carom.Seed("box", 0.1, position=(1, 0, 0)), [carom.SceneTangent(slides)])
