"""The exact largest values of a motion and its derivatives, and when they exceed limits.

Between the ends of pieces a motion is smooth; there it is written as Chebyshev series, exactly where it is a
polynomial, and their extremes and crossings are found from roots. Nothing between two samples can be missed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats
from armlab.kin.motion.extremes import Extremes, exceeding, extremes_of_series, outside
from armlab.kin.motion.field import positive_bounds
from armlab.kin.motion.series import Series, series_of
from armlab.kin.motion.trajectory import Motion

Floats = NDArray[np.float64]

Quantity = Literal["position", "velocity", "acceleration", "jerk"]
QUANTITIES: tuple[Quantity, ...] = ("position", "velocity", "acceleration", "jerk")

LIMIT_SLACK = 1e-9
"""Rad or m beyond a joint limit that count as rounding."""


@dataclass(frozen=True)
class Violation:
    """A limit exceeded for a while.

    Attributes
    ----------
    joint : int
        1-based.
    quantity : str
        ``"position"``, ``"velocity"``, ``"acceleration"`` or ``"jerk"``.
    start, end : float
        Seconds.
    """

    joint: int
    quantity: Quantity
    start: float
    end: float


def motion_series(motion: Motion, order: int) -> Series:
    """Return a derivative of a motion as Chebyshev series over time."""
    degree = None if motion.degree is None else max(motion.degree - order, 0)
    return series_of(lambda t: motion.at(t, order), motion.edges, degree)


def peaks(motion: Motion, order: int) -> Extremes:
    """Return the range of a derivative of each coordinate over a motion, with the times.

    Parameters
    ----------
    motion : Motion
    order : int
        0: position, 1: velocity, 2: acceleration, 3: jerk between jumps of the acceleration.

    References
    ----------
    Notes 6.161-6.162; ends of pieces are included.
    """
    return extremes_of_series(motion_series(motion, order))


def violations(
    motion: Motion,
    *,
    positions: Any = None,
    velocity: Any = None,
    acceleration: Any = None,
    jerk: Any = None,
) -> list[Violation]:
    """Return when which limit is exceeded, in the order of time.

    Parameters
    ----------
    motion : Motion
    positions : array_like, shape (m, 2), optional
        Smallest and largest value of each coordinate.
    velocity, acceleration, jerk : array_like, shape (m,) or (), optional
        Of the absolute values; positive, infinite where there is none.

    Raises
    ------
    InputError
        A limit that is not positive (the text names the joint), or a wrong shape.
    """
    found: list[Violation] = []
    if positions is not None:
        low, high = _position_limits(positions, motion.m)
        found += _named("position", outside(motion_series(motion, 0), low, high, LIMIT_SLACK))
    for order, limits in ((1, velocity), (2, acceleration), (3, jerk)):
        if limits is not None:
            bounds = positive_bounds(limits, f"limit of {QUANTITIES[order]}", motion.m)
            if np.isfinite(bounds).any():
                found += _named(QUANTITIES[order], exceeding(motion_series(motion, order), bounds))
    return sorted(found, key=lambda violation: (violation.start, violation.joint, violation.quantity))


def _named(quantity: Quantity, intervals: list[list[tuple[float, float]]]) -> list[Violation]:
    return [Violation(j + 1, quantity, low, high) for j, each in enumerate(intervals) for low, high in each]


def _position_limits(positions: Any, m: int) -> tuple[Floats, Floats]:
    limits = as_floats(positions, "positions", f"{m} pairs of numbers")
    if limits.shape != (m, 2) or not np.isfinite(limits).all():
        raise InputError(f"positions: expected {m} pairs of finite numbers, got shape {limits.shape}")
    for j, (low, high) in enumerate(limits):
        if low > high:
            raise InputError(f"positions of joint {j + 1}: the smaller comes first, got [{low:g}, {high:g}]")
    return limits[:, 0], limits[:, 1]
