"""The exact largest values of a motion and its derivatives, and when they exceed limits.

Between the ends of pieces a motion is smooth; there it is written as Chebyshev series, exactly where it is a
polynomial, and their extremes and crossings are found from roots. Nothing between two samples can be missed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import as_floats
from armlab.kin.motion.extremes import Extremes, exceeding, extremes, extremes_of_series, outside
from armlab.kin.motion.limits import Limits, limits_of
from armlab.kin.motion.series import Series, series_of
from armlab.kin.motion.trajectory import Motion

Floats = NDArray[np.float64]

Quantity = Literal["position", "velocity", "acceleration", "jerk"]
QUANTITIES: tuple[Quantity, ...] = ("position", "velocity", "acceleration", "jerk")

LIMIT_SLACK = 1e-9
"""Excess over a joint limit, rad or m, that counts as rounding."""


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
        Seconds; the same where a jump exceeds it.
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


def largest_length(motion: Motion, order: int) -> float:
    """Return the largest length of the vector of a derivative over a motion, such as the speed of a point.

    Parameters
    ----------
    motion : Motion
    order : int
        As of `peaks`; ends of pieces are included from both sides.
    """
    degree = None if motion.degree is None else 2 * max(motion.degree - order, 0)
    squares = extremes(lambda t: np.sum(motion.at(t, order) ** 2, axis=1, keepdims=True), motion.edges, degree)
    return math.sqrt(max(float(squares.highest[0]), 0.0))


def violations(
    motion: Motion, limits: Limits | Arm | None = None, *, positions: Any = None, from_rest: bool = True
) -> list[Violation]:
    """Return when which limit is exceeded, in the order of time.

    A derivative that jumps exceeds every limit of the next one for an instant.

    Parameters
    ----------
    motion : Motion
    limits : Limits or Arm, optional
        Limits of the absolute values of the rates; an arm stands for its own limits.
    positions : array_like, shape (m, 2), optional
        Smallest and largest value of each coordinate; those of an arm when left out.
    from_rest : bool
        Whether all stands still before and after the motion, so that a velocity at its ends is a jump.

    Raises
    ------
    InputError
        Limits of another number of joints.
    """
    if positions is None and isinstance(limits, Arm):
        positions = limits.limits
    found: list[Violation] = []
    if positions is not None:
        low, high = _position_limits(positions, motion.m)
        found += _named("position", outside(motion_series(motion, 0), low, high, LIMIT_SLACK))
    held = _held(limits, motion.m)
    for order, (bounds, finite) in enumerate(zip(held.each, held.bounded, strict=True), start=1):
        if finite:
            between = _named(QUANTITIES[order], exceeding(motion_series(motion, order), bounds))
            found += [*between, *_jumping(motion, order, bounds, between, from_rest)]
    return sorted(found, key=lambda violation: (violation.start, violation.joint, violation.quantity))


def _held(limits: Limits | Arm | None, m: int) -> Limits:
    """Return limits of the rates with a number for each joint; an arm may have none besides those of its positions."""
    if limits is None:
        return Limits().for_joints(m)
    return Limits.of(limits).for_joints(m) if isinstance(limits, Arm) else limits_of(limits, m)


def _jumping(motion: Motion, order: int, bounds: Floats, known: list[Violation], from_rest: bool) -> list[Violation]:
    """Return the violations by jumps of the lower derivative, except where the limit is exceeded already."""
    found = set()
    for lower in range(1, order):
        for joint, time in motion.jumps(lower):
            inside = 0.0 < time < motion.duration
            over = any(each.joint == joint and each.start <= time <= each.end for each in known)
            if np.isfinite(bounds[joint - 1]) and (inside or from_rest) and not over:
                found.add((joint, time))
    return [Violation(joint, QUANTITIES[order], time, time) for joint, time in sorted(found)]


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
