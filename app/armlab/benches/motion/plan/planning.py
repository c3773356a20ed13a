"""The planning of a motion: paths, inverse kinematics, laws; in pieces, because it takes longer than a command may."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import takewhile

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.plan.laws import (
    bounds_of,
    fastest,
    independent_motion,
    lasting,
    shaped_by_limits,
    slack,
    unkept,
)
from armlab.benches.motion.plan.moves import Stretch
from armlab.benches.motion.plan.paths import counted, joint_path, shortfall, tool_path
from armlab.benches.motion.plan.question import LONGEST, SHORTEST, Feasible, Leg, Planned, Question
from armlab.benches.motion.plan.recorded import recorded_motion
from armlab.benches.motion.plan.samples import DRAWN, drawn_leg, exceeded, sampled, spans_of, too_fast
from armlab.errors import InputError
from armlab.kin.conditioning import NEAR
from armlab.kin.ik.branches import branch_names
from armlab.kin.motion import (
    Followed,
    Hold,
    Motion,
    Path,
    Sequential,
    ToolPath,
    follow,
)

Floats = NDArray[np.float64]

APART = 1e-6
"""Distance from a waypoint's configuration, radians or length scales, below which a leg has reached it."""


def making(question: Question) -> Iterator[Planned | None]:
    """Plan a motion; yield None between pieces of the work, and finally the planned motion."""
    if question.recorded is not None:
        yield from recorded_motion(question)
        return
    legs: list[Leg] = []
    q: Floats | None = np.array(question.waypoints[0].q)
    for stretch in question.parts:
        yield None
        # Behind a leg that cannot be run the arm begins as its waypoint was stored.
        leg = _laid(question, stretch, np.array(question.waypoints[stretch.first].q) if q is None else q)
        yield None
        leg = _timed(question, leg)
        q = None if leg.motion is None else leg.motion.at(leg.motion.duration)
        legs.append(leg)
    yield None
    yield _together(question, legs)


def _laid(question: Question, stretch: Stretch, q: Floats) -> Leg:
    """Return a leg with its path in joint space, or with the reason why there is none."""
    lay = _in_space if stretch.move.space == "cartesian" else _in_joints
    try:
        leg = lay(question, stretch, q)
    except InputError as refusal:
        return Leg(stretch, 0.0, np.zeros((0, 3)), np.zeros(0, dtype=int), None, str(refusal))
    return replace(leg, remarks=(*_too_short(question, stretch), *leg.remarks))


def _too_short(question: Question, stretch: Stretch) -> tuple[str, ...]:
    """Return a sentence on a move that is straight since it has too few waypoints for the path that was chosen."""
    chosen = question.moves[stretch.first].kind
    if chosen is stretch.move.kind:
        return ()
    return (f"a straight line here: {chosen.title} takes {chosen.least} waypoints with moves of one kind between them",)


def _timed(question: Question, leg: Leg) -> Leg:
    """Return a leg with the fastest motion that the limits allow."""
    if leg.path is None or leg.stretch is None or leg.trouble:
        return leg
    motion: Motion
    try:
        if leg.stretch.move.independent:
            motion = independent_motion(question, leg.stretch, leg.path.at(0.0), leg.path.at(1.0))
        else:
            motion = fastest(question, leg.stretch, leg.path)
        bounds = bounds_of(question, leg.stretch, leg.path)
    except InputError as refusal:
        return replace(leg, trouble=str(refusal))
    if motion.duration > LONGEST:
        long = f"move {leg.stretch.title}: within the limits it lasts {motion.duration:.0f} s, more than {LONGEST:g} s"
        return replace(leg, trouble=long)
    other_way = _other_way(question, leg.stretch, motion.at(motion.duration))
    return replace(leg, motion=motion, bounds=bounds, remarks=(*leg.remarks, *leg.path.remarks, *other_way))


def _in_joints(question: Question, stretch: Stretch, q: Floats) -> Leg:
    knots = np.array([point.q for point in question.waypoints[stretch.first : stretch.last + 1]])
    knots[0] = q
    path = joint_path(question.arm, stretch, knots)
    s = np.linspace(0.0, 1.0, DRAWN)
    points = np.asarray(question.arm.position(path.at(s)), dtype=np.float64)
    leg = Leg(stretch, 0.0, points, np.zeros(DRAWN, dtype=int), None, path=path)
    for k in range(stretch.first, stretch.last + 1):
        if short := shortfall(question.arm, question.waypoints[k]):
            worth = np.full(DRAWN, int(Feasible.NOT_REACHED))
            return replace(leg, path=None, worth=worth, trouble=f"waypoint {k + 1}: {short}")
    return leg


def _in_space(question: Question, stretch: Stretch, q: Floats) -> Leg:
    arm = question.arm
    poses = np.array([point.wanted(arm) for point in question.waypoints[stretch.first : stretch.last + 1]])
    poses[0] = arm.fk(q) if question.waypoints[stretch.first].pose is None or stretch.first else poses[0]
    way = tool_path(arm, stretch, poses)
    found = follow(arm, way, q, question.samples, carry_on=True)
    leg = Leg(stretch, 0.0, way.pose(found.s)[:, :3, 3], _worth(found), None, tool_path=way, followed=found)
    leg = replace(leg, remarks=(*_remarks(stretch, way), *_only_passed(question, stretch)))
    if not found.whole:
        return replace(leg, trouble=f"move {stretch.title}: {_decapitalised(found.reason).rstrip('.')}")
    path = found.joint_path()
    return replace(leg, path=path, deviation=_deviation(question, way, path, found))


def _remarks(stretch: Stretch, way: ToolPath) -> tuple[str, ...]:
    """Return the remarks on a path of the tool, with its waypoints counted as those of the plan."""
    told = way.remarks
    if stretch.move.returns:
        # Behind its last waypoint it has the first one again.
        n = stretch.last - stretch.first + 1
        told = tuple(remark.replace(f"waypoints {n} and {n + 1}:", f"waypoints {n} and 1:") for remark in told)
    return tuple(counted(remark, stretch.first) for remark in told)


def _only_passed(question: Question, stretch: Stretch) -> tuple[str, ...]:
    """Return a sentence on a waypoint at which the arm should rest, and that the path only passes."""
    if stretch.end is not None or not question.waypoints[stretch.last].rests:
        return ()
    return (f"waypoint {stretch.last + 1} is only passed by the whole circle: the arm neither waits nor grips there",)


def _worth(found: Followed) -> NDArray[np.int_]:
    near = np.where(np.nan_to_num(found.singular_value) < NEAR, Feasible.NEAR_SINGULAR, Feasible.YES)
    return np.where(found.reached, near, Feasible.NOT_REACHED).astype(int)


def _deviation(question: Question, way: ToolPath, path: Path, found: Followed) -> float:
    """Return the largest distance of the tool from its path half way between two samples."""
    between = 0.5 * (found.s[1:] + found.s[:-1])
    arm = question.arm
    gap = arm.position(path.at(between)) - way.pose(between)[:, :3, 3]
    # A planar arm holds two coordinates, along the axes of frame 0.
    held = ["xyz".index(axis) for axis in arm.task.position]
    return float(np.linalg.norm((gap @ arm.base[:3, :3])[:, held], axis=1).max())


def _decapitalised(text: str) -> str:
    return text[:1].lower() + text[1:]


def _other_way(question: Question, stretch: Stretch, q: Floats) -> tuple[str, ...]:
    """Return a sentence on a waypoint that is reached in another configuration than the stored one."""
    if stretch.move.space == "joint" or stretch.end is None:
        return ()
    arm, stored = question.arm, np.array(question.waypoints[stretch.end].q)
    scale = np.where(arm.revolute, 1.0, arm.length_scale)
    if np.abs((q - stored) / scale).max() <= APART:
        return ()
    names = branch_names(arm, np.stack([q, stored]))
    how = f": {names[0]} instead of {names[1]}" if names[0] != names[1] and not names[0].startswith("solution") else ""
    return (
        f"waypoint {stretch.end + 1} is reached on the branch on which the move began{how}, not in its "
        f"stored configuration",
    )


def _together(question: Question, legs: Sequence[Leg]) -> Planned:
    """Return the planned motion of legs in sequence, in the requested time."""
    running = list(takewhile(lambda leg: leg.motion is not None, legs))
    within = sum(leg.motion.duration for leg in running if leg.motion is not None)
    first = question.waypoints[0].wait
    waits = [_wait(question, leg) for leg in running]
    start, placed = first, []
    for k, leg in enumerate(running):
        try:
            placed.append(replace(_lasting(question, leg, within, first + sum(waits)), start=start, wait=waits[k]))
        except InputError as refusal:
            return _together(question, (*legs[:k], replace(leg, motion=None, trouble=str(refusal)), *legs[k + 1 :]))
        start = placed[-1].arrival + waits[k]
    if not placed:
        return Planned(question, tuple(legs), None, None, (), math.nan)
    parts = [part for leg in placed for part in (_motion(leg), *_rest(_motion(leg), leg.wait))]
    if first:
        parts.insert(0, Hold(parts[0].at(0.0), first))
    motion: Motion = parts[0] if len(parts) == 1 else Sequential(parts)
    over, samples = exceeded(question, motion), sampled(question.arm, motion, placed)
    spans = (*spans_of(over), *too_fast(question.arm, samples, placed, question.limits.tool_speed))
    drawn = [drawn_leg(question.arm, leg, spans) for leg in placed]
    every = (*drawn, *legs[len(running) :])
    waiting = first + sum(waits)
    least = _least_in_shape(question, placed, within, waiting)
    return Planned(question, every, motion, samples, over, within + waiting, unkept(question, motion), in_shape=least)


def _least_in_shape(question: Question, placed: Sequence[Leg], within: float, waits: float) -> float | None:
    """Return the least seconds of placed legs with their waits if typed ramps shape some of them, else None.

    All legs are scaled together with the given time; those without typed ramps need ``within`` for it.
    """
    if question.duration is None:
        return None
    typed = [_motion(leg) for leg in placed if leg.stretch is not None and not shaped_by_limits(leg.stretch)]
    moving = [slack(question, motion) * (question.duration - waits) for motion in typed]
    if not moving:
        return None
    return max(moving if len(typed) == len(placed) else [within, *moving]) + waits


def _wait(question: Question, leg: Leg) -> float:
    """Return the seconds for which the arm rests at the end of a leg."""
    return 0.0 if leg.stretch is None or leg.stretch.end is None else question.waypoints[leg.stretch.end].wait


def _rest(motion: Motion, wait: float) -> tuple[Motion, ...]:
    """Return the rest at the end of a motion, if there is one."""
    return (Hold(motion.at(motion.duration), wait),) if wait else ()


def _lasting(question: Question, leg: Leg, within: float, waits: float) -> Leg:
    """Return a leg in its share of the requested time, or as fast as allowed if none was requested.

    Raises
    ------
    InputError
        The waits leave no time to move.
    """
    if question.duration is None or leg.stretch is None or leg.path is None:
        return leg
    if question.duration - waits < SHORTEST:
        raise InputError(f"duration: expected more than the {waits:g} s of the waits, got {question.duration:g} s")
    share = (question.duration - waits) * _motion(leg).duration / within
    return replace(leg, motion=lasting(leg.stretch, leg.path, _motion(leg), share))


def _motion(leg: Leg) -> Motion:
    assert leg.motion is not None
    return leg.motion
