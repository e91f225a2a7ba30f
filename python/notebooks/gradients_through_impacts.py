# SPDX-License-Identifier: MIT
# %% [markdown]
# # Gradients through impacts
#
# A ball without friction is thrown up and bounces three times in two seconds. How does its height at the end change with the
# vertical velocity of the throw? The answer has a closed form, beside which we put carom's gradient and finite differences of
# MuJoCo. MuJoCo is a good simulator of contact that is soft by design; the comparison is about derivatives only.

# %%
import matplotlib.pyplot as plt
import numpy as np

import carom

ELASTICITY, RADIUS, END, G = 0.8, 0.1, 2.0, 9.81

scene = carom.Scene({
    "carom": 1, "gravity": [0, 0, -G], "duration": END,
    "materials": {"rubber": {"elasticity": ELASTICITY, "friction": 0}},
    "bodies": [
        {"name": "floor", "fixed": True, "material": "rubber", "shape": {"plane": {"normal": [0, 0, 1]}}},
        {"name": "ball", "material": "rubber", "mass": 1, "shape": {"sphere": {"radius": RADIUS}},
         "position": [0, 0, 1], "velocity": [1, 0, 1]},
    ],
})
motion = carom.simulate(scene)
motion

# %% [markdown]
# ## In closed form
#
# Between impacts the height is a parabola; an impact turns the velocity v round into e v. The same in numbers that carry a
# derivative:

# %%
def height(v, dv=1.0):
    """Height at the end, m, and its derivative with respect to the vertical velocity of the throw, s."""
    z, dz, left, dleft = 1 - RADIUS, 0.0, END, 0.0
    while True:
        speed = np.sqrt(v * v + 2 * G * z)  # of the impact
        dspeed = (v * dv + G * dz) / speed
        time, dtime = (v + speed) / G, (dv + dspeed) / G
        if time > left:
            return z + v * left - G * left**2 / 2 + RADIUS, dz + dv * left + (v - G * left) * dleft
        v, dv, z, dz = ELASTICITY * speed, ELASTICITY * dspeed, 0.0, 0.0
        left, dleft = left - time, dleft - dtime


exact_height, exact = height(1.0)
print(f"height {exact_height:.15f} m, derivative {exact:.15f} s")

# %% [markdown]
# ## carom

# %%
seed = carom.Seed("ball", END, position=(0, 0, 1))
gradient = carom.adjoint(motion, seed)
derivative = gradient.velocity[scene.bodies.index("ball")][2]
print(f"height     {motion.state_at('ball', END).position[2]:.15f} m")
print(f"derivative {derivative:.15f} s, error {abs(derivative - exact):.1e}")
assert abs(motion.state_at("ball", END).position[2] - exact_height) < 1e-13
assert abs(derivative - exact) < 1e-13

# %% [markdown]
# One reverse pass gives all parameters at once:

# %%
print("with respect to the coefficient of restitution", gradient.elasticity)
print("with respect to gravity", gradient.gravity)

# %% [markdown]
# ## Finite differences of MuJoCo
#
# The contact is a spring with a damper that only push. For a coefficient of restitution e the damping ratio is calibrated by
# its closed form (Schwager and Poeschel, Granular Matter 9, 2007), and the stiffness grows as the step gets finer.

# %%
try:
    import mujoco
except ImportError:
    mujoco = None
    print("MuJoCo is not installed (pip install mujoco): what follows is left out.")


def damping_ratio(e):
    """Of a spring and damper that only push: e falls from 1 to 0 as the ratio grows."""
    low, high = 0.0, 1.0
    for _ in range(60):
        ratio = (low + high) / 2
        root = np.sqrt(1 - ratio**2)
        at = np.exp(-ratio / root * (np.pi - np.arctan2(2 * ratio * root, 1 - 2 * ratio**2)))
        low, high = (ratio, high) if at > e else (low, ratio)
    return low


def model_of(step, stiffness):
    damping = 2 * damping_ratio(ELASTICITY) * np.sqrt(stiffness)
    return mujoco.MjModel.from_xml_string(f"""
      <mujoco>
        <option timestep="{step}" gravity="0 0 {-G}" integrator="RK4"/>
        <default><geom solref="{-stiffness} {-damping}" solimp="0.9999 0.9999 0.001 0.5 2" condim="1"/></default>
        <worldbody>
          <geom type="plane" size="10 10 1"/>
          <body pos="0 0 1"><freejoint/><geom type="sphere" size="{RADIUS}" mass="1"/></body>
        </worldbody>
      </mujoco>""")


def simulated_height(model, v):
    data = mujoco.MjData(model)
    data.qvel[0], data.qvel[2] = 1, v
    for _ in range(round(END / model.opt.timestep)):
        mujoco.mj_step(model, data)
    return data.qpos[2]


# %%
DIFFERENCES = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6]
errors = {}
if mujoco:
    print("step s   height error m   error of the derivative, with a difference of")
    print(" " * 26 + "".join(f"{h:10.0e}" for h in DIFFERENCES) + " m/s")
    for step, stiffness in [(1e-2, 1e3), (1e-3, 1e5), (1e-4, 1e7)]:
        model = model_of(step, stiffness)
        errors[step] = [abs((simulated_height(model, 1 + h) - simulated_height(model, 1 - h)) / (2 * h) - exact)
                        for h in DIFFERENCES]
        off = simulated_height(model, 1.0) - exact_height
        print(f"{step:6.0e} {off:15.1e}    " + "".join(f"{error:10.1e}" for error in errors[step]))

# %% [markdown]
# The height gets better with the step, the derivative does not: where in a step the contact begins moves the state after it
# by a little, and a finer difference divides that by ever less. A coarse difference smooths it and has an error of its own;
# here the derivative itself is 0.05 s. carom has no step and takes no difference.

# %%
figure, axes = plt.subplots()
for step, of_step in errors.items():
    axes.loglog(DIFFERENCES, of_step, "o-", label=f"MuJoCo, step {step:.0e} s")
axes.axhline(max(abs(derivative - exact), 1e-17), color="black", label="carom, no difference")
axes.axhline(abs(exact), color="gray", linestyle=":", label="the derivative itself")
axes.set_xlabel("difference of the velocity (m/s)")
axes.set_ylabel("error of the derivative (s)")
axes.legend();
