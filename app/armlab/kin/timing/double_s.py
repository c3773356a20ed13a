"""The double-S speed profile: the jerk is bounded, so the acceleration has no jumps."""

from __future__ import annotations

import math
from typing import Any

from armlab.kin.field import Field
from armlab.kin.motion.law import Law, PolynomialLaw
from armlab.kin.motion.law_types import LawType
from armlab.kin.motion.limits import Limits
from armlab.kin.motion.piecewise import integrated
from armlab.kin.timing.trapezoidal import END_SPEEDS, check_end_speeds, ramps_of, refuse_short

HALVINGS = 200
"""Largest number of halvings of the interval of the peak speed; about 60 reach the last digit."""


def make(duration: float, distance: float, options: dict[str, Any]) -> Law:
    """Return the law whose ramps take a given share of the time, a given share of each with constant jerk."""
    t_a, t_d, v = ramps_of(duration, distance, options)
    v_0, v_1, share = options["sdot_start"], options["sdot_end"], options["rounding"]
    times: list[float] = []
    jerks: list[float] = []
    for t, change in ((t_a, v - v_0), (t_d, v_1 - v)):
        part = share * t
        # The area under the acceleration, a trapezoid, is the change of speed.
        jerk = change / (part * (t - part))
        times += [part, max(t - 2.0 * part, 0.0), part, max(duration - t_a - t_d, 0.0)]
        jerks += [jerk, 0.0, -jerk, 0.0]
    return PolynomialLaw(integrated(times[:-1], jerks[:-1], [0.0, v_0, 0.0]))


def fastest(limits: Limits, distance: float, options: dict[str, Any]) -> Law:
    """Return the fastest law with bounded speed, acceleration and jerk, the acceleration zero at both ends.

    The distance of speeding up to v and slowing down again grows with v, so the peak speed is the limit where that
    fits, and otherwise found by halving. This takes in every case: no constant speed, no constant acceleration, end
    speeds.

    Raises
    ------
    InputError
        An end speed above the limit, or a distance too short to get from one end speed to the other.

    References
    ----------
    Biagiotti and Melchiorri, *Trajectory Planning for Automatic Machines and Robots*, 2008, section 3.4.
    """
    v_0, v_1 = options["sdot_start"], options["sdot_end"]
    v, a, j = (float(limit) for limit in limits.each)
    check_end_speeds(v_0, v_1, v)
    least = max(v_0, v_1)
    refuse_short(_covered(v_0, least, a, j) + _covered(least, v_1, a, j), distance, v_0, v_1)

    def missing(v: float) -> float:
        return distance - _covered(v_0, v, a, j) - _covered(v, v_1, a, j)

    if math.isinf(v) or missing(v) < 0.0:
        v = _root(missing, least, v)
    coast = max(missing(v) / v, 0.0)
    up, down = _ramp(v - v_0, a, j), _ramp(v - v_1, a, j)
    jerk_up, jerk_down = [j, 0.0, -j], [-j, 0.0, j]
    return PolynomialLaw(integrated([*up, coast, *down], [*jerk_up, 0.0, *jerk_down], [0.0, v_0, 0.0]))


def _ramp(change: float, a: float, j: float) -> tuple[float, float, float]:
    """Return the times of rising, constant and falling acceleration for a change of speed."""
    if change >= a * a / j:
        return a / j, change / a - a / j, a / j
    part = math.sqrt(change / j)
    return part, 0.0, part


def _covered(v_0: float, v_1: float, a: float, j: float) -> float:
    """Return the distance of a ramp: it is symmetric, so the mean speed is that of its ends."""
    return 0.5 * (v_0 + v_1) * sum(_ramp(abs(v_1 - v_0), a, j))


def _root(missing: Any, low: float, high: float) -> float:
    """Return the largest speed at which nothing is missing, by bisection."""
    if math.isinf(high):
        high = max(2.0 * low, 1e-3)
        while missing(high) > 0.0:
            high *= 2.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        low, high = (middle, high) if missing(middle) >= 0.0 else (low, middle)
    return low


LAW = LawType(
    "double_s",
    "Double S (bounded jerk)",
    7,
    make,
    fastest,
    fields=(
        Field("ramp", "T_a/T", "share of each ramp, when the duration is given", "number", 1 / 3, 0.0, 0.5, above=True),
        Field("rounding", "T_j/T_a", "share of growing acceleration in a ramp", "number", 0.3, 0.0, 0.5, above=True),
        *END_SPEEDS,
    ),
    needs=("acceleration", "jerk"),
)
