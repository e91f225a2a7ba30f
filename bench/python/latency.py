# SPDX-License-Identifier: MIT
"""Times of carom.jax for a ball that bounces three times, in microseconds:  latency.py [FILE]

Best of the rounds, all in one process. Beside a value with its gradient stand what it takes through a callback of Python, what
such a callback takes that does nothing, and the simulation with its Jacobian alone. With FILE the table is written there (bench/python/latency.csv).
"""

import pathlib
import sys
import time

import jax
import jax.numpy as jnp
import numpy as np

import carom
import carom.jax
from carom import batches

ROUNDS = 200  # short ones, of which some have the processor to themselves
SCENE = {
    "carom": 1, "gravity": [0, 0, -9.81], "duration": 2, "materials": {"rubber": {"elasticity": 0.8, "friction": 0.5}},
    "bodies": [
        {"name": "floor", "fixed": True, "material": "rubber", "shape": {"plane": {"normal": [0, 0, 1], "offset": 0}}},
        {"name": "ball", "material": "rubber", "mass": 0.06, "shape": {"sphere": {"radius": 0.03}},
         "position": [0, 0, 1], "velocity": [2, 0, 1], "angular_velocity": [0, 10, 0]},
    ],
}


def best(functions):
    """Microseconds a call of each, of the best round; `functions` gives the calls of a round along."""
    least = dict.fromkeys(functions, float("inf"))
    for _ in range(ROUNDS):
        for name, (function, calls) in functions.items():
            function()
            began = time.perf_counter()
            for _ in range(calls):
                function()
            least[name] = min(least[name], 1e6 * (time.perf_counter() - began) / calls)
    return least


def main():
    jax.config.update("jax_enable_x64", True)
    edit = carom.Edit(carom.Scene(SCENE))
    edit.vary(carom.velocity("ball"))
    edit.nail("ball", 2.0).position(3, 0, None)
    evaluator = edit.evaluator()
    start = np.asarray(evaluator.start)
    x = jnp.asarray(start)
    xs = start + 1e-3 * np.random.default_rng(1).standard_normal((256, 3))
    rows, host = carom.jax.rows(evaluator), batches.Rows(evaluator)
    nothing = np.zeros((2, 4))
    callback = jax.jit(lambda x: jax.pure_callback(lambda y: nothing, jax.ShapeDtypeStruct((2, 4), x.dtype), x))
    one = jax.jit(jax.value_and_grad(lambda x: rows(x)[0]))
    assert carom.jax.direct(), "built without XLA's headers"
    jax.block_until_ready(one(x))
    carom.jax.direct = lambda: False
    through_python = carom.jax.rows(evaluator)
    slower = jax.jit(jax.value_and_grad(lambda x: through_python(x)[0]))
    jax.block_until_ready(slower(x))
    carom.jax.direct = lambda: True
    many = jax.jit(jax.vmap(jax.value_and_grad(lambda x: rows(x)[0])))
    times = best({
        "callback of JAX that does nothing": (lambda: jax.block_until_ready(callback(x)), 50),
        "simulation and Jacobian without JAX": (lambda: host.values_and_jacobian(start), 50),
        "value and gradient": (lambda: jax.block_until_ready(one(x)), 50),
        "the same through a callback": (lambda: jax.block_until_ready(slower(x)), 50),
        "a batch of 256": (lambda: jax.block_until_ready(many(xs)), 1),
    })
    times["each of a batch of 256"] = times.pop("a batch of 256") / 256
    table = "what,microseconds\n" + "".join(f"{name},{value:.1f}\n" for name, value in times.items())
    print(table, end="")
    if len(sys.argv) > 1:
        pathlib.Path(sys.argv[1]).write_text(table)


main()
