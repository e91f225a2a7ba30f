# SPDX-License-Identifier: MIT
# peer: MJX
# requires: jax==0.10.2 mujoco==4.0.0 mujoco-mjx==3.17.0
# package: mujoco-mjx
"""MuJoCo in JAX, in double precision, derived by jax.jacfwd through all steps.

MuJoCo has no restitution. As its documentation says, contacts that bounce have a negative solref: stiffness and damping
of a spring. Damping is chosen so that a lone impact has the wanted elasticity, stiffness so that a contact lasts for a
number of steps that grows slowly as steps shrink: both the length of a contact and its error of stepping go to zero.
"""

import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import peer
import problems
import springs

import jax

jax.config.update("jax_enable_x64", True)
import jax.numpy as jnp
import mujoco
from mujoco import mjx

peer.ready()

STEPS = (1e-2, 1e-3, 1e-4, 1e-5)
LONGEST = 25  # s that a run may be expected to take
BODY = ('<body name="{0}" pos="{1} {2} {3}"><freejoint/><inertial pos="0 0 0" mass="{4}" diaginertia="{5} {6} {7}"/>{8}'
        '</body>')
GEOM = '<geom type="sphere" size="{0}"/>'


def model(gravity, bodies):
    return mjx.put_model(mujoco.MjModel.from_xml_string(f"""
      <mujoco><option integrator="RK4" iterations="10" tolerance="1e-14" ls_iterations="10"
        gravity="0 0 {-gravity}"/>
      <default><geom condim="1" friction="0 0 0" margin="0" solimp="0.9999 0.9999 0.001"/></default>
      <worldbody>{bodies}</worldbody></mujoco>"""))


def bouncing(m, step, elasticity):
    """All contacts with this elasticity, in a way that can be derived by it."""
    ratio = springs.damping_ratio(jnp, elasticity)
    frequency = springs.frequency(ratio, step, 0.35)
    solref = jnp.stack([-frequency**2, -2 * ratio * frequency])
    return m.replace(geom_solref=jnp.broadcast_to(solref, m.geom_solref.shape))


def end(m, qpos, qvel, duration, step):
    m = m.replace(opt=m.opt.replace(timestep=step))
    data = mjx.make_data(m).replace(qpos=qpos, qvel=qvel)
    steps = jnp.round(duration / step).astype(int)
    return jax.lax.fori_loop(0, steps, lambda _, d: mjx.step(m, d), data)


def ball():
    p = problems.BALL
    r, mass = p.fixed["radius"], p.fixed["mass"]
    inertia = 0.4 * mass * r * r
    m = model(problems.GRAVITY, '<geom type="plane" size="0 0 1"/>'
              + BODY.format("b", 0, 0, 1, mass, inertia, inertia, inertia, GEOM.format(r)))

    def last(x, step):
        qpos = jnp.array([0, 0, r, 1, 0, 0, 0]).at[2].add(x[0])
        d = end(bouncing(m, step, x[2]), qpos, jnp.zeros(6).at[2].set(x[1]), p.duration, step)
        return jnp.array([d.qpos[2] - r, d.qvel[2]])
    return p, last


def top():
    p = problems.TOP
    m = model(0, BODY.format("b", 0, 0, 0, p.fixed["mass"], *p.values()[3:], ""))

    def last(x, step):
        moments = m.replace(body_inertia=m.body_inertia.at[1].set(x[3:]))
        d = end(moments, jnp.array([0.0, 0, 0, 1, 0, 0, 0]), jnp.concatenate([jnp.zeros(3), x[:3]]), p.duration, step)
        R = jnp.array(problems.rotation(d.qpos[3:7] / jnp.linalg.norm(d.qpos[3:7])))
        return jnp.concatenate([R.reshape(3, 3) @ d.qvel[3:6], R])
    return p, last


def two_balls():
    p = problems.HIT
    r = p.fixed["radius"]
    def body(name):
        mass = p.value("mass of " + name)
        return BODY.format(name, *p.fixed["place of " + name], mass, *[0.4 * mass * r * r] * 3, GEOM.format(r))
    m = model(0, body("a") + body("b"))
    start = [*p.fixed["place of a"], 1, 0, 0, 0, *p.fixed["place of b"], 1, 0, 0, 0]

    def last(x, step):
        masses = bouncing(m, step, x[5]).replace(
            body_mass=m.body_mass.at[1:3].set(x[3:5]),
            body_inertia=m.body_inertia.at[1:3].set(0.4 * r * r * x[3:5, None] * jnp.ones(3)))
        qvel = jnp.concatenate([x[:3], jnp.zeros(3), jnp.array(p.fixed["velocity of b"]), jnp.zeros(3)])
        d = end(masses, jnp.array(start), qvel, p.duration, step)
        return jnp.concatenate([d.qpos[0:3], d.qpos[7:10], d.qvel[0:3], d.qvel[6:9]])
    return p, last


def main():
    for make in (ball, top, two_balls):
        problem, last = make()
        twice = lambda x, step: (lambda end: (end, end))(last(x, step))
        at = jnp.array(problem.values())
        start = time.perf_counter()
        both = jax.jit(jax.jacfwd(twice, has_aux=True)).lower(at, STEPS[0]).compile()
        compiling = time.perf_counter() - start
        for step in STEPS:
            def run():
                jacobian, state = both(at, step)
                return state.tolist(), jacobian.tolist()
            seconds = peer.measure(problem, step, run, "forward mode", compiling)
            if seconds is None or seconds > LONGEST / 10:
                break


main()
