# SPDX-License-Identifier: MIT
"""Whatever the calling thread does with denormal numbers, results have the same bits: JAX, and programs that were linked with
-ffast-math, flush them to zero."""

import ctypes
import platform
import sys
import threading

import numpy as np
import pytest
from conftest import BALL, ROOT, SCENES

import carom

TINY = 1e-310  # denormal: the smallest normal number is 2.2e-308
FLUSH = 0x8040  # of MXCSR: results to zero, and operands
MXCSR = 28  # bytes into fenv_t of glibc


def flushing(work):
    """What work() gives in a thread that flushes denormal numbers to zero, which it still does afterwards."""
    libm = ctypes.CDLL("libm.so.6")
    result = []

    def run():
        environment = ctypes.create_string_buffer(64)
        libm.fegetenv(environment)
        control = ctypes.c_uint32.from_buffer(environment, MXCSR)
        control.value |= FLUSH
        libm.fesetenv(environment)
        flushes = np.full(1, TINY) * np.ones(1)
        try:
            result.append(work())
        except BaseException as error:
            result.append(error)
        libm.fegetenv(environment)
        result.extend([flushes[0] == 0, control.value & FLUSH == FLUSH])

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    value, flushed, flushes = result
    assert flushed, "this thread was to flush"
    assert flushes, "the call left the thread with another arithmetic"
    if isinstance(value, BaseException):
        raise value
    return value


pytestmark = pytest.mark.skipif(sys.platform != "linux" or platform.machine() != "x86_64", reason="MXCSR of x86-64, fenv_t of glibc")


@pytest.fixture
def crawling():
    """The ball in a world of its own, as slow to the side as denormal numbers are."""
    document = BALL | {"bodies": [BALL["bodies"][0], BALL["bodies"][1] | {"velocity": [TINY, 0, 1], "angular_velocity": [0, 0, 0]}]}
    return carom.Scene(document)


def edit_of(scene):
    edit = carom.Edit(scene)
    edit.vary(carom.velocity("ball"))
    edit.nail("ball", 0.4).position(None, None, 1.1)
    return edit


def gradient_of(scene):
    motion = carom.simulate(scene)
    return carom.adjoint(motion, carom.Seed("ball", 0.3, position=(TINY, 0, 0)))


def tangent_of(scene):
    motion = carom.simulate(scene)
    return carom.tangent(motion, carom.SceneTangent(scene, velocity={"ball": (TINY, 0, 0)}))


def session_of(scene):
    session = carom.EditSession(scene)
    session.set_controls([carom.velocity("ball")])
    session.grab("ball", 0.3)
    session.drag_to((0.1, 0, 1.2))
    return session


def second_of(scene):
    motion = carom.simulate(scene)
    direction = carom.SceneTangent(scene, velocity={"ball": (1, 0, 0)})
    return carom.second_order(motion, carom.Seed("ball", 0.3, position=(TINY, 0, 0)), [direction])


# What is computed in full, and then, in a thread that flushes, by the call alone.
CALLS = {
    # From a text: Python itself reads numbers of a dict by arithmetic.
    "Scene": lambda scene: (lambda text: lambda: carom.simulate(carom.Scene(text)).state_at("ball", 0.3).position)(scene.to_text()),
    "simulate": lambda scene: lambda: carom.simulate(scene).state_at("ball", 2.0).position,
    "state_at": lambda scene: (lambda motion: lambda: motion.state_at("ball", 0.3).position)(carom.simulate(scene)),
    "sample": lambda scene: (lambda motion: lambda: motion.sample("ball", np.linspace(0, 2, 21)).position)(carom.simulate(scene)),
    "adjoint": lambda scene: lambda: gradient_of(scene).velocity,
    "adjoint.dot": lambda scene: (lambda gradient, along: lambda: gradient.dot(along))(
        gradient_of(scene), carom.SceneTangent(scene, velocity={"ball": (1, 0, 0)})),
    "tangent": lambda scene: lambda: tangent_of(scene).at("ball", 0.3).position,
    "tangent.at": lambda scene: (lambda tangent: lambda: tangent.at("ball", 0.3).position)(tangent_of(scene)),
    "rate.dot": lambda scene: (lambda rate: lambda: rate.dot(carom.Seed("ball", 0.3, position=(1, 0, 0))))(
        tangent_of(scene).at("ball", 0.3)),
    "second_order": lambda scene: lambda: second_of(scene).gradient.velocity,
    "NlpEvaluator.at": lambda scene: (lambda evaluator: lambda: evaluator.at([TINY, 0, 1]).motion.state_at("ball", 0.3).position)(
        edit_of(scene).evaluator()),
    "NlpPoint.hessian": lambda scene: (lambda point: lambda: point.hessian(TINY, [0]))(edit_of(scene).evaluator().at([0, 0, 1])),
    "NlpEvaluator.rows_at": lambda scene: (lambda evaluator: lambda: evaluator.rows_at([[TINY, 0, 1]], jacobian=True)[1])(
        edit_of(scene).evaluator()),
    "Edit.solve": lambda scene: lambda: edit_of(scene).solve(effort="fast").motion.state_at("ball", 0.3).position,
    "Motion.text": lambda scene: (lambda motion: lambda: np.frombuffer(motion.text("csv"), np.uint8))(carom.simulate(scene)),
    "EditSession": lambda scene: lambda: session_of(scene).motion.state_at("ball", 0.3).position,
}
WITHOUT_TINY = {"NlpEvaluator.rows_at", "EditSession", "Motion.text"}  # no denormal number is among the results


@pytest.mark.parametrize("name", CALLS)
def test_a_thread_that_flushes_gets_the_same_bits(name, crawling):
    call = CALLS[name](crawling)
    expected = np.asarray(call())
    assert np.isfinite(expected).all()
    if name not in WITHOUT_TINY:
        assert ((expected != 0) & (abs(expected) < 2.3e-308)).any(), expected
    assert np.asarray(flushing(call)).tobytes() == expected.tobytes()


@pytest.mark.parametrize("name", ["bounce", "book-on-shelf", "mug-on-mark", "die-at-rest"])
def test_scenes_and_their_gradients(name):
    scene = carom.Scene.read(SCENES / f"{name}.json")
    moving = scene.bodies[-1]

    def numbers():
        motion = carom.simulate(scene)
        path = motion.sample(scene.bodies, np.linspace(0, motion.end, 50))
        gradient = carom.adjoint(motion, carom.Seed(moving, motion.end, position=(1, 2, 3)))
        return np.concatenate([path.position.ravel(), path.orientation.ravel(), gradient.velocity.ravel(), gradient.inertia.ravel()])

    assert flushing(numbers).tobytes() == numbers().tobytes()


def test_it_is_one_place_that_gives_the_gil_away():
    for path in sorted((ROOT / "python" / "src").glob("*.?pp")):
        if path.name != "computing.hpp":
            assert "gil_scoped_release" not in path.read_text(), f"{path.name}: use Computing of computing.hpp"
