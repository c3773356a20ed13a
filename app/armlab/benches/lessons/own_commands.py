"""Commands of the lessons that a person has loaded, and of the course that is put in order.

They lie beside the pages, since the commands in the folder of a page are words that lessons can use.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

from armlab.benches.lessons.course_order import left_out, moved, put_back
from armlab.content.course import Course
from armlab.content.lessons import lessons
from armlab.content.upload import ASSIGNMENT, COURSE_KIND, LESSON_KIND, Upload
from armlab.errors import InputError
from armlab.session.edits import PasteTable
from armlab.session.state import Command, State
from armlab.teaching.assignment_rules import refuse_in_assignment
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.own_lessons import OwnLessons, course_in
from armlab.teaching.preview_commands import EndPreview


@dataclass(frozen=True)
class LoadFile(Command):
    """Load a file: a lesson or an assignment for oneself, a course to put in order, or an arm.

    A lesson or an assignment takes the place of one with its name.

    Parameters
    ----------
    upload : Upload
    """

    upload: Upload
    label: ClassVar[str] = "loaded arm"

    def apply(self, state: State) -> State:
        """Return the state with the file.

        Raises
        ------
        ContentError, InputError
            It cannot be used; the sentence has file and line.
        """
        refuse_in_assignment(state[LessonPart])
        state = EndPreview().apply(state)
        upload, own = self.upload, state[OwnLessons]
        if upload.kind == COURSE_KIND:
            return state.replace(replace(own, course=course_in(upload)))
        if upload.kind not in (LESSON_KIND, ASSIGNMENT):
            return PasteTable(upload.text, upload.file).apply(state)
        others = tuple(each for each in own.files if (each.kind, each.name) != (upload.kind, upload.name))
        found = own.having((*others, upload))
        if upload.file in found.problems:
            raise found.problems[upload.file]
        return state.replace(found)


@dataclass(frozen=True)
class ForgetFile(Command):
    """Remove a lesson or an assignment that was loaded; ``file`` is the name of its file."""

    file: str
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state without it."""
        refuse_in_assignment(state[LessonPart])
        state = EndPreview().apply(state)
        own = state[OwnLessons]
        return state.replace(own.having(tuple(each for each in own.files if each.file != self.file)))


@dataclass(frozen=True)
class ArrangeCourse(Command):
    """Begin to put a course in order: the one that is shown, or none.

    Parameters
    ----------
    begin : bool
        False to forget the order.
    """

    begin: bool = True
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the course."""
        course = lessons().course(state[LessonPart].course) if self.begin else None
        return state.replace(replace(state[OwnLessons], course=course))


@dataclass(frozen=True)
class MoveInCourse(Command):
    """Move a lesson of the course by one place, also into the next chapter.

    Parameters
    ----------
    key : str
    by : int
        -1 towards the beginning, 1 towards the end.
    """

    key: str
    by: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the lesson moved; the same state at the end of the course."""
        return _with(state, moved(_course(state), self.key, self.by))


@dataclass(frozen=True)
class LeaveOut(Command):
    """Take a lesson out of the course, or put one in at the end of a chapter.

    Parameters
    ----------
    key : str
    back : bool
        Whether it is put in, behind all others.
    """

    key: str
    back: bool = False
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the other course."""
        course = _course(state)
        return _with(state, put_back(course, self.key) if self.back else left_out(course, self.key))


def _course(state: State) -> Course:
    course = state[OwnLessons].course
    if course is None:
        raise InputError("course: none is being put in order")
    return course


def _with(state: State, course: Course) -> State:
    own = state[OwnLessons]
    return state if course == own.course else state.replace(replace(own, course=course))
