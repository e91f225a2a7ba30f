# SPDX-License-Identifier: MIT
# %% [markdown]
# # A first edit
#
# A ball is thrown at a floor and a wall. We want it to meet a mark, and carom finds the smallest change of the throw that
# does it. Units are SI, z is up.

# %%
import numpy as np

import carom
import carom.plot

scene = carom.Scene({
    "carom": 1,
    "name": "A throw at a wall",
    "gravity": [0, 0, -9.81],
    "duration": 1.5,
    "materials": {"rubber": {"elasticity": 0.8, "friction": 0.5}},
    "bodies": [
        {"name": "floor", "fixed": True, "material": "rubber", "shape": {"plane": {"normal": [0, 0, 1]}}},
        {"name": "wall", "fixed": True, "material": "rubber", "shape": {"plane": {"normal": [-1, 0, 0], "offset": -2}}},
        {"name": "ball", "material": "rubber", "mass": 0.06, "shape": {"sphere": {"radius": 0.03}},
         "position": [0, 0, 1], "velocity": [3, 0.5, 2]},
    ],
})
motion = carom.simulate(scene)
motion

# %% [markdown]
# A motion shows itself from the side and from above. It is a sequence of events, each at its own time:

# %%
for event in motion.events:
    print(f"{event.time:.4f} s  {event.contacts[0]}")

# %% [markdown]
# What would a faster throw change? The gradient of a reading of the motion has every parameter of the scene. Here it is that
# of x at the end, with respect to the velocity of the throw, to the coefficients of restitution and of friction.

# %%
end = motion.end
gradient = carom.adjoint(motion, carom.Seed("ball", end, position=(1, 0, 0)))
print("dx/dv =", gradient.velocity[scene.bodies.index("ball")])
print("dx/de =", gradient.elasticity, " dx/dmu =", gradient.friction)
print("reliable:", gradient.reliability.reliable)

# %% [markdown]
# Now the edit: velocity and spin of the throw may change (a change of the spin counts half), and the second bounce on the
# floor has to be at a mark.

# %%
edit = carom.Edit(scene)
edit.vary(carom.velocity("ball"), carom.angular_velocity("ball", weight=0.5))
edit.nail("ball", carom.nth_impact(2, "floor")).position(0.5, 0.6, None)
result = edit.solve()
result

# %% [markdown]
# The answer is verified: its scene was simulated afresh. Dashed is the throw as it was.

# %%
assert result.solved and result.met
bounce = result.motion.find_impact("ball", 2, "floor")
place = result.motion.state_at("ball", bounce.time).position
assert np.abs(place[:2] - [0.5, 0.6]).max() < 1e-8
print(result.status, place)

# %%
axes = carom.plot.paths(result.motion, "xz", before=motion)
axes.plot(0.5, 0.03, "x", color="black")
carom.plot.histories(result.motion, "velocity", "z", before=motion);

# %% [markdown]
# Where the command `carom` is at hand, a page plays the motion.

# %%
from IPython.display import display

import carom.notebook

try:
    display(carom.notebook.page(result.motion, before=motion))
except (FileNotFoundError, carom.InputError) as error:
    print("There is no page:", error)
