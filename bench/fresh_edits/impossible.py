# SPDX-License-Identifier: MIT
"""Edits that no motion meets, each for a reason that is known by construction. PROVABLE are those for which carom has a proof; HARD
are those for which it says that it did not converge: only a false solution would be wrong."""

import math

from scenes import GRAVITY, NoMotion, body, moving, rounded, shape, states, wall
from tasks import KINDS, SURFACE, THROW, at, edited, thrown


def energy(r, carom):
    """Higher than all the energy lifts it, with bounded velocities."""
    scene = thrown(r, speed=2)
    a = moving(scene, "a")
    a["angular_velocity"] = [0, 0, 0]
    most = a["position"][2] + 3 * 3.0 ** 2 / (2 * GRAVITY)
    return edited(scene, [{"vary": "velocity", "body": "a", "min": -3, "max": 3}],
                  [at("a", rounded(r.uniform(0.4, 1.5)), position=[None, None, rounded(most + r.uniform(0.2, 0.6))])])


def rest_in_air(r, carom):
    scene = thrown(r, kind=r.choice(["box", "hull", "cylinder"]))
    scene["bodies"].append(wall("shelf", [0.4, 0.4, 0.1], [r.uniform(1, 2), 0, 0.5]))
    return edited(scene, THROW, [at("a", {"rest": True}, position=[0.2, 0.1, rounded(r.uniform(1.2, 2))])])


def parabola(r, carom):
    """Farther than a bounded throw without contact leads until then."""
    scene = thrown(r, kind="sphere")
    a = moving(scene, "a")
    t = rounded(r.uniform(0.2, 0.3))
    a["position"][2] = 1.5
    return edited(scene, [{"vary": "velocity", "body": "a", "min": -2, "max": 2}],
                  [at("a", t, position=[rounded(2 * t + r.uniform(0.1, 0.5)), None, None])])


def filters(r, carom):
    scene = thrown(r)
    scene["bodies"].append(body("b", shape(r, "sphere", 0.2), [1.5, 0.3, 0.1], collision_filter={"systems": ["b"]}))
    moving(scene, "a")["collision_filter"] = {"not_collide_with": ["b"]}
    return edited(scene, THROW, [{"body": "a", "hits": "b"}])


def locked(r, carom):
    scene = thrown(r, kind="sphere")
    a = moving(scene, "a")
    a["velocity"][1] = 0
    a["angular_velocity"] = [0, 0, 0]
    return edited(scene, [{"vary": "velocity", "body": "a", "components": ["x", "z"]}],
                  [at("a", rounded(r.uniform(0.5, 1.5)), position=[1.0, rounded(r.uniform(0.2, 0.6)), None])])


def in_solid(r, carom):
    scene = thrown(r)
    scene["bodies"].append(wall("block", [0.8, 0.8, 0.8], [1.5, 0, 0.4]))
    return edited(scene, THROW, [at("a", rounded(r.uniform(0.5, 1.5)), position=[1.5, 0, 0.4])])


def two_targets(r, carom):
    scene = thrown(r)
    t = rounded(r.uniform(0.5, 1.5))
    return edited(scene, THROW, [at("a", t, position=[1, None, None]), at("a", t, position=[rounded(r.uniform(1.2, 2)), None, None])])


def before_cause(r, carom):
    """Elasticity alone varies, and the place is before the first impact."""
    scene = thrown(r, kind="sphere")
    moving(scene, "a")["position"][2] = 1.5
    moving(scene, "a")["velocity"][2] = 1.0
    return edited(scene, [SURFACE[0]], [at("a", rounded(r.uniform(0.1, 0.4)), position=[5, None, None])])


def below_floor(r, carom):
    scene = thrown(r)
    return edited(scene, THROW, [at("a", rounded(r.uniform(0.5, 1.5)), position=[0.5, 0, rounded(-r.uniform(0.3, 1))])])


def faster_than_energy(r, carom):
    scene = thrown(r, kind="sphere", speed=2)
    moving(scene, "a")["angular_velocity"] = [0, 0, 0]
    return edited(scene, [{"vary": "velocity", "body": "a", "min": -2, "max": 2}],
                  [at("a", rounded(r.uniform(0.4, 1.5)), speed=rounded(r.uniform(12, 15)))])


def rest_too_high_pose(r, carom):
    """A box is to rest on an edge: it would topple. No proof is known to carom."""
    scene = thrown(r, kind="box", duration=5, elasticity=0.3)
    size = moving(scene, "a")["shape"]["box"]["size"]
    high = math.hypot(size[0], size[1]) / 2
    if high < 1.2 * max(size) / 2:
        raise NoMotion
    c = math.cos(math.pi / 8)
    return edited(scene, THROW, [at("a", {"rest": True}, orientation=[c, math.sin(math.pi / 8), 0, 0])])


def too_soon(r, carom):
    """Two places whose straight way is longer than the bounded speed allows; it may bounce in between."""
    scene = thrown(r, duration=2)
    times = [0.3, 0.35]
    return edited(scene, [{"vary": "velocity", "body": "a", "min": -2, "max": 2}],
                  [at("a", times[0], position=[0.1, None, None]), at("a", times[1], position=[rounded(r.uniform(1, 2)), None, None])])


def through_wall(r, carom):
    """Behind a wall as high as the bounded throw cannot pass, and as wide."""
    scene = thrown(r, kind=r.choice(KINDS))
    a = moving(scene, "a")
    scene["bodies"].append(wall("wall", [0.4, 40, 8], [1.0, 0, 4]))
    a["velocity"] = [1, 0, 1]
    return edited(scene, [{"vary": "velocity", "body": "a", "min": -3, "max": 3}], [at("a", 1.8, position=[2.0, None, None])])


PROVABLE = {f.__name__: f for f in (energy, rest_in_air, parabola, filters, locked, in_solid, two_targets, before_cause, below_floor,
                                    faster_than_energy)}
HARD = {f.__name__: f for f in (rest_too_high_pose, too_soon, through_wall)}
