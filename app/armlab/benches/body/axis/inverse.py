"""Axis and angle from the matrix alone, by the formulas of the notes, and what each of them loses."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.forms.rotation import STILL, forms_of
from armlab.kin.axis_angle import angle_by_arccos, angle_by_atan2
from armlab.kin.rotations import axis_angle, rotation_from_axis_angle
from armlab.session.state import State

Floats = NDArray[np.float64]

EPS = float(np.finfo(float).eps)

HALF = 1e-6
"""Distance from pi, radians, up to which -r is called as good an axis as r."""

FINEST = 10.0
"""Smallest distance from 0 or pi at which the formulas are compared: 10 to the power of minus this, radians."""


@dataclass(frozen=True)
class Inverse:
    """Axis and angle as the matrix of the body tells them.

    Attributes
    ----------
    angle : float
        In [0, pi], as it was typed or dragged to: what the formulas should find.
    arccos, atan2, printed : float
        By 3.63, by 3.66 as it is right, and as it is printed; radians.
    axis : (float, float, float)
        Belongs to the positive angle; the opposite one to the negative one.
    still, half : bool
        Whether the angle is 0, so that every axis is right, or half a turn, so that both axes are.
    """

    angle: float
    arccos: float
    atan2: float
    printed: float
    axis: tuple[float, float, float]
    still: bool
    half: bool

    def lost(self, found: float) -> float:
        """Return how many of the sixteen digits of the angle are lost in what a formula has found."""
        if self.angle == 0.0:
            return 0.0
        return max(0.0, math.log10(max(abs(found - self.angle) / self.angle, EPS) / EPS))


def inverse_of(state: State) -> Inverse:
    """Return what the matrix of the body tells of axis and angle."""
    found = state.derived(forms_of)
    angle = 2.0 * math.atan2(float(np.linalg.norm(found.q[1:])), abs(float(found.q[0])))
    axis, _ = axis_angle(found.R)
    still = angle < 2.0 * STILL
    return Inverse(
        angle,
        float(angle_by_arccos(found.R)),
        float(angle_by_atan2(found.R)),
        float(angle_by_atan2(found.R, 0.5)),
        (float(axis[0]), float(axis[1]), float(axis[2])),
        still,
        math.pi - angle < HALF,
    )


def errors(axis: Floats, near: str, powers: Floats) -> tuple[Floats, Floats]:
    """Return the errors of arccos and atan2, radians, shape (N,) each, at distances 10^-power from 0 or pi.

    Parameters
    ----------
    axis : ndarray, shape (3,)
    near : "zero" or "pi"
    powers : ndarray, shape (N,)
    """
    distance = 10.0**-powers
    angle = distance if near == "zero" else math.pi - distance
    axes = np.broadcast_to(axis, (len(powers), 3))
    R = np.asarray(rotation_from_axis_angle(axes, angle), dtype=np.float64)
    return np.abs(angle_by_arccos(R) - angle), np.abs(angle_by_atan2(R) - angle)
