"""Assignments: which lessons a class works on, until when, under which conditions, and for how many points."""

from __future__ import annotations

import datetime
import hashlib
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from types import MappingProxyType

from armlab.content.lesson import Lesson, Step
from armlab.content.lesson_fields import Fields
from armlab.content.lesson_lines import LessonError, line_of, located
from armlab.content.names import named
from armlab.content.reader import Table, shown
from armlab.content.robots import KEY
from armlab.errors import ContentError, suggestion

MOST_TASKS = 50
MOST_MINUTES = 24 * 60
MOST_ATTEMPTS = 99
MOST_POINTS = 10_000.0
LAST_VARIANT = 9999
FIRST_YEAR, LAST_YEAR = 1971, 9998
BY_STUDENT = "student"
"""The word for variants that each student has of their own."""


@dataclass(frozen=True)
class Task:
    """One lesson of an assignment.

    Attributes
    ----------
    lesson : str
        Its key.
    variant : int or None
        The variant that all work on; None where each student has one of their own.
    points : float, mapping of str to float, or None
        For the whole lesson, in equal parts; or by title of the step, where all others give none; or one point for each
        step with something to do.
    """

    lesson: str
    variant: int | None = None
    points: float | Mapping[str, float] | None = None

    def number(self, student: int) -> int:
        """Return the variant for a student with a number of their own."""
        return student if self.variant is None else self.variant

    def points_of(self, lesson: Lesson) -> tuple[float, ...]:
        """Return the points that each step gives when it is done.

        Parameters
        ----------
        lesson : Lesson
            In its variant 0, by whose titles steps are named: a title may hold values of the variant.
        """
        tasks = [step.check is not None or step.question is not None for step in lesson.steps]
        if isinstance(self.points, Mapping):
            return tuple(self.points.get(step.title, 0.0) for step in lesson.steps)
        each = 1.0 if self.points is None else self.points / max(1, sum(tasks))
        return tuple(each if task else 0.0 for task in tasks)


@dataclass(frozen=True)
class Assignment:
    """An assignment; moments are seconds since 1970.

    Attributes
    ----------
    key : str
        Name of its file without ending.
    file, title, about : str
        ``about`` is a sentence or two; empty for none.
    version : int
        Work on another version is not accepted.
    exam : bool
        Whether nothing is said of answers and checks until the work is handed in, and what stands last counts.
    hints : bool
    pages : tuple of str or None
        Keys of the only pages that are open besides those of its lessons; None for all.
    pages_line : int
        Line of the file that names them, from 1.
    opens, due, closes : float or None
        From when on it can be begun; after which work is late; after which none is accepted.
    minutes : int
        Time for the work from its beginning; 0 for as long as it is open.
    attempts : int
        How often it can be handed in; 0 for any number.
    late_percent : float
        Part of the points that late work loses.
    last_hint_percent : float
        Part of its points that a step loses whose last hint was shown.
    tasks : tuple of Task
    digest : str
        Changes with the text of the file.
    """

    key: str
    file: str
    title: str
    about: str
    version: int
    exam: bool
    hints: bool
    pages: tuple[str, ...] | None
    pages_line: int
    opens: float | None
    due: float | None
    closes: float | None
    minutes: int
    attempts: int
    late_percent: float
    last_hint_percent: float
    tasks: tuple[Task, ...]
    digest: str

    @property
    def lessons(self) -> tuple[str, ...]:
        """Keys of its lessons, in order."""
        return tuple(task.lesson for task in self.tasks)

    @property
    def by_student(self) -> bool:
        """Whether any of its variants is the student's own."""
        return any(task.variant is None for task in self.tasks)

    def ends(self, begun: float) -> float | None:
        """Return when work that was begun at a moment ends; None for never."""
        moments = [begun + 60.0 * self.minutes] if self.minutes else []
        return min([*moments, *([] if self.closes is None else [self.closes])], default=None)

    def lost(self, points: float, step: Step, shown: int) -> float:
        """Return what a step loses of its points when so many of its hints were shown: nothing but for the last one."""
        return points * self.last_hint_percent / 100.0 if step.hints and shown >= len(step.hints) else 0.0

    def task_of(self, lesson: str) -> Task | None:
        """Return the task with a lesson; None when it has none."""
        return next((task for task in self.tasks if task.lesson == lesson), None)


def parse_assignment(key: str, text: str, file: str) -> Assignment:
    """Read the text of an assignment file; whether its lessons exist is told by `amiss`.

    Parameters
    ----------
    key, text : str
    file : str
        Its name in messages.

    Raises
    ------
    LessonError
        It is no TOML, a key is missing, unknown or wrong, or dates and conditions contradict each other.
    """
    with located(file, "", text, 1):
        if not KEY.match(key):
            problem = f"expected a file name of lower-case letters, digits and underscores, got {key!r}; rename it"
            raise ContentError(file, "", problem)
        top = Fields.of(Table.parse(file, text))
        exam = top.boolean("exam", False)
        opens, due, closes = (_moment(top, name) for name in ("opens", "due", "closes"))
        assignment = Assignment(
            key=key,
            file=file,
            title=top.text("title"),
            about=top.text("about", ""),
            version=top.whole("version", 1, 9999) if top.has("version") else 1,
            exam=exam,
            hints=top.boolean("hints", not exam),
            pages=top.words("pages") if top.has("pages") else None,
            pages_line=line_of(text, "pages") or 1,
            opens=opens,
            due=due,
            closes=due if exam and closes is None else closes,
            minutes=top.whole("minutes", 1, MOST_MINUTES) if top.has("minutes") else 0,
            attempts=top.whole("attempts", 1, MOST_ATTEMPTS) if top.has("attempts") else int(exam),
            late_percent=_percent(top, "late_percent"),
            last_hint_percent=_percent(top, "last_hint_percent"),
            tasks=_tasks(top),
            digest=hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()[:16],
        )
        top.done()
        _refuse_contradictions(top, assignment)
    return assignment


def _percent(top: Table, key: str) -> float:
    percent = top.number(key, 0.0)
    if not 0.0 <= percent <= 100.0:
        raise top.fail(key, f"expected 0 to 100, got {percent:g}")
    return percent


def _moment(top: Table, key: str) -> float | None:
    """Take a date, or a date with a time; one without an offset is meant in the time zone of this computer."""
    if not top.has(key):
        return None
    value = top.value(key)
    if isinstance(value, datetime.date) and not FIRST_YEAR <= value.year <= LAST_YEAR:
        # Beyond these a moment has no date in some time zone.
        raise top.fail(key, f"expected a year from {FIRST_YEAR} to {LAST_YEAR}, got {value.year}")
    if isinstance(value, datetime.datetime):
        return value.timestamp()
    if isinstance(value, datetime.date):
        # A day begins with its first second, and work that is due on it may come until its last.
        time = datetime.time.min if key == "opens" else datetime.time(23, 59, 59)
        return datetime.datetime.combine(value, time).timestamp()
    example = "2026-11-30, 2026-11-30T09:00:00 or 2026-11-30T09:00:00+01:00, without quotes"
    raise top.fail(key, f"expected a date or a date with a time such as {example}, got {shown(value)}")


def _tasks(top: Table) -> tuple[Task, ...]:
    tables = top.tables("tasks")
    if not 1 <= len(tables) <= MOST_TASKS:
        raise top.fail("tasks", f"expected 1 to {MOST_TASKS} tables [[tasks]] with a lesson each, got {len(tables)}")
    tasks = tuple(_task(Fields.of(table)) for table in tables)
    for i, task in enumerate(tasks):
        if task.lesson in [earlier.lesson for earlier in tasks[:i]]:
            raise tables[i].fail("lesson", f"the lesson {task.lesson!r} is in the assignment already; name it once")
    return tasks


def _task(fields: Fields) -> Task:
    task = Task(fields.text("lesson"), _variant(fields), _points(fields))
    fields.done()
    return task


def _variant(fields: Fields) -> int | None:
    value = fields.value("variant", BY_STUDENT)
    if value == BY_STUDENT:
        return None
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value <= LAST_VARIANT:
        problem = f'expected "{BY_STUDENT}", for one of their own each, or a number from 0 to {LAST_VARIANT}'
        raise fields.fail("variant", f"{problem}, got {shown(value)}")
    return value


def _points(fields: Fields) -> float | Mapping[str, float] | None:
    if not fields.has("points"):
        return None
    if not isinstance(fields.value("points"), dict):
        return _worth(fields, "points")
    table = fields.table("points")
    assert table is not None
    steps = Fields.of(table)
    found = {title: _worth(steps, title) for title in steps.keys}
    if not found:
        raise fields.fail("points", 'expected a number, or titles of steps with numbers such as "Find the hand" = 2')
    return MappingProxyType(found)


def _worth(table: Table, key: str) -> float:
    points = table.number(key)
    if not 0.0 < points <= MOST_POINTS:
        raise table.fail(key, f"expected more than 0 and at most {MOST_POINTS:g} points, got {points:g}")
    return points


def _refuse_contradictions(top: Table, found: Assignment) -> None:
    if found.exam and found.hints:
        raise top.fail("hints", "an exam gives no hints: leave hints away, or exam = true")
    if found.last_hint_percent and not found.hints:
        raise top.fail("last_hint_percent", "without hints none costs anything: leave this away, or let hints be given")
    order = [(name, moment) for name in ("opens", "due", "closes") if (moment := getattr(found, name)) is not None]
    for (first, earlier), (name, later) in pairwise(order):
        # An exam closes when it is due unless it says otherwise.
        if later < earlier or (later == earlier and first == "opens"):
            at_fault = name if top.has(name) else "due"
            problem = f"expected a moment after {first}, {said_date(earlier)}, got {said_date(later)}"
            raise top.fail(at_fault, problem)
    if found.late_percent and found.due is None:
        raise top.fail("late_percent", "without a date that it is due nothing is late: add due, or leave this away")
    if found.late_percent and found.closes is not None and found.closes == found.due:
        raise top.fail("late_percent", "it closes when it is due, so nothing can be late: let closes be later")
    if found.minutes and found.opens is not None and found.closes is not None:
        there = (found.closes - found.opens) / 60.0
        if found.minutes > there:
            problem = f"expected at most the {there:.0f} minutes for which it is open, got {found.minutes}"
            raise top.fail("minutes", problem)


def amiss(found: Assignment, text: str, lessons: Mapping[str, Lesson], known: Collection[str]) -> Iterator[LessonError]:
    """Yield what does not fit the lessons that there are: an unknown one, or a step that one does not have.

    Parameters
    ----------
    found : Assignment
    text : str
        That of its file.
    lessons : mapping of str to Lesson
        Those that can be used.
    known : collection of str
        Keys of all lessons that have a file.
    """
    for i, task in enumerate(found.tasks, start=1):
        where = f"tasks[{i}].lesson"
        if task.lesson not in lessons:
            problem = f"unknown lesson {named(task.lesson)!r}{suggestion(task.lesson, map(named, lessons))}"
            if task.lesson in known:
                problem = f"the lesson {named(task.lesson)!r} cannot be used; its own file has a mistake"
            yield LessonError(found.file, where, problem, line_of(text, where) or 1)
            continue
        lesson = lessons[task.lesson]
        if isinstance(task.points, Mapping):
            yield from _unknown_steps(found, text, i, task.points, lesson)
        if not sum(task.points_of(lesson)):
            problem = f"the lesson {named(task.lesson)!r} has nothing to do, and so no points to give"
            yield LessonError(found.file, where, problem, line_of(text, where) or 1)


def _unknown_steps(
    found: Assignment, text: str, i: int, points: Mapping[str, float], lesson: Lesson
) -> Iterator[LessonError]:
    titles = {step.title: step for step in lesson.steps}
    for title in points:
        step, where = titles.get(title), f"tasks[{i}].points"
        if step is None:
            problem = f"the lesson {named(lesson.key)!r} has no step {title!r}{suggestion(title, titles)}"
        elif step.check is None and step.question is None:
            problem = (
                f"the step {title!r} of the lesson {named(lesson.key)!r} has nothing to do, and so no points to give"
            )
        else:
            continue
        yield LessonError(found.file, f"{where}.{title}", problem, _line_of_step(text, where, title))


def _line_of_step(text: str, where: str, title: str) -> int:
    """Return the line of a title in a table of points, or of the table."""
    begins = line_of(text, where) or 1
    lines = text.split("\n")
    return next((n for n in range(begins, len(lines) + 1) if title in lines[n - 1]), begins)


def said_date(moment: float) -> str:
    """Return a moment as it is told: day and time, in the time zone of this computer."""
    found = datetime.datetime.fromtimestamp(moment)
    return f"{found.day} {found:%b %Y, %H:%M}"
