# SPDX-License-Identifier: MIT
"""carom.jax: gradients are those of the command, and of differences, in both modes, through impacts and rest."""

import gc
import json
import os
import subprocess
import sys
import weakref
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from conftest import BALL, ROOT, SCENES

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


@pytest.fixture(params=["direct", "callback"], autouse=True)
def way(request, monkeypatch):
    """Both ways by which programs of JAX compute rows."""
    if request.param == "callback":
        monkeypatch.setattr(carom.jax, "direct", lambda: False)
    elif not carom.jax.direct():
        assert "CAROM_REQUIRE_PYTHON" not in os.environ
        pytest.skip("left out: built without XLA's headers; scripts/setup frameworks, then build again")
    return request.param


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
        jacobian = np.asarray(jax.jit(mode(function))(evaluator.start))[:len(expected)]
        assert jacobian.shape == expected.shape
        for mine, its in zip(jacobian.ravel(), expected.ravel(), strict=True):
            assert not abs(mine - its) > 1e-12 * max(1, abs(its)), (mine, its)


@pytest.mark.parametrize("name", IMPACTS_AND_REST)
def test_rows_agree_with_differences_in_both_modes(name):
    evaluator = evaluator_of(name)
    function = jax.jit(carom.jax.rows(evaluator))
    check_grads(function, (evaluator.start,), order=1, modes=["fwd", "rev"], atol=1e-6, rtol=1e-6, eps=1e-6)


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
    assert jax.jit(function)(jnp.ones(3)) == 1
    assert (jax.vmap(function)(jnp.ones((8, 3))) == 1).all()


def test_a_row_of_ones_own_may_raise(ball):
    def wrong(motion):
        raise KeyError("no such thing")

    edit = carom.Edit(ball)
    edit.vary(carom.velocity("ball"))
    edit.require("wrong", wrong, 1, until=1.0)
    function = carom.jax.rows(edit.evaluator(), threads=2)
    with pytest.raises(KeyError, match="no such thing"):
        function(jnp.ones(3))
    with pytest.raises(Exception, match="KeyError: 'no such thing'"):
        jax.block_until_ready(jax.jit(function)(jnp.ones(3)))
    with pytest.raises(Exception, match="KeyError: 'no such thing'"):
        jax.block_until_ready(jax.jit(jax.vmap(function))(jnp.ones((5, 3))))


def test_programs_keep_what_they_compute(ball):
    """A compiled program outlives its function and its evaluator, and lets go of them in the end."""
    def height(motion):
        return carom.Reading(motion.state_at("ball", 0.3).position[2], [carom.Seed("ball", 0.3, position=(0, 0, 1))])

    def programs():
        edit = carom.Edit(ball)
        edit.vary(carom.velocity("ball"))
        edit.require("height", height, 1, until=0.3)
        evaluator = edit.evaluator()
        function = carom.jax.rows(evaluator)
        lowered = jax.jit(carom.jax.rows(evaluator)).lower(jnp.ones(3))  # of a function that is gone when it is compiled
        return jax.jit(function).lower(jnp.ones(3)).compile(), lowered.compile(), evaluator.at(np.ones(3)).values

    first, second, expected = programs()
    gc.collect()
    assert np.array_equal(first(jnp.ones(3)), expected)
    assert np.array_equal(second(jnp.ones(3)), expected)
    kept = weakref.ref(height)
    del first, second, height, programs
    jax.clear_caches()
    for _ in range(3):
        gc.collect()
    assert kept() is None


def test_an_evaluator_that_is_gone_is_named(evaluator, way):
    if way == "callback":
        pytest.skip("the callback keeps it")
    edit = carom.Edit(carom.Scene(BALL))
    edit.vary(carom.velocity("ball"))
    edit.nail("ball", 1.0).position(3, 0, None)
    lowered = jax.jit(carom.jax.rows(edit.evaluator())).lower(jnp.ones(3))
    jax.clear_caches()
    gc.collect()
    with pytest.raises(Exception, match="the evaluator of carom.jax.rows is gone"):
        lowered.compile()(jnp.ones(3))


def test_programs_of_several_threads(evaluator):
    program = jax.jit(jax.vmap(carom.jax.rows(evaluator, threads=2)))
    xs = evaluator.start + 0.01 * np.random.default_rng(1).standard_normal((8, 16, 4))
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(lambda x: np.asarray(program(x)), xs))
    for x, rows in zip(xs, found, strict=True):
        assert np.array_equal(rows, evaluator.rows_at(x)[0])


def test_keyboard_interrupt(way):
    if way == "callback":
        pytest.skip("JAX makes it an error of its own")
    code = """
import os, signal, sys, threading, time
sys.path.insert(0, "tests/python")
import jax, numpy as np
jax.config.update("jax_enable_x64", True)
import carom, carom.jax
from test_interrupt import crowd_of
crowd = carom.Scene(crowd_of(3))
edit = carom.Edit(crowd)
edit.vary(carom.velocity(crowd.bodies[-1]))
edit.nail(crowd.bodies[-1], 5.0).position(0, None, None)
evaluator = edit.evaluator()
program = jax.jit(jax.vmap(carom.jax.rows(evaluator, threads=2)))
program(np.tile(evaluator.start, (2000, 1))[:1])
def press():
    time.sleep(0.5)
    global pressed
    pressed = time.perf_counter()
    os.kill(os.getpid(), signal.SIGINT)
threading.Thread(target=press).start()
try:
    for _ in range(1000):
        jax.block_until_ready(program(np.tile(evaluator.start, (2000, 1))))
except KeyboardInterrupt:
    print("interrupted after", time.perf_counter() - pressed)
"""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT)
    assert "interrupted after" in run.stdout, run.stderr


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
    with pytest.raises(carom.InputError, match="found values of the type complex128, expected real numbers"):
        function(jnp.zeros(4, complex))
    with pytest.raises(Exception, match="finite"):
        jax.block_until_ready(function(jnp.array([np.nan, 0, 0, 0.5])))
    with pytest.raises(ValueError, match="do not support JVP|cannot be differentiated"):
        jax.hessian(lambda x: function(x)[0])(evaluator.start)
    edit = carom.Edit(ball)
    edit.vary(carom.velocity("ball"))
    edit.nail("ball", carom.nth_impact(40)).position(3, 0, None)
    lacking = carom.jax.rows(edit.evaluator())
    with pytest.raises(carom.NotComputable, match="Impact 40 of 'ball' does not come within 2 s"):
        lacking(jnp.array([2.0, 0, 1]))
    for program, x in ((jax.jit(lacking), jnp.ones(3)), (jax.vmap(lacking), jnp.ones((2, 3))),
                       (jax.jit(jax.grad(lambda x: lacking(x)[0])), jnp.ones(3))):
        with pytest.raises(Exception, match="Impact 40 of 'ball' does not come within 2 s"):
            jax.block_until_ready(program(x))
    with pytest.raises(carom.InputError, match="threads"):
        carom.jax.rows(evaluator, threads=0)
    with pytest.raises(carom.InputError, match="bodies"):
        carom.jax.states(ball, [carom.velocity("ball")], [], [1.0])
    with pytest.raises(carom.InputError, match="times"):
        carom.jax.states(ball, [carom.velocity("ball")], ["ball"], [])


def test_states_of_a_motion_that_ends_early():
    plate = {"material": "wax", "mass": 1, "shape": {"box": {"size": [1, 1, 0.1]}}, "velocity": [1, 0, 0]}
    pile = [plate | {"name": f"plate {k}", "position": [0, 0, 0.05 + 0.1 * k]} for k in range(8)]
    rider = {"name": "rider", "material": "wax", "mass": 1, "shape": {"sphere": {"radius": 0.5}}, "position": [0.1, 0, 2.3]}
    on_a_moving_one = carom.Scene(BALL | {  # more bodies than move on each other
        "materials": {"wax": {"elasticity": 0, "friction": 0}}, "bodies": [BALL["bodies"][0] | {"material": "wax"}, *pile, rider]})
    motion = carom.simulate(on_a_moving_one)
    assert motion.status == "unresolved_contact", motion
    function = carom.jax.states(on_a_moving_one, [carom.velocity("rider")], ["rider"], [0.0, 2.0])
    with pytest.raises(Exception, match="The motion ends at 0.4515"):
        jax.block_until_ready(function(jnp.array([0.0, 0, 0])))


@pytest.mark.parametrize("name", ["jax", "torch", "plot"])
def test_a_missing_framework_is_named(name):
    needs = "matplotlib" if name == "plot" else name
    code = f"import sys; sys.modules[{needs!r}] = None\nimport carom\nimport carom.{name}"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert f"ImportError: carom.{name} needs {needs}, which is not installed: pip install {needs}" in run.stderr
