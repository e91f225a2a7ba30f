# SPDX-License-Identifier: MIT
"""Rows and states of motions as functions of the control parameters x, for many x at once: what carom.jax and carom.torch
are made of. Motions are simulated in several threads; the derivatives are those of the library, exact to rounding."""

import os
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import numpy.typing as npt

from carom._carom import Control, Edit, Motion, NlpEvaluator, NlpPoint, Reading, Scene, Seed
from carom.errors import InputError, NotComputable

Floats = npt.NDArray[np.float64]

_pool_guard = threading.Lock()
_pools: dict[int, ThreadPoolExecutor] = {}


def _forget_pools() -> None:
    global _pool_guard
    _pool_guard = threading.Lock()
    _pools.clear()  # their threads do not survive a fork


os.register_at_fork(after_in_child=_forget_pools)


def _pool(threads: int) -> ThreadPoolExecutor:
    with _pool_guard:
        if threads not in _pools:
            _pools[threads] = ThreadPoolExecutor(threads, "carom")
        return _pools[threads]


def _for_each(count: int, threads: int, work: Callable[[int], None]) -> None:
    """Calls work(i) for all i below count, in that many threads; raises the first exception, by index."""
    if count == 1 or threads == 1:
        for i in range(count):
            work(i)
        return

    def share(first: int) -> None:
        for i in range(first, count, threads):
            work(i)

    for done in [_pool(threads).submit(share, first) for first in range(min(threads, count))]:
        done.result()


def _threads(threads: int | None) -> int:
    if threads is None:
        return len(os.sched_getaffinity(0))
    if threads < 1:
        raise InputError("threads", f"found {threads}, expected 1 or more")
    return threads


def _points(x: npt.ArrayLike, n: int) -> tuple[Floats, tuple[int, ...]]:
    """x as (count, n), and the shape of the batch."""
    points = np.asarray(x, dtype=np.float64)
    if points.ndim == 0 or points.shape[-1] != n:
        raise InputError("x", f"found the shape {points.shape}, expected (..., {n})")
    return points.reshape(-1, n), points.shape[:-1]


class Rows:
    """The rows of an edit as a function of its variables, SI: x (..., n) -> values (..., m), Jacobian (..., m, n).

    Raises InputError for x of another shape or with numbers that are not finite, NotComputable with the reason where a
    row does not exist, such as one at the second impact of a motion that has one.
    """

    def __init__(self, evaluator: NlpEvaluator, *, threads: int | None = None) -> None:
        self.evaluator = evaluator
        self.n, self.m = len(evaluator.variables), len(evaluator.rows)
        self.threads = _threads(threads)

    def values(self, x: npt.ArrayLike) -> Floats:
        points, batch = _points(x, self.n)
        values, _ = self.evaluator.rows_at(points, threads=self.threads)
        return values.reshape(*batch, self.m)

    def values_and_jacobian(self, x: npt.ArrayLike) -> tuple[Floats, Floats]:
        points, batch = _points(x, self.n)
        values, jacobian = self.evaluator.rows_at(points, jacobian=True, threads=self.threads)
        assert jacobian is not None
        return values.reshape(*batch, self.m), jacobian.reshape(*batch, self.m, self.n)


class _Reader(threading.local):
    """What one thread reads of the motion that is being evaluated in it."""

    weights: Floats | None = None  # (bodies, times, 13)
    states: Floats | None = None


class States:
    """States of bodies at times as a function of control parameters, SI: x (..., n) -> (..., bodies, times, 13), columns as
    in COLUMNS; and the pullback of weights of that shape to (..., n), by one reverse pass for each x.

    Raises as Rows, NotComputable also for a motion that ends before the last of the times.
    """

    COLUMNS = (slice(0, 3), slice(3, 7), slice(7, 10), slice(10, 13))  # position, orientation, velocity, angular velocity

    def __init__(self, scene: Scene, controls: Sequence[Control], bodies: Sequence[str], times: npt.ArrayLike, *,
                 threads: int | None = None) -> None:
        self.bodies, self.times = tuple(bodies), np.array(times, dtype=np.float64)
        if not self.bodies:
            raise InputError("bodies", "found none, expected at least one")
        if self.times.ndim != 1 or not self.times.size or not np.isfinite(self.times).all() or self.times.min() < 0:
            raise InputError("times", f"found {times!r}, expected a sequence of times, s")
        self._reader = _Reader()
        self._threads = _threads(threads)
        last = float(self.times.max())
        edit = Edit(scene, last)
        edit.vary(*controls)
        edit.minimise("states", self._read, until=last)
        self.evaluator = edit.evaluator()
        self.n = len(self.evaluator.variables)
        self.shape = (len(self.bodies), len(self.times), 13)

    def _read(self, motion: Motion) -> Reading:
        if motion.end < self.times.max():
            raise NotComputable(f"the motion ends at {motion.end} s: {motion.message}")
        sampled = motion.sample(self.bodies, self.times)
        states = np.concatenate([sampled.position, sampled.orientation, sampled.velocity, sampled.angular_velocity], axis=-1)
        self._reader.states = states
        weights = self._reader.weights
        if weights is None or not weights.any():
            return Reading(0.0, [Seed(self.bodies[0], float(self.times[0]))])  # of weight 0
        return Reading(float((weights * states).sum()), self._seeds(states, weights))

    def _seeds(self, states: Floats, weights: Floats) -> list[Seed]:
        position, orientation, velocity, spin = (weights[..., columns] for columns in self.COLUMNS)
        # A rotation by the vector w changes a quaternion q by 1/2 (0, w) q.
        scalar, vector = states[..., 3:4], states[..., 4:7]
        rotation = 0.5 * (scalar * orientation[..., 1:] - orientation[..., :1] * vector + np.cross(vector, orientation[..., 1:]))
        return [Seed(body, float(time), position=position[b, t], orientation=rotation[b, t], velocity=velocity[b, t],
                     angular_velocity=spin[b, t])
                for b, body in enumerate(self.bodies) for t, time in enumerate(self.times) if weights[b, t].any()]

    def _evaluate(self, x: Floats, weights: Floats | None) -> tuple[Floats, NlpPoint]:
        reader = self._reader
        reader.weights, reader.states = weights, None
        point = self.evaluator.at(x)
        if not point.available or reader.states is None:
            raise NotComputable(f"x = {x.tolist()}: {point.message}")
        return reader.states, point

    def values(self, x: npt.ArrayLike) -> Floats:
        points, batch = _points(x, self.n)
        values = np.empty((len(points), *self.shape))

        def work(i: int) -> None:
            values[i], _ = self._evaluate(points[i], None)

        _for_each(len(points), self._threads, work)
        return values.reshape(*batch, *self.shape)

    def pullback(self, x: npt.ArrayLike, weights: npt.ArrayLike) -> Floats:
        points, batch = _points(x, self.n)
        weights = np.asarray(weights, dtype=np.float64)
        if weights.shape != (*batch, *self.shape):
            raise InputError("weights", f"found the shape {weights.shape}, expected {(*batch, *self.shape)}")
        all_weights = weights.reshape(-1, *self.shape)
        gradient = np.empty((len(points), self.n))

        def work(i: int) -> None:
            _, point = self._evaluate(points[i], all_weights[i])
            gradient[i] = point.gradient().entries

        _for_each(len(points), self._threads, work)
        return gradient.reshape(*batch, self.n)


def missing(name: str, install: str) -> Any:
    """Raises ImportError, with what to do, where an optional package is missing."""
    raise ImportError(f"carom.{name} needs {install}, which is not installed: pip install {install}", name=install)
