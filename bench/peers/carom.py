# SPDX-License-Identifier: MIT
# peer: carom
# builds: b=${BUILD:-build/release}; cmake --preset release -B "$b" -DCAROM_BENCH=ON && cmake --build "$b" -t carom_peer
"""carom itself, as a library: carom_peer.cpp, with the problems written as scene documents."""

import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import peer
import problems

PROGRAM = Path(os.environ.get("BUILD", "build/release")).resolve() / "carom_peer"
FLOOR = {"name": "floor", "fixed": True, "material": "m", "shape": {"plane": {"normal": [0, 0, 1], "offset": 0}}}


def scene(problem, bodies, elasticity=0.0, gravity=0.0):
    return {"carom": 1, "gravity": [0, 0, -gravity], "duration": problem.duration,
            "materials": {"m": {"elasticity": elasticity, "friction": 0}}, "bodies": bodies}


def ball():
    p = problems.BALL
    r = p.fixed["radius"]
    body = {"name": "b", "material": "m", "mass": p.fixed["mass"], "shape": {"sphere": {"radius": r}},
            "position": [0, 0, p.value("height") + r], "velocity": [0, 0, p.value("speed")]}
    columns = [lambda row: row["bodies"]["b"]["position"][2], lambda row: row["bodies"]["b"]["velocity"][2],
               lambda row: row["elasticity"]]
    return p, scene(p, [FLOOR, body], p.value("elasticity"), problems.GRAVITY), ["b.position.2", "b.velocity.2"], \
        columns, [r, 0]


def top():
    p = problems.TOP
    values = p.values()
    body = {"name": "b", "material": "m", "mass": p.fixed["mass"], "shape": {"box": {"size": [1, 1, 1]}},
            "inertia": values[3:], "angular_velocity": values[:3]}
    columns = [lambda row, i=i: row["bodies"]["b"]["angular_velocity"][i] for i in range(3)]
    columns += [lambda row, i=i: row["bodies"]["b"]["inertia"][i] for i in range(3)]
    read = [f"b.angular_velocity.{i}" for i in range(3)] + [f"b.rotation.{i}" for i in range(9)]
    return p, scene(p, [body]), read, columns, [0] * len(read)


def two_balls():
    p = problems.HIT
    def body(name, velocity):
        return {"name": name, "material": "m", "mass": p.value("mass of " + name),
                "shape": {"sphere": {"radius": p.fixed["radius"]}}, "position": p.fixed["place of " + name],
                "velocity": velocity}
    bodies = [body("a", p.values()[:3]), body("b", p.fixed["velocity of b"])]
    columns = [lambda row, i=i: row["bodies"]["a"]["velocity"][i] for i in range(3)]
    columns += [lambda row, name=name: row["bodies"][name]["mass"] for name in "ab"] + [lambda row: row["elasticity"]]
    read = [f"{name}.{quantity}.{i}" for quantity in ("position", "velocity") for name in "ab" for i in range(3)]
    return p, scene(p, bodies, p.value("elasticity")), read, columns, [0] * len(read)


def main():
    for problem, document, read, columns, offsets in (ball(), top(), two_balls()):
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            json.dump(document, file)
            file.flush()
            def run(repetitions):
                out = subprocess.run([PROGRAM, file.name, str(repetitions), *read], check=True, capture_output=True)
                return json.loads(out.stdout)
            start = time.perf_counter()
            run(1)
            cold = time.perf_counter() - start
            result = run(2000)
        peer.answer(problem=problem.name, step=None, method="adjoint", seconds=result["seconds"], cold_start=cold,
                    state=[row["value"] - offset for row, offset in zip(result["rows"], offsets)],
                    jacobian=[[column(row) for column in columns] for row in result["rows"]])


main()
