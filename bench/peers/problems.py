# SPDX-License-Identifier: MIT
"""The problems that every peer is given, their exact answers, and how an answer is judged.

Peers read the numbers alone. The answers need mpmath and are computed by score.py: closed forms, or a Taylor series in
extended precision, never carom.
"""

from dataclasses import dataclass

GRAVITY = 9.81


@dataclass(frozen=True)
class Problem:
    name: str
    duration: float
    parameters: tuple  # (name, value, quantity): derivatives are asked for by each, in this order
    components: tuple  # (name, group): what is read at the end, in this order
    fixed: dict  # numbers that nothing is derived by
    text: str

    def values(self):
        return [value for _, value, _ in self.parameters]

    def value(self, name):
        return next(value for known, value, _ in self.parameters if known == name)


def named(names, group):
    return tuple((name, group) for name in names.split())


BALL = Problem(
    "ball", 2.1,
    (("height", 1.0, "position"), ("speed", 1.0, "velocity"), ("elasticity", 0.8, "elasticity")),
    named("z", "place") + named("vz", "speed"),
    {"radius": 0.1, "mass": 1.0, "bounces": 3},
    "height (of the lowest point) and speed of a ball after three bounces on a floor")

TOP = Problem(
    "top", 2.0,
    (("wx", 2.0, "spin"), ("wy", 3.0, "spin"), ("wz", 1.0, "spin"),
     ("I1", 1.0, "inertia"), ("I2", 1.5, "inertia"), ("I3", 2.2, "inertia")),
    named("wx wy wz", "spin") + named("R00 R01 R02 R10 R11 R12 R20 R21 R22", "turn"),
    {"mass": 12.0},
    "angular velocity (world) and rotation matrix of a free body with three different moments")

HIT = Problem(
    "two balls", 1.0,
    (("vx", 2.0, "velocity"), ("vy", 0.1, "velocity"), ("vz", -0.05, "velocity"),
     ("mass of a", 1.0, "mass"), ("mass of b", 2.0, "mass"), ("elasticity", 0.7, "elasticity")),
    named("ax ay az", "place of a") + named("bx by bz", "place of b")
    + named("aux auy auz", "velocity of a") + named("bux buy buz", "velocity of b"),
    {"radius": 0.1, "place of a": (-1.0, 0.05, 0.02), "place of b": (0.0, 0.0, 0.0),
     "velocity of b": (-0.1, 0.2, 0.1)},
    "places and velocities of two balls after an oblique hit, without friction and gravity")

PROBLEMS = (BALL, TOP, HIT)


def ball_end(height, speed, elasticity):
    from mpmath import mpf, sqrt
    g, left = mpf(str(GRAVITY)), mpf(str(BALL.duration))
    up = sqrt(speed**2 + 2 * g * height)  # at the floor, downwards
    left -= (speed + up) / g
    for _ in range(BALL.fixed["bounces"]):
        up *= elasticity
        if _ + 1 < BALL.fixed["bounces"]:
            left -= 2 * up / g
    return [up * left - g * left**2 / 2, up - g * left]


def top_end(wx, wy, wz, *moments):
    """Taylor series of Euler's equations and of the quaternion, coefficient by coefficient; the start is not turned."""
    from mpmath import mpf
    order, steps = 26, 50
    h = mpf(str(TOP.duration)) / steps
    q, w = [mpf(1), mpf(0), mpf(0), mpf(0)], [wx, wy, wz]
    ratio = [(moments[(i + 1) % 3] - moments[(i + 2) % 3]) / moments[i] for i in range(3)]
    for _ in range(steps):
        Q, W = [[x] for x in q], [[x] for x in w]
        for n in range(order):
            def product(a, b):
                return sum(a[k] * b[n - k] for k in range(n + 1))
            dw = [ratio[i] * product(W[(i + 1) % 3], W[(i + 2) % 3]) for i in range(3)]
            dq = [(-product(Q[1], W[0]) - product(Q[2], W[1]) - product(Q[3], W[2])) / 2,
                  (product(Q[0], W[0]) + product(Q[2], W[2]) - product(Q[3], W[1])) / 2,
                  (product(Q[0], W[1]) + product(Q[3], W[0]) - product(Q[1], W[2])) / 2,
                  (product(Q[0], W[2]) + product(Q[1], W[1]) - product(Q[2], W[0])) / 2]
            for series, rate in zip(W + Q, dw + dq):
                series.append(rate / (n + 1))
        q, w = ([sum(c * h**k for k, c in enumerate(series)) for series in group] for group in (Q, W))
    R = rotation(q)
    return [sum(R[3 * i + j] * w[j] for j in range(3)) for i in range(3)] + R


def rotation(q):
    """Rotation matrix of a unit quaternion (w, x, y, z), row by row; of numbers of any kind."""
    w, x, y, z = q
    return [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
            2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
            2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]


def hit_end(vx, vy, vz, mass_a, mass_b, elasticity):
    from mpmath import mpf, sqrt
    def exact(numbers):
        return [mpf(str(x)) for x in numbers]
    def dot(u, v):
        return sum(x * y for x, y in zip(u, v))
    a, b, ub = (exact(HIT.fixed[key]) for key in ("place of a", "place of b", "velocity of b"))
    ua, reach, end = [vx, vy, vz], 2 * mpf(str(HIT.fixed["radius"])), mpf(str(HIT.duration))
    apart, closing = [x - y for x, y in zip(a, b)], [x - y for x, y in zip(ua, ub)]
    A, B, C = dot(closing, closing), dot(apart, closing), dot(apart, apart) - reach**2
    t = (-B - sqrt(B * B - A * C)) / A
    normal = [(x + t * y) / reach for x, y in zip(apart, closing)]
    impulse = -(1 + elasticity) * dot(closing, normal) / (1 / mass_a + 1 / mass_b)
    wa = [u + impulse / mass_a * n for u, n in zip(ua, normal)]
    wb = [u - impulse / mass_b * n for u, n in zip(ub, normal)]
    return ([x + t * u + (end - t) * w for x, u, w in zip(a, ua, wa)]
            + [x + t * u + (end - t) * w for x, u, w in zip(b, ub, wb)] + wa + wb)


ENDS = {"ball": ball_end, "top": top_end, "two balls": hit_end}


def truth(problem):
    """State at the end, and its derivatives by the parameters (rows: components), to more than 18 digits."""
    from mpmath import mp, mpf
    mp.dps = 45
    end, at, h = ENDS[problem.name], [mpf(str(v)) for v in problem.values()], mpf(10) ** -10
    state, columns = end(*at), []
    for k in range(len(at)):
        ahead, back = list(at), list(at)
        ahead[k] += h
        back[k] -= h
        columns.append([(x - y) / (2 * h) for x, y in zip(end(*ahead), end(*back))])
    return state, [list(row) for row in zip(*columns)]


def worst(problem, found, exact):
    """Worst relative error of a column: each entry over itself, or over a hundredth of the largest of its group."""
    from mpmath import isfinite, mpf
    largest = {}
    for (_, group), x in zip(problem.components, exact):
        largest[group] = max(largest.get(group, 0), abs(x))
    result = mpf(0)
    for (_, group), x, y in zip(problem.components, exact, found, strict=True):
        if y is None or not isfinite(mpf(y)):
            return float("nan")
        result = max(result, abs(mpf(y) - x) / max(abs(x), largest[group] / 100))
    return float(result)
