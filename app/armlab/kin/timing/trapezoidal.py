"""The trapezoidal speed profile: full acceleration, constant speed, full deceleration (bang-coast-bang)."""

from __future__ import annotations

import math
from typing import Any

from armlab.errors import InputError
from armlab.kin.field import Field
from armlab.kin.motion.extremes import SLACK
from armlab.kin.motion.law import Law, PolynomialLaw
from armlab.kin.motion.law_types import LawType
from armlab.kin.motion.limits import Limits
from armlab.kin.motion.piecewise import integrated

END_SPEEDS = (
    Field("sdot_start", "ṡ_i", "speed of s at the start", "number", 0.0, low=0.0, unit="1/s", was="v_start"),
    Field("sdot_end", "ṡ_f", "speed of s at the end", "number", 0.0, low=0.0, unit="1/s", was="v_end"),
)


def ramps_of(duration: float, distance: float, options: dict[str, Any]) -> tuple[float, float, float]:
    """Return the times of both ramps and the constant speed between them, from the share of the ramps.

    With symmetric ramps each covers its mean speed times its time, whatever its shape.

    Raises
    ------
    InputError
        The end speeds alone cover more than the distance: s would have to go back.
    """
    t_a, t_d = duration * options["ramp"], duration * options["ramp"]
    v_0, v_1 = options["sdot_start"], options["sdot_end"]
    v = (distance - 0.5 * v_0 * t_a - 0.5 * v_1 * t_d) / (duration - 0.5 * t_a - 0.5 * t_d)
    if v < 0.0:
        raise InputError(
            f"sdot_start and sdot_end: at {v_0:g} and {v_1:g} ramps alone go farther than {distance:g} in "
            f"{duration:g} s; lower them, or take less time"
        )
    return t_a, t_d, v


def make(duration: float, distance: float, options: dict[str, Any]) -> Law:
    """Return the law with ramps of a given share of the time.

    References
    ----------
    Notes 6.104-6.113.
    """
    t_a, t_d, v = ramps_of(duration, distance, options)
    v_0, v_1 = options["sdot_start"], options["sdot_end"]
    times = [t_a, max(duration - t_a - t_d, 0.0), t_d]
    return PolynomialLaw(integrated(times, [(v - v_0) / t_a, 0.0, (v_1 - v) / t_d], [0.0, v_0]))


def fastest(limits: Limits, distance: float, options: dict[str, Any]) -> Law:
    """Return the fastest law with bounded speed and acceleration.

    With speed limit V, accelerations a and d and end speeds v_0, v_1 the peak is the smaller of V and
    sqrt((2 L a d + v_0^2 d + v_1^2 a) / (a + d)); below V there is no constant part (triangle).

    Raises
    ------
    InputError
        An end speed or a deceleration above its limit, or a distance too short to get from one end speed to the other.

    References
    ----------
    Notes 6.110-6.113. For short ways, where they give no formulas: v = sqrt(L a), T_s = sqrt(L / a), T = 2 T_s.
    """
    v_0, v_1 = options["sdot_start"], options["sdot_end"]
    most, a = float(limits.velocity), float(limits.acceleration)
    d = a if options["sddot_down"] is None else options["sddot_down"]
    if d > a * (1.0 + SLACK):
        raise InputError(f"sddot_down: expected at most the limit of acceleration {a:g}, got {d:g}")
    check_end_speeds(v_0, v_1, most)
    needed = (v_1 * v_1 - v_0 * v_0) / (2.0 * a) if v_1 > v_0 else (v_0 * v_0 - v_1 * v_1) / (2.0 * d)
    refuse_short(needed, distance, v_0, v_1)
    top = math.sqrt((2.0 * distance * a * d + v_0 * v_0 * d + v_1 * v_1 * a) / (a + d))
    v = min(most, max(top, v_0, v_1))
    t_a, t_d = (v - v_0) / a, (v - v_1) / d
    left = distance - 0.5 * (v_0 + v) * t_a - 0.5 * (v + v_1) * t_d
    coast = max(left / v, 0.0) if v < top else 0.0
    return PolynomialLaw(integrated([t_a, coast, t_d], [a, 0.0, -d], [0.0, v_0]))


def check_end_speeds(v_start: float, v_end: float, most: float) -> None:
    """Raise `InputError` when an end speed is above the limit."""
    for where, value in (("sdot_start", v_start), ("sdot_end", v_end)):
        if value > most:
            raise InputError(f"{where}: expected at most the speed limit {most:g}, got {value:g}")


def refuse_short(needed: float, distance: float, v_start: float, v_end: float) -> None:
    """Raise `InputError` when the distance is too short for the change of speed."""
    if needed > distance * (1.0 + 1e-12):
        raise InputError(
            f"distance: to get from speed {v_start:g} to {v_end:g} within the limits takes at least {needed:.6g}, got "
            f"{distance:.6g}"
        )


LAW = LawType(
    "trapezoidal",
    "Trapezoid of speed (bang-coast-bang)",
    5,
    make,
    fastest,
    fields=(
        Field("ramp", "T_s/T", "share of each ramp, when the duration is given", "number", 1 / 3, 0.0, 0.5, above=True),
        *END_SPEEDS,
        Field(
            "sddot_down",
            "s̈_dec",
            "deceleration of s, at most its limit; left out: that",
            "number",
            low=0.0,
            above=True,
            unit="1/s²",
            was="deceleration",
        ),
    ),
    needs=("acceleration",),
)
