# SPDX-License-Identifier: MIT
# %% [markdown]
# # What is this box made of?
#
# A box was thrown onto the floor, and a camera recorded its pose, with noise. From the recorded motion we estimate the
# coefficients of restitution and friction, the three moments of inertia and the throw itself, each with its standard
# deviation, by least squares through the impacts. Nothing but NumPy and carom is needed.
#
# ## The recorded motion
#
# There is no camera here: the motion is simulated with known numbers, and noise is added. So we can see afterwards what the
# estimate is worth.

# %%
import json

import numpy as np

import carom

END = 0.58  # s; two impacts
TRUTH = {
    "carom": 1, "gravity": [0, 0, -9.81], "duration": END,
    "materials": {"wood": {"elasticity": 0.55, "friction": 0.3}},
    "bodies": [
        {"name": "floor", "fixed": True, "material": "wood", "shape": {"plane": {"normal": [0, 0, 1]}}},
        {"name": "box", "material": "wood", "mass": 0.8, "inertia": [0.0016, 0.0031, 0.0038],
         "shape": {"box": {"size": [0.2, 0.12, 0.1]}}, "position": [0, 0, 0.6], "velocity": [1.5, 0.2, 0.5],
         "orientation": [0.9233805168766388, 0.20519567041703085, -0.3077935056255463, 0.10259783520851543],
         "angular_velocity": [3, -5, 2]},
    ],
}
NOISE = {"position": 5e-4, "orientation": 3e-3}  # m, rad: standard deviations
TIMES = np.linspace(0, END, 36)

motion = carom.simulate(carom.Scene(TRUTH))
exact = motion.sample("box", TIMES)
motion


# %%
def turned(quaternion, vector):
    """The quaternion after a rotation by a vector, rad."""
    half = np.linalg.norm(vector) / 2
    v, w = np.sinc(half / np.pi) / 2 * vector, np.cos(half)
    q0, q = quaternion[0], quaternion[1:]
    return np.array([w * q0 - v @ q, *(w * q + q0 * v + np.cross(v, q))])


def recorded(rng):
    """Positions and orientations as the camera saw them."""
    positions = exact.position + NOISE["position"] * rng.standard_normal(exact.position.shape)
    turns = NOISE["orientation"] * rng.standard_normal((len(TIMES), 3))
    return positions, np.array([turned(q, turn) for q, turn in zip(exact.orientation, turns, strict=True)])


rng = np.random.default_rng(1)
positions, orientations = recorded(rng)

# %% [markdown]
# ## A first guess
#
# The throw comes from the first frames, where the box flies: a parabola through the positions, and the turn from one frame to
# another. Of the material we know little. The friction is guessed low, so that the contacts slide: a contact that sticks does
# not depend on the coefficient, and then nothing could be learned about it.

# %%
def guessed(positions, orientations):
    scene = json.loads(json.dumps(TRUTH))
    scene["materials"]["wood"] = {"elasticity": 0.4, "friction": 0.1}
    box = scene["bodies"][1]
    box["inertia"] = [0.002, 0.003, 0.004]
    first = TIMES[:10]
    without_weight = positions[:10] + 9.81 / 2 * np.outer(first**2, [0, 0, 1])
    box["velocity"], box["position"] = np.polyfit(first, without_weight, 1)
    box["orientation"] = orientations[0]
    (p0, *p), (q0, *q) = orientations[0], orientations[2]
    scalar, vector = q0 * p0 + np.dot(q, p), -q0 * np.array(p) + p0 * np.array(q) - np.cross(q, p)
    box["angular_velocity"] = 2 * np.arctan2(np.linalg.norm(vector), scalar) * vector / np.linalg.norm(vector) / TIMES[2]
    return carom.Scene(scene)


guess = guessed(positions, orientations)
print(guess.to_dict()["bodies"][1]["angular_velocity"])

# %% [markdown]
# ## Least squares
#
# Each recorded pose becomes a nail, and the edit is not solved but evaluated: its rows are the deviations from the recorded
# poses (an orientation row is a component of the rotation vector between the two), and their Jacobian is exact, by one
# reverse pass a row.

# %%
def measurements(scene, positions, orientations, until):
    edit = carom.Edit(scene, until)
    edit.vary(carom.elasticity("wood"), carom.friction("wood"), carom.inertia("box"), carom.position("box"),
              carom.orientation("box"), carom.velocity("box"), carom.angular_velocity("box"))
    for time, position, orientation in zip(TIMES, positions, orientations, strict=True):
        if time <= until:
            edit.nail("box", time).position(*position).orientation(orientation)
    return edit.evaluator()


def gauss_newton(evaluator):
    """Parameters, and residuals and Jacobian in units of the noise, by Gauss-Newton with Levenberg and Marquardt's damping."""
    rows = [row for row in evaluator.rows if row.constraint >= 0]
    wanted = np.array([row.lower for row in rows])
    noise = np.array([NOISE[row.name.split(".")[0]] for row in rows])
    scale = np.array([variable.scale for variable in evaluator.variables])

    def residuals(x):
        point = evaluator.at(x)
        return point, (point.values[:len(rows)] - wanted) / noise if point.available else np.full(len(rows), np.inf)

    x, damping, gain = np.array(evaluator.start), 1.0, 1.0
    point, r = residuals(x)
    while gain > 1e-9 and damping < 1e9:
        jacobian = point.jacobian().entries[:len(rows)] / noise[:, None] * scale
        normal = jacobian.T @ jacobian
        mean = np.trace(normal) / len(normal)
        step = -scale * np.linalg.solve(normal + damping * mean * np.eye(len(normal)), jacobian.T @ r)
        next_point, next_r = residuals(x + step)
        if next_r @ next_r < r @ r:
            gain = 1 - (next_r @ next_r) / (r @ r)
            x, point, r = x + step, next_point, next_r
            damping = max(damping / 10, 1e-14)
        else:
            damping *= 4
    return x, r, point.jacobian().entries[:len(rows)] / noise[:, None]


def identified(positions, orientations):
    """Until before the first impact, then the second, then the end: so the impact sequence is that of the record."""
    scene = guessed(positions, orientations)
    for until in (0.3, 0.45, END):
        evaluator = measurements(scene, positions, orientations, until)
        x, r, jacobian = gauss_newton(evaluator)
        scene = evaluator.scene_at(x)
    return evaluator, x, r, np.linalg.inv(jacobian.T @ jacobian)


evaluator, x, r, covariance = identified(positions, orientations)
deviations = np.sqrt(np.diag(covariance))
box = TRUTH["bodies"][1]
true = [0.55, 0.3, *box["inertia"], *box["position"], 0, 0, 0, *box["velocity"], *box["angular_velocity"]]
print("                                estimate     deviation   true")
for i, variable in enumerate(evaluator.variables):
    shown = "" if variable.name.startswith("orientation") else f"{true[i]:8.4f}"  # measured from the guess
    print(f"{variable.name:28} {x[i]:12.6f} +- {deviations[i]:.6f} {shown}")
print(f"squared residuals {r @ r:.0f}, expected {len(r) - len(x)} +- {np.sqrt(2 * (len(r) - len(x))):.0f}")

# %% [markdown]
# The sum of squared residuals is what noise alone would leave. The moments have larger deviations than their ratios, which
# the flight shows: only the impacts tell moments from mass.

# %%
inertia = slice(2, 5)
correlation = covariance[inertia, inertia] / np.outer(deviations[inertia], deviations[inertia])
print("correlation of the moments:")
print(correlation.round(3))

# %% [markdown]
# ## Are the standard deviations true?
#
# We throw the same box thirty times, with other noise. In units of its standard deviation the error of an estimate has to
# spread by about 1, up to 2 or 3.

# %%
errors = []
for _ in range(30):
    _, x, _, covariance = identified(*recorded(rng))
    errors.append((x[:5] - true[:5]) / np.sqrt(np.diag(covariance)[:5]))
names = ["restitution", "friction", "inertia x", "inertia y", "inertia z"]
for name, mean, spread in zip(names, np.mean(errors, axis=0), np.std(errors, axis=0), strict=True):
    print(f"{name:12} mean {mean:6.2f}, spread {spread:5.2f}")
assert (np.abs(np.mean(errors, axis=0)) < 4 / np.sqrt(30)).all()
assert (np.abs(np.std(errors, axis=0) - 1) < 4 / np.sqrt(60)).all()
