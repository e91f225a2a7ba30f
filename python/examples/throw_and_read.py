# SPDX-License-Identifier: MIT
"""Throws a ball at a wall, reads its path and its gradient, and finds the throw that lands somewhere else."""

import numpy as np

import carom

scene = carom.Scene(
    {
        "carom": 1,
        "duration": 1.5,
        "materials": {"rubber": {"elasticity": 0.8, "friction": 0.5}},
        "bodies": [
            {"name": "floor", "fixed": True, "material": "rubber", "shape": {"plane": {"normal": [0, 0, 1], "offset": 0}}},
            {"name": "wall", "fixed": True, "material": "rubber", "shape": {"plane": {"normal": [-1, 0, 0], "offset": -2}}},
            {
                "name": "ball",
                "material": "rubber",
                "mass": 0.06,
                "shape": {"sphere": {"radius": 0.03}},
                "position": np.array([0.0, 0.0, 1.0]),
                "velocity": [3, 0.5, 2],
            },
        ],
    }
)

motion = carom.simulate(scene)
print(motion)
for line in motion.describe_events():
    print(" ", line)

path = motion.sample("ball", np.linspace(0, 1.5, 301)).position
print(f"highest {path[:, 2].max():.4f} m, farthest {path[:, 0].max():.4f} m")

ball = scene.bodies.index("ball")
gradient = carom.adjoint(motion, carom.Seed("ball", 1.5, position=(0, 1, 0)))
print("dy/dv", np.round(gradient.velocity[ball], 6), "dy/de", np.round(gradient.elasticity, 6))
print(gradient.reliability.reliable, gradient.reliability.unreliable_for)

edit = carom.Edit(scene)
edit.vary(carom.velocity("ball"), carom.angular_velocity("ball", weight=0.5))
edit.nail("ball", carom.nth_impact(1, "floor")).position(1.0, 0.5, None)
result = edit.solve(effort="fast")
print(result.status)
for number in result.changed:
    print(f"  {number.name:28} {number.before:8.4f} -> {number.after:8.4f}")
