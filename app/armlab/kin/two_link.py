"""The planar 2R arm: its velocity ellipse over the distance of the tool from the first axis."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import as_floats
from armlab.kin.dh import link_transform

Array = NDArray[np.float64]

PARALLEL = 1e-9
"""Sine of the angle below which two joint axes are parallel."""


class TwoLink(NamedTuple):
    """Lengths of the two links, metres: between the axes, and from the second axis to the tool point."""

    l1: float
    l2: float

    @property
    def best(self) -> float:
        """The distance r at which w is largest: ``sqrt(l1^2 + l2^2)``, the elbow at a right angle.

        For links of 1 m it is sqrt(2) m (notes, the text after 5.152).
        """
        return math.hypot(self.l1, self.l2)

    @property
    def ends(self) -> tuple[float, float]:
        """The least and the largest distance of the tool from the first axis, metres; both are singular."""
        return abs(self.l1 - self.l2), self.l1 + self.l2

    def sigma(self, r: ArrayLike) -> Array:
        """Return both half axes of the velocity ellipse at distances of the tool from the first axis.

        With ``c2 = (r^2 - l1^2 - l2^2) / (2 l1 l2)`` the trace of J J^T is ``r^2 + l2^2`` and its determinant
        ``(l1 l2 s2)^2``.

        Parameters
        ----------
        r : array_like, shape (...)
            Metres; what is outside `ends` counts as the end.

        Returns
        -------
        ndarray, shape (..., 2)
            Descending, m (m/s for joint speeds of length 1 rad/s); the second is 0 at the ends.

        References
        ----------
        Notes 5.143-5.144 with the Jacobian of 5.50 and the cosine of 4.50.
        """
        low, high = self.ends
        at = np.clip(as_floats(r, "r", "metres"), low, high)
        # w = l1 l2 |s2| is twice the area of the triangle with the sides l1, l2, r: Heron's formula as it is exact.
        w = 0.5 * np.sqrt(np.maximum((high - at) * (high + at) * (at - low) * (at + low), 0.0))
        trace = at**2 + self.l2**2
        largest = np.sqrt(0.5 * (trace + np.sqrt(np.maximum((trace - 2.0 * w) * (trace + 2.0 * w), 0.0))))
        return np.stack([largest, np.divide(w, largest, out=np.zeros_like(w), where=largest > 0.0)], axis=-1)


def two_link(arm: Arm) -> TwoLink:
    """Return the links of an arm with two turning joints about parallel axes.

    Raises
    ------
    InputError
        It is not such an arm, or a link has no length.
    """
    if arm.n != 2 or not arm.revolute.all():
        raise InputError(f"arm: expected two joints that turn, got {arm.n} of which {int(arm.revolute.sum())} turn")
    frames = arm.frames([0.0, 0.0])
    if arm.convention == "standard":
        first, second = frames[0], frames[1]
    else:
        first, second = frames[1], frames[2]
    z = first[:3, 2]
    if np.linalg.norm(np.cross(z, second[:3, 2])) > PARALLEL:
        raise InputError("arm: expected two parallel joint axes")
    l1 = float(_across(second[:3, 3] - first[:3, 3], z))
    l2 = float(_across(arm.position([0.0, 0.0]) - second[:3, 3], z))
    if min(l1, l2) <= PARALLEL * arm.length_scale:
        raise InputError(f"arm: expected two links with a length, got {l1:.6g} m and {l2:.6g} m")
    return TwoLink(l1, l2)


def distance(arm: Arm, q: ArrayLike) -> Array:
    """Return the distance of the tool point from the first joint axis, metres, shape (...) for q of shape (..., n)."""
    root = arm.base @ (np.eye(4) if arm.convention == "standard" else link_transform(*_first(arm), 0.0, 0.0))
    return np.asarray(_across(arm.position(q) - root[:3, 3], root[:3, 2]))


def _first(arm: Arm) -> tuple[float, float]:
    return arm.rows[0].a, arm.rows[0].alpha


def _across(vectors: Array, z: Array) -> Array:
    """Return the length of the part perpendicular to a unit vector."""
    return np.asarray(np.linalg.norm(np.cross(vectors, z), axis=-1))
