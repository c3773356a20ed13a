"""Orientation along s in [0, 1]: by three Euler angles, or about one axis.

Each gives the rotation R(s), the angular velocity omega per unit of s, and its derivative, all in the axes in which R
is given (the world). With a timing law s(t) the angular velocity is omega(s) s', the angular acceleration
omega(s) s'' + omega'(s) s'^2.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats
from armlab.kin.euler import euler_angles
from armlab.kin.motion.law import Law
from armlab.kin.rotations import (
    axis_angle,
    is_rotation,
    rotation_about,
    rotation_from_axis_angle,
    rotation_from_sequence,
)

Floats = NDArray[np.float64]

HALF_TURN = 1e-7
"""Distance from pi, in radians, within which both directions of turning are equally short, as for matrices with eight
decimals."""

STILL = 1e-12
"""Angle, in radians, below which there is no rotation."""


class Orientation(ABC):
    """Rotations along s.

    Attributes
    ----------
    pieces : ndarray, shape (k,)
        Interior s where one formula ends and the next begins.
    corners : ndarray, shape (c,)
        Those of them where the angular velocity may jump.
    remarks : tuple of str
    """

    pieces: Floats = np.zeros(0)
    corners: Floats = np.zeros(0)
    remarks: tuple[str, ...] = ()

    @property
    def goes_on(self) -> bool:
        """Whether the angular velocity goes on without a jump from one formula to the next somewhere."""
        return len(self.pieces) > len(self.corners)

    @abstractmethod
    def rotation(self, s: ArrayLike) -> Floats:
        """Return R(s), (..., 3, 3)."""

    @abstractmethod
    def angular(self, s: ArrayLike) -> tuple[Floats, Floats]:
        """Return omega and d omega / ds per unit of s, (..., 3) each, in world axes."""

    def in_time(self, law: Law, t: ArrayLike) -> tuple[Floats, Floats, Floats]:
        """Return rotation (..., 3, 3), angular velocity in rad/s and angular acceleration in rad/s², (..., 3)."""
        s, ds, dds = law.derivatives(t, (0, 1, 2))
        omega, change = self.angular(s)
        return self.rotation(s), omega * ds[..., None], omega * dds[..., None] + change * ds[..., None] ** 2


@dataclass(frozen=True, eq=False)
class AxisAngle(Orientation):
    """A turn about one axis: R_A R(r, theta s). Make one with `about_one_axis`.

    Attributes
    ----------
    start : ndarray, shape (3, 3)
        R_A.
    axis : ndarray, shape (3,)
        Unit vector r, in the axes of R_A.
    angle : float
        theta_AB, radians; negative or more than pi when the long way was asked for.
    remarks : tuple of str
    """

    start: Floats
    axis: Floats
    angle: float
    remarks: tuple[str, ...] = ()

    def rotation(self, s: ArrayLike) -> Floats:
        """Return R(s)."""
        turned = np.asarray(s, dtype=float) * self.angle
        return np.asarray(self.start @ rotation_from_axis_angle(self.axis, turned))

    def angular(self, s: ArrayLike) -> tuple[Floats, Floats]:
        """Return the constant omega and zeros, (..., 3) each."""
        shape = np.shape(s)
        omega = np.broadcast_to(self.start @ self.axis * self.angle, (*shape, 3))
        return np.array(omega), np.zeros((*shape, 3))


def about_one_axis(R_A: ArrayLike, R_B: ArrayLike, *, other_way: bool = False) -> AxisAngle:
    """Return the turn from one orientation to another about the axis of R_A^T R_B.

    Parameters
    ----------
    R_A, R_B : array_like, shape (3, 3)
    other_way : bool
        The long way round: by theta - 2 pi. At a half turn, where both ways are as short, the other of the two.

    Raises
    ------
    InputError
        Not rotations, or the same with ``other_way``: a whole turn about no axis in particular.

    References
    ----------
    Notes 6.151-6.155, with theta(0) = 0. At theta = pi the axis may be r or -r: the notes leave it open, here r is the
    one whose last component that is not zero is positive, and the choice is a remark.
    """
    start, end = _rotation(R_A, "R_A"), _rotation(R_B, "R_B")
    axis, angle = axis_angle(start.T @ end)
    theta = float(angle)
    if theta < STILL and other_way:
        raise InputError("other_way: both orientations are the same; a whole turn could be about any axis")
    remarks: tuple[str, ...] = ()
    if theta > math.pi - HALF_TURN:
        way = "−r" if other_way else "r"
        remarks = (f"A half turn: about r or −r, both as short. Chosen: {way}. The arm turns the other way with −r.",)
    return AxisAngle(start, np.asarray(axis, dtype=np.float64), theta - 2.0 * math.pi if other_way else theta, remarks)


@dataclass(frozen=True, eq=False)
class EulerAngles(Orientation):
    """Three angles, each growing evenly from start to end. Make one with `by_euler_angles`.

    Attributes
    ----------
    axes : str
        The sequence, such as ``"zxz"``.
    fixed : bool
        Whether about fixed axes.
    start, end : ndarray, shape (3,)
        Angles in radians, in the order of the sequence.
    remarks : tuple of str
    """

    axes: str
    fixed: bool
    start: Floats
    end: Floats
    remarks: tuple[str, ...] = ()

    def angles(self, s: ArrayLike) -> Floats:
        """Return the three angles, (..., 3)."""
        return np.asarray(self.start + np.asarray(s, dtype=float)[..., None] * (self.end - self.start))

    def rotation(self, s: ArrayLike) -> Floats:
        """Return R(s)."""
        return np.asarray(rotation_from_sequence(self.axes, self.angles(s), fixed=self.fixed))

    def angular(self, s: ArrayLike) -> tuple[Floats, Floats]:
        """Return omega, the sum of rates times axes after the turns before them, and its derivative, (..., 3) each."""
        angles = self.angles(s)
        order = (2, 1, 0) if self.fixed else (0, 1, 2)
        turned = np.broadcast_to(np.eye(3), (*angles.shape[:-1], 3, 3))
        omega, change = np.zeros(angles.shape), np.zeros(angles.shape)
        for k in order:
            axis = turned[..., :, "xyz".index(self.axes[k])]
            rate = self.end[k] - self.start[k]
            change = change + rate * np.cross(omega, axis)
            omega = omega + rate * axis
            turned = turned @ rotation_about(self.axes[k], angles[..., k])
        return omega, change


def by_euler_angles(R_A: ArrayLike, R_B: ArrayLike, axes: str = "zxz", *, fixed: bool = False) -> EulerAngles:
    """Return the orientation with evenly growing Euler angles, to show how it wanders.

    Start and end angles are the principal ones; each angle goes the short way round. Where an end is singular only a
    sum or difference is defined there: the third angle is then taken as that of the other end, and this is a remark.

    Raises
    ------
    InputError
        Not rotations, or not one of the 12 sequences.

    References
    ----------
    Notes 6.150.
    """
    start, end = _rotation(R_A, "R_A"), _rotation(R_B, "R_B")
    found = euler_angles(np.stack([start, end]), axes, fixed=fixed)
    angles = found.solutions[:, 0].copy()
    remarks = []
    for k, name in ((0, "start"), (1, "end")):
        if found.singular[k]:
            third = angles[1 - k, 2] if not found.singular[1 - k] else 0.0
            # first + c third is what is defined.
            angles[k, 0] -= found.combination[k] * third
            angles[k, 2] = third
            remarks.append(f"The {name} is singular for {axes.lower()}: infinitely many angles; one pair is chosen.")
    turn = 2.0 * math.pi
    change = angles[1] - angles[0]
    short = change - turn * np.round(change / turn)
    # Principal middle angles are at most a half turn apart, and another turn of them is another way.
    short[1] = change[1]
    return EulerAngles(axes.lower(), fixed, angles[0], angles[0] + short, tuple(remarks))


def wandering(one: Orientation, other: Orientation, count: int = 201) -> float:
    """Return the largest angle in radians between two orientations at equal s, a measure of how they deviate."""
    s = np.linspace(0.0, 1.0, count)
    between = np.swapaxes(one.rotation(s), -1, -2) @ other.rotation(s)
    return float(axis_angle(between)[1].max())


def swept(orientation: Orientation, count: int = 401) -> float:
    """Return the total angle turned through in radians, the integral of |omega| over s; it is least about one axis."""
    nodes, weights = np.polynomial.legendre.leggauss(20)
    edges = np.unique(np.concatenate([np.linspace(0.0, 1.0, max(count // 20, 1) + 1), orientation.pieces]))
    low, width = edges[:-1, None], np.diff(edges)[:, None]
    omega, _ = orientation.angular((low + width * (0.5 + 0.5 * nodes)).ravel())
    speeds = np.linalg.norm(omega, axis=-1).reshape(-1, len(nodes))
    return float(np.sum(speeds * weights * width / 2.0))


def _rotation(R: ArrayLike, where: str) -> Floats:
    matrix = as_floats(R, where, "a 3 x 3 rotation matrix")
    if not is_rotation(matrix):
        raise InputError(f"{where}: expected a 3 x 3 rotation matrix (orthonormal, determinant 1)")
    return matrix


def held(R: ArrayLike) -> AxisAngle:
    """Return an orientation that is constant."""
    return AxisAngle(_rotation(R, "R"), np.array([0.0, 0.0, 1.0]), 0.0)
