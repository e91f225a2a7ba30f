# SPDX-License-Identifier: MIT
# peer: diffsol
# requires: pydiffsol==0.6.2 numpy==2.4.6
# package: pydiffsol
"""diffsol (its Python package): equations of motion, events and what happens at them are written here in its language
DiffSL, which it compiles. Forward sensitivities, which it carries through events; double precision."""

import sys
import time
from pathlib import Path

HERE = str(Path(__file__).parent)
sys.path = [p for p in sys.path if p not in (HERE, "")]  # this file has the name of the package
import numpy as np
import pydiffsol as ds

sys.path.insert(0, HERE)
import peer
import problems

peer.ready()

TOLERANCES = (1e-6, 1e-9, 1e-12)
LIFT = 1e-13  # m, above the surface after an impact: at zero the next event would be found at once

BALL = f"""
in_i {{ h = 1, s = 1, e = 0.8 }}
u_i {{ z = h, v = s }}
F_i {{ v, {-problems.GRAVITY} }}
stop_i {{ z }}
reset_i {{ {LIFT}, -e * v }}
out_i {{ z, v }}
"""

TOP = """
in_i { a = 1, b = 1, c = 1, A = 1, B = 1, C = 1 }
u_i { q0 = 1, q1 = 0, q2 = 0, q3 = 0, x = a, y = b, z = c }
F_i {
  (-q1 * x - q2 * y - q3 * z) / 2,
  (q0 * x + q2 * z - q3 * y) / 2,
  (q0 * y + q3 * x - q1 * z) / 2,
  (q0 * z + q1 * y - q2 * x) / 2,
  (B - C) / A * y * z,
  (C - A) / B * z * x,
  (A - B) / C * x * y,
}
R_i {
  1 - 2 * (q2 * q2 + q3 * q3), 2 * (q1 * q2 - q0 * q3), 2 * (q1 * q3 + q0 * q2),
  2 * (q1 * q2 + q0 * q3), 1 - 2 * (q1 * q1 + q3 * q3), 2 * (q2 * q3 - q0 * q1),
  2 * (q1 * q3 - q0 * q2), 2 * (q2 * q3 + q0 * q1), 1 - 2 * (q1 * q1 + q2 * q2),
}
out_i {
  R_i[0] * x + R_i[1] * y + R_i[2] * z,
  R_i[3] * x + R_i[4] * y + R_i[5] * z,
  R_i[6] * x + R_i[7] * y + R_i[8] * z,
  R_i[0], R_i[1], R_i[2], R_i[3], R_i[4], R_i[5], R_i[6], R_i[7], R_i[8],
}
"""


def two_balls_text():
    p = problems.HIT
    reach = 2 * p.fixed["radius"]
    names = "xyz"
    apart = [f"(a{n} - b{n})" for n in names]
    closing = " + ".join(f"(a{n} - b{n}) * (u{n} - v{n})" for n in names)
    square = " + ".join(f"{d} * {d}" for d in apart)
    places = [f"{body}{n}" for body in "ab" for n in names]
    set_apart = [f"b{n} + {reach * (1 + LIFT)!r} / sqrt({square}) * {d}" for n, d in zip(names, apart)] + places[3:]
    start = [f"{body}{n} = {x}" for body in "ab" for n, x in zip(names, p.fixed["place of " + body])]
    start += [f"u{n} = s{n}" for n in names] + [f"v{n} = {x}" for n, x in zip(names, p.fixed["velocity of b"])]
    struck = [f"u{n} + j / A * (a{n} - b{n})" for n in names]
    struck += [f"v{n} - j / B * (a{n} - b{n})" for n in names]
    return f"""
in_i {{ sx = 1, sy = 0, sz = 0, A = 1, B = 1, e = 1 }}
u_i {{ {", ".join(start)} }}
F_i {{ ux, uy, uz, vx, vy, vz, 0, 0, 0, 0, 0, 0 }}
j {{ -(1 + e) * ({closing}) / (1 / A + 1 / B) / {reach * reach} }}
stop_i {{ {square} - {reach * reach} }}
reset_i {{ {", ".join(set_apart + struck)} }}
out_i {{ {", ".join(places + [f"{u}{n}" for u in "uv" for n in names])} }}
"""


def main():
    for problem, text in ((problems.BALL, BALL), (problems.TOP, TOP), (problems.HIT, two_balls_text())):
        for tolerance in TOLERANCES:
            start = time.perf_counter()
            try:
                ode = ds.Ode(text, matrix_type=ds.nalgebra_dense, ode_solver=ds.tsit45)
            except Exception as error:  # noqa: BLE001: whatever it refuses is its outcome
                peer.cannot(problem, str(error))
                break
            ode.rtol = ode.atol = ode.sens_rtol = ode.sens_atol = tolerance
            compiling = time.perf_counter() - start
            at, times = np.array(problem.values()), np.array([problem.duration])

            def run():
                solution = ode.solve_fwd_sens(at, times)
                return solution.ys[:, -1].tolist(), np.array(solution.sens)[:, :, -1].T.tolist()
            peer.measure(problem, tolerance, run, "forward sensitivities", compiling)


main()
