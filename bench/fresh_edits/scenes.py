# SPDX-License-Identifier: MIT
"""Random scenes and hidden motions for fresh edits. Everything follows from the generator of random numbers that is passed in."""

import json
import math
import subprocess

GRAVITY = 9.81
OCTAHEDRON = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]


class NoMotion(Exception):
    """The scene has no motion that serves: another one is drawn."""


def rounded(x, digits=4):
    return [rounded(y, digits) for y in x] if isinstance(x, list) else round(x, digits)


def vector(r, low, high):
    return [rounded(r.uniform(a, b)) for a, b in zip(low, high)]


def turn(r):
    q = [r.gauss(0, 1) for _ in range(4)]
    n = math.sqrt(sum(x * x for x in q))
    return [x / n for x in q]


def shape(r, kind, size):
    if kind == "sphere":
        return {"sphere": {"radius": rounded(size / 2)}}
    if kind == "box":
        return {"box": {"size": vector(r, [size * 0.5] * 3, [size * 1.2] * 3)}}
    if kind in ("capsule", "cylinder", "cone"):
        return {kind: {"radius": rounded(size * r.uniform(0.2, 0.4)), "height": rounded(size * r.uniform(0.5, 1.1))}}
    corners = [[c * size * 0.5 * r.uniform(0.7, 1.2) for c in p] for p in OCTAHEDRON]
    return {"hull": {"points": rounded(corners)}}


def body(name, shape, position, **more):
    return {"name": name, "material": "m", "density": 400, "shape": shape, "position": rounded(position), **more}


def floor():
    return {"name": "floor", "fixed": True, "material": "m", "shape": {"plane": {"normal": [0, 0, 1]}}}


def wall(name, size, position):
    return {"name": name, "fixed": True, "material": "m", "shape": {"box": {"size": size}}, "position": rounded(position)}


def document(r, duration, bodies, elasticity=None, friction=None):
    return {"carom": 1, "duration": duration,
            "materials": {"m": {"elasticity": rounded(r.uniform(0.4, 0.85) if elasticity is None else elasticity),
                                "friction": rounded(r.uniform(0.05, 0.5) if friction is None else friction)}},
            "bodies": bodies}


def moving(scene, name):
    return next(b for b in scene["bodies"] if b["name"] == name)


def simulate(carom, scene, times=()):
    """The answer of `carom simulate --json`, with states at these times."""
    command = [carom, "simulate", "-", "--json"] + [w for t in times for w in ("--at", repr(t))]
    done = subprocess.run(command, input=json.dumps(scene), capture_output=True, text=True)
    if done.returncode not in (0, 5):
        raise RuntimeError(f"carom simulate: {done.stderr}")
    answer = json.loads(done.stdout)
    if answer["status"] != "complete":
        raise NoMotion(answer["message"])
    return answer


def impacts(answer, name=None, other=None):
    return [e for e in answer["events"] if e["kind"] == "impact" and e.get("counts", True)
            and (name is None or name in e["bodies"]) and (other is None or other in e["bodies"])]


def states(carom, scene, name, times):
    answer = simulate(carom, scene, times)
    return [s["bodies"][name] for s in answer["states"]]


def different_throw(r, scene, name, much=1.0, spin=3.0):
    """The start of an edit: the same scene with another throw."""
    start = json.loads(json.dumps(scene))
    b = moving(start, name)
    b["velocity"] = [rounded(v + r.uniform(-much, much)) for v in b.get("velocity", [0, 0, 0])]
    b["angular_velocity"] = [rounded(w + r.uniform(-spin, spin)) for w in b.get("angular_velocity", [0, 0, 0])]
    return start
