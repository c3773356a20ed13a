"""The timing of a planned path: as fast as the limits allow, or in a given time."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.motion import (
    LawBounds,
    Motion,
    Path,
    Trajectory,
    as_fast_as_allowed,
    independent,
    law_bounds,
    law_types,
    scaled,
)
from armlab.kin.motion.law_types import SMOOTH_ENOUGH
from armlab.session.plan_moves import Stretch
from armlab.session.plan_question import Limits, Question
from armlab.session.plan_samples import fastest_tool

Floats = NDArray[np.float64]

RAMPS = {"ramp", "rounding"}
"""Options that say the shape of a law in a given time; as fast as allowed the limits shape it."""

JERK_JUMPS = "the acceleration jumps, so the limit of jerk cannot be kept"
SPEED_JUMPS = "the speed jumps where it begins or ends: no motor can do that. Take a law that rests there"


def fastest(question: Question, stretch: Stretch, path: Path) -> tuple[Trajectory, LawBounds]:
    """Return a path in joint space run through as fast as its law can be within the limits.

    The bounds of section 6.1.1 give the law its shape; they are safe and not sharp, so that the motion is then scaled
    to meet one limit exactly.

    Returns
    -------
    trajectory : Trajectory
    bounds : LawBounds
        Those used: with the speed lowered where no acceleration was left at the largest one.

    Raises
    ------
    InputError
        The law does not fit; the text names the move.
    """
    limits, kind = question.limits, law_types()[stretch.move.law.key]
    try:
        bounds = law_bounds(path, limits.velocity, limits.acceleration)
        if not bounds.possible:
            bounds = bounds.lowered()
        needed = "jerk" in kind.needs
        jerk = _jerk_bound(path, limits.jerk(needed), bounds)
        law = kind.within(bounds.V, bounds.A, jerk, **stretch.move.law.options)
        trajectory = Trajectory(path, law)
    except InputError as refusal:
        raise InputError(f"move {stretch.title}: {refusal}") from None
    smooth = trajectory.continuity_from_rest >= SMOOTH_ENOUGH
    asked = limits.jerk_time is not None
    jerks = limits.jerk() if asked and smooth else np.inf
    motion, _ = as_fast_as_allowed(trajectory, limits.velocity, limits.acceleration, jerks)
    motion = scaled(motion, max(1.0, _too_fast(question.arm, motion, limits)))
    assert isinstance(motion, Trajectory)
    return motion, bounds


def unkept(question: Question, motion: Motion) -> tuple[str, ...]:
    """Return the limits that a motion cannot keep in any time, in words."""
    if motion.continuity_from_rest < 1.0:
        return (SPEED_JUMPS,)
    jumps = motion.continuity_from_rest < SMOOTH_ENOUGH
    return (JERK_JUMPS,) if question.limits.jerk_time is not None and jumps else ()


def independent_motion(question: Question, stretch: Stretch, start: Floats, end: Floats) -> Motion:
    """Return a straight joint move in which each joint is as fast as its limits allow, and those there first wait.

    Raises
    ------
    InputError
        The law does not fit; the text names the move.
    """
    limits, law = question.limits, stretch.move.law
    jerk = limits.jerk("jerk" in law_types()[law.key].needs)
    bounds = {"v_max": limits.velocity, "a_max": limits.acceleration, "jerk_max": jerk}
    try:
        motion: Motion = independent(start, end, law.key, **bounds, **law.options)
    except InputError as refusal:
        raise InputError(f"move {stretch.title}: {refusal}") from None
    return scaled(motion, max(1.0, slack(question, motion)))


def lasting(stretch: Stretch, path: Path, motion: Motion, duration: float) -> Motion:
    """Return a motion of a stretch in another time: the same law scaled, or with the ramps that were typed for it.

    Raises
    ------
    InputError
        The typed law does not fit; the text names the move.
    """
    if stretch.move.independent or not RAMPS & set(stretch.move.law.options):
        return scaled(motion, duration / motion.duration)
    try:
        return Trajectory(path, law_types()[stretch.move.law.key].law(duration, **stretch.move.law.options))
    except InputError as refusal:
        raise InputError(f"move {stretch.title}: {refusal}") from None


def slack(question: Question, motion: Motion) -> float:
    """Return the factor for the time of a motion at which one limit is met; below 1 it may be faster."""
    limits = question.limits
    smooth = limits.jerk_time is not None and motion.continuity_from_rest >= SMOOTH_ENOUGH
    _, scaling = as_fast_as_allowed(motion, limits.velocity, limits.acceleration, limits.jerk() if smooth else np.inf)
    return max(scaling.k, _too_fast(question.arm, motion, limits))


def _jerk_bound(path: Path, jerk: Floats, bounds: LawBounds) -> float:
    """Return a bound of the third derivative of s for the shape of the law: of the straight part of q''' alone."""
    moving = bounds.M_v > 0.0
    return float((jerk[moving] / bounds.M_v[moving]).min())


def _too_fast(arm: Arm, motion: Motion, limits: Limits) -> float:
    """Return the largest speed of the tool in parts of its limit."""
    return 0.0 if limits.tool_speed is None else fastest_tool(arm, motion) / limits.tool_speed
