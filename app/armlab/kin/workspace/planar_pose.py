"""The pose of a planar arm with two or three links as distance and angle of its tool, and its inverse kinematics."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.ik.rest import AT
from armlab.kin.ik.screws import screws_of
from armlab.kin.ik.solutions import wrapped_rows
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.planar import Signs, lengths_of

Floats = NDArray[np.float64]

STRAIGHT = 1e-9
"""Excess over one of the cosine of an elbow that is rounding."""

FEW, MANY = 91, 2001
"""Values of a joint that are tried to find the tool on a line: when two joints take values, and when one does."""


class Place(NamedTuple):
    """Distance and angle of the tool of a planar arm.

    Attributes
    ----------
    r, theta : float
        Metres and rad: polar coordinates about axis 1, in the axes of the arm's `FirstJoint`.
    psi : float
        Angle of the last link against the direction outward, rad in (-pi, pi].
    """

    r: float
    theta: float
    psi: float


def place_of(arm: Arm, q: ArrayLike) -> Place:
    """Return where the tool of a planar arm is; on the first axis theta is 0.

    Raises
    ------
    InputError
        The arm is not planar with two or three turning joints.
    """
    links = _links(arm)
    absolute = np.cumsum(_senses(arm) * np.asarray(q, dtype=np.float64)) + np.angle(links)
    tip = complex(np.sum(np.abs(links) * np.exp(1j * absolute)))
    r = abs(tip)
    theta = float(np.angle(tip)) if r > STRAIGHT * float(np.abs(links).sum()) else 0.0
    return Place(r, theta, -math.remainder(theta - float(absolute[-1]), math.tau))


def configurations(arm: Arm, place: Place) -> Floats:
    """Return the joint values that put the tool at a place, (k, n): both elbows where there are two.

    For a 2R, psi does not matter. They are inside the limits by whole turns where they can be; where links fold and
    joint 1 is free, one of them.

    Raises
    ------
    InputError
        The arm is not planar with two or three turning joints.
    """
    links = _links(arm)
    lengths, target = np.abs(links), place.r * np.exp(1j * place.theta)
    last = place.theta + place.psi
    wrist = target - lengths[2] * np.exp(1j * last) if arm.n == 3 else target
    a, b = float(lengths[0]), float(lengths[1])
    cosine = (abs(wrist) ** 2 - a * a - b * b) / (2.0 * a * b)
    if abs(cosine) > 1.0 + STRAIGHT:
        return np.empty((0, arm.n))
    bend = math.acos(min(max(cosine, -1.0), 1.0))
    rows = []
    for elbow in (bend, -bend):
        first = float(np.angle(wrist) - np.angle(a + b * np.exp(1j * elbow)))
        rows.append(_joints(arm, np.array([first, first + elbow, last])[: arm.n]))
    found = np.array(rows)
    return found[:1] if np.allclose(np.exp(1j * found[0]), np.exp(1j * found[1]), atol=STRAIGHT) else found


def stretched(arm: Arm, signs: Signs, theta: float) -> Floats:
    """Return the joint values (n,) with all links on the line at angle theta, each outward (1) or back (-1).

    Raises
    ------
    InputError
        The arm is not planar with two or three turning joints, or its limits do not let it stand so.
    """
    absolute = np.array([theta if sign > 0 else theta + math.pi for sign in signs])
    q = _joints(arm, absolute)
    if not arm.within_limits(q):
        raise InputError("the joint limits do not let the arm stand so")
    return q


def along_ray(arm: Arm, theta: float, held: ArrayLike) -> tuple[Floats, Floats]:
    """Return configurations inside the limits with the tool on a ray from the first axis, and its distances there.

    One joint brings the tool onto the ray, exactly; the others take values all over their ranges.

    Parameters
    ----------
    arm : Arm
    theta : float
        Angle of the ray, rad.
    held : array_like, shape (n,)
        Values of the joints that stay, rad; nan of the others.

    Returns
    -------
    q : ndarray, shape (k, n)
    r : ndarray, shape (k,)
        Metres.

    Raises
    ------
    InputError
        The arm is not planar with two or three turning joints.
    """
    links, fixed = _links(arm), np.asarray(held, dtype=np.float64)
    free = np.flatnonzero(np.isnan(fixed))
    if not free.size:
        return fixed[None], np.array([place_of(arm, fixed).r])
    q, joint = _tried(arm, fixed, free), int(free[0])
    tips = np.abs(links) * np.exp(1j * (np.cumsum(_senses(arm) * q, axis=1) + np.angle(links) - theta))
    still, carried = tips[:, :joint].sum(axis=1), tips[:, joint:].sum(axis=1)
    # With the ray as real axis: still + carried exp(i turn) is real.
    length = np.maximum(np.abs(carried), np.finfo(float).tiny)
    sine = np.clip(-still.imag / length, -1.0, 1.0)
    turns = np.stack([np.arcsin(sine), np.pi - np.arcsin(sine)])
    r = still.real + length * np.cos(turns)
    q = np.stack([q, q])
    q[..., joint] = _senses(arm)[joint] * (turns - np.angle(carried))
    rows = np.where(np.isnan(fixed), wrapped_rows(arm, q.reshape(-1, arm.n)), q.reshape(-1, arm.n))
    low, high = arm.limits.T
    met = np.tile(np.abs(still.imag) <= length, 2) & (r.ravel() >= 0.0)
    kept = met & np.all((rows >= low - AT) & (rows <= high + AT), axis=1)
    return rows[kept], r.ravel()[kept]


def _tried(arm: Arm, fixed: Floats, free: NDArray[np.intp]) -> Floats:
    """Return joint values (k, n): zero of the first free joint, all over their ranges of the other free ones."""
    count = FEW if len(free) > 2 else MANY
    low, high = arm.limits.T
    values = [np.linspace(low[i], high[i], count) if i in free[1:] else np.nan_to_num(fixed[[i]]) for i in range(arm.n)]
    return np.stack(np.meshgrid(*values, indexing="ij"), axis=-1).reshape(-1, arm.n)


def _joints(arm: Arm, absolute: Floats) -> Floats:
    """Return joint values, inside the limits if possible, from the angles of the links in the plane."""
    steps = np.diff(absolute - np.angle(_links(arm)), prepend=0.0)
    return np.asarray(wrapped_rows(arm, (_senses(arm) * steps)[None])[0])


def _senses(arm: Arm) -> Floats:
    """Return 1 for joints with the direction of the first and -1 for the others, shape (n,)."""
    z = screws_of(arm).z
    return np.asarray(np.sign(z @ z[0]))


def _links(arm: Arm) -> NDArray[np.complex128]:
    """Return the links at q = 0 as complex numbers in the plane, shape (n,), metres."""
    if lengths_of(arm) is None:
        raise InputError("arm: expected a planar arm of two or three links with revolute joints")
    screws = screws_of(arm)
    points = np.vstack([screws.o, screws.home[:3, 3]])
    axes = arm.base[:3, :3].T @ first_joint(arm).axes
    steps = np.diff(points, axis=0) @ axes[:, :2]
    return np.asarray(steps[:, 0] + 1j * steps[:, 1])
