# SPDX-License-Identifier: MIT
# peer: torchdiffeq
# environment: torch
# requires: torch==1.13.1 numpy==1.26.4 scipy==1.17.1 torchdiffeq==0.2.5
# package: torchdiffeq
"""torchdiffeq: equations of motion, events and what happens at them are written here by hand. Reverse mode, one pass a
component, double precision. The package does not have bodies; torch 1.13.1 because later ones take more than 3 GB."""

import sys
from pathlib import Path

HERE = str(Path(__file__).parent)
sys.path = [p for p in sys.path if p not in (HERE, "")]  # this file has the name of the package
import torch
from torchdiffeq import odeint, odeint_event

sys.path.insert(0, HERE)
import peer
import problems

torch.set_num_threads(1)
peer.ready()

TOLERANCES = (1e-6, 1e-9, 1e-12)
METHOD = "dopri8"
LIFT = 1e-13  # m, above the surface after an impact: at zero the next event would be found at once


def flight(tolerance, until=None):
    """`until`: a time that steps shall end at; what lies between two steps is read with less accuracy."""
    options = {} if until is None else {"step_t": torch.tensor([until], dtype=torch.float64)}
    return {"method": METHOD, "rtol": tolerance, "atol": tolerance, "options": options}


def set_apart(distance):
    """Adds LIFT to a distance that is zero but for rounding; derivatives stay."""
    return distance + (LIFT - distance.detach())


def ball(x, tolerance):
    p = problems.BALL
    t, y = torch.zeros((), dtype=x.dtype), torch.stack([x[0], x[1]])
    fall = lambda t, y: torch.stack([y[1], torch.full_like(y[1], -problems.GRAVITY)])
    for _ in range(p.fixed["bounces"]):
        t, path = odeint_event(fall, y, t, event_fn=lambda t, y: y[0], **flight(tolerance))
        y = torch.stack([set_apart(path[-1][0]), -x[2] * path[-1][1]])
    return odeint(fall, y, torch.stack([t, torch.full_like(t, p.duration)]), **flight(tolerance, p.duration))[-1]


def top(x, tolerance):
    a, b, c = x[3], x[4], x[5]

    def turn(_, y):
        q0, q1, q2, q3, u, v, w = y.unbind()
        return torch.stack([(-q1 * u - q2 * v - q3 * w) / 2, (q0 * u + q2 * w - q3 * v) / 2,
                            (q0 * v + q3 * u - q1 * w) / 2, (q0 * w + q1 * v - q2 * u) / 2,
                            (b - c) / a * v * w, (c - a) / b * w * u, (a - b) / c * u * v])
    start = torch.cat([torch.tensor([1.0, 0, 0, 0], dtype=x.dtype), x[:3]])
    until = problems.TOP.duration
    y = odeint(turn, start, torch.tensor([0, until], dtype=x.dtype), **flight(tolerance, until))[-1]
    R = torch.stack(problems.rotation(y[:4]))
    return torch.cat([R.reshape(3, 3) @ y[4:], R])


def two_balls(x, tolerance):
    p = problems.HIT
    known = lambda key: torch.tensor(p.fixed[key], dtype=x.dtype)
    reach = 2 * p.fixed["radius"]
    start = torch.cat([known("place of a"), known("place of b"), x[:3], known("velocity of b")])
    fly = lambda t, y: torch.cat([y[6:], torch.zeros_like(y[6:])])
    t, path = odeint_event(fly, start, torch.zeros((), dtype=x.dtype),
                           event_fn=lambda t, y: torch.sum((y[:3] - y[3:6])**2) - reach**2, **flight(tolerance))
    y = path[-1]
    n = (y[:3] - y[3:6]) / reach
    impulse = -(1 + x[5]) * torch.dot(n, y[6:9] - y[9:]) / (1 / x[3] + 1 / x[4]) * n
    y = torch.cat([y[:6], y[6:9] + impulse / x[3], y[9:] - impulse / x[4]])
    return odeint(fly, y, torch.stack([t, torch.full_like(t, p.duration)]), **flight(tolerance, p.duration))[-1]


def main():
    for problem, end in ((problems.BALL, ball), (problems.TOP, top), (problems.HIT, two_balls)):
        for tolerance in TOLERANCES:
            def run():
                x = torch.tensor(problem.values(), dtype=torch.float64, requires_grad=True)
                state = end(x, tolerance)
                rows = [torch.autograd.grad(one, x, retain_graph=True)[0].tolist() for one in state]
                return state.tolist(), rows
            peer.measure(problem, tolerance, run, "reverse mode")


main()
