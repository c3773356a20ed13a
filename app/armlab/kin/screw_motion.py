"""Screw motions: every rigid motion is a turn about one axis in space with a slide along it (Mozzi, Chasles).

A twist is ``(v; omega)``, the velocity in m/s of that point of the body which is at the origin, and the angular
velocity in rad/s, both in the axes in which the transform is written. Kept for one second it makes the transform
``exp``: the twist is then in m and rad.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats
from armlab.kin.rotations import axis_angle, skew
from armlab.kin.transforms import as_pose, transform

Floats = NDArray[np.float64]
Kind = Literal["none", "translation", "rotation", "screw"]

STILL = 1e-9
"""Angle, radians, below which nothing turns: beside a length of 1 m the axis would be a thousand kilometres away."""

PLACED = 1e-9
"""Length, metres, below which nothing moves."""

SERIES = 0.1
"""Angle, radians, below which coefficients of exponential and logarithm are taken from their series: the first term
that is left out is some 1e-15 of the sum."""


@dataclass(frozen=True, eq=False)
class ScrewMotion:
    """A rigid motion as a screw.

    Attributes
    ----------
    kind : "none", "translation", "rotation" or "screw"
        Nothing moves; it moves without turning, and every line along ``direction`` would do; it turns without moving
        along its axis; it does both.
    direction : ndarray, shape (3,)
        Unit vector along the axis, or of the translation; (0, 0, 1) where nothing moves.
    point : ndarray, shape (3,)
        The point of the axis that is nearest to the origin, metres; the origin where nothing turns.
    angle : float
        About the axis, radians in [0, pi].
    distance : float
        Along the axis, metres, negative against ``direction``; the length of a translation.
    twist : ndarray, shape (6,)
        ``(v; omega)`` in m and rad: the transform is its exponential.
    """

    kind: Kind
    direction: Floats
    point: Floats
    angle: float
    distance: float
    twist: Floats

    @property
    def pitch(self) -> float:
        """Distance along the axis for each radian, m/rad; infinite for a translation, 0 where nothing moves."""
        if self.kind == "none":
            return 0.0
        return math.inf if self.kind == "translation" else self.distance / self.angle

    @property
    def half_turn(self) -> bool:
        """Whether it turns by pi, so that the opposite axis is as good: another screw of the same length."""
        return math.pi - self.angle < STILL

    def at(self, s: ArrayLike) -> Floats:
        """Return the transforms (..., 4, 4) after parts (...) of the motion, at an even rate from 0 to 1."""
        return exponential(as_floats(s, "s", "numbers")[..., None] * self.twist)

    def foot(self, p: ArrayLike) -> Floats:
        """Return the point of the axis that is nearest to a point, both of shape (3,), metres."""
        away = as_floats(p, "p", "three numbers, metres") - self.point
        return np.asarray(self.point + (away @ self.direction) * self.direction)


def screw_motion(T: ArrayLike, where: str = "T") -> ScrewMotion:
    """Return the screw of a rigid transform, the one that turns by half a turn at most.

    With the axis ``omega`` and the angle ``theta`` of R, the part ``d = omega . p`` of the translation is along the
    axis. The rest of p is across it and tells where the axis is: a point c that is only shifted along it fulfils
    ``(I - R) c = p - d omega``, and nearest to the origin is

        c = ((p - d omega) + cot(theta / 2) omega x p) / 2

    Between two poses T1 and T2 the motion is the screw of ``T2 T1^-1``, written where the poses are written.

    Parameters
    ----------
    T : array_like, shape (4, 4)
    where : str
        What it is called in the text of an error.

    Raises
    ------
    InputError
        As of `armlab.kin.transforms.as_pose`.

    References
    ----------
    Lynch and Park, *Modern Robotics*, section 3.3.2; the notes have transforms in 3.4, and axis and angle in 3.2.

    Examples
    --------
    >>> found = screw_motion([[0, -1, 0, 1], [1, 0, 0, 1], [0, 0, 1, 0.5], [0, 0, 0, 1]])
    >>> found.kind, (found.point.round(12) + 0.0).tolist(), round(found.angle, 4), found.distance
    ('screw', [0.0, 1.0, 0.0], 1.5708, 0.5)
    """
    pose = as_pose(T, where)
    R, p = pose[:3, :3], pose[:3, 3]
    axis, turned = (np.asarray(each, dtype=np.float64) for each in axis_angle(R))
    angle, length, nothing = float(turned), float(np.linalg.norm(p)), np.zeros(3)
    if angle < STILL:
        if length < PLACED:
            return ScrewMotion("none", np.array([0.0, 0.0, 1.0]), nothing, 0.0, 0.0, np.zeros(6))
        return ScrewMotion("translation", p / length, nothing, 0.0, length, np.concatenate([p, nothing]))
    distance = float(axis @ p)
    point = 0.5 * (p - distance * axis + np.cross(axis, p) / math.tan(0.5 * angle))
    kind: Kind = "rotation" if abs(distance) < PLACED else "screw"
    return ScrewMotion(kind, axis, point, angle, distance, logarithm(pose))


def exponential(twist: ArrayLike) -> Floats:
    """Return the transforms (..., 4, 4) that twists (..., 6) make in one second.

    With ``S = S(omega)`` and ``theta = |omega|``

        R = I + a S + b S^2,    p = (I + b S + c S^2) v,
        a = sin(theta) / theta,    b = (1 - cos(theta)) / theta^2,    c = (theta - sin(theta)) / theta^3

    Parameters
    ----------
    twist : array_like, shape (..., 6)
        ``(v; omega)`` in m and rad.

    Raises
    ------
    InputError
        The last dimension is not 6, or not finite.

    References
    ----------
    Lynch and Park, *Modern Robotics*, proposition 3.25, with the two powers of theta in front of S and S^2 taken into
    v and omega.

    Examples
    --------
    >>> exponential([0.0, 0.0, 0.5, 0.0, 0.0, np.pi / 2]).round(6).tolist()[0]
    [0.0, -1.0, 0.0, 0.0]
    """
    given = as_floats(twist, "twist", "numbers of shape (..., 6)")
    if given.shape[-1:] != (6,):
        raise InputError(f"twist: expected shape (..., 6), got {given.shape}")
    if not np.isfinite(given).all():
        raise InputError("twist: every number must be finite")
    v, omega = given[..., :3], given[..., 3:]
    theta = np.linalg.norm(omega, axis=-1)[..., None, None]
    S = skew(omega)
    a = np.sinc(theta / math.pi)
    # The half of the angle loses nothing near zero, where 1 - cos does.
    b = 0.5 * np.sinc(0.5 * theta / math.pi) ** 2
    small, safe = theta < SERIES, np.where(theta < SERIES, 1.0, theta)
    square = theta**2
    series = (1.0 - square / 20.0 * (1.0 - square / 42.0 * (1.0 - square / 72.0))) / 6.0
    c = np.where(small, series, (safe - np.sin(safe)) / safe**3)
    S2 = S @ S
    R, V = np.eye(3) + a * S + b * S2, np.eye(3) + b * S + c * S2
    return np.asarray(transform(R, (V @ v[..., None])[..., 0]), dtype=np.float64)


def logarithm(T: ArrayLike) -> Floats:
    """Return the twists (..., 6), ``(v; omega)`` in m and rad, whose exponentials are rigid transforms (..., 4, 4).

    The angle is in [0, pi]; at pi the sense of the axis is that of `armlab.kin.rotations.axis_angle`. With
    ``S = S(omega)``

        v = (I - S / 2 + e S^2) p,    e = (1 - (theta / 2) cot(theta / 2)) / theta^2

    Raises
    ------
    InputError
        Not of shape (..., 4, 4), or no rotation in the upper left block.

    References
    ----------
    Lynch and Park, *Modern Robotics*, section 3.3.3.2.

    Examples
    --------
    >>> logarithm([[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]]).tolist()
    [1.0, 2.0, 3.0, 0.0, 0.0, 0.0]
    """
    given = as_floats(T, "T", "numbers of shape (..., 4, 4)")
    if given.shape[-2:] != (4, 4):
        raise InputError(f"T: expected shape (..., 4, 4), got {given.shape}")
    axis, angle = axis_angle(given[..., :3, :3])
    omega, p = axis * angle[..., None], given[..., :3, 3]
    theta = angle[..., None, None]
    small, safe = theta < SERIES, np.where(theta < SERIES, 1.0, theta)
    square = theta**2
    series = (1.0 + square / 60.0 * (1.0 + square / 42.0 * (1.0 + square / 40.0))) / 12.0
    e = np.where(small, series, (1.0 - 0.5 * safe / np.tan(0.5 * safe)) / safe**2)
    S = skew(omega)
    v = ((np.eye(3) - 0.5 * S + e * (S @ S)) @ p[..., None])[..., 0]
    return np.concatenate([v, omega], axis=-1)
