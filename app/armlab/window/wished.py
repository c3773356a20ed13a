"""The request of a link to a session.

``robot/puma560`` wants that arm on the table, ``lesson/first_arm`` that lesson, ``lesson/first_arm/7`` a variant of it,
``page/section`` a page, ``example/laws/triangle`` an example on its page, ``assignment/arm_positions`` an assignment,
``assignment/arm_positions/7`` that in a variant, ``erratum/5.58`` the page Errata at that one, ``state/1eN...`` a state
that was shared.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress

from armlab.content.errata import erratum
from armlab.errors import InputError, UnknownName
from armlab.session.bench import page_of
from armlab.session.example_links import LookAt
from armlab.session.panel_commands import OpenPanel
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.session import RefuseLink
from armlab.session.share import short
from armlab.session.state import Command, State
from armlab.teaching.assignment_commands import OpenAssignment
from armlab.teaching.errata_links import PAGE, LookUp
from armlab.teaching.lesson_commands import OpenLesson
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.shelf import BackToLesson, OpenShared, Shelf
from armlab.window.dead_link import leads_nowhere


def wished(state: State, wish: str) -> Command | None:
    """Return the command for a request, or None if it is met already, so that a reload resets nothing."""
    kind, _, what = wish.partition("/")
    if kind not in KINDS:
        return None
    nowhere = leads_nowhere(state, kind, what)
    return RefuseLink(nowhere) if nowhere else KINDS[kind](state, what)


def panel_of(wish: str) -> str:
    """Return the key of the panel at which the window of a request opens; empty if it names none."""
    kind, _, what = wish.partition("/")
    with suppress(UnknownName):
        return PANELS[kind](what) if kind in PANELS else ""
    return ""


def _page_of_erratum(key: str) -> str:
    erratum(key)
    return PAGE


def _robot(state: State, what: str) -> Command | None:
    return ChooseRobot(what) if what != state[RobotPart].robot.key else None


def _assignment(state: State, what: str) -> Command:
    key, _, number = what.partition("/")
    return OpenAssignment(key, int(number) if number else None)


def _state(state: State, what: str) -> Command | None:
    return OpenShared(what) if what not in (state[Shelf].shared, _shared(state)) else None


def _lesson(state: State, what: str) -> Command | None:
    """Return the command that opens a lesson: in the variant of the last work if none is named."""
    key, _, variant = what.partition("/")
    place = f"{key}/{int(variant)}" if variant else ""
    if _is(state[LessonPart].open, key, place):
        return None
    if _is(state[Shelf].waiting, key, place):
        return BackToLesson()
    return OpenLesson(key, variant=int(variant) if variant else None)


def _is(opened: str, key: str, place: str) -> bool:
    return opened == place if place else opened.partition("/")[0] == key


def _shared(state: State) -> str:
    """Return the state as a short text; empty if it has none."""
    try:
        return short(state)
    except InputError:
        return ""


KINDS: dict[str, Callable[[State, str], Command | None]] = {
    "robot": _robot,
    "lesson": _lesson,
    "page": lambda state, what: OpenPanel(what),
    "example": lambda state, what: LookAt(what),
    "assignment": _assignment,
    "erratum": lambda state, what: LookUp(what),
    "state": _state,
}
"""Commands of the kinds of requests."""

PANELS: dict[str, Callable[[str], str]] = {"page": str, "example": page_of, "erratum": _page_of_erratum}
"""Panels of the kinds of requests that have one; `UnknownName` when there is nothing of that name."""
