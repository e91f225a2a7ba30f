# SPDX-License-Identifier: MIT
# peer: Warp (Newton)
# requires: warp-lang==1.19.0 newton==1.8.0 numpy==2.4.6
# package: newton
"""Newton, which has taken over the simulation of Warp (warp.sim is gone): its differentiable solver of rigid bodies,
SolverSemiImplicit, derived by wp.Tape in reverse mode; single precision, as it is.

Contacts are springs that are damped on approach; damping is chosen so that a lone impact has the wanted elasticity,
stiffness grows as steps shrink. Derivatives by elasticity and mass go through stiffness and damping.
"""

import sys
from pathlib import Path

HERE = str(Path(__file__).parent)
sys.path = [p for p in sys.path if p not in (HERE, "")]  # this file has the name of the package
import newton
import numpy as np
import warp as wp

sys.path.insert(0, HERE)
import peer
import problems
import springs

wp.config.quiet = True
wp.init()
peer.ready()

STEPS = (1e-2, 1e-3, 1e-4, 1e-5)
LONGEST = 100  # s that a run may be expected to take


class Play:
    """One world with all of its states, so that the tape has each step's own."""

    def __init__(self, builder, step, duration, follow=False):
        self.model = builder.finalize(requires_grad=True, device="cpu")
        self.solver = newton.solvers.SolverSemiImplicit(self.model, angular_damping=0.0)
        self.step, self.steps = step, round(duration / step)
        self.states = [self.model.state() for _ in range(self.steps + 1)]
        self.control = self.model.control()
        self.pipeline = newton.CollisionPipeline(self.model, broad_phase="explicit", requires_grad=True,
                                                 rigid_contact_max=4)
        # a contact with a floor is the same at all times; one of two balls is made anew every step
        self.contacts = [self.pipeline.contacts() for _ in range(self.steps if follow else 1)]

    def end(self):
        """Plays the motion anew; a tape that is walked back twice would add the forces of contacts once more."""
        tape = wp.Tape()
        with tape:
            if len(self.contacts) == 1:
                self.pipeline.collide(self.states[0], self.contacts[0])
            for i in range(self.steps):
                contacts = self.contacts[min(i, len(self.contacts) - 1)]
                if len(self.contacts) > 1:
                    self.pipeline.collide(self.states[i], contacts)
                self.states[i].clear_forces()
                self.solver.step(self.states[i], self.states[i + 1], self.control, contacts, self.step)
        last = self.states[-1]
        return tape, last.body_q.numpy().astype(float), last.body_qd.numpy().astype(float)

    def derive(self, twist, seeds):
        """End of the motion that starts with these velocities, once for each seed (of pose and of velocity) with all
        derivatives of what the seed weighs in the arrays."""
        self.states[0].body_qd.assign(np.array(twist, dtype=np.float32))
        last = self.states[-1]
        tape, pose, velocity = self.end()
        for k, (of_pose, of_velocity) in enumerate(seeds(pose, velocity)):
            if k > 0:
                tape.zero()
                tape, pose, velocity = self.end()
            tape.backward(grads={last.body_q: wp.array(of_pose.astype(np.float32), dtype=wp.transform, device="cpu"),
                                 last.body_qd: wp.array(of_velocity.astype(np.float32), dtype=wp.spatial_vector,
                                                        device="cpu")})
            yield pose, velocity
        tape.zero()


def grad(array):
    return array.grad.numpy().astype(float)


class Contact:
    """Stiffness and damping of a contact, and their derivatives by elasticity and by the reduced mass."""

    def __init__(self, elasticity, mass, step):
        # damped on approach only, such a spring has the root of the restitution of one that is damped both ways
        ratio = springs.damping_ratio(np, elasticity**2)
        h = 1e-6
        above, below = (springs.damping_ratio(np, (elasticity + d)**2) for d in (h, -h))
        by_e = (above - below) / (2 * h)
        frequency = springs.frequency(0.0, step, 0.5)
        self.ke, self.kd = mass * frequency**2, 2 * ratio * frequency * mass
        self.kd_by_elasticity, self.mass = 2 * by_e * frequency * mass, mass

    def config(self):
        return newton.ModelBuilder.ShapeConfig(ke=self.ke, kd=self.kd, kf=0.0, mu=0.0, ka=0.0, density=0.0, gap=10.0)

    def by_elasticity(self, model):
        return grad(model.shape_material_kd).sum() * self.kd_by_elasticity

    def by_mass(self, model):
        stiffness, damping = (grad(array).sum() for array in (model.shape_material_ke, model.shape_material_kd))
        return (stiffness * self.ke + damping * self.kd) / self.mass


def builder(gravity=0.0):
    b = newton.ModelBuilder(up_axis=newton.Axis.Z)
    b.gravity = wp.vec3(0.0, 0.0, -gravity)
    return b


def add_ball(b, place, mass, radius, contact):
    body = b.add_body(xform=wp.transform(wp.vec3(*place), wp.quat_identity()), mass=mass,
                      inertia=wp.mat33(0.4 * mass * radius**2 * np.eye(3)), com=wp.vec3(0.0))
    b.add_shape_sphere(body, radius=radius, cfg=contact.config())


def unit_seeds(entries, bodies):
    """Seeds of single entries: (0 for a pose or 1 for a velocity, body, index)."""
    def seeds(_, __):
        for which, body, index in entries:
            pair = [np.zeros((bodies, 7)), np.zeros((bodies, 6))]
            pair[which][body, index] = 1
            yield pair
    return seeds


def ball(step):
    p = problems.BALL
    r, mass = p.fixed["radius"], p.fixed["mass"]
    contact = Contact(p.value("elasticity"), mass, step)
    b = builder(problems.GRAVITY)
    add_ball(b, (0, 0, p.value("height") + r), mass, r, contact)
    b.add_ground_plane(cfg=contact.config())
    play = Play(b, step, p.duration)

    def run():
        rows = []
        for pose, velocity in play.derive([[0, 0, p.value("speed"), 0, 0, 0]], unit_seeds([(0, 0, 2), (1, 0, 2)], 1)):
            first = play.states[0]
            rows.append([grad(first.body_q)[0, 2], grad(first.body_qd)[0, 2], contact.by_elasticity(play.model)])
        return [pose[0, 2] - r, velocity[0, 2]], rows
    return p, run


def turned(q):
    """Rotation matrix of a pose's quaternion (x, y, z, w), row by row."""
    x, y, z, w = q
    return np.array(problems.rotation((w, x, y, z)))


def top(step):
    p = problems.TOP
    moments = np.array(p.values()[3:])
    b = builder()
    b.add_body(mass=p.fixed["mass"], inertia=wp.mat33(np.diag(moments)), com=wp.vec3(0.0))
    play = Play(b, step, p.duration)

    def seeds(pose, _):
        yield from unit_seeds([(1, 0, 3 + i) for i in range(3)], 1)(None, None)
        columns = [turned(pose[0, 3:] + 1e-30j * np.eye(4)[k]).imag / 1e-30 for k in range(4)]
        for row in np.array(columns).T:
            of_pose = np.zeros((1, 7))
            of_pose[0, 3:] = row
            yield of_pose, np.zeros((1, 6))

    def run():
        rows, model = [], play.model
        for pose, velocity in play.derive([[0, 0, 0, *p.values()[:3]]], seeds):
            by_moments = np.diag(grad(model.body_inertia)[0]) - np.diag(grad(model.body_inv_inertia)[0]) / moments**2
            rows.append([*grad(play.states[0].body_qd)[0, 3:], *by_moments])
        return [*velocity[0, 3:], *turned(pose[0, 3:])], rows
    return p, run


def two_balls(step):
    p = problems.HIT
    r, masses = p.fixed["radius"], [p.value("mass of a"), p.value("mass of b")]
    reduced = masses[0] * masses[1] / sum(masses)
    contact = Contact(p.value("elasticity"), reduced, step)
    b = builder()
    for name, mass in zip("ab", masses):
        add_ball(b, p.fixed["place of " + name], mass, r, contact)
    play = Play(b, step, p.duration, follow=True)
    entries = [(which, body, i) for which in (0, 1) for body in (0, 1) for i in range(3)]

    def run():
        rows, model = [], play.model
        twist = [[*p.values()[:3], 0, 0, 0], [*p.fixed["velocity of b"], 0, 0, 0]]
        for pose, velocity in play.derive(twist, unit_seeds(entries, 2)):
            by_mass = [-grad(model.body_inv_mass)[i] / masses[i]**2
                       + contact.by_mass(model) * (reduced / masses[i])**2 for i in (0, 1)]
            rows.append([*grad(play.states[0].body_qd)[0, :3], *by_mass, contact.by_elasticity(model)])
        return [*pose[:, :3].ravel(), *velocity[:, :3].ravel()], rows
    return p, run


def main():
    left = [ball, top, two_balls]
    for step in STEPS:  # should time run out, all problems have their longer steps
        for make in list(left):
            problem, run = make(step)
            seconds = peer.measure(problem, step, run, "reverse mode")
            if seconds is None or seconds > LONGEST / 10:
                left.remove(make)


main()
