# SPDX-License-Identifier: MIT
"""carom.jax: gradients are those of the command, and of differences, in both modes, through impacts and rest."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest
from conftest import BALL, SCENES

import carom

jax = pytest.importorskip("jax", reason="left out: JAX is not installed; scripts/setup frameworks")
import jax.numpy as jnp  # noqa: E402
from jax.test_util import check_grads  # noqa: E402

import carom.jax  # noqa: E402

IMPACTS_AND_REST = ["bounce", "book-on-shelf", "mug-on-mark", "curling", "die-at-rest"]


@pytest.fixture(autouse=True)
def double_precision():
    before = jax.config.jax_enable_x64
    jax.config.update("jax_enable_x64", True)
    yield
    jax.config.update("jax_enable_x64", before)


@pytest.fixture
def evaluator(ball):
    edit = carom.Edit(ball)
    edit.vary(carom.velocity("ball"), carom.elasticity("rubber"))
    edit.nail("ball", 2.0).position(3, 0, None)
    return edit.evaluator()


def evaluator_of(name):
    return carom.Edit.of(carom.Scene.read(SCENES / f"{name}.json")).evaluator()


@pytest.mark.parametrize("name", IMPACTS_AND_REST)
def test_the_jacobian_is_that_of_the_command(name):
    command = os.environ.get("CAROM_COMMAND")
    if not command:
        pytest.skip("the command is not built")
    run = subprocess.run([command, "gradient", SCENES / f"{name}.json", "--json"], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    expected = np.array(json.loads(run.stdout)["jacobian"])
    evaluator = evaluator_of(name)
    function = carom.jax.rows(evaluator)
    for mode in (jax.jacfwd, jax.jacrev):
        jacobian = np.asarray(mode(function)(evaluator.start))[:len(expected)]
        assert jacobian.shape == expected.shape
        for mine, its in zip(jacobian.ravel(), expected.ravel(), strict=True):
            assert not abs(mine - its) > 1e-12 * max(1, abs(its)), (mine, its)


@pytest.mark.parametrize("name", IMPACTS_AND_REST)
def test_rows_agree_with_differences_in_both_modes(name):
    evaluator = evaluator_of(name)
    check_grads(carom.jax.rows(evaluator), (evaluator.start,), order=1, modes=["fwd", "rev"], atol=1e-6, rtol=1e-6, eps=1e-6)


def states_of(name, controls, body, until):
    scene = carom.Scene.read(SCENES / f"{name}.json")
    edit = carom.Edit(scene)
    edit.vary(*controls)
    edit.nail(body, until).position(0, None, None)
    return carom.jax.states(scene, controls, [body], np.linspace(0.1, until, 7)), edit.evaluator().start


@pytest.mark.parametrize(("name", "body", "until"), [("bounce", "ball", 0.6), ("mug-on-mark", "mug", 1.5)])
def test_states_agree_with_differences(name, body, until):
    controls = [carom.velocity(body), carom.angular_velocity(body)]
    function, start = states_of(name, controls, body, until)
    start = start + 0.01  # spins about all axes
    check_grads(function, (start,), order=1, modes=["rev"], atol=1e-6, rtol=1e-6, eps=1e-6)
    with pytest.raises(TypeError, match="custom_vjp"):
        jax.jvp(function, (start,), (start,))


def test_states_are_those_of_the_motion(ball):
    times = np.linspace(0, 2, 9)
    states = carom.jax.states(ball, [carom.velocity("ball")], ["floor", "ball"], times)(jnp.array([2.0, 0, 1]))
    sampled = carom.simulate(ball).sample(["floor", "ball"], times)
    for name in ("position", "orientation", "velocity", "angular_velocity"):
        assert np.array_equal(getattr(states, name), getattr(sampled, name)), name


def test_batches(evaluator):
    function = carom.jax.rows(evaluator, threads=2)
    xs = evaluator.start + 0.01 * np.random.default_rng(1).standard_normal((17, 4))
    together = jax.jit(jax.vmap(jax.value_and_grad(lambda x: function(x)[0])))(xs)
    for x, value, gradient in zip(xs, *together, strict=True):
        point = evaluator.at(x)
        assert float(value) == point.values[0]
        assert np.array_equal(gradient, point.jacobian().entries[0])
    nested = jax.vmap(jax.vmap(function))(xs[:6].reshape(2, 3, 4))
    assert np.array_equal(nested.reshape(6, 2), jax.vmap(function)(xs[:6]))


def test_denormal_numbers_are_computed_with(ball):
    """JAX flushes them to zero where it calls back."""
    def smallest(motion):
        return carom.Reading(float(least * one > 0), [carom.Seed("ball", 1.0)])

    least, one = np.float64(5e-324), np.float64(1)
    edit = carom.Edit(ball)
    edit.vary(carom.velocity("ball"))
    edit.require("smallest", smallest, 1, until=1.0)
    function = carom.jax.rows(edit.evaluator(), threads=2)
    assert function(jnp.ones(3)) == 1
    assert (jax.vmap(function)(jnp.ones((8, 3))) == 1).all()


def test_reduced_precision_is_told_once(evaluator):
    jax.config.update("jax_enable_x64", False)
    carom.jax._warned = False
    function = carom.jax.rows(evaluator)
    with pytest.warns(UserWarning, match="jax_enable_x64"):
        value, gradient = jax.value_and_grad(lambda x: function(x)[0])(jnp.asarray(evaluator.start))
    assert value.dtype == gradient.dtype == jnp.float32
    point = evaluator.at(evaluator.start.astype(np.float32))
    assert value == np.float32(point.values[0])
    assert np.array_equal(gradient, point.jacobian().entries[0].astype(np.float32))


def test_what_is_wrong_is_said(ball, evaluator):
    function = carom.jax.rows(evaluator)
    with pytest.raises(carom.InputError, match=r"found the shape \(3,\), expected \(4,\)"):
        function(jnp.zeros(3))
    with pytest.raises(Exception, match="finite"):
        jax.block_until_ready(function(jnp.array([np.nan, 0, 0, 0.5])))
    with pytest.raises(ValueError, match="do not support JVP"):
        jax.hessian(lambda x: function(x)[0])(evaluator.start)
    edit = carom.Edit(ball)
    edit.vary(carom.velocity("ball"))
    edit.nail("ball", carom.nth_impact(40)).position(3, 0, None)
    with pytest.raises(Exception, match="Impact 40 of 'ball' does not come within 2 s"):
        jax.block_until_ready(carom.jax.rows(edit.evaluator())(jnp.array([2.0, 0, 1])))
    with pytest.raises(carom.InputError, match="threads"):
        carom.jax.rows(evaluator, threads=0)
    with pytest.raises(carom.InputError, match="bodies"):
        carom.jax.states(ball, [carom.velocity("ball")], [], [1.0])
    with pytest.raises(carom.InputError, match="times"):
        carom.jax.states(ball, [carom.velocity("ball")], ["ball"], [])


def test_states_of_a_motion_that_ends_early():
    box = {"material": "wax", "mass": 1, "shape": {"box": {"size": [1, 1, 1]}}}
    on_a_moving_one = carom.Scene(BALL | {
        "materials": {"wax": {"elasticity": 0, "friction": 0}},
        "bodies": [BALL["bodies"][0] | {"material": "wax"}, box | {"name": "sled", "position": [0, 0, 0.5], "velocity": [1, 0, 0]},
                   box | {"name": "rider", "position": [0.5, 0, 2]}]})
    motion = carom.simulate(on_a_moving_one)
    assert motion.status == "unresolved_contact", motion
    function = carom.jax.states(on_a_moving_one, [carom.velocity("rider")], ["rider"], [0.0, 2.0])
    with pytest.raises(Exception, match="would move|moving|moves"):
        jax.block_until_ready(function(jnp.array([0.0, 0, 0])))


@pytest.mark.parametrize("name", ["jax", "torch", "plot"])
def test_a_missing_framework_is_named(name):
    needs = "matplotlib" if name == "plot" else name
    code = f"import sys; sys.modules[{needs!r}] = None\nimport carom\nimport carom.{name}"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert f"ImportError: carom.{name} needs {needs}, which is not installed: pip install {needs}" in run.stderr
