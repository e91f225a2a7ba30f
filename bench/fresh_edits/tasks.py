# SPDX-License-Identifier: MIT
"""The families of fresh edits. Each is a function of (random, carom) that returns a scene document with controls and constraints;
those of FEASIBLE are met by a hidden motion, those of IMPOSSIBLE by none."""

import json
import math

from scenes import (GRAVITY, NoMotion, body, different_throw, document, floor, impacts, moving, rounded, shape, simulate, states, turn,
                    vector, wall)

KINDS = ["sphere", "box", "hull", "capsule", "cylinder", "cone"]
THROW = [{"vary": "velocity", "body": "a"}, {"vary": "angular_velocity", "body": "a"}]
SURFACE = [{"vary": "elasticity", "material": "m", "min": 0.1, "max": 0.95}, {"vary": "friction", "material": "m", "max": 1.0}]


def thrown(r, kind=None, duration=2.0, speed=3.0, elasticity=None):
    kind = kind or r.choice(KINDS)
    size = r.uniform(0.06, 0.3)
    a = body("a", shape(r, kind, size), [0, 0, r.uniform(0.4, 1.2)], orientation=turn(r),
             velocity=vector(r, [0.3, -speed / 3, -1], [speed, speed / 3, 3]), angular_velocity=vector(r, [-6] * 3, [6] * 3))
    if kind == "sphere":
        a["orientation"] = [1, 0, 0, 0]
    return document(r, duration, [floor(), a], elasticity=elasticity)


def at(body, when, **targets):
    return {"body": body, "at": when, **targets}


def edited(start, controls, constraints):
    return {**start, "controls": json.loads(json.dumps(controls)), "constraints": constraints}


def place(r, carom):
    scene = thrown(r)
    t = rounded(r.uniform(0.6, 1.8))
    s, = states(carom, scene, "a", [t])
    return edited(different_throw(r, scene, "a"), THROW, [at("a", t, position=s["position"])])


def nth_impact(r, carom):
    scene = thrown(r, duration=3.0)
    found = impacts(simulate(carom, scene), "a", "floor")
    if len(found) < 2:
        raise NoMotion
    n = r.randint(1, min(4, len(found)))
    s, = states(carom, scene, "a", [found[n - 1]["time"]])
    return edited(different_throw(r, scene, "a"), THROW, [at("a", {"impact": n, "with": "floor"}, position=s["position"][:2] + [None])])


def pose(r, carom):
    scene = thrown(r, kind=r.choice(["box", "hull", "cone", "cylinder"]))
    t = rounded(r.uniform(0.5, 1.4))
    s, = states(carom, scene, "a", [t])
    return edited(different_throw(r, scene, "a", 0.7, 2), THROW, [at("a", t, position=s["position"], orientation=s["orientation"])])


def two_nails(r, carom):
    scene = thrown(r, duration=2.5)
    times = [rounded(r.uniform(0.4, 1.0)), rounded(r.uniform(1.2, 2.3))]
    first, last = states(carom, scene, "a", times)
    free = [r.random() < 0.3 for _ in range(3)]
    wanted = [None if f else p for f, p in zip(free, first["position"])]
    if all(free):
        wanted = first["position"]
    return edited(different_throw(r, scene, "a"), THROW + SURFACE, [at("a", times[0], position=wanted),
                                                                   at("a", times[1], position=last["position"])])


def meeting(r, carom):
    a, b = (shape(r, r.choice(["sphere", "box", "capsule"]), r.uniform(0.12, 0.3)) for _ in range(2))
    t = r.uniform(0.3, 0.6)
    va, vb = vector(r, [1, -0.5, 2], [3, 0.5, 3.5]), vector(r, [-3, -0.5, 2], [-1, 0.5, 3.5])
    pa = [-va[0] * t, -va[1] * t, 0.6]
    pb = [-vb[0] * t, -vb[1] * t, 0.6 + (va[2] - vb[2]) * t + r.uniform(-0.05, 0.05)]
    if pb[2] < 0.4:
        raise NoMotion
    scene = document(r, 1.5, [floor(), body("a", a, pa, velocity=va, orientation=turn(r)), body("b", b, pb, velocity=vb, orientation=turn(r))])
    found = impacts(simulate(carom, scene), "a", "b")
    if not found or found[0]["time"] > 0.9:
        raise NoMotion
    t = rounded(found[0]["time"] + r.uniform(0.1, 0.4))
    s, = states(carom, scene, "b", [t])
    return edited(different_throw(r, scene, "a", 0.5, 1), [THROW[0]], [{"body": "a", "hits": "b"}, at("b", t, position=s["position"])][r.randint(0, 1):])


def table(r, balls):
    rails = [wall("rail_east", [0.1, 2, 0.3], [1.05, 0, 0]), wall("rail_west", [0.1, 2, 0.3], [-1.05, 0, 0]),
             wall("rail_north", [2, 0.1, 0.3], [0, 0.55, 0]), wall("rail_south", [2, 0.1, 0.3], [0, -0.55, 0])]
    bodies = [body(n, {"sphere": {"radius": 0.03}}, p, gravity_factor=0) for n, p in balls]
    return document(r, 2.5, rails + bodies, elasticity=0.9, friction=0.05)


def chain(r, carom):
    balls = [("a", vector(r, [-0.9, -0.4, 0], [-0.4, 0.4, 0])), ("b", vector(r, [0, -0.4, 0], [0.4, 0.4, 0])),
             ("c", vector(r, [0.5, -0.4, 0], [0.9, 0.4, 0]))]
    scene = table(r, balls)
    angle = r.uniform(-math.pi, math.pi)
    moving(scene, "a")["velocity"] = rounded([3 * math.cos(angle), 3 * math.sin(angle), 0])
    found = impacts(simulate(carom, scene))
    ab = [e for e in found if set(e["bodies"]) == {"a", "b"}]
    if not ab:
        raise NoMotion
    c = [e for e in found if "c" in e["bodies"]]
    start = different_throw(r, scene, "a", 1.0, 0)
    moving(start, "a")["velocity"][2] = 0
    hits = [{"body": "a", "hits": "b"}] + ([{"body": c[0]["bodies"][0], "hits": c[0]["bodies"][1]}] if c else [])
    if "c" not in found[0]["bodies"] and r.random() < 0.4:
        upto = [e for e in found if "a" in e["bodies"]]
        upto = upto[:next(i for i, e in enumerate(upto) if "b" in e["bodies"]) + 1]
        hits = [{"sequence": [f"a {next(n for n in e['bodies'] if n != 'a')}" for e in upto]}]
    return edited(start, [{"vary": "velocity", "body": "a", "components": ["x", "y"]}], hits)


def rack(r, carom):
    balls = [(f"r{i}{j}", [0.3 + 0.0531 * i, 0.0605 * (j - i / 2), 0]) for i in range(3) for j in range(i + 1)]
    scene = table(r, [("a", [-0.6, r.uniform(-0.2, 0.2), 0])] + balls)
    moving(scene, "a")["velocity"] = vector(r, [2.5, -0.6, 0], [4, 0.6, 0])
    name, t = r.choice(["a"] + [n for n, _ in balls]), rounded(r.uniform(0.6, 1.2))
    s, = states(carom, scene, name, [t])
    if not impacts(simulate(carom, scene), name):
        raise NoMotion
    start = different_throw(r, scene, "a", 0.3, 0)
    moving(start, "a")["velocity"][2] = 0
    return edited(start, [{"vary": "velocity", "body": "a", "components": ["x", "y"]}],
                  [at(name, t, position=[rounded(s["position"][0], 12), s["position"][1], None])])


def quantities(r, carom):
    scene = thrown(r)
    target = wall("post", [0.1, 0.1, 0.8], [r.uniform(1.5, 2.5), r.uniform(0.6, 1), 0.4])
    scene["bodies"].append(target)
    t = rounded(r.uniform(0.5, 1.6))
    s, = states(carom, scene, "a", [t])
    speed = math.sqrt(sum(v * v for v in s["velocity"]))
    asked = [at("a", t, speed=speed), at("a", t, velocity=[s["velocity"][0], None, s["velocity"][2]]),
             at("a", t, angular_velocity=s["angular_velocity"]), at("a", t, position=[s["position"][0], None, None], speed=speed)]
    return edited(different_throw(r, scene, "a"), THROW, [r.choice(asked)])


def rest(r, carom):
    scene = thrown(r, kind=r.choice(["box", "box", "hull"]), duration=6.0, elasticity=r.uniform(0.1, 0.4), speed=2)
    scene["materials"]["m"]["friction"] = rounded(r.uniform(0.4, 0.7))
    a = simulate(carom, scene, [5.0, 6.0])
    before, end = (s["bodies"]["a"] for s in a["states"])
    if before["position"] != end["position"]:
        raise NoMotion
    p = end["position"]
    wanted = [{"min": p[0] - 0.02, "max": p[0] + 0.02}, {"min": p[1] - 0.02, "max": p[1] + 0.02}, None]
    if r.random() < 0.5:
        wanted = [p[0], p[1], None]
    return edited(different_throw(r, scene, "a", 0.4, 1), [THROW[0]], [at("a", {"rest": True}, position=wanted)])


def long(r, carom):
    scene = thrown(r, kind=r.choice(["sphere", "sphere", "box"]), duration=12.0, elasticity=r.uniform(0.85, 0.95), speed=2)
    for x, y, sx, sy in [(3, 0, 0.2, 6), (-3, 0, 0.2, 6), (0, 3, 6, 0.2), (0, -3, 6, 0.2)]:
        scene["bodies"].append(wall(f"wall{x}{y}", [sx, sy, 8], [x, y, 4]))
    found = impacts(simulate(carom, scene), "a")
    if len(found) < 10:
        raise NoMotion
    n = r.randint(8, min(len(found), 25)) - 1
    t = rounded(found[n]["time"] - 0.02)
    s, = states(carom, scene, "a", [t])
    return edited(different_throw(r, scene, "a", 0.2, 0.5), THROW, [at("a", t, position=s["position"])])


def many_nails(r, carom):
    scene = thrown(r, duration=3.0)
    times = sorted(rounded(r.uniform(0.2, 2.9)) for _ in range(r.randint(6, 10)))
    exact = r.sample(range(len(times)), 2)
    nails = []
    for i, s in enumerate(states(carom, scene, "a", times)):
        p = s["position"]
        nails.append(at("a", times[i], position=[p[0], None, p[2]] if i in exact else [{"min": x - 0.03, "max": x + 0.03} for x in p]))
    return edited(different_throw(r, scene, "a", 0.5, 1), THROW + SURFACE, nails)


FEASIBLE = {f.__name__: f for f in (place, nth_impact, pose, two_nails, meeting, chain, rack, quantities, rest, long, many_nails)}
