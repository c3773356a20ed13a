"""Trips of a student between lesson, sandbox and shared states."""

from __future__ import annotations

import itertools
import json

from armlab.content.robots import catalogue
from armlab.session.parts.display import Show
from armlab.session.parts.joints import MoveJoint
from armlab.session.session import Session
from armlab.session.share import short
from armlab.session.state import Command, Json, State, part_types
from armlab.session.store import state_from_text
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.shelf import Shelf

NOT_COMPARED = (Shelf, LessonPart)


def shared_text(key: str, value: float) -> str:
    """Return the text of an arm somebody has moved."""
    session = Session.fresh("teacher", catalogue()[key])
    session.apply(MoveJoint(0, value), 0.0)
    session.apply(Show("frames", True), 1.0)
    return short(session.state)


SCARA, UR10 = shared_text("scara", 0.5), shared_text("ur10", -0.25)


def applied(session: Session, *commands: Command) -> Session:
    """Apply commands with rests between them."""
    for command in commands:
        session.apply(command, 2.0 * next(_CLOCK))
    return session


_CLOCK = itertools.count()


def reloaded(state: State) -> State:
    """Return the state after a restart."""
    return state_from_text(json.dumps({"format": 1, "parts": state.to_json()}))


def written(state: State) -> Json:
    """Return all of a state but the shelf and what the lessons know, which travels along."""
    return {key: part for key, part in state.to_json().items() if key not in ("shelf", "lesson")}


def same(state: State, left: State) -> None:
    """Check that every part is the one that was left."""
    for kind in part_types():
        if kind not in NOT_COMPARED:
            assert state[kind] is left[kind] or state[kind] == left[kind], kind
    assert state[LessonPart].open == left[LessonPart].open
    assert written(state) == written(left)
