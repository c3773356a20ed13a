"""Solutions that move on while the tool nearly stands still, within the tolerance of a reached target.

A hand that is turned out of a straight wrist by 1e-7 rad is exact for two values of joint 4, and reached with any. So
is a tool that is pushed out of a family in any other way. Newton's method knows the exact ones alone: here a step is
made along a direction in which the tool hardly moves, and the others make up for it as well as they can.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.many_at_once import damped_steps, many_at_once
from armlab.kin.ik.verdict import task_error_of
from armlab.kin.ik.verified import reaches
from armlab.kin.transforms import inverse

Vector = NDArray[np.float64]

SLACK = 3e-3
"""Singular value of the scaled Jacobian, relative to the largest, below which the tool hardly moves (a slack
direction). A configuration 1e-6 away from a fold has one of about the root of that."""

DEPENDENT = 1e-5
"""Product of the two smallest singular values, relative to the square of the largest, above which the arm cannot move
on. Where one is small, the tool leaves in proportion to it; where both are, the second makes up for all but the
product."""

ALL_AROUND = 6
"""Number of directions in a plane of slack ones, every 30 degrees: one so near to that of a curve leads onto it."""

MIXED, ALIKE = 0.5, 0.98
"""Part of a joint's motion that lies along slack directions, when there are more of them, from which it is tried by
itself; and the cosine of two such motions that count as one."""

STEP = 0.35
"""Length of a step over all joints, in radians or length scales; half-way the target has to be reached as well."""

LOOSEST = 1e-5
"""Largest tolerance, as a scaled error: for a tiny arm the usual one is more than the whole arm."""

WEAK, CORRECTIONS = 1e-4, 7
"""Singular value, relative to the largest, below which a direction is hardly corrected on the way back; number of
corrections."""


def is_dependent(values: Vector) -> NDArray[np.bool_]:
    """Return whether singular values (..., k), largest first, are small enough for the arm to move on."""
    return np.asarray(values[..., -1] * values[..., -2:].max(axis=-1) < DEPENDENT * values[..., 0] ** 2)


def slack_ways(ways: Vector) -> Vector:
    """Return unit directions (k, n) of a curve through a solution, from an orthonormal basis of the slack ones (r, n).

    A curve leaves along any mixture of these.
    """
    some = ways
    if len(ways) == 2:
        angles = np.pi / ALL_AROUND * np.arange(ALL_AROUND)[:, None]
        some = np.cos(angles) * ways[0] + np.sin(angles) * ways[1]
    elif len(ways) > 2:
        mixed = ways.T @ ways
        sizes = np.linalg.norm(mixed, axis=1)
        some = np.vstack([ways, mixed[sizes > MIXED] / sizes[sizes > MIXED, None]])
        some = some[~np.tril(np.abs(some @ some.T) > ALIKE, -1).any(axis=1)]
    return np.concatenate([some, -some])


def moved_on(arm: Arm, q: Vector, T: Vector) -> list[Vector]:
    """Return the configurations reached by steps from a solution q (n,) of a target T (4, 4) in the world, if any."""
    G = np.asarray(inverse(arm.base) @ T, dtype=np.float64)
    _, values, basis = np.linalg.svd(many_at_once(arm).linearised(q[None], G)[0][0])
    basis = basis[: len(values)][values < SLACK * values[0]]
    if not len(basis):
        return []
    target = task_error_of(arm).target(T)
    ways = np.repeat(slack_ways(basis), 2, axis=0)
    many, scales = many_at_once(arm), np.where(arm.revolute, 1.0, arm.length_scale)
    parts = np.tile([1.0, 0.5], len(ways) // 2)[:, None]
    straight = q + STEP * parts * ways * scales
    there = straight.copy()
    best, least = there.copy(), np.full(len(there), np.inf)
    for _ in range(CORRECTIONS):
        J, e = many.linearised(there, G)
        sizes = (e * e).sum(axis=1)
        better = sizes < least
        best[better], least[better] = there[better], sizes[better]
        J = J - (J @ ways[:, :, None]) * ways[:, None, :]
        there = there + damped_steps(J, e, (WEAK * float(values[0])) ** 2) * scales
    aside = np.linalg.norm((best - straight) / scales, axis=1)
    near = (least <= LOOSEST**2) & (aside < 0.5 * STEP * parts[:, 0])
    good = np.array([near[k] and reaches(arm, row, target) for k, row in enumerate(best)])
    return list(best[::2][good[::2] & good[1::2]])
