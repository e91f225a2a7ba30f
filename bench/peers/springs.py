# SPDX-License-Identifier: MIT
"""Contacts that are damped springs which do not pull, with the restitution of a lone impact that is wanted.

Restitution by damping ratio: T. Schwager, T. Poeschel, Coefficient of restitution and linear-dashpot model revisited,
Granular Matter 9, 2007. `np` is the module of mathematics of the peer (numpy, jax.numpy), so that it can be derived.
"""

import math


def restitution(np, ratio):
    root = np.sqrt(1 - ratio * ratio)
    return np.exp(-2 * ratio / root * np.arctan2(root, ratio))


def damping_ratio(np, elasticity):
    """The inverse of restitution, by Newton's method; derived, its last steps give the derivative of the inverse."""
    def slope(ratio):
        h = 1e-6
        return (restitution(np, ratio + h) - restitution(np, ratio - h)) / (2 * h)
    ratio = 0.25 - 0.2 * (elasticity - 0.5)
    for _ in range(12):
        ratio = ratio - (restitution(np, ratio) - elasticity) / slope(ratio)
    return ratio


def contact_steps(step, exponent):
    """Half a period of the spring, in steps: grows as steps shrink, so that contacts are stepped ever better."""
    return 5 * (0.01 / step) ** exponent


def frequency(ratio, step, exponent):
    """rad/s, of the spring without damping. `exponent`: 0.5 for steps of first order, less for better ones."""
    return math.pi / (contact_steps(step, exponent) * step) / (1 - ratio * ratio) ** 0.5
