"""The timing of a planned path: as fast as the limits allow, or in a given time."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.plan.moves import Stretch
from armlab.benches.motion.plan.question import Limits, Question
from armlab.benches.motion.plan.samples import fastest_tool
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.motion import (
    LawBounds,
    Motion,
    Path,
    Sequential,
    Trajectory,
    as_fast_as_allowed,
    independent,
    law_bounds,
    law_types,
    scaled,
)
from armlab.kin.motion.breaks import SMOOTH_ENOUGH
from armlab.kin.motion.sequence import Separate, Slowed

Floats = NDArray[np.float64]

RAMPS = {"ramp", "rounding"}
"""Options that shape a law in a given time; a law that is as fast as allowed is shaped by the limits."""

JERK_JUMPS = "the acceleration jumps, so the limit of jerk cannot be kept"
SPEED_JUMPS = "the speed jumps at its ends, which no motor can follow; choose a law that starts and ends at rest"
CORNERS = (
    "the velocity jumps at a corner, which no motor can follow; fly over the corner, or choose the time-optimal law, "
    "which stops there"
)


def fastest(question: Question, stretch: Stretch, path: Path) -> Trajectory:
    """Return the motion along a path in joint space that is as fast as its law can be within the limits.

    Raises
    ------
    InputError
        The law does not fit; the text names the move.
    """
    limits, kind = question.limits, law_types()[stretch.move.law.key]
    try:
        law = kind.along(path, limits.of_joints(), **how(question, stretch))
    except InputError as refusal:
        raise InputError(f"move {stretch.title}: {refusal}") from None
    motion = Trajectory(path, law)
    slower = scaled(motion, max(1.0, tool_share(question.arm, motion, limits)))
    assert isinstance(slower, Trajectory)
    return slower


def bounds_of(question: Question, stretch: Stretch, path: Path) -> LawBounds | None:
    """Return the bounds of the law of a stretch from the limits, or None if its shape does not follow from them."""
    kind = law_types()[stretch.move.law.key]
    if stretch.move.independent or kind.on_path is not None:
        return None
    return law_bounds(path, how(question, stretch)["shape"]).usable


def how(question: Question, stretch: Stretch) -> dict[str, Any]:
    """Return the options with which the law of a stretch is made along its path.

    Jumps are reported, not refused, and a law that needs a limit of jerk takes a usual one for its shape.
    """
    law = stretch.move.law
    shape = question.limits.of_joints("jerk" in law_types()[law.key].needs)
    return {"shape": shape, "jumps": True, **law.options}


def unkept(question: Question, motion: Motion) -> tuple[str, ...]:
    """Return in words the limits that a motion exceeds in any time."""
    if _cornered(motion):
        return (CORNERS,)
    if motion.continuity_from_rest < 1.0:
        return (SPEED_JUMPS,)
    jumps = motion.continuity_from_rest < SMOOTH_ENOUGH
    return (JERK_JUMPS,) if question.limits.jerk_time is not None and jumps else ()


def _cornered(motion: Motion) -> bool:
    """Return whether the velocity jumps inside of a move, where all joints go along one path.

    At the end of a move, and where the first of several independent joints arrives, it is the law that makes it jump.
    """
    if isinstance(motion, Slowed):
        return _cornered(motion.motion)
    if isinstance(motion, Sequential):
        return any(map(_cornered, motion.motions))
    return not isinstance(motion, Separate) and motion.continuity < 1.0


def independent_motion(question: Question, stretch: Stretch, start: Floats, end: Floats) -> Motion:
    """Return a straight joint move with each joint as fast as its limits allow, so that the first ones wait.

    Raises
    ------
    InputError
        The law does not fit; the text names the move.
    """
    try:
        motion: Motion = independent(
            start, end, stretch.move.law.key, question.limits.of_joints(), **how(question, stretch)
        )
    except InputError as refusal:
        raise InputError(f"move {stretch.title}: {refusal}") from None
    return scaled(motion, max(1.0, slack(question, motion)))


def shaped_by_limits(stretch: Stretch) -> bool:
    """Return whether the limits shape the law of a stretch also in a given time, and not typed ramps."""
    return stretch.move.independent or not RAMPS & set(stretch.move.law.options)


def lasting(stretch: Stretch, path: Path, motion: Motion, duration: float) -> Motion:
    """Return a motion of a stretch in another time: the same law scaled, or with the typed ramps.

    Raises
    ------
    InputError
        The typed law does not fit; the text names the move.
    """
    if shaped_by_limits(stretch):
        return scaled(motion, duration / motion.duration)
    try:
        return Trajectory(path, law_types()[stretch.move.law.key].law(duration, **stretch.move.law.options))
    except InputError as refusal:
        raise InputError(f"move {stretch.title}: {refusal}") from None


def slack(question: Question, motion: Motion) -> float:
    """Return the factor of time with which a motion meets one limit; below 1 it may be faster."""
    limits = question.limits
    # What was recorded may begin and end with a speed; that is no jump, so its jerk counts.
    moving = question.recorded is not None
    _, scaling = as_fast_as_allowed(motion, limits.of_joints(), jumps=True, moving=(moving, moving))
    return max(scaling.k, tool_share(question.arm, motion, limits))


def tool_share(arm: Arm, motion: Motion, limits: Limits) -> float:
    """Return the ratio of the largest speed of the tool to its limit."""
    return 0.0 if limits.tool_speed is None else fastest_tool(arm, motion) / limits.tool_speed
