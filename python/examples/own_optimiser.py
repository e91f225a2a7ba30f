# SPDX-License-Identifier: MIT
"""Solves an edit with SciPy in place of carom's solver: an evaluator gives values and exact derivatives."""

import numpy as np
import numpy.typing as npt
from scipy.optimize import NonlinearConstraint, minimize  # type: ignore[import-untyped]

import carom

Vector = npt.NDArray[np.float64]

scene = carom.Scene(
    {
        "carom": 1,
        "duration": 2,
        "materials": {"court": {"elasticity": 0.7, "friction": 0.4}},
        "bodies": [
            {"name": "floor", "fixed": True, "material": "court", "shape": {"plane": {"normal": [0, 0, 1], "offset": 0}}},
            {
                "name": "ball",
                "material": "court",
                "mass": 0.057,
                "shape": {"sphere": {"radius": 0.033}},
                "position": [0, 0, 1],
                "velocity": [3, 0, 2],
            },
        ],
    }
)
edit = carom.Edit(scene)
edit.vary(carom.velocity("ball"), carom.elasticity("court", min=0.5, max=0.9))
edit.nail("ball", carom.nth_impact(2)).position(4.2, 0.5, None)
program = edit.evaluator()
start = program.at(program.start)

# In natural scales: y = x / scale. Optimisers ask for one point several times, so the last one is kept.
scale: Vector = np.array([variable.scale for variable in program.variables])
last = start


def at(y: Vector) -> carom.NlpPoint:
    global last
    if not np.array_equal(last.x, y * scale):
        last = program.at(y * scale)
    if last.available and last.signature != start.signature:
        print("another impact sequence")  # rows may jump there
    return last  # a point that is not available raises NotComputable, with the reason, when it is read


def curvature_of_rows(y: Vector, weights: Vector) -> Vector:
    hessian: Vector = scale[:, None] * at(y).hessian(0, weights) * scale
    return hessian


no_weights = np.zeros(len(program.rows))
answer = minimize(
    lambda y: at(y).objective,
    program.start / scale,
    method="trust-constr",
    jac=lambda y: at(y).gradient().entries * scale,
    hess=lambda y: scale[:, None] * at(y).hessian(1, no_weights) * scale,
    bounds=list(zip(program.lower / scale, program.upper / scale, strict=True)),
    constraints=NonlinearConstraint(
        lambda y: at(y).values,
        [row.lower for row in program.rows],
        [row.upper for row in program.rows],
        jac=lambda y: at(y).jacobian().entries * scale,
        hess=curvature_of_rows,
    ),
    options={"gtol": 1e-9, "xtol": 1e-12, "maxiter": 200},
)
its_own = edit.solve(sequence="stay")
print(f"objective {answer.fun:.6f}, that of solve {its_own.objective:.6f}")
for number, value in zip(its_own.changed, answer.x * scale, strict=True):
    print(f"  {number.name:22} {number.before:8.4f} -> {value:8.4f}, solve {number.after:8.4f}")

motion = carom.simulate(program.scene_at(answer.x * scale))
place = motion.state_before(motion.events[1], "ball").position
print(f"second bounce at ({place[0]:.4f}, {place[1]:.4f}) m")


def energy(motion: carom.Motion) -> carom.Reading:
    """A row of one's own: 1/2 |v|^2 of the ball at 0.3 s, with its first and second derivatives."""
    velocity = motion.state_at("ball", 0.3).velocity

    def rates(states: list[carom.BodyStateRate]) -> list[carom.Seed]:
        return [carom.Seed("ball", 0.3, velocity=states[0].velocity)]

    seeds = [carom.Seed("ball", 0.3, velocity=velocity)]
    return carom.Reading(0.5 * float(velocity @ velocity), seeds, seed_rates=rates, second_order=True)


print(carom.check_motion_function(scene, energy, [carom.velocity("ball")], until=0.3))
