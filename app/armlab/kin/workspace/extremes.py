"""The extreme values of a function of the tool point inside the joint limits, to all digits."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from armlab.kin.workspace.first_joint import FirstJoint

Floats = NDArray[np.float64]
Objective = Callable[[Floats], Floats]

STEPS = 12
"""Largest number of Newton steps; from a neighbouring cell a few are enough."""

DIFFERENCE = 1e-4
"""Step of the central differences, radians or length scales."""

FLAT = 1e-7
"""Curvature, relative to the largest, below which a direction counts as straight."""

STRAIGHT = 1e-3
"""Curvature, relative to the slope, below which Newton's step is too long; it is then cut at `LONGEST`."""

LONGEST = 0.3
"""Largest change of a joint in one step, radians or length scales."""

SHORTENED = (1.0, 0.5, 0.1, 0.01)
"""Fractions of a step that are tried; the best is used."""


def climbed(joint: FirstJoint, q: Floats, objective: Objective) -> Floats:
    """Return a configuration at a local maximum of an objective, inside the limits, found from a near one.

    Newton's method by differences; joints at a limit that would go on are held.

    Parameters
    ----------
    joint : FirstJoint
    q : ndarray, shape (n,)
        Inside the limits but for joint 1, which stays.
    objective : callable
        A function of (u, v), shape (k, 2), with values (k,), metres.
    """
    moving = list(joint.moving)
    low, high = joint.arm.limits[moving].T
    scale = np.where(joint.arm.revolute[moving], 1.0, joint.arm.length_scale)

    def value(x: Floats) -> Floats:
        given = np.tile(q, (len(x), 1))
        given[:, moving] = x * scale
        return objective(joint.split(joint.arm.position(given))[:, :2])

    x, low, high = q[moving] / scale, low / scale, high / scale
    for _ in range(STEPS if moving else 0):
        g, H = _derivatives(value, x)
        free = ~(((x <= low) & (g < 0.0)) | ((x >= high) & (g > 0.0)))
        step = np.zeros_like(x)
        step[free] = _uphill(g[free], H[np.ix_(free, free)])
        tried = np.clip(x + np.outer(SHORTENED, step), low, high)
        values = value(np.vstack([x, tried]))
        best = int(np.argmax(values))
        if best == 0:
            break
        x = tried[best - 1]
    found = q.copy()
    found[moving] = np.clip(x * scale, *joint.arm.limits[moving].T)
    return found


def _derivatives(value: Objective, x: Floats) -> tuple[Floats, Floats]:
    m, h = len(x), DIFFERENCE
    unit = h * np.eye(m)
    pairs = (unit[:, None] + unit[None]).reshape(-1, m)
    points = np.vstack([x, x + unit, x - unit, x + pairs, x - pairs])
    f = value(points)
    up, down = f[1 : 1 + m], f[1 + m : 1 + 2 * m]
    both = (f[1 + 2 * m : 1 + 2 * m + m * m] + f[1 + 2 * m + m * m :]).reshape(m, m)
    once = up + down
    H = (both - once[:, None] - once[None] + 2.0 * f[0]) / (2.0 * h * h)
    return (up - down) / (2.0 * h), np.asarray(0.5 * (H + H.T))


def _uphill(g: Floats, H: Floats) -> Floats:
    """Return Newton's step with every curvature taken as negative, so that it leads uphill."""
    if not len(g):
        return g
    values, vectors = np.linalg.eigh(H)
    least = max(FLAT * float(np.abs(values).max()), STRAIGHT * float(np.abs(g).max()), np.finfo(np.float64).tiny ** 0.5)
    bend = np.maximum(np.abs(values), least)
    step = vectors @ ((vectors.T @ g) / bend)
    longest = float(np.abs(step).max())
    return np.asarray(step * min(1.0, LONGEST / longest)) if longest > 0.0 else step
