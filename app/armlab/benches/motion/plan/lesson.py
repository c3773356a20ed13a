"""The planned motion in lessons: facts of the plan, and the commands of solutions for waypoints and moves."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from armlab.benches.motion.plan import commands, limits, points
from armlab.benches.motion.plan.actions import EditWaypoint, SetDuration, SetLimits, SetMoveKind
from armlab.benches.motion.plan.job import JOB, with_planned
from armlab.benches.motion.plan.moves import TURNINGS
from armlab.benches.motion.plan.seen import motion_changed, seen_motion
from armlab.benches.motion.plan.seen_motion import KEY, SeenMotion
from armlab.benches.motion.plan.state import CLIP_KEY, Plan, planned_now
from armlab.content import evidence
from armlab.content.actions import Action
from armlab.content.robots import Robot
from armlab.errors import InputError, suggestion
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Command, Json, State
from armlab.teaching.taught import Taught

MOST_POSES = 30_000
"""Largest number of poses for which the inverse kinematics of one plan is solved again; no lesson needs more."""


def ended(before: State, now: State) -> bool:
    """Return whether the planned motion has reached its end."""
    # What has moved is else the motion before the last change; or a shorter one has come to where the old one stood.
    return planned_now(now) is not None and now[Timeline].time > before[Timeline].time


def again(data: Json, told: SeenMotion, robot: Robot) -> SeenMotion:
    """Return the facts of a motion that is planned again; how far it was played is taken from ``told``."""
    if data is None:
        raise InputError("motion: what it is planned of is missing")
    part = Plan.from_json(evidence.mapping(data, Plan.key, (), tuple(Plan.initial(robot).to_json())), robot)
    poses = part.samples * sum(move.space == "cartesian" for move in part.moves)
    if poses > MOST_POSES:
        raise InputError(f"motion: it has {poses} poses to solve; at most {MOST_POSES} are looked at again")
    state = with_planned(State.initial(robot).replace(replace(part, compared=False, before=None)))
    return replace(seen_motion(state, told.played), time=told.time)


def motion_commands(action: Action, state: State) -> Iterator[Command]:
    """Yield the commands of a solution for the plan of the motion."""
    if isinstance(action, EditWaypoint):
        k = state[Plan].selected if action.k is None else action.k
        if action.how == "add":
            yield points.SelectWaypoint(k, handled=False)
            yield points.AddWaypoint()
        else:
            yield points.TakePresent(k) if action.how == "set" else points.RemoveWaypoint(k)
    elif isinstance(action, SetMoveKind):
        k = 1 if action.to is None else action.to
        yield commands.SetMove(k, action.space, action.path, action.law, action.turning, action.stop)
        if action.to is None:
            yield commands.AllMovesLike(k)
    elif isinstance(action, SetDuration):
        yield limits.LastFor(action.seconds)
    elif isinstance(action, SetLimits):
        if action.velocity is not None or action.acceleration is not None:
            yield limits.UseShare(action.velocity, action.acceleration)
        if action.tool_speed is not None:
            yield limits.LimitTool(action.tool_speed)
        if action.jerk_time is not None:
            yield limits.LimitJerk(action.jerk_time)


def mistakes(action: Action) -> Iterator[str]:
    """Yield what is wrong with an action: a turning that there is not."""
    if isinstance(action, SetMoveKind) and action.turning not in (None, *TURNINGS):
        yield f"unknown turning {action.turning!r}{suggestion(str(action.turning), list(TURNINGS))}"


TAUGHT = Taught(
    KEY,
    Plan,
    CLIP_KEY,
    JOB,
    motion_changed,
    ended,
    seen_motion,
    SeenMotion.from_json,
    again,
    motion_commands,
    mistakes,
)
