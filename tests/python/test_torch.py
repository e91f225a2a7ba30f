# SPDX-License-Identifier: MIT
"""carom.torch: gradients are those of the library, and of differences, through impacts and rest."""

import numpy as np
import pytest
from conftest import SCENES, torch_or_skip

import carom

torch = torch_or_skip()

import carom.torch  # noqa: E402


def evaluator_of(name):
    return carom.Edit.of(carom.Scene.read(SCENES / f"{name}.json")).evaluator()


@pytest.mark.parametrize("name", ["bounce", "book-on-shelf", "mug-on-mark", "curling", "die-at-rest"])
def test_rows(name):
    evaluator = evaluator_of(name)
    function = carom.torch.rows(evaluator)
    x = torch.tensor(evaluator.start, requires_grad=True)
    jacobian = torch.autograd.functional.jacobian(function, x).numpy()
    assert np.array_equal(jacobian, evaluator.at(evaluator.start).jacobian().entries)
    assert torch.autograd.gradcheck(function, (x,), eps=1e-6, atol=1e-6, rtol=1e-6)
    assert not function(x.detach()).requires_grad


@pytest.mark.parametrize(("name", "body", "until"), [("bounce", "ball", 0.6), ("curling", "stone", 20.0)])
def test_states(name, body, until):
    scene = carom.Scene.read(SCENES / f"{name}.json")
    controls = [carom.velocity(body, components=["x", "y"])]
    edit = carom.Edit(scene)
    edit.vary(*controls)
    edit.nail(body, until).position(0, None, None)
    times = np.linspace(0.1, until, 5)
    function = carom.torch.states(scene, controls, [body], times)
    x = torch.tensor(edit.evaluator().start, requires_grad=True)
    assert torch.autograd.gradcheck(function, (x,), eps=1e-6, atol=1e-6, rtol=1e-6)
    assert function(x).orientation.shape == (1, 5, 4)


def test_batches_and_precision(ball):
    edit = carom.Edit(ball)
    edit.vary(carom.velocity("ball"))
    edit.nail("ball", 2.0).position(3, 0, None)
    evaluator = edit.evaluator()
    function = carom.torch.rows(evaluator, threads=2)
    xs = np.asarray(evaluator.start + 0.01 * np.random.default_rng(1).standard_normal((2, 5, 3)), np.float32)
    x = torch.tensor(xs, requires_grad=True)
    rows = function(x)
    rows[..., 0].sum().backward()
    assert rows.shape == (2, 5, 2) and rows.dtype == x.grad.dtype == torch.float32
    for i in np.ndindex(2, 5):
        point = evaluator.at(xs[i])
        assert np.array_equal(rows[i].detach(), point.values.astype(np.float32))
        assert np.array_equal(x.grad[i], point.jacobian().entries[0].astype(np.float32))


def test_what_is_wrong_is_said(ball):
    edit = carom.Edit(ball)
    edit.vary(carom.velocity("ball"))
    edit.nail("ball", carom.nth_impact(40)).position(3, 0, None)
    function = carom.torch.rows(edit.evaluator())
    with pytest.raises(carom.NotComputable, match="Impact 40 of 'ball' does not come within 2 s"):
        function(torch.tensor([2.0, 0, 1]))
    with pytest.raises(carom.InputError, match=r"found the shape \(2,\), expected \(..., 3\)"):
        function(torch.zeros(2))
    for wrong in (torch.tensor([2, 0, 1]), torch.zeros(3, dtype=torch.complex128)):  # values would be rounded to whole ones
        with pytest.raises(carom.InputError, match="expected floating-point numbers"):
            function(wrong)
    x = torch.tensor([2.0, 0, 1], dtype=torch.float64, requires_grad=True)
    states = carom.torch.states(ball, [carom.velocity("ball")], ["ball"], [1.0])
    gradient, = torch.autograd.grad(states(x).position.square().sum(), x, create_graph=True)
    with pytest.raises(RuntimeError, match="once_differentiable"):
        gradient.sum().backward()
