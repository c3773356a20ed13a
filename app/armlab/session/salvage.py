"""Saved work of which something cannot be read: each part is read by itself."""

from __future__ import annotations

import json
from collections.abc import Iterable

from armlab.content.robots import Robot
from armlab.errors import InputError, in_one_line
from armlab.session.pages import pages, place_of
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart, robot_from_json
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Json, Part, State, part_types

NEEDED = (RobotPart, Joints)
"""The parts without which nothing is read, since the others are of their arm."""

Lost = dict[type[Part], str]
"""The parts that could not be read, and why not in one line."""

LOST = "Of your saved work this could not be read and begins anew: {what}. Everything else is as it was."
"""The sentence for a student who has lost something."""


def salvaged(parts: Json) -> tuple[State, Lost]:
    """Return the state of parts written by `State.to_json`, and what could not be read.

    A part that cannot be read is as it opens with the arm. In states that wait elsewhere the same holds; if such a
    state cannot be read at all, the part that holds it is lost. Raises any error when arm or joints cannot be read.
    """
    lost: Lost = {}
    readable = _readable(parts, lost)
    state = State.from_json(readable, robot_from_json(readable[RobotPart.key]))
    # The film may be shorter than it was.
    return state.replace(state[Timeline].after(state, state)), lost


def told(lost: Iterable[type[Part]]) -> str:
    """Return what a student is told of lost parts; empty where there is nothing to miss."""
    names = dict.fromkeys(_name_of(kind) for kind in lost)
    return LOST.format(what=" · ".join(filter(None, names))) if any(names) else ""


def _readable(parts: Json, lost: Lost) -> Json:
    robot = robot_from_json(parts[RobotPart.key])
    readable = {}
    for kind in part_types():
        if not kind.saved or kind.key not in parts:
            continue
        try:
            readable[kind.key] = _checked(kind, parts[kind.key], robot, lost)
        except Exception as error:
            # Nobody can list what a damaged part may raise.
            if kind in NEEDED:
                raise
            lost[kind] = in_one_line(error)
    return readable


def _checked(kind: type[Part], data: Json, robot: Robot, lost: Lost) -> Json:
    """Return the JSON of a part that can be read, if need be without what cannot be read of states in it."""
    try:
        return _read(kind, data, robot)
    except Exception:
        within: Lost = {}
        mended = kind.with_states(data, lambda parts: _readable(parts, within))
        if not within:
            raise
        found = _read(kind, mended, robot)
        lost |= within
        return found


def _read(kind: type[Part], data: Json, robot: Robot) -> Json:
    try:
        json.dumps(data, allow_nan=False)
    except ValueError:
        raise InputError(f"{kind.key}: expected finite numbers") from None
    kind.from_json(data, robot).to_json()
    return data


def _name_of(kind: type[Part]) -> str:
    """Return what a person calls a part: its page, or the name that it has itself."""
    package = kind.__module__.rpartition(".")[0]
    page = next((key for key, each in pages().items() if each.package == package), "")
    return place_of(page) if page else kind.called
