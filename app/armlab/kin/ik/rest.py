"""The test whether an arm is at rest for a target, and the way down when it only balances.

A vanishing slope is not enough. A stretched arm whose hand is pulled inwards does not slope anywhere: bending the elbow
to either side comes closer, and the arm balances between the two like a ball on a saddle. A saddle and a minimum differ
in the sign of the curvature, over the joints that may move.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.closest import Closest
from armlab.kin.ik.problem import Errors

PUSH = 1e-6
"""Scaled slope of the error above which a joint at its limit pushes against it."""

REST = 1e-3
"""Slope, relative to the scaled error, below which it counts as zero: near a boundary the error is flat, and a descent
stops when a step gains less than a billionth."""

BEND = 1e-3
"""Curvature, relative to the scaled error, that counts as downhill; a smaller one would gain nothing visible."""

AT = 1e-9
"""Distance in rad or m within which a joint is at its limit."""

NEAR = 1e-3
"""Room, in scaled units, that is too little to leave a balance that way; at most a quarter of a narrow range."""


def pushing(
    q: NDArray[np.float64], slope: NDArray[np.float64], low: NDArray[np.float64], high: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Return which joints are at a limit and pulled outwards, (n,)."""
    return np.asarray(((q <= low + AT) & (slope < -PUSH)) | ((q >= high - AT) & (slope > PUSH)))


def is_flat(slope: NDArray[np.float64], held: NDArray[np.bool_], errors: Errors) -> bool:
    """Return whether the error has no slope along the joints that are not held."""
    return bool(np.all(np.abs(slope[~held]) < REST * math.sqrt(errors.cost)))


def way_down(
    closest: Closest,
    q: NDArray[np.float64],
    target: Sequence[float],
    free: Sequence[float] | None,
    low: NDArray[np.float64],
    high: NDArray[np.float64],
) -> NDArray[np.float64] | None:
    """Return a direction in which the error falls: down the slope, or where there is none along the curvature.

    Parameters
    ----------
    closest : Closest
    q, low, high : ndarray, shape (n,)
        Configuration and the range it may move in, rad or m.
    target : sequence of 12 floats
        See `TaskError.target`.
    free : sequence of float, optional
        1 for joints that may move, 0 for others.

    Returns
    -------
    ndarray, shape (n,), or None
        Change of the joint values, rad or m, the largest by 1 rad or one length scale. It does not leave the range.
        None at a minimum.
    """
    free = [1.0] * len(q) if free is None else free
    slope, H, errors = closest.curve(q.tolist(), target, free)
    if not math.isfinite(errors.cost):
        return None  # An overflow, far outside every workspace.
    held = pushing(q, slope, low, high) | (np.array(free) == 0.0)
    scales = _scales(closest.arm)
    if not is_flat(slope, held, errors):
        return _unscaled(np.where(held, 0.0, slope), scales)
    margin = np.minimum(NEAR * scales, (high - low) / 4.0)
    lowest, highest = q <= low + margin, q >= high - margin
    # A direction out of all joints may be cut to nothing by limits where one out of those inside them is not.
    for movable in (~held, ~(held | lowest | highest)):
        for d in _bent_down(H, movable, BEND * math.sqrt(errors.cost)):
            side = _side(closest.arm, q, slope, d)
            for way in (side * d, -side * d):
                inside = np.where((lowest & (way < 0.0)) | (highest & (way > 0.0)), 0.0, way)
                if inside @ H @ inside < -BEND * math.sqrt(errors.cost) * (inside @ inside):
                    return _unscaled(inside, scales)
    return None


def _bent_down(H: NDArray[np.float64], movable: NDArray[np.bool_], least: float) -> list[NDArray[np.float64]]:
    """Return the principal directions (n,) of the movable joints along which the error curves down, steepest first."""
    values, vectors = np.linalg.eigh(H[np.ix_(movable, movable)])
    directions = np.zeros((len(values), len(movable)))
    directions[:, movable] = vectors.T
    return list(directions[values < -least])


def _side(arm: Arm, q: NDArray[np.float64], slope: NDArray[np.float64], d: NDArray[np.float64]) -> float:
    """Return the sign of a direction to take: downhill, else towards the middle of the limits, else plus."""
    if abs(slope @ d) > PUSH:
        return math.copysign(1.0, slope @ d)
    room = float(d @ ((arm.limits.mean(axis=1) - q) / _scales(arm)))
    if abs(room) > REST:
        return math.copysign(1.0, room)
    # Plus for the joint that moves most; the first of those that are equal up to rounding.
    return math.copysign(1.0, d[int(np.argmax(np.round(np.abs(d), 6)))])


def _unscaled(way: NDArray[np.float64], scales: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.asarray(way / np.abs(way).max() * scales)


def _scales(arm: Arm) -> NDArray[np.float64]:
    return np.where(arm.revolute, 1.0, arm.length_scale)
