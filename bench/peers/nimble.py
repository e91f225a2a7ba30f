# SPDX-License-Identifier: MIT
# peer: nimblephysics
# environment: torch
# requires: torch==1.13.1 numpy==1.26.4 nimblephysics==0.10.52.1
# package: nimblephysics
"""nimblephysics: fixed steps, impacts with restitution by a complementarity problem, analytic derivatives of each step
by state and by masses and moments (not by elasticity), chained by torch in reverse mode; double precision."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import peer
import problems

import nimblephysics as nimble
import numpy as np
import torch

torch.set_num_threads(1)
peer.ready()

STEPS = (1e-2, 1e-3, 1e-4, 1e-5)
LONGEST = 25  # s that a run may be expected to take
MASS = nimble.neural.WrtMassBodyNodeEntryType.MASS
MOMENTS = nimble.neural.WrtMassBodyNodeEntryType.INERTIA_DIAGONAL


def world(step, gravity=0.0):
    w = nimble.simulation.World()
    w.setGravity([0, 0, -gravity])
    w.setTimeStep(step)
    return w


def add_ball(w, radius, mass, elasticity):
    skeleton = nimble.dynamics.Skeleton()
    _, body = skeleton.createTranslationalJointAndBodyNodePair()
    body.createShapeNode(nimble.dynamics.SphereShape(radius)).createCollisionAspect()
    body.setFrictionCoeff(0)
    body.setRestitutionCoeff(elasticity)
    body.setMass(mass)
    w.addSkeleton(skeleton)
    return body


def add_floor(w):
    skeleton = nimble.dynamics.Skeleton()
    joint, body = skeleton.createWeldJointAndBodyNodePair()
    body.createShapeNode(nimble.dynamics.BoxShape([10, 10, 1])).createCollisionAspect()
    body.setFrictionCoeff(0)
    body.setRestitutionCoeff(1)  # those of the two bodies are multiplied
    joint.setTransformFromParentBodyNode(nimble.math.Isometry3(np.eye(3), np.array([0, 0, -0.5])))
    w.addSkeleton(skeleton)


def play(w, state, duration, step, masses=None):
    action = torch.zeros(w.getActionSize(), dtype=torch.float64)
    for _ in range(round(duration / step)):
        state = nimble.timestep(w, state, action, masses)
    return state


def ball(step):
    p = problems.BALL
    r = p.fixed["radius"]
    w = world(step, problems.GRAVITY)
    add_ball(w, r, p.fixed["mass"], p.value("elasticity"))
    add_floor(w)

    def end(x):
        start = torch.zeros(6, dtype=torch.float64)
        start = torch.stack([start[0], start[0], x[0] + r, start[0], start[0], x[1]])
        y = play(w, start, p.duration, step)
        return torch.stack([y[2] - r, y[5]])
    return p, end, {2}


def top(step):
    p = problems.TOP
    w = world(step)
    skeleton = nimble.dynamics.Skeleton()
    _, body = skeleton.createBallJointAndBodyNodePair()
    body.setMass(p.fixed["mass"])
    body.setMomentOfInertia(*p.values()[3:], 0, 0, 0)
    w.addSkeleton(skeleton)
    w.tuneMass(body, MOMENTS, 10 * np.ones(3), 0.1 * np.ones(3))

    def end(x):
        y = play(w, torch.cat([torch.zeros(3, dtype=torch.float64), x[:3]]), p.duration, step, x[3:])
        angle = torch.linalg.norm(y[:3])
        axis = y[:3] / angle
        half = torch.cat([torch.cos(angle / 2)[None], torch.sin(angle / 2) * axis])
        R = torch.stack(problems.rotation(half))
        return torch.cat([R.reshape(3, 3) @ y[3:], R])
    return p, end, set()


def two_balls(step):
    p = problems.HIT
    w = world(step)
    for name, elasticity in (("a", p.value("elasticity")), ("b", 1.0)):
        body = add_ball(w, p.fixed["radius"], p.value("mass of " + name), elasticity)
        w.tuneMass(body, MASS, 10 * np.ones(1), 0.1 * np.ones(1))
    known = lambda key: torch.tensor(p.fixed[key], dtype=torch.float64)

    def end(x):
        start = torch.cat([known("place of a"), known("place of b"), x[:3], known("velocity of b")])
        return play(w, start, p.duration, step, x[3:5])
    return p, end, {5}


def main():
    left = [ball, top, two_balls]
    for step in STEPS:  # should time run out, all problems have their longer steps
        for make in list(left):
            problem, end, unknown = make(step)

            def run():
                x = torch.tensor(problem.values(), dtype=torch.float64, requires_grad=True)
                state = end(x)
                rows = [torch.autograd.grad(one, x, retain_graph=True)[0].tolist() for one in state]
                return state.tolist(), [[None if k in unknown else d for k, d in enumerate(row)] for row in rows]
            seconds = peer.measure(problem, step, run, "reverse mode")
            if seconds is None or seconds > LONGEST / 10:
                left.remove(make)


main()
