"""Actions of starts and solutions on the plan of a motion, as they are written in lesson files."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import get_args

from armlab.benches.motion.plan.seen_motion import MOST_WAYPOINTS
from armlab.content.lesson_fields import Fields
from armlab.content.lesson_values import written
from armlab.content.robots import Robot
from armlab.content.vocabulary import BenchAction
from armlab.kin.motion import law_types, path_types
from armlab.kin.motion.path_types import Space


@dataclass(frozen=True)
class EditWaypoint:
    """Change the list of waypoints.

    Attributes
    ----------
    how : "add", "set" or "remove"
        Add the configuration of the arm, put a waypoint there, or take one out.
    k : int or None
        The waypoint, from 0; with "add" the one after which it is added, None for the selected one.
    """

    how: str
    k: int | None

    def says(self) -> str:
        """Return the action in words.

        >>> EditWaypoint("set", 1).says()
        'waypoint 2 goes to where the arm is'
        """
        if self.how == "remove":
            return f"remove waypoint {(self.k or 0) + 1}"
        if self.how == "set":
            return f"waypoint {(self.k or 0) + 1} goes to where the arm is"
        behind = "" if self.k is None else f" behind waypoint {self.k + 1}"
        return f"add the configuration of the arm as a waypoint{behind}"


@dataclass(frozen=True)
class SetMoveKind:
    """Choose the move to a waypoint; None leaves a choice unchanged.

    Attributes
    ----------
    to : int or None
        The waypoint, from 0; None: all moves.
    space, path, law, turning : str or None
        Keys.
    stop : bool or None
        Whether the arm rests there although its path could go through.
    """

    to: int | None
    space: str | None = None
    path: str | None = None
    law: str | None = None
    turning: str | None = None
    stop: bool | None = None

    def says(self) -> str:
        """Return the action in words."""
        which = "all moves" if self.to is None else f"move to waypoint {self.to + 1}"
        kinds = {"space": self.space, "path": self.path, "law": self.law, "turning": self.turning}
        words = [f"{name} {value}" for name, value in kinds.items() if value is not None]
        if self.stop is not None:
            words.append("stop there" if self.stop else "do not stop there")
        return f"{which}: {', '.join(words)}"


@dataclass(frozen=True)
class SetDuration:
    """Set the duration of the motion in seconds; None for as fast as allowed."""

    seconds: float | None

    def says(self) -> str:
        """Return the action in words."""
        return "as fast as allowed" if self.seconds is None else f"duration {written(self.seconds)} s"


@dataclass(frozen=True)
class SetLimits:
    """Set limits of the motion; None leaves a limit unchanged.

    Attributes
    ----------
    velocity, acceleration : float or None
        Shares of the limits of the joints that are used, more than 0 and at most 1.
    tool_speed : float or None
        m/s.
    jerk_time : float or None
        Seconds in which the full acceleration is built up.
    """

    velocity: float | None = None
    acceleration: float | None = None
    tool_speed: float | None = None
    jerk_time: float | None = None

    def says(self) -> str:
        """Return the action in words."""
        words = [
            f"{name} {written(100.0 * share)} %"
            for name, share in (("velocity", self.velocity), ("acceleration", self.acceleration))
            if share is not None
        ]
        if self.tool_speed is not None:
            words.append(f"tool speed {written(self.tool_speed)} m/s")
        if self.jerk_time is not None:
            words.append(f"jerk time {written(self.jerk_time)} s")
        return f"limits: {', '.join(words)}"


def _edit_waypoint(entry: Fields, robot: Robot) -> EditWaypoint:
    del robot
    given = [key for key in ("after", "set", "remove") if entry.has(key)]
    if len(given) > 1:
        raise entry.fail(given[1], f"expected one of {' and '.join(given)}")
    if not given:
        return EditWaypoint("add", None)
    return EditWaypoint({"after": "add"}.get(given[0], given[0]), entry.whole(given[0], 1, MOST_WAYPOINTS) - 1)


def _set_move_kind(entry: Fields, robot: Robot) -> SetMoveKind:
    del robot
    to = entry.whole("to", 2, MOST_WAYPOINTS) - 1 if entry.has("to") else None
    kinds = {"space": get_args(Space), "path": path_types(), "law": law_types()}
    chosen = {key: entry.choice(key, options) for key, options in kinds.items() if entry.has(key)}
    if entry.has("turning"):
        chosen["turning"] = entry.text("turning")
    stop = entry.boolean("stop", True) if entry.has("stop") else None
    if not chosen and stop is None:
        raise entry.fail("space", "missing; expected some of space, path, law, turning, stop")
    if stop is not None and to is None:
        raise entry.fail("to", "missing; expected the waypoint at which the arm stops or does not")
    return SetMoveKind(to, stop=stop, **chosen)


def _set_duration(entry: Fields, robot: Robot) -> SetDuration:
    del robot
    return SetDuration(_positive(entry, "seconds"))


def _set_limits(entry: Fields, robot: Robot) -> SetLimits:
    del robot
    found = SetLimits(
        _share(entry, "velocity_percent"),
        _share(entry, "acceleration_percent"),
        _positive(entry, "tool_speed_m_s"),
        _positive(entry, "jerk_time_s"),
    )
    if found == SetLimits():
        raise entry.fail("velocity_percent", "missing; expected some limit")
    return found


def _share(entry: Fields, key: str) -> float | None:
    percent = _positive(entry, key)
    if percent is not None and percent > 100.0:
        raise entry.fail(key, f"expected at most 100, got {percent:g}")
    return None if percent is None else percent / 100.0


def _positive(entry: Fields, key: str) -> float | None:
    if not entry.has(key):
        return None
    value = entry.number(key)
    if value <= 0.0:
        raise entry.fail(key, f"expected a positive number, got {value:g}")
    return value


READERS: dict[str, Callable[[Fields, Robot], BenchAction]] = {
    "waypoint": _edit_waypoint,
    "move_kind": _set_move_kind,
    "duration": _set_duration,
    "limits": _set_limits,
}
"""Readers of the actions, by their kind in lesson files."""
