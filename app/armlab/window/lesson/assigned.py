"""An assignment in the dock of the lesson: its tasks, the clock, and the hand-in."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from armlab.content.as_written import as_part
from armlab.content.assignment import Assignment, said_date
from armlab.content.lesson import Lesson
from armlab.content.lessons import lessons
from armlab.session.clock import now
from armlab.teaching.assignment_commands import OpenTask, TakeUp
from armlab.teaching.assignment_work import Work
from armlab.teaching.hand_in import work_name
from armlab.teaching.lesson_commands import CloseLesson, GoToStep, TakeLessonArm
from armlab.teaching.lesson_places import kept_at, place_of, where_in
from armlab.teaching.lesson_progress import Progress, step_names
from armlab.teaching.parts.lesson import LessonPart
from armlab.ui.form import Form, Wish
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import verdict_box

TASK = "task-"
LEAVE = "assignment-leave"


@dataclass(frozen=True)
class Sheet:
    """An assignment as it is worked on.

    Parameters
    ----------
    part : LessonPart
    of : Assignment
    work : Work
    """

    part: LessonPart
    of: Assignment
    work: Work

    @classmethod
    def open(cls, part: LessonPart) -> Sheet | None:
        """Return the open assignment, or None."""
        found, work = part.assigned, part.work
        return None if found is None or work is None else cls(part, found, work)

    @property
    def task(self) -> int | None:
        """The open task, from 0; None where its file has changed, and the open lesson is none of its tasks any more."""
        return next((i for i in range(len(self.of.tasks)) if self.place(i) == self.part.open), None)

    def place(self, i: int) -> str:
        """Return the place of the lesson of a task in the variant of the student."""
        task = self.of.tasks[i]
        return place_of(task.lesson, task.number(self.work.number))

    def lesson(self, i: int) -> Lesson:
        """Return the lesson of a task in the variant of the student."""
        return kept_at(self.place(i))

    def progress(self, i: int) -> Progress:
        """Return the progress in a task."""
        return self.part.progress_of.get(where_in(self.of.key, self.place(i)), Progress())

    def answered(self, lesson: Lesson) -> frozenset[int]:
        """Return the steps of the open lesson, from 0, that have an answer; of arms nothing is told."""
        answers = self.part.progress.answers
        return frozenset(k for k, name in enumerate(step_names(lesson)) if name in answers)

    @property
    def points(self) -> tuple[float, float]:
        """The points of all that is done, as judged on screen, and of all there is; without what late work loses."""
        got = most = 0.0
        for i, task in enumerate(self.of.tasks):
            lesson, progress = self.lesson(i), self.progress(i)
            points, names = task.points_of(lessons()[task.lesson]), step_names(lesson)
            passed = progress.passed(lesson)
            if self.of.exam:  # of a prediction any answer counts in a lesson; in an exam it has to be right
                passed = frozenset(k for k in passed if lesson.steps[k].question is None or names[k] in progress.right)
            shown = [progress.hints.get(name, 0) for name in names]
            lost = sum(self.of.lost(points[k], lesson.steps[k], shown[k]) for k in passed)
            got, most = got + sum(points[k] for k in passed) - lost, most + sum(points)
        return got, most


def head(form: Form, sheet: Sheet) -> Inside:
    """Return title and tasks, with the button to leave."""
    leave = "Leave the assignment; its clock goes on" if sheet.of.ends(sheet.work.begun) else "Leave the assignment"
    title = tag(
        "div.lesson-head.as-head",
        tag("b", sheet.of.title),
        form.button(LEAVE, "✕", CloseLesson(), "chip", leave, leave),
    )
    here = sheet.task

    def entry(i: int) -> Markup:
        said = f"Task {i + 1}: {as_part(lessons()[sheet.of.tasks[i].lesson].title)}"
        return form.chip(f"{TASK}{i}", str(i + 1), OpenTask(i), said, i == here)

    tasks = [entry(i) for i in range(len(sheet.of.tasks))]
    name = tag("b", "The tasks have changed: choose one." if here is None else sheet.lesson(here).title)
    return title, tag("div.as-tasks", tag("span", "Tasks"), tasks, name)


class Clock:
    """The clock of the work, which the page's script lets run; the time of the lab counts."""

    def __init__(self) -> None:
        self._said: tuple[float, int] | None = None

    def markup(self, sheet: Sheet) -> Markup:
        """Return what is left, or when it was closed."""
        if sheet.work.handed is not None:
            return tag("div.as-line", tag("span", f"Closed on {said_date(sheet.work.handed)}"))
        ends = sheet.of.ends(sheet.work.begun)
        if ends is None:
            due = f"Due on {said_date(sheet.of.due)}" if sheet.of.due is not None else "No date is set"
            return tag("div.as-line", tag("span", due))
        if self._said is None or self._said[0] != ends:
            self._said = ends, round(1000.0 * now())
        attributes = {"data_ends": str(round(1000.0 * ends)), "data_now": str(self._said[1])}
        until = tag("time.as-clock", f"until {said_date(ends)}", role="timer", **attributes)
        return tag("div.as-line", tag("span", "Time left"), until)


def strips(form: Form, sheet: Sheet, lesson: Lesson) -> Markup:
    """Return one strip for each step: answered, shown, or to come."""
    answered = sheet.answered(lesson)

    def strip(i: int, title: str) -> Markup:
        done = ", answered" if i in answered else ""
        kind = " ".join(["strip"] + ["answered"] * (i in answered))
        said = f"Step {i + 1}{done}: {as_part(title)}"
        here = "step" if i == sheet.part.index else ""
        return form.button(f"lesson-step-{i}", "", GoToStep(i), kind, said, said, aria_current=here)

    return tag("div.strips", [strip(i, step.title) for i, step in enumerate(lesson.steps)])


def check_box(part: LessonPart) -> Markup:
    """Return what is said of a check whose verdict has to wait: the same whether it is met or not."""
    says = "What counts is how the arm stands when you leave this step."
    return verdict_box("todo", "Noted" if part.progress.tried else "To do", says)


def noted(typed: str, settled: bool) -> Markup | None:
    """Return what is said of an answer whose verdict has to wait, settled as a prediction is; nothing before it."""
    if not typed:
        return None
    if settled:
        return verdict_box("todo", "Your prediction is noted; only the first one counts.", role="status")
    return verdict_box("todo", "Your answer is noted", "You can change it until you hand in.", role="status")


def foot(form: Form, sheet: Sheet, lesson: Lesson, hint: Inside) -> Markup:
    """Return the buttons back and on, which lead from task to task."""
    i, here = sheet.part.index, sheet.task
    if i:
        back = form.button("lesson-back", "‹ Back", GoToStep(i - 1), "way")
    elif here:
        back = form.button("lesson-back", f"‹ Task {here}", OpenTask(here - 1), "way")
    else:
        back = tag("span")
    if i < len(lesson.steps) - 1:
        on = form.button("lesson-next", "Next ›", GoToStep(i + 1), "way on")
    elif here is not None and here < len(sheet.of.tasks) - 1:
        on = form.button("lesson-next", f"Task {here + 2} ›", OpenTask(here + 1), "way on")
    else:
        on = tag("span.dim", "The last step")
    return tag("div.lesson-foot", back, hint, on)


def hand_in_form(
    form: Form, sheet: Sheet, name: Markup, ask: Callable[[], Wish], save: Callable[[], Wish], now: float
) -> Markup:
    """Return the name and the button to hand in; when that is done, the file to give, and a further attempt."""
    work, of = sheet.work, sheet.of
    again = "Restore the arm of this step; your answers are kept"
    own = tag("div.row", tag("span", "Name"), tag("div.answer", name))
    if work.handed is None:
        chips = (
            form.button("assignment-hand-in", "Hand in", ask, "main"),
            form.chip("lesson-setup", "Set up again", TakeLessonArm(), again),
        )
        return tag("div.as-hand-in", own, tag("div.chips", chips), tag("p.dim", _attempts(of, work)))
    file = form.button("lesson-save", "Save the file", save, "main", "The file to give to your teacher")
    takes = work.left_over(of, now)
    more = form.chip("assignment-again", "Work on it again", TakeUp(), "For another attempt") if takes else None
    told = tag("p.dim", _attempts(of, work)) if takes else None
    return tag("div.as-hand-in", _closed(sheet), own, tag("div.chips", file, more), told)


def _closed(sheet: Sheet) -> Markup:
    """Return what is left to do with work that is closed: the lab gives it to nobody."""
    work, due = sheet.work, sheet.of.due
    got, most = sheet.points
    why = "The time is over, and your work is closed." if work.by_clock else "Your work is closed."
    given = f"Your teacher has it only when you have given them the file {work_name(sheet.part)}."
    inside = [tag("p", why), tag("p", given)]
    if not sheet.part.student:
        inside.append(tag("p", "Your name is missing in it: write it below, and save the file again."))
    if due is not None and work.handed is not None and work.handed > due:
        inside.append(tag("p", "It came late."))
    said = f"{_number(got)} of {_number(most)} points on screen; what counts is how your teacher judges the file."
    return verdict_box("todo", "Give the file to your teacher", inside, tag("p", said), role="status")


def _attempts(of: Assignment, work: Work) -> str:
    """Return how often the work can still be handed in."""
    if not of.attempts:
        return "You can hand in as often as you like; the last time counts."
    left = of.attempts - work.attempts
    return f"You can hand in {'once' if left == 1 else f'{left} times'}{' more' if work.attempts else ''}."


def _number(points: float) -> str:
    return f"{math.floor(100.0 * points + 0.5) / 100.0:g}"
