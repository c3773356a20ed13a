"""All forms of the orientation of the body: matrix, axis and angle, quaternion, three angles in both triples."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.forms.state import Body
from armlab.kin.euler import euler_angles
from armlab.kin.nearest import NearestRotation, nearest_rotation
from armlab.kin.quaternions import unit
from armlab.kin.rotations import rotation_from_quaternion
from armlab.kin.velocity.rates import lost_axis, rate_determinant
from armlab.session.state import State

Floats = NDArray[np.float64]

STILL = 1e-9
"""Half of an angle, radians, below which there is no rotation, and every axis is right."""

SAME = 1e-9
"""Largest difference of an entry of two equal rotations."""


@dataclass(frozen=True, eq=False)
class Triples:
    """Three angles of an orientation.

    Attributes
    ----------
    shown, other : ndarray, shape (3,)
        Radians in the order of the sequence; at a singularity both are the same.
    singular : bool
    combination : int
        At a singularity what is defined: 1 for first + third, -1 for first - third; elsewhere 0.
    defined : float
        That sum or difference, radians in (-pi, pi]; elsewhere 0.
    determinant : float
        Of the matrix T from the rates of the angles to omega: 0 at a singularity.
    lost : ndarray, shape (3,)
        At a singularity the axis, in the base frame, about which no rates of the angles turn the body.
    """

    shown: Floats
    other: Floats
    singular: bool
    combination: int
    defined: float
    determinant: float
    lost: Floats

    @property
    def inverse_condition(self) -> float:
        """Return the smallest over the largest singular value of T, which are the roots of 1 - c and 1 + c.

        There c is the cosine between the first axis and the third, and det T the sine.
        """
        sine = min(abs(self.determinant), 1.0)
        return sine / (1.0 + math.sqrt(1.0 - sine**2))


@dataclass(frozen=True, eq=False)
class Forms:
    """One orientation in all forms.

    Attributes
    ----------
    R : ndarray, shape (3, 3)
    q : ndarray, shape (4,)
        Of unit length, with the sign that was typed or dragged to.
    length : float
        Of the quaternion as it was typed.
    axis : ndarray, shape (3,)
        Of unit length.
    angle : float
        About it, radians in (-2 pi, 2 pi].
    still : bool
        Whether there is no rotation: the axis is then free.
    triples : Triples
    nearest : NearestRotation or None
        Of the matrix that was typed, as long as the body is where it put it.
    """

    R: Floats
    q: Floats
    length: float
    axis: Floats
    angle: float
    still: bool
    triples: Triples
    nearest: NearestRotation | None


def forms_of(state: State) -> Forms:
    """Return all forms of the present orientation."""
    return forms(state[Body])


def forms(part: Body) -> Forms:
    """Return all forms of the orientation of a body."""
    q = unit(part.q)
    R = np.asarray(rotation_from_quaternion(q), dtype=np.float64)
    axis, angle, still = turn_of(q, part.axis)
    nearest = None if part.matrix is None else nearest_rotation(part.matrix)
    if nearest is not None and np.abs(nearest.rotation - R).max() > SAME:
        nearest = None
    triples = triples_of(R, part.axes, part.fixed, np.array(part.angles))
    return Forms(R, q, math.hypot(*part.q), axis, angle, still, triples, nearest)


def turn_of(q: Floats, towards: tuple[float, float, float]) -> tuple[Floats, float, bool]:
    """Return axis (3,), angle and whether there is no rotation, of a unit quaternion, with the axis that way."""
    hint = np.array(towards) / math.hypot(*towards)
    size = float(np.linalg.norm(q[1:]))
    if size < STILL:
        return hint, 0.0 if q[0] > 0.0 else 2.0 * math.pi, True
    axis = q[1:] / size
    angle = 2.0 * math.atan2(size, float(q[0]))
    return (axis, angle, False) if axis @ hint >= 0.0 else (-axis, -angle, False)


def triples_of(R: Floats, axes: str, fixed: bool, near: Floats) -> Triples:
    """Return both triples of angles of a rotation, first the one that is nearer to given angles (3,).

    At a singularity the third angle is the given one, and the first makes up the sum or difference.
    """
    found = euler_angles(R, axes, fixed=fixed)
    one, two = found.solutions
    sign = int(found.combination)
    defined = float(one[0])
    if bool(found.singular):
        one = two = np.array([defined - sign * near[2], one[1], near[2]])
    shown, other = _beside(one, near), _beside(two, near)
    if np.linalg.norm(other - near) < np.linalg.norm(shown - near):
        shown, other = other, shown
    return Triples(
        shown,
        _principal(other),
        bool(found.singular),
        sign,
        defined if sign else 0.0,
        float(rate_determinant(shown, axes, fixed)),
        np.asarray(lost_axis(shown, axes, fixed)),
    )


def _beside(angles: Floats, near: Floats) -> Floats:
    """Return angles, moved by whole turns to the nearest place to given ones."""
    away = angles - near
    return np.asarray(near + away - 2.0 * math.pi * np.round(away / (2.0 * math.pi)))


def _principal(angles: Floats) -> Floats:
    return np.array([math.remainder(float(angle), 2.0 * math.pi) for angle in angles])
