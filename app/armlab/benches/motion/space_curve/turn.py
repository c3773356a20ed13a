"""Turning from one orientation to another: about one axis, and by three angles, side by side."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.motion import about_one_axis, by_euler_angles, swept, wandering
from armlab.kin.motion.orientation import AxisAngle, EulerAngles
from armlab.kin.rotations import axis_angle, rotation_from_sequence

Floats = NDArray[np.float64]
Triple = tuple[float, float, float]

SAMPLES = 201


class TurnQuestion(NamedTuple):
    """Arguments of the two turns.

    Attributes
    ----------
    axes : str
        One of the 12 sequences.
    fixed : bool
    start, end : (float, float, float)
        Angles of R_A and R_B, radians.
    other_way : bool
        Whether the turn about one axis goes the long way round.
    """

    axes: str
    fixed: bool
    start: Triple
    end: Triple
    other_way: bool


@dataclass(frozen=True, eq=False)
class Turned:
    """Both turns.

    Attributes
    ----------
    straight : AxisAngle
        R_A R(r, theta s), notes 6.151-6.155.
    euler : EulerAngles
        The angles as they were typed, each growing evenly, notes 6.150.
    swept : (float, float)
        The whole angle turned through by each, radians.
    wandering : float
        The largest angle between both at the same s, radians.
    s : ndarray, shape (N,)
    rotations : (ndarray, ndarray), shape (N, 3, 3)
    apart : ndarray, shape (N,)
        The angle between both, radians.
    rates : (ndarray, ndarray), shape (N,)
        |omega| per unit of s, radians.
    remarks : tuple of str
    """

    straight: AxisAngle
    euler: EulerAngles
    swept: tuple[float, float]
    wandering: float
    s: Floats
    rotations: tuple[Floats, Floats]
    apart: Floats
    rates: tuple[Floats, Floats]
    remarks: tuple[str, ...]


def rotation_of(axes: str, fixed: bool, angles: Triple) -> Floats:
    """Return the matrix of three angles, (3, 3)."""
    return np.asarray(rotation_from_sequence(axes, angles, fixed=fixed), dtype=np.float64)


@lru_cache(maxsize=64)
def turned(question: TurnQuestion) -> Turned:
    """Return both turns.

    Raises
    ------
    InputError
        The long way between two orientations that are the same.
    """
    axes, fixed, start, end, other_way = question
    R_A, R_B = rotation_of(axes, fixed, start), rotation_of(axes, fixed, end)
    straight = about_one_axis(R_A, R_B, other_way=other_way)
    euler = EulerAngles(axes, fixed, np.array(start), np.array(end))
    s = np.linspace(0.0, 1.0, SAMPLES)
    one, other = straight.rotation(s), euler.rotation(s)
    apart = axis_angle(np.swapaxes(one, -1, -2) @ other)[1]
    rates = (np.linalg.norm(straight.angular(s)[0], axis=1), np.linalg.norm(euler.angular(s)[0], axis=1))
    singular = by_euler_angles(R_A, R_B, axes, fixed=fixed).remarks
    return Turned(
        straight,
        euler,
        (swept(straight), swept(euler)),
        wandering(straight, euler),
        s,
        (one, other),
        np.asarray(apart),
        rates,
        (*straight.remarks, *singular),
    )


def written(axes: str, fixed: bool, R_A: Floats, R_B: Floats) -> tuple[Triple, Triple]:
    """Return the angles of two orientations in a sequence; each goes the short way from the first to the second."""
    found = by_euler_angles(R_A, R_B, axes, fixed=fixed)
    return _triple(found.start), _triple(found.end)


def _triple(angles: Floats) -> Triple:
    # Rounding of a matrix would turn 90° into 89.999999...: a person reads and types three decimals.
    x, y, z = (float(np.round(angle, 12)) + 0.0 for angle in angles)
    return x, y, z
