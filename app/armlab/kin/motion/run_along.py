"""A path with a timing law: as fast as limits allow, or in a given time that keeps them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.field import positive
from armlab.kin.motion.along import moving_ends, restless
from armlab.kin.motion.extremes import SLACK
from armlab.kin.motion.law_types import LawType, law_type
from armlab.kin.motion.limits import Limits, limits_of
from armlab.kin.motion.path import Path
from armlab.kin.motion.peaks import peaks
from armlab.kin.motion.scaling import Scaling, optimal_scaling, refuse_jumps
from armlab.kin.motion.trajectory import Trajectory

LONGER = 1.1
"""Factor from one duration to the next in the search for one that keeps the limits; where only durations between two
of these keep them, it finds none or a longer one."""

NEAR = 1e-13
"""Relative length of the interval in which it is then known: much less than the digits in which it is told."""

DIGITS = 6
"""Significant digits of a duration that is told."""

EXACT = 1e-12
"""Relative excess over a number of so many digits that is rounding."""


def run_along(
    path: Path,
    law: str = "trapezoidal",
    limits: Limits | Arm | None = None,
    *,
    duration: float | None = None,
    **options: Any,
) -> Trajectory:
    """Return a path in joint space with a law; every limit that is given is kept, or refused with the reason.

    Parameters
    ----------
    path : Path
    law : str
        Key of a timing law.
    limits : Limits or Arm, optional
        Limits of the joints; an arm stands for its own limits. They may be left out only with a duration.
    duration : float, optional
        Seconds; left out: as fast as the limits allow.
    **options
        Of the law.

    Raises
    ------
    InputError
        No limits and no duration, a limit that cannot be kept, or a duration that is too short for the limits; the
        text says which is long enough, or that the end speeds are to be lowered.

    Examples
    --------
    >>> from armlab.kin.motion.path_types import path_type
    >>> line = path_type("line").path([[0.0], [1.0]])
    >>> run_along(line, "cubic", Limits(velocity=1.0), duration=1.0)
    Traceback (most recent call last):
    ...
    armlab.errors.InputError: duration: in 1 s joint 1 exceeds its limit of velocity; it takes at least 1.5 s
    """
    kind = law_type(law)
    if duration is None:
        if limits is None:
            raise InputError("limits: give Limits(velocity=..., acceleration=...), an arm, or a duration")
        return Trajectory(path, kind.along(path, limits, **options))
    seconds = positive(duration, "duration")
    if kind.on_path is not None:
        return _stretched(kind, path, limits, seconds, options)
    motion = Trajectory(path, kind.law(seconds, **options))
    if limits is not None:
        held = limits_of(limits, path.m)
        refuse_jumps(motion, held, moving_ends(options))
        _refuse_short(kind, motion, held, options)
    return motion


def _stretched(
    kind: LawType, path: Path, limits: Limits | Arm | None, duration: float, options: dict[str, Any]
) -> Trajectory:
    """Return the trajectory with a law that depends on the path, slowed down to a duration."""
    if limits is None:
        raise InputError(f"limits: {kind.title} takes its shape from them; give Limits(...) or an arm")
    law = kind.along(path, limits, **options)
    if restless(options):
        raise InputError(f"duration: {kind.title} with speeds at its ends lasts {law.duration:.6g} s; leave it out")
    if duration < law.duration * (1.0 - SLACK):
        raise InputError(
            f"duration: {duration:g} s is too short for the limits; it takes at least {_long_enough(law.duration)} s"
        )
    return Trajectory(path, law.stretched(duration / law.duration))


def _refuse_short(kind: LawType, motion: Trajectory, limits: Limits, options: dict[str, Any]) -> None:
    """Raise `InputError` for a motion that exceeds a limit; the text says which durations do not."""
    scaling = _used(motion, limits)
    if scaling is None or scaling.k <= 1.0 + SLACK:
        return
    enough = _enough(kind, motion, limits, options) if restless(options) else scaling.k * motion.duration
    raise InputError(
        f"duration: in {motion.duration:g} s joint {scaling.joint} exceeds its limit of {scaling.quantity}; "
        f"{_advice(kind, motion.path, limits, options, enough)}"
    )


def _advice(kind: LawType, path: Path, limits: Limits, options: dict[str, Any], enough: float | None) -> str:
    """Return in words how long it takes with the ramps that are typed, and with those the limits allow if shorter."""
    ways = []
    share = next((options.get(field.key, field.default) for field in kind.fields if field.key == "ramp"), None)
    free = None if share is None else _free(kind, path, limits, options)
    if free is not None and (enough is None or free < enough * (1.0 - SLACK)):
        ways.append(f"without a duration it takes {free:.6g} s")
    ramps = f"with ramps of {share:.3g} T " if ways else ""
    if enough is None:
        ways.append("or lower sdot_start or sdot_end" if ways else "lower sdot_start or sdot_end")
    elif restless(options):
        ways.append(f"{ramps}{_long_enough(enough)} s is long enough")
    else:
        ways.append(f"{ramps}it takes at least {_long_enough(enough)} s")
    return ", ".join(ways)


def _long_enough(seconds: float) -> str:
    """Return a positive duration in six digits, rounded up: rounded down it would be too short."""
    unit = 10.0 ** (math.floor(math.log10(seconds)) - DIGITS + 1)
    return f"{math.ceil(seconds * (1.0 - EXACT) / unit) * unit:.{DIGITS}g}"


def _free(kind: LawType, path: Path, limits: Limits, options: dict[str, Any]) -> float | None:
    """Return how long the law takes whose ramps follow from the limits, or None if there is none."""
    try:
        return kind.along(path, limits, **options).duration
    except InputError:
        return None


def _used(motion: Trajectory, limits: Limits) -> Scaling | None:
    """Return the scaling that would meet one limit, or None where none is used at all."""
    peak = [peaks(motion, k).peak if finite else 0.0 for k, finite in enumerate(limits.bounded, start=1)]
    return optimal_scaling(limits, *peak) if any(np.any(values) for values in peak) else None


def _enough(kind: LawType, motion: Trajectory, limits: Limits, options: dict[str, Any]) -> float | None:
    """Return the next longer duration of a law with end speeds that keeps the limits; None if it is not found.

    Stretched in time its end speeds would be others, so each duration is another law, and a longer one may need more:
    it has to slow down from the same speeds to a smaller one.
    """

    def keeps(duration: float) -> bool:
        used = _used(Trajectory(motion.path, kind.law(duration, **options)), limits)
        return used is None or used.k <= 1.0

    low, high = motion.duration, motion.duration
    try:
        while not keeps(high):
            low, high = high, high * LONGER
        while high - low > NEAR * high:
            middle = 0.5 * (low + high)
            low, high = (low, middle) if keeps(middle) else (middle, high)
    except InputError:
        # In so long a time the ramps alone go farther than the path.
        return None
    return high
