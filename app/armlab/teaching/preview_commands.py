"""A look at a lesson or an assignment as a student sees it, and the way back to what one was doing."""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import ClassVar

from armlab.content.held import hold_without_dates
from armlab.content.lessons import lessons
from armlab.errors import InputError
from armlab.session.parts.display import Display
from armlab.session.parts.language import LanguagePart
from armlab.session.parts.notation import Notation
from armlab.session.parts.panels import Panels
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Command, State
from armlab.teaching.assignment_commands import OpenAssignment
from armlab.teaching.assignment_rules import refuse_in_assignment
from armlab.teaching.lesson_commands import OpenLesson
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.own_lessons import OwnLessons
from armlab.teaching.parts.preview import Preview
from armlab.teaching.parts.teacher import Teacher


@dataclass(frozen=True)
class PreviewLesson(Command):
    """Open a lesson as somebody sees it who has done nothing yet; what was done before waits.

    Parameters
    ----------
    key : str
    panel : str
        The page to come back to.
    """

    key: str
    panel: str
    undoable: ClassVar[bool] = False
    reacts: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state in the lesson."""
        return OpenLesson(self.key).apply(_as_new(state, Preview(*_back(state, self.panel))))


@dataclass(frozen=True)
class PreviewAssignment(Command):
    """Open an assignment in the same way, whatever its dates.

    Parameters
    ----------
    key : str
    panel : str
    """

    key: str
    panel: str
    undoable: ClassVar[bool] = False
    reacts: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state in the assignment.

        Raises
        ------
        InputError
            It is one of the lab, which students are not to see before its time.
        """
        if not state[Teacher].let_in and not state[OwnLessons].holds(self.key):
            raise InputError("An assignment of the lab is opened here with the key of the teacher.")
        held = hold_without_dates(lessons().assignment(self.key))
        begun = _as_new(state, Preview(*_back(state, self.panel), held))
        return OpenAssignment(held.assignment.key).apply(begun)


@dataclass(frozen=True)
class EndPreview(Command):
    """Go back to what was done before the preview; what was done in it is forgotten."""

    undoable: ClassVar[bool] = False
    reacts: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state before the preview; the same state where there is none."""
        before, panel = state[Preview].before, state[Preview].panel
        if before is None:
            return state
        display = Display(MappingProxyType({**before[Display].switches, **state[Display].of_screen()}))
        panels = state[Panels].opening(panel) if panel else state[Panels]
        return before.replace(display, panels, state[OwnLessons], state[Teacher], state[LanguagePart], Preview())


def _back(state: State, panel: str) -> tuple[State, str]:
    """Return where the preview leads back to; from within one that is where the first began."""
    here = state[Preview]
    if here.before is not None:
        return here.before, here.panel
    refuse_in_assignment(state[LessonPart])
    return state.replace(OwnLessons(), Teacher(), Preview()), panel


def _as_new(state: State, preview: Preview) -> State:
    """Return the state of somebody who has just come, with the windows, the units and the files of the present one."""
    fresh = State.initial(state[RobotPart].robot)
    display = Display(MappingProxyType(dict(state[Display].of_screen())))
    lesson = replace(fresh[LessonPart], course=state[LessonPart].course, set_up=state[LessonPart].set_up + 1)
    own = state[Notation], state[LanguagePart], state[Panels], state[OwnLessons], state[Teacher]
    numbered = replace(preview, number=state[Preview].number + 1)
    return fresh.replace(display, lesson, *own, numbered).dated(state.at)
