# SPDX-License-Identifier: MIT
"""Figures of motions with matplotlib: `paths` in a plane, `histories` of states over time. Both draw into axes of yours or
make some, and return them."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from carom import batches
from carom._carom import Motion
from carom.errors import InputError

try:
    import matplotlib.pyplot as plt
except ImportError:
    batches.missing("plot", "matplotlib")

_AXES = "xyz"
_UNITS = {"position": "m", "velocity": "m/s", "angular_velocity": "rad/s"}


def _moving(motion: Motion, bodies: Sequence[str] | None) -> list[str]:
    """The bodies that were asked for; else those that are not at the same place all the time."""
    names = motion.scene.bodies
    if bodies is not None:
        for name in bodies:
            if name not in names:
                raise InputError("bodies", f"found {name!r}, expected names among {', '.join(names)}")
        return list(bodies)
    places = motion.sample(names, np.linspace(0, motion.end, 33)).position
    turns = motion.sample(names, np.linspace(0, motion.end, 33)).orientation
    moved = (np.ptp(places, axis=1) > 0).any(axis=1) | (np.ptp(turns, axis=1) > 0).any(axis=1)
    return [name for name, moves in zip(names, moved, strict=True) if moves]


def _times(motion: Motion, samples: int) -> batches.Floats:
    """Evenly spaced, and those of the events, so that corners are drawn sharp."""
    if samples < 2:
        raise InputError("samples", f"found {samples}, expected 2 or more")
    times: batches.Floats = np.union1d(np.linspace(0, motion.end, samples), motion.events.time)
    return times[times <= motion.end]


def _index(axis: str, where: str) -> int:
    if axis not in _AXES or len(axis) != 1:
        raise InputError(where, f"found {axis!r}, expected 'x', 'y' or 'z'")
    return _AXES.index(axis)


def paths(motion: Motion, plane: str = "xz", *, bodies: Sequence[str] | None = None, before: Motion | None = None,
          ax: Any = None, samples: int = 501) -> Any:
    """Paths of the origins of bodies in the plane of two axes, 'xz' from the side, 'xy' from above; impacts are marked. The
    motion `before` is dashed. Bodies default to those that move. Raises InputError."""
    if len(plane) != 2 or plane[0] == plane[1]:
        raise InputError("plane", f"found {plane!r}, expected two axes such as 'xz'")
    i, j = _index(plane[0], "plane"), _index(plane[1], "plane")
    axes = plt.subplots()[1] if ax is None else ax
    for body in _moving(motion, bodies):
        place = motion.sample(body, _times(motion, samples)).position
        line, = axes.plot(place[:, i], place[:, j], label=body)
        met = [event.time for event in motion.events if event.kind == "impact" and body in event.bodies]
        if met:
            at = motion.sample(body, met).position
            axes.plot(at[:, i], at[:, j], "o", markersize=4, color=line.get_color())
        if before is not None:
            place = before.sample(body, _times(before, samples)).position
            axes.plot(place[:, i], place[:, j], "--", linewidth=1, color=line.get_color(), alpha=0.6)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel(f"{plane[0]} (m)")
    axes.set_ylabel(f"{plane[1]} (m)")
    axes.legend()
    return axes


def histories(motion: Motion, quantity: str = "position", component: str = "z", *, bodies: Sequence[str] | None = None,
              before: Motion | None = None, ax: Any = None, samples: int = 501) -> Any:
    """A component of the 'position', 'velocity' or 'angular_velocity' of bodies over time. Where an impact changes a
    velocity, the line is vertical. Otherwise as `paths`."""
    if quantity not in _UNITS:
        raise InputError("quantity", f"found {quantity!r}, expected one of {', '.join(_UNITS)}")
    k = _index(component, "component")
    axes = plt.subplots()[1] if ax is None else ax
    for body in _moving(motion, bodies):
        color = None
        for one, style in ((motion, "-"), (before, "--")):
            if one is None:
                continue
            times, values = _history(one, body, quantity, k, samples)
            line, = axes.plot(times, values, style, color=color, label=body if color is None else None)
            color = line.get_color()
    axes.set_xlabel("t (s)")
    axes.set_ylabel(f"{quantity.replace('_', ' ')} {component} ({_UNITS[quantity]})")
    axes.legend()
    return axes


def _history(motion: Motion, body: str, quantity: str, k: int, samples: int) -> tuple[batches.Floats, batches.Floats]:
    """Times and values, with those just before and after each event of the body."""
    times = _times(motion, samples)
    values = getattr(motion.sample(body, times), quantity)[:, k]
    events = [event for event in motion.events if body in event.bodies]
    if not events:
        return times, values
    at = np.array([event.time for event in events])
    jumps = np.array([[getattr(state(event, body), quantity)[k] for state in (motion.state_before, motion.state_after)]
                      for event in events])
    keep = ~np.isin(times, at)
    times, values = np.append(times[keep], np.repeat(at, 2)), np.append(values[keep], jumps.ravel())
    order = np.argsort(times, kind="stable")  # before stays ahead of after
    return times[order], values[order]
