"""The shelf: what a student has put aside to go to a sandbox of their own, or to look at a state somebody has shared.

There are three places. At home are the lessons, and the work without one. The sandbox is where a student plays while a
lesson waits at home. A shared state lies over either of them. Going and coming are no steps of undo; each place has a
history of its own (`armlab.session.session`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import ClassVar, Self

from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.session.parts.display import Display
from armlab.session.parts.language import LanguagePart
from armlab.session.parts.panels import Panels
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.share import STAYS, from_short, state_of_parts
from armlab.session.share_text import TEXT
from armlab.session.state import Command, Json, Part, PartType, Stand, State
from armlab.teaching.assignment_rules import refuse_in_assignment
from armlab.teaching.lesson_panels import lesson_followed
from armlab.teaching.lesson_places import is_place
from armlab.teaching.lesson_start import without_lesson
from armlab.teaching.parts.errata_practice import Practice
from armlab.teaching.parts.former import Former
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.own_lessons import OwnLessons
from armlab.teaching.parts.preview import Preview
from armlab.teaching.parts.teacher import Teacher

HOME, SANDBOX, SHARED = "home", "sandbox", "shared"


@dataclass(frozen=True)
class Shelf(Part):
    """The present place of the student, and the states at the other places.

    Attributes
    ----------
    own : "home" or "sandbox"
        The place where the student's own work goes on.
    shared : str
        The text of the shared state that lies over it; empty for none.
    parked : mapping of str to State
        States by place, ``home`` or ``sandbox``. They have empty shelves and no progress in lessons: the present
        progress always counts.
    """

    key: ClassVar[str] = "shelf"
    called: ClassVar[str] = "the work that waits elsewhere"
    kept_by_undo: ClassVar[bool] = True

    own: str = HOME
    shared: str = ""
    parked: Mapping[str, State] = field(default_factory=lambda: MappingProxyType({}))

    @property
    def place(self) -> str:
        """The present place: home, sandbox or shared."""
        return SHARED if self.shared else self.own

    @property
    def stand(self) -> Stand:
        """The present place; a shared state has no history of its own once it is left."""
        return Stand(self.place, self.shared)

    def waiting_at(self, stand: str) -> State | None:
        """Return the state that waits at another place."""
        return self.parked.get(stand)

    @property
    def waiting(self) -> str:
        """The lesson that waits at home while the student is elsewhere, as in `LessonPart.open`; empty for none."""
        return self.parked[HOME][LessonPart].open if HOME in self.parked else ""

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return an empty shelf, the student at home."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Return the part unchanged."""
        return self

    def after(self, before: State, now: State) -> Self:
        """Return the part at home when a lesson is opened elsewhere: it replaces the one that waits there."""
        if self.place == HOME or not now[LessonPart].open:
            return self
        parked = _left(before)
        parked.pop(HOME)
        return type(self)(parked=_frozen(parked))

    def to_json(self) -> Json:
        """Return the waiting states as JSON, without parts that are at their defaults."""
        parked = {
            place: {
                "lesson": state[LessonPart].open,
                "parts": _written(state),
            }
            for place, state in self.parked.items()
        }
        return {"own": self.own, "shared": self.shared, "parked": parked}

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Return the part from JSON; raises when a waiting state is not usable."""
        own, shared = data["own"], data["shared"]
        states = {place: _read(each) for place, each in data["parked"].items()}
        needed = {HOME} if own == SANDBOX else set()
        needed |= {own} if shared else set()
        optional = {SANDBOX} if own == HOME else set()
        if own not in (HOME, SANDBOX) or not needed <= set(states) <= needed | optional:
            raise InputError(f"shelf: expected the states of other places, got {sorted(states)} at {own!r}")
        if shared and not TEXT.match(shared):
            raise InputError("shelf: not the text of a shared state")
        return cls(own, shared, _frozen(states))

    @classmethod
    def with_states(cls, data: Json, change: Callable[[Json], Json]) -> Json:
        """Return the JSON with the parts of each waiting state changed."""
        parked = {place: {**each, "parts": change(each["parts"])} for place, each in data["parked"].items()}
        return {**data, "parked": parked}


PART = PartType(Shelf, order=96)


@dataclass(frozen=True)
class ToSandbox(Command):
    """Put the open lesson aside and go to the last sandbox; the first one begins with the present arm."""

    undoable: ClassVar[bool] = False
    reacts: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state of the sandbox."""
        shelf = state[Shelf]
        if shelf.place == SANDBOX:
            return state
        if shelf.place == SHARED:
            raise InputError("sandbox: a shared state is open; go back to your work first")
        refuse_in_assignment(state[LessonPart])
        if not state[LessonPart].open:
            raise InputError("sandbox: no lesson is open, so the arm is already your own")
        if state[LessonPart].hides:
            raise InputError("Your prediction is still open, and the sandbox would give it away: answer first.")
        parked = _left(state)
        found = parked.pop(SANDBOX, None) or without_lesson(parked[HOME]).replace(Former())
        return _arrived(state, found, Shelf(SANDBOX, parked=_frozen(parked)))


@dataclass(frozen=True)
class BackToLesson(Command):
    """Return home to the lesson as it was left; the sandbox is kept."""

    undoable: ClassVar[bool] = False
    reacts: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state at home."""
        if state[Shelf].place == HOME:
            return state
        parked = _left(state)
        found = parked.pop(HOME)
        return _arrived(state, found, Shelf(parked=_frozen(parked)), found[LessonPart].open)


@dataclass(frozen=True)
class OpenShared(Command):
    """Look at a state somebody has shared, and play with it; the present work waits.

    Parameters
    ----------
    text : str
        Text made by `armlab.session.share.short`.
    """

    text: str
    undoable: ClassVar[bool] = False
    reacts: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the shared state, or the same state when it is open already.

        Raises
        ------
        InputError
            The text does not hold a state.
        """
        shelf = state[Shelf]
        if self.text == shelf.shared:
            return state
        refuse_in_assignment(state[LessonPart])
        found = from_short(self.text)
        display = Display(MappingProxyType({**found[Display].switches, **state[Display].of_screen()}))
        return _arrived(state, found.replace(display), Shelf(shelf.own, self.text, _frozen(_left(state))))


@dataclass(frozen=True)
class BackFromShared(Command):
    """Leave the shared state and return to one's own work as it was left."""

    undoable: ClassVar[bool] = False
    reacts: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state of the student's own work."""
        shelf = state[Shelf]
        if not shelf.shared:
            return state
        parked = dict(shelf.parked)
        found = parked.pop(shelf.own)
        return _arrived(state, found, Shelf(shelf.own, parked=_frozen(parked)), found[LessonPart].open)


def at_home(state: State) -> State:
    """Return the state at home, without what waits elsewhere: the one that waits there, or the present one."""
    shelf = state[Shelf]
    return state.replace(Shelf()) if shelf.place == HOME else shelf.parked[HOME]


def _left(state: State) -> dict[str, State]:
    """Return the states that wait after leaving; a shared state is not kept, as its link restores it."""
    shelf = state[Shelf]
    parked = dict(shelf.parked)
    if not shelf.shared:
        lesson = replace(LessonPart.initial(state[RobotPart].robot), open=state[LessonPart].open)
        parked[shelf.own] = state.replace(Shelf(), lesson, replace(state[Timeline], playing=False))
    return parked


def _arrived(state: State, found: State, shelf: Shelf, lesson: str = "") -> State:
    """Return a stored state with what is the student's own at every place, and this lesson open."""
    stays = state[Panels], state[OwnLessons], state[Preview], state[Teacher], state[LanguagePart], state[Practice]
    arrived = found.replace(shelf, replace(state[LessonPart], open=lesson), *stays)
    return lesson_followed(state, arrived)


def _frozen(parked: dict[str, State]) -> Mapping[str, State]:
    return MappingProxyType(parked)


def _written(state: State) -> Json:
    """Return the parts of a state that waits, with what was on the table before its lesson, if anything was."""
    parts = {key: part for key, part in state.to_json().items() if key not in STAYS}
    return parts if state[Former].state is None else {**parts, Former.key: state[Former].to_json()}


def _read(data: Json) -> State:
    parts, key = data["parts"], data["lesson"]
    if not set(STAYS).isdisjoint(parts.keys() - {Former.key}):
        raise InputError("shelf: a state that waits has no shelf and no lessons of its own")
    state = state_of_parts(parts)
    return state.replace(replace(state[LessonPart], open=key if is_place(key) else ""))
