# SPDX-License-Identifier: MIT
"""Motions as differentiable functions of JAX: `rows` in both modes, `states` in reverse mode.

Both work with jit, grad and vmap; a batch is simulated in several threads. Derivatives are carom's, exact through
impacts, and are computed in double precision even if JAX has its 32 bits: then they come back rounded to these. Second
derivatives raise; NlpPoint.hessian has them.
"""

import functools
import warnings
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from carom import batches
from carom._carom import Control, NlpEvaluator, Scene, xla_handler, xla_number
from carom.errors import InputError

try:
    import jax
    import jax.numpy as jnp
except ImportError:
    batches.missing("jax", "jax")

_warned = False


@functools.cache
def direct() -> bool:
    """Whether programs of JAX compute `rows` directly, on its CPU backend, or else through a callback of Python, which takes
    60 us longer: where carom was built without XLA's headers, or for a version of XLA that this one does not take."""
    parts = xla_handler()
    # Of a backend that is there: before, JAX would keep them for later, and an error would take the backend along.
    if not parts or jax.default_backend() != "cpu":
        return False
    try:
        jax.ffi.register_ffi_type("carom_rows", {"type_id": parts["type_id"], "type_info": parts["type_info"]}, platform="cpu")
        jax.ffi.register_ffi_target("carom_rows", {stage: parts[stage] for stage in ("instantiate", "execute")}, platform="cpu")
    except Exception as error:
        warnings.warn(f"carom.jax.rows takes the slower way through Python: {error}", stacklevel=2)
        return False
    return True


def _like(x: Any, n: int) -> Any:
    """x as floats of JAX, checked while it is traced; warns once of 32 bits."""
    global _warned
    x = jnp.asarray(x)
    if jnp.iscomplexobj(x):
        raise InputError("x", f"found values of the type {x.dtype}, expected real numbers")
    x = jnp.asarray(x, dtype=jnp.result_type(float))
    if x.shape != (n,):
        raise InputError("x", f"found the shape {x.shape}, expected ({n},); jax.vmap does batches")
    if x.dtype == jnp.float32 and not _warned:
        _warned = True
        warnings.warn("JAX rounds to 32 bits: jax.config.update('jax_enable_x64', True) keeps every digit", stacklevel=3)
    return x


def _on_host(function: Callable[..., batches.Floats], shape: tuple[int, ...], *arguments: Any) -> Any:
    """What a function of arrays gives, of a batch as a whole; `shape` is that of one x."""
    dtype = arguments[0].dtype

    def call(*given: Any) -> Any:
        return function(*[np.asarray(one) for one in given]).astype(dtype, copy=False)

    return jax.pure_callback(call, jax.ShapeDtypeStruct(shape, dtype), *arguments, vmap_method="broadcast_all")


def rows(evaluator: NlpEvaluator, *, threads: int | None = None) -> Callable[[Any], Any]:
    """The rows of an edit as a function x (n,) -> (m,), by SI, with a `custom_jvp`: value and Jacobian come from one
    simulation. For few rows: the Jacobian takes one reverse pass each.

    Raises as carom.batches.Rows; within jit it is JAX that raises, with the same sentence.
    """
    work = batches.Rows(evaluator, threads=threads)

    def together(x: Any) -> batches.Floats:
        """The values as the first column: every further result of a callback takes JAX 10 us."""
        values, jacobian = work.values_and_jacobian(x)
        return np.concatenate([values[..., None], jacobian], axis=-1)

    def evaluate(x: Any, jacobian: bool) -> Any:
        host, shape = (together, (work.m, 1 + work.n)) if jacobian else (work.values, (work.m,))
        if not isinstance(x, jax.core.Tracer):  # not in a program: exceptions come out as they are
            return jnp.asarray(host(x), dtype=x.dtype)
        if not direct():
            return _on_host(host, shape, x)
        call = jax.ffi.ffi_call("carom_rows", jax.ShapeDtypeStruct(shape, x.dtype), vmap_method="broadcast_all")
        return call(x, evaluator=np.int64(xla_number(evaluator)), jacobian=np.int64(jacobian), threads=np.int64(work.threads))

    @jax.custom_jvp
    def inner(x: Any) -> Any:
        return evaluate(x, False)

    @inner.defjvp
    def rule(primals: Any, tangents: Any) -> Any:
        both = evaluate(primals[0], True)
        return both[:, 0], both[:, 1:] @ tangents[0]

    def function(x: Any) -> Any:
        return inner(_like(x, work.n))

    return function


class States(NamedTuple):
    """States as arrays of JAX, SI, rows in the order of the bodies and times."""

    position: Any  # (bodies, times, 3)
    orientation: Any  # (bodies, times, 4), [w, x, y, z]
    velocity: Any  # (bodies, times, 3)
    angular_velocity: Any  # (bodies, times, 3)


def states(scene: Scene, controls: Sequence[Control], bodies: Sequence[str], times: npt.ArrayLike, *,
           threads: int | None = None) -> Callable[[Any], States]:
    """The states of bodies at times as a function x (n,) -> States of the control parameters, by SI, with a `custom_vjp`:
    for many states. The reverse pass simulates again and takes one pass for all of them. Forward mode raises TypeError.

    Raises as carom.batches.States; within jit it is JAX that raises, with the same sentence.
    """
    work = batches.States(scene, controls, bodies, times, threads=threads)

    @jax.custom_vjp
    def inner(x: Any) -> Any:
        return _on_host(work.values, work.shape, x)

    def forward(x: Any) -> Any:
        return inner(x), x

    def backward(x: Any, weights: Any) -> Any:
        return (_on_host(work.pullback, (work.n,), x, weights),)

    inner.defvjp(forward, backward)

    def function(x: Any) -> States:
        values = inner(_like(x, work.n))
        return States(*(values[..., columns] for columns in work.COLUMNS))

    return function
