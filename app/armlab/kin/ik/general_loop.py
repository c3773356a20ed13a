"""A 6R arm as a closed loop of six turns and five constant links, without units.

An arm with six revolute joints has the pose ``T = base E_0 Rz(th_1) E_1 Rz(th_2) ... Rz(th_6) E_6 tool`` with constant
E_i in either convention. The constant motions before the first and behind the last turn are moved into the target:

    Rz(th_1) E_1 Rz(th_2) E_2 Rz(th_3) E_3 Rz(th_4) E_4 Rz(th_5) E_5 Rz(th_6) = H,    th_i = q_i + offset_i.

So does d_1, which slides along the first axis, and a high pedestal or a long tool costs no digits. Lengths are divided
by a third of the sum of those that are left, which makes them about as large as the cosines they meet.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.dh import common_normals, link_transform
from armlab.kin.ik.problem import REACHED_M, REACHED_RAD
from armlab.kin.transforms import inverse, transform

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]
Numbers = NDArray[Any]
"""Arrays of real or complex numbers: the equations of the loop are analytic in its angles."""

JOINTS = 6

LOOSEST = 1e-5
"""Largest tolerance, in units of length: for a tiny arm the usual one is more than the whole arm."""


@dataclass(frozen=True, eq=False)
class Loop:
    """The loop of an arm.

    Attributes
    ----------
    links : ndarray, shape (5, 4, 4)
        E_1 to E_5 with scaled lengths.
    offsets : ndarray, shape (6,)
        th_i - q_i in rad.
    scale : float
        Metres in a unit of length.
    reach : float
        The origin of H is no farther than this from that of frame 0, in units of length.
    """

    links: Floats
    offsets: Floats
    scale: float
    reach: float
    _before: Floats
    _after: Floats

    @classmethod
    def of(cls, arm: Arm) -> Loop:
        """Return the loop of an arm; `InputError` unless it has six revolute joints."""
        if arm.n != JOINTS or not arm.revolute.all():
            kinds = "".join(row.kind for row in arm.rows)
            raise InputError(f"arm: the general solver is for six revolute joints, got {arm.n} joints of kinds {kinds}")
        normals = common_normals(arm.rows, arm.convention)
        slides = [0.0, *(row.d for row in arm.rows[1:])]
        E = [link_transform(a, alpha, d, 0.0) for (a, alpha), d in zip(normals[1:], slides, strict=True)]
        first = link_transform(*normals[0], 0.0, 0.0) @ transform(position=[0.0, 0.0, arm.rows[0].d])
        links = np.array(E[:5], dtype=np.float64)
        lengths = np.linalg.norm(links[:, :3, 3], axis=1)
        sizes = sum(abs(a) for a, _ in normals[1:6]) + sum(map(abs, slides[:5]))
        scale = sizes / 3.0 or 1.0
        links[:, :3, 3] /= scale
        return cls(
            links=links,
            offsets=np.array([row.theta for row in arm.rows]),
            scale=scale,
            reach=float(lengths.sum()) / scale,
            _before=np.array(inverse(arm.base @ first), dtype=np.float64),
            _after=np.array(inverse(E[5] @ arm.tool), dtype=np.float64),
        )

    @property
    def reached(self) -> float:
        """Error, in radians and units of length, below which a pose counts as reached."""
        return min(REACHED_RAD, REACHED_M / self.scale)

    @property
    def allowed(self) -> tuple[float, float]:
        """Errors, in units of length and radians, below which a pose counts as reached; smaller for tiny arms."""
        return min(LOOSEST, REACHED_M / self.scale), REACHED_RAD

    def hands(self, poses: Floats) -> Floats:
        """Return H for tool poses in the world, both of shape (..., 4, 4), H in scaled lengths."""
        H: Floats = self._before @ orthonormal(poses) @ self._after
        H[..., :3, 3] /= self.scale
        return H


def orthonormal(poses: Floats) -> Floats:
    """Return poses (..., 4, 4) with the nearest rotations; those given are such within 1e-6, as `as_pose` checks.

    Newton's iteration for the polar factor, R (3 - R^T R) / 2, squares the deviation at each step: two are enough.
    """
    exact = poses.copy()
    R = exact[..., :3, :3]
    for _ in range(2):
        R = R @ (1.5 * np.eye(3) - 0.5 * np.swapaxes(R, -1, -2) @ R)
    exact[..., :3, :3] = R
    return exact


def turns(angles: Numbers) -> Numbers:
    """Return Rz of angles (...), real or complex, as transforms, shape (..., 4, 4)."""
    R = np.zeros((*angles.shape, 4, 4), dtype=angles.dtype)
    c, s = np.cos(angles), np.sin(angles)
    R[..., 0, 0] = R[..., 1, 1] = c
    R[..., 0, 1], R[..., 1, 0] = -s, s
    R[..., 2, 2] = R[..., 3, 3] = 1.0
    return R


def inverses(T: Floats) -> Floats:
    """Return the inverses of rigid transforms (..., 4, 4) without the checks and conversions in `transforms`."""
    found = np.zeros_like(T)
    R = np.swapaxes(T[..., :3, :3], -1, -2)
    found[..., :3, :3] = R
    found[..., :3, 3:] = -(R @ T[..., :3, 3:])
    found[..., 3, 3] = 1.0
    return found


def principal(angles: Floats) -> Floats:
    """Return angles in (-pi, pi]; values within 1e-12 of -pi become pi, so that rounding does not decide."""
    wrapped = (angles + math.pi) % (2.0 * math.pi) - math.pi
    return np.where(wrapped <= -math.pi + 1e-12, math.pi, wrapped)


def angle_of(ahead: Complex, back: Complex) -> Complex:
    """Return complex angles t (...) from exp(i t) and exp(-i t), up to a common positive factor."""
    with np.errstate(all="ignore"):  # what is at infinity is no root
        angles = -0.5j * np.log(ahead / back)
        turned = np.exp(1j * angles)
        opposite = np.where(np.abs(ahead) >= np.abs(back), ahead / turned, back * turned).real < 0.0
        return np.asarray(np.where(opposite, angles + np.pi, angles))
