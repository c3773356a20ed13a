"""The way back to the arm that was on the table before a lesson."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from types import MappingProxyType
from typing import ClassVar, Self

import numpy as np

from armlab.content.robots import Robot, catalogue
from armlab.session.parts.display import Display
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.share import STAYS, personal, state_of_parts
from armlab.session.state import Command, Json, Part, PartType, State
from armlab.teaching.parts.lesson import LessonPart


@dataclass(frozen=True)
class Former(Part):
    """The state before the lesson that is open, or before the first of several that followed each other.

    It is kept after the lesson has been closed, until the student goes back to it or puts another arm on the table.

    Attributes
    ----------
    state : State or None
        Without a lesson and without a former state of its own; None where there is nothing to go back to.
    """

    key: ClassVar[str] = "former"
    called: ClassVar[str] = "the arm before the lesson"
    kept_by_undo: ClassVar[bool] = True

    state: State | None = None

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the part with nothing to go back to."""
        return cls()

    @classmethod
    def of(cls, state: State) -> Self:
        """Return the part for a lesson that is opened in a state: that state, or the one to which it leads back itself.

        Switches of the picture that were set after an earlier lesson count.
        """
        former = state[cls]
        if state[LessonPart].open:
            return former
        if former.state is not None:
            return cls(former.state.replace(state[Display]))
        return cls(state.replace(replace(state[Timeline], playing=False)))

    def for_robot(self, robot: Robot) -> Self:
        """Return the part unchanged."""
        return self

    def after(self, before: State, now: State) -> Self:
        """Return the part without the state when the student has put another arm on the table without a lesson."""
        if self.state is None or before[LessonPart].open or now[LessonPart].open:
            return self
        was, robot = before[RobotPart], now[RobotPart]
        edited = robot.own and robot.origin == was.origin
        return self if robot.robot is was.robot or edited else type(self)()

    @cached_property
    def _written(self) -> Json:
        if self.state is None:
            return None
        robot = self.state[RobotPart]
        opened = State.initial(robot.robot).to_json()
        told = {key: part for key, part in self.state.to_json().items() if key not in STAYS and part != opened[key]}
        return {**told, robot.key: robot.to_json()}

    def to_json(self) -> Json:
        """Return those parts of the state that are not as they open with its arm, as JSON; None for no state.

        Parts that are the student's own at every place are left out, too.
        """
        return self._written

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Return the part from JSON; raises when the state is not usable.

        There is no way back to an arm whose file is gone, but that keeps nobody from the present one.
        """
        if data is None or (isinstance(data[RobotPart.key], str) and data[RobotPart.key] not in catalogue().robots):
            return cls()
        return cls(state_of_parts({key: part for key, part in data.items() if key not in STAYS}))

    @classmethod
    def with_states(cls, data: Json, change: Callable[[Json], Json]) -> Json:
        """Return the JSON with the parts of the state changed."""
        return None if data is None else change(data)


PART = PartType(Former, order=97)


def offered(state: State) -> Robot | None:
    """Return the arm to which a student can go back now; None during a lesson, and where it stands there already."""
    former = state[Former].state
    if former is None or state[LessonPart].open or _same(former, state):
        return None
    return former[RobotPart].robot


def without_lessons_switches(state: State) -> State:
    """Return the state with the switches of the picture as they were before the lesson."""
    former = state[Former].state
    if former is None:
        return state
    return state.replace(_switched(former[Display], state[Display]))


@dataclass(frozen=True)
class BackToFormer(Command):
    """Go back to what was on the table before the lesson; units and progress are the present ones."""

    label: ClassVar[str] = "way back to the former arm"
    reacts: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the former state, or the same state where there is none, or a lesson is open."""
        former = state[Former].state
        if former is None or state[LessonPart].open:
            return state
        return former.replace(*personal(state), state[Notation], Former(), _switched(former[Display], state[Display]))


@dataclass(frozen=True)
class ForgetFormer(Command):
    """Stay with the lesson's arm."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with nothing to go back to."""
        return state if state[Former].state is None else state.replace(Former())


def _switched(former: Display, present: Display) -> Display:
    """Return the former switches with those of the screen as they are now."""
    kept = {name: on for name, on in former.switches.items() if name not in former.of_screen()}
    return Display(MappingProxyType({**kept, **present.of_screen()}))


def _same(one: State, other: State) -> bool:
    """Return whether the same arm stands in the same pose."""
    same = one[RobotPart].robot is other[RobotPart].robot
    return same and bool(np.array_equal(one[Joints].q, other[Joints].q))
