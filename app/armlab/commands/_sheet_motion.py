"""The actions of a solution on the plan of a motion, in words for the solution sheet."""

from __future__ import annotations

from armlab.content.lesson_values import written
from armlab.content.motion_actions import (
    EditWaypoint,
    MotionAction,
    SetDuration,
    SetLimits,
    SetMoveKind,
    TakeExample,
)


def motion_words(action: MotionAction) -> str:
    """Return what is to be done.

    >>> motion_words(SetDuration(10.0)), motion_words(EditWaypoint("set", 1))
    ('duration 10 s', 'waypoint 2 goes to where the arm is')
    """
    if isinstance(action, TakeExample):
        return f"example {action.name}"
    if isinstance(action, EditWaypoint):
        return _waypoint(action)
    if isinstance(action, SetMoveKind):
        return _move(action)
    if isinstance(action, SetDuration):
        return "as fast as allowed" if action.seconds is None else f"duration {written(action.seconds)} s"
    return _limits(action)


def _waypoint(action: EditWaypoint) -> str:
    if action.how == "remove":
        return f"remove waypoint {(action.k or 0) + 1}"
    if action.how == "set":
        return f"waypoint {(action.k or 0) + 1} goes to where the arm is"
    behind = "" if action.k is None else f" behind waypoint {action.k + 1}"
    return f"add the configuration of the arm as a waypoint{behind}"


def _move(action: SetMoveKind) -> str:
    which = "all moves" if action.to is None else f"move to waypoint {action.to + 1}"
    kinds = {"space": action.space, "path": action.path, "law": action.law, "turning": action.turning}
    words = [f"{name} {value}" for name, value in kinds.items() if value is not None]
    if action.stop is not None:
        words.append("stop there" if action.stop else "do not stop there")
    return f"{which}: {', '.join(words)}"


def _limits(action: SetLimits) -> str:
    words = [
        f"{name} {written(100.0 * share)} %"
        for name, share in (("velocity", action.velocity), ("acceleration", action.acceleration))
        if share is not None
    ]
    if action.tool_speed is not None:
        words.append(f"tool speed {written(action.tool_speed)} m/s")
    if action.jerk_time is not None:
        words.append(f"jerk time {written(action.jerk_time)} s")
    return f"limits: {', '.join(words)}"
