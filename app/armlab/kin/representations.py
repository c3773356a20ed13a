"""Numbers that represent a configuration: more of them than are needed, or too little said by them.

A representation of r numbers is minimal when these are as many as the degrees of freedom, and unambiguous when one
value of it belongs to one configuration (notes, section 4, before 4.1).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import finite_floats
from armlab.kin.transforms import inverse

Floats = NDArray[np.float64]

PARALLEL = 1e-9
"""Sine of the angle below which two axes are parallel, and length, in half reaches, below which a link has none."""

STRETCHED = 1e-12
"""Distance of the cosine of the elbow from 1 within which the arm counts as stretched or folded: rounding."""


def stick_end(theta: float, length: float) -> tuple[float, float]:
    """Return the free end of a stick that hangs from the origin, turned by theta from straight down.

    Parameters
    ----------
    theta : float
        Radians, counter-clockwise.
    length : float
        Metres.

    References
    ----------
    Notes, figure 4.2: theta is the minimal representation.
    """
    return length * math.sin(theta), -length * math.cos(theta)


def stick_residual(x: float, y: float, length: float) -> float:
    """Return ``x^2 + y^2 - length^2``, m²: 0 where (x, y) can be the end of a stick of this length (notes 4.4).

    >>> stick_residual(0.6, -0.8, 1.0)
    0.0
    """
    return x * x + y * y - length * length


def stick_angle(x: float, y: float) -> float:
    """Return the angle from straight down to a point, radians in (-pi, pi]; 0 for the origin, which has none."""
    return math.atan2(x, -y) if x or y else 0.0


def nearest_stick_end(x: float, y: float, length: float) -> tuple[float, float]:
    """Return the point nearest to (x, y) that can be the end of the stick; straight down for the origin."""
    return stick_end(stick_angle(x, y), length)


# --- A planar 3R described by the place of its third joint and the angle of that joint.


def third_joint_misfit(arm: Arm) -> str | None:
    """Return a sentence why an arm is no planar 3R in the plane of x and y of its frame 0; None when it is one."""
    if arm.n != 3 or not arm.revolute.all():
        kinds = "".join(row.kind for row in arm.rows)
        return f"expected three joints that turn, RRR, but the arm has {kinds}"
    axes = _axes(arm, np.zeros(3))
    if any(math.hypot(*T[:2, 2]) > PARALLEL for T in axes):
        return "expected three axes along z of frame 0, but they are not all parallel to it"
    if min(_lengths(axes)) <= PARALLEL * arm.length_scale:
        return "expected two links with a length before joint 3"
    return None


def by_third_joint(arm: Arm, q: ArrayLike) -> Floats:
    """Return r = (p_x, p_y, q_3) of a planar 3R: where joint 3 is in frame 0, metres, and its angle, radians.

    References
    ----------
    Notes, figure 4.3 and the text before it.
    """
    values = finite_floats(q, "q", (3,), "three finite numbers")
    x, y = _axes(arm, values)[2][:2, 3]
    return np.array([x, y, values[2]])


def third_joint_on_first_axis(arm: Arm, q: ArrayLike) -> bool:
    """Return whether joint 3 of a planar 3R lies on the axis of joint 1: any angle of joint 1 then leaves it there."""
    axes = _axes(arm, finite_floats(q, "q", (3,), "three finite numbers"))
    away = float(np.hypot(*(axes[2] - axes[0])[:2, 3]))
    return away <= PARALLEL * sum(_lengths(axes))


def arms_by_third_joint(arm: Arm, r: ArrayLike) -> Floats:
    """Return all configurations of a planar 3R with r = (p_x, p_y, q_3).

    Parameters
    ----------
    arm : Arm
        For which `third_joint_misfit` is None.
    r : array_like, shape (3,)
        Metres, metres, radians, in frame 0.

    Returns
    -------
    ndarray, shape (k, 3)
        Two in general; one where links 1 and 2 are stretched or folded; none out of their reach. Angles are in
        (-pi, pi]. Where joint 3 is on the axis of joint 1, any angle of joint 1 will do: those with 0 are given.

    Raises
    ------
    InputError
        The arm is no planar 3R.

    References
    ----------
    Notes, figure 4.3; the law of cosines as in 4.50-4.61.
    """
    why = third_joint_misfit(arm)
    if why is not None:
        raise InputError(f"arm: {why}")
    x, y, last = finite_floats(r, "r", (3,), "three finite numbers").tolist()
    axes = _axes(arm, np.zeros(3))
    (l1, l2), first = _lengths(axes), axes[0][:2, 3]
    across = np.array([x, y]) - first
    distance = float(np.hypot(*across))
    cosine = (distance**2 - l1**2 - l2**2) / (2.0 * l1 * l2)
    if abs(cosine) > 1.0 + STRETCHED:
        return np.zeros((0, 3))
    bend = math.acos(min(max(cosine, -1.0), 1.0))
    bends = (bend,) if 1.0 - abs(cosine) <= STRETCHED else (bend, -bend)
    return np.array([[*_joints(axes, across, each, (l1, l2)), last] for each in bends])


def _joints(axes: Floats, across: Floats, bend: float, lengths: tuple[float, float]) -> tuple[float, float]:
    """Return joints 1 and 2 for the angle between links 1 and 2."""
    l1, l2 = lengths
    zero1, zero2 = (math.atan2(*(axes[i + 1] - axes[i])[1::-1, 3]) for i in (0, 1))
    turn = math.atan2(across[1], across[0]) - math.atan2(l2 * math.sin(bend), l1 + l2 * math.cos(bend))
    if math.hypot(*across) <= PARALLEL * (l1 + l2):
        turn = zero1
    signs = [math.copysign(1.0, T[2, 2]) for T in axes]
    return _turn(signs[0] * (turn - zero1)), _turn(signs[1] * (bend - zero2 + zero1))


def _turn(angle: float) -> float:
    """Return an angle in (-pi, pi]."""
    turned = math.remainder(angle, math.tau)
    return math.pi if turned == -math.pi else turned


def _axes(arm: Arm, q: Floats) -> Floats:
    """Return the frames on the axes of the joints, in frame 0, shape (n, 4, 4)."""
    frames = inverse(arm.base) @ arm.frames(q)
    return np.asarray(frames[:-1] if arm.convention == "standard" else frames[1:], dtype=np.float64)


def _lengths(axes: Floats) -> tuple[float, float]:
    """Return the lengths of links 1 and 2, across the axes."""
    l1, l2 = (float(np.hypot(*(axes[i + 1] - axes[i])[:2, 3])) for i in (0, 1))
    return l1, l2
