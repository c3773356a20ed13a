"""Commands of assignments: open one, go to a task, hand in, take up again. It is left as a lesson is closed."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

from armlab.content.as_written import as_part
from armlab.content.assignment import LAST_VARIANT, Assignment, said_date
from armlab.content.held import is_held
from armlab.content.lesson_lines import LessonError
from armlab.content.lessons import lessons
from armlab.errors import ArmlabError, InputError, suggestion
from armlab.registry import known_name
from armlab.session.pages import pages
from armlab.session.state import Command, State, apply
from armlab.teaching.assignment_work import Work, is_open
from armlab.teaching.lesson_commands import OpenLesson
from armlab.teaching.lesson_places import where_in
from armlab.teaching.parts.former import Former
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.preview import Preview
from armlab.teaching.parts.shelf import HOME, Shelf, at_home


@dataclass(frozen=True)
class OpenAssignment(Command):
    """Open an assignment at the task last opened; the first time its clock begins to run.

    Parameters
    ----------
    key : str
    number : int, optional
        The variant of its lessons, where that is the student's own; by default the one it was begun in.
    """

    key: str
    number: int | None = None
    label: ClassVar[str] = "arm of the assignment"

    def apply(self, state: State) -> State:
        """Return the state in the assignment, or the same state if it is open already.

        Raises
        ------
        UnknownName, ContentError
            There is no such assignment, or it cannot begin since it names a page that does not exist.
        InputError
            It is not open yet, or not any more; another one is open; or the student is not at home, or in a preview,
            which forgets what is done in it.
        """
        found, part = lessons().assignment(self.key), state[LessonPart]
        work = _begun(found, part, state.at, self.number)
        if part.assignment == self.key and part.work == work:
            return state
        if part.assigned is not None and part.assignment != self.key:
            raise InputError(f"{is_open(part.assigned)} Leave it before you open another.")
        in_preview = state[Preview].before is not None and not is_held(self.key)
        if state[Shelf].place != HOME or in_preview:
            raise InputError("assignment: go back to your own work first")
        opened = replace(part, open="", assignment=self.key).with_work(work.at(found, state.at))
        begun = OpenTask(_last(opened, found)).apply(state.replace(opened))
        return begun.replace(Former.of(at_home(state)))  # of the lesson that is open until now, too


def clock_of(command: Command | None, state: State, now: float) -> Assignment | None:
    """Return the assignment whose clock a command would start; None also where it would be refused."""
    if not isinstance(command, OpenAssignment) or command.key in state[LessonPart].works:
        return None
    try:
        found = apply(state, command, now)[LessonPart].assigned
    except ArmlabError:
        return None  # it is refused again where it is carried out, and that is told
    return found if found is not None and found.minutes else None


@dataclass(frozen=True)
class OpenTask(Command):
    """Open a task of the open assignment.

    Parameters
    ----------
    task : int
        From 0.
    """

    task: int
    label: ClassVar[str] = "arm of the assignment"

    def apply(self, state: State) -> State:
        """Return the state in the lesson of the task, or the same state if it is open already."""
        found, work = _assigned(state)
        if not 0 <= self.task < len(found.tasks):
            raise InputError(f"task: expected 1 to {len(found.tasks)}, got {self.task + 1}")
        task = found.tasks[self.task]
        return OpenLesson(task.lesson, variant=task.number(work.number), within=True).apply(state)


@dataclass(frozen=True)
class HandIn(Command):
    """Hand the work in: from now on it is judged on screen, and cannot be changed."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the work handed in; the same state when it is already.

        Raises
        ------
        InputError
            No assignment is open, or the work is not signed.
        """
        found, work = _assigned(state)
        part = state[LessonPart]
        if part.rests:
            return state
        if work.over(found, state.at):
            return state.replace(part.with_work(work.at(found, state.at)))
        if not part.student:
            raise InputError("Write your name at “Name” first: the work is handed in under it.")
        return state.replace(part.with_work(work.handed_in(state.at)))


@dataclass(frozen=True)
class TakeUp(Command):
    """Take up work again that was handed in, for another attempt."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the work open to be changed; the same state when it is already.

        Raises
        ------
        InputError
            No assignment is open, no attempt is left, or its time is over.
        """
        found, work = _assigned(state)
        part = state[LessonPart]
        if not part.rests:
            return state
        if not work.left_over(found, state.at):
            over = "its time is over" if work.over(found, state.at) else f"all {found.attempts} attempts are used"
            raise InputError(f"This work cannot be taken up again: {over}.")
        return state.replace(part.with_work(replace(work, handed=None, by_clock=False)))


@dataclass(frozen=True)
class LookAtClock(Command):
    """Hand the open work in if its time is over."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the work as it is now; the same state while there is time, or no work."""
        part = state[LessonPart]
        found, work = part.assigned, part.work
        if found is None or work is None or work.at(found, state.at) is work:
            return state
        return state.replace(part.with_work(work.at(found, state.at)))


def refuse_unknown_pages(found: Assignment) -> None:
    """Raise `LessonError` where an assignment names a page that does not exist."""
    for i, page in enumerate(found.pages or (), start=1):
        if page not in pages():
            problem = f"unknown page {page!r}{suggestion(page, pages())}"
            raise LessonError(found.file, f"pages[{i}]", problem, found.pages_line)


def refuse_before(found: Assignment, now: float) -> None:
    """Raise `InputError` where an assignment is not open yet."""
    if found.opens is not None and now < found.opens:
        raise InputError(f"The assignment “{as_part(found.title)}” opens on {said_date(found.opens)}.")


def _begun(found: Assignment, part: LessonPart, now: float, number: int | None) -> Work:
    """Return the work on an assignment, or that which begins now."""
    if number is not None and not 0 <= number <= LAST_VARIANT:
        raise InputError(f"variant: expected 0 to {LAST_VARIANT}, got {number}")
    work = part.works.get(found.key)
    if work is not None and number not in (None, work.number) and work.handed is not None:
        # Else one could work in several variants, see all verdicts, and save the best of them.
        raise InputError(f"The work on “{as_part(found.title)}” has been handed in in variant {work.number}.")
    if work is not None:
        # Who has begun can come back, whatever has become of the file.
        return work if number is None else replace(work, number=number)
    if not lessons().has_assignment(found.key):
        known_name("assignment", found.key, lessons().assignments)
    refuse_unknown_pages(found)
    refuse_before(found, now)
    if found.closes is not None and now >= found.closes:
        raise InputError(f"The assignment “{as_part(found.title)}” closed on {said_date(found.closes)}.")
    return Work(part.number if number is None else number, now)


def _last(part: LessonPart, found: Assignment) -> int:
    """Return the task, from 0, that was opened last; the first where none was."""
    opened = [where for where in part.progress_of if where.startswith(where_in(found.key, ""))]
    key = opened[-1].rpartition(":")[2].partition("/")[0] if opened else ""
    return found.lessons.index(key) if key in found.lessons else 0


def _assigned(state: State) -> tuple[Assignment, Work]:
    part = state[LessonPart]
    if part.assigned is None or part.work is None:
        raise InputError("assignment: none is open")
    return part.assigned, part.work
