# SPDX-License-Identifier: MIT
"""Motions as differentiable functions of PyTorch: `rows` and `states`, with carom's derivatives, exact through impacts.

Tensors may have leading dimensions, a batch, which is simulated in several threads. Everything is computed in double
precision on the CPU, and comes back in the type and on the device of x. Second derivatives raise; NlpPoint.hessian has them.
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy.typing as npt

from carom import batches
from carom._carom import Control, NlpEvaluator, Scene
from carom.errors import InputError

try:
    import torch
    from torch.autograd.function import once_differentiable
except ImportError:
    batches.missing("torch", "torch")


def _array(x: Any) -> batches.Floats:
    if not x.is_floating_point():  # what comes of it would be rounded to its type
        raise InputError("x", f"found values of the type {x.dtype}, expected floating-point numbers")
    array: batches.Floats = x.detach().to("cpu", torch.float64).numpy()
    return array


def _tensor(array: batches.Floats, like: Any) -> Any:
    return torch.tensor(array, dtype=like.dtype, device=like.device)


class _Rows(torch.autograd.Function):
    @staticmethod
    def forward(ctx: Any, x: Any, work: batches.Rows) -> Any:
        if not ctx.needs_input_grad[0]:
            return _tensor(work.values(_array(x)), x)
        values, jacobian = work.values_and_jacobian(_array(x))
        ctx.save_for_backward(_tensor(jacobian, x))
        return _tensor(values, x)

    @staticmethod
    @once_differentiable
    def backward(ctx: Any, weights: Any) -> Any:
        jacobian, = ctx.saved_tensors
        return torch.einsum("...m,...mn->...n", weights, jacobian), None


class _States(torch.autograd.Function):
    @staticmethod
    def forward(ctx: Any, x: Any, work: batches.States) -> Any:
        ctx.save_for_backward(x)
        ctx.work = work
        return _tensor(work.values(_array(x)), x)

    @staticmethod
    @once_differentiable
    def backward(ctx: Any, weights: Any) -> Any:
        x, = ctx.saved_tensors
        return _tensor(ctx.work.pullback(_array(x), _array(weights)), x), None


def rows(evaluator: NlpEvaluator, *, threads: int | None = None) -> Callable[[Any], Any]:
    """The rows of an edit as a function x (..., n) -> (..., m), by SI; value and Jacobian come from one simulation. For few
    rows: the Jacobian takes one reverse pass each.

    Raises as carom.batches.Rows.
    """
    work = batches.Rows(evaluator, threads=threads)

    def function(x: Any) -> Any:
        return _Rows.apply(x, work)

    return function


class States(NamedTuple):
    """States as tensors, SI, rows in the order of the bodies and times, after the dimensions of the batch."""

    position: Any  # (..., bodies, times, 3)
    orientation: Any  # (..., bodies, times, 4), [w, x, y, z]
    velocity: Any  # (..., bodies, times, 3)
    angular_velocity: Any  # (..., bodies, times, 3)


def states(scene: Scene, controls: Sequence[Control], bodies: Sequence[str], times: npt.ArrayLike, *,
           threads: int | None = None) -> Callable[[Any], States]:
    """The states of bodies at times as a function x (..., n) -> States of the control parameters, by SI; for many states. The
    reverse pass simulates again and takes one pass for all of them.

    Raises as carom.batches.States.
    """
    work = batches.States(scene, controls, bodies, times, threads=threads)

    def function(x: Any) -> States:
        values = _States.apply(x, work)
        return States(*(values[..., columns] for columns in work.COLUMNS))

    return function
