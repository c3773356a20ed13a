"""Commands of lessons: open, step through, answer, ask for a hint, close."""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import ClassVar

from armlab.content.held import is_held
from armlab.content.lesson import Lesson
from armlab.content.lessons import lessons
from armlab.errors import InputError, UnknownName
from armlab.registry import known_name
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Command, State
from armlab.teaching.assignment_rules import refuse_in_assignment, refuse_late
from armlab.teaching.lesson_panels import lesson_followed
from armlab.teaching.lesson_places import at_place, kept_at, place_of
from armlab.teaching.lesson_progress import MOST_TYPED, Progress, RightAnswer, step_names
from armlab.teaching.lesson_start import gone_to, refuse_unknown, set_up, without_lesson
from armlab.teaching.parts.former import Former, offered, without_lessons_switches
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.own_lessons import OwnLessons
from armlab.teaching.parts.preview import Preview
from armlab.teaching.parts.shelf import at_home
from armlab.teaching.plain_text import plain
from armlab.teaching.shown_step import refuse_of_another
from armlab.teaching.signature import signed

MOST_VARIANT = 9999


@dataclass(frozen=True)
class OpenLesson(Command):
    """Open a lesson: its arm in its start pose, its target, its switches. It goes on where the student has left it.

    Parameters
    ----------
    key : str
    anew : bool
        Whether to forget the progress in it, also when it is open already.
    variant : int, optional
        Variant of a lesson that has some; by default the one last worked on, or the student's own.
    within : bool
        Whether it is opened as a task of the open assignment, or by its author.
    """

    key: str
    anew: bool = False
    variant: int | None = None
    within: bool = False
    label: ClassVar[str] = "arm of the lesson"

    def apply(self, state: State) -> State:
        """Return the state at the start of the lesson, or the same state if it is open already."""
        part = state[LessonPart]
        if not self.within:
            self._refuse_in_assignment(part)
        self._refuse_of_others(state)
        place = self._place(part)
        if part.open == place and not self.anew:
            return state
        opened = replace(part, open=place, set_up=part.set_up + 1).taken_up()
        kept = Progress() if self.anew else opened.progress.anew()
        kept_one = self.within and opened.where in part.progress_of
        lesson = kept_at(place) if kept_one else at_place(place)
        refuse_unknown(lesson)
        begun = set_up(state, lesson, kept.shown(lesson)).replace(opened.with_progress(kept), Former.of(at_home(state)))
        return lesson_followed(state, begun)

    def _refuse_in_assignment(self, part: LessonPart) -> None:
        refuse_in_assignment(part)
        if not at_place(self.key).listed and not is_held(self.key):
            raise InputError(f"The lesson {self.key!r} belongs to an assignment, and is opened with it.")

    def _refuse_of_others(self, state: State) -> None:
        """Raise `UnknownName` for what somebody else has loaded; one's own is opened by a preview alone."""
        if is_held(self.key) and (state[Preview].before is None or not state[OwnLessons].holds(self.key)):
            raise UnknownName("lesson", self.key, [found.key for found in lessons().listed])

    def _place(self, part: LessonPart) -> str:
        if self.variant is not None and not 0 <= self.variant <= MOST_VARIANT:
            raise InputError(f"variant: expected 0 to {MOST_VARIANT}, got {self.variant}")
        if self.variant is not None or not at_place(self.key).varies:
            return place_of(self.key, self.variant or 0)
        known = (place for place in reversed(list(part.progress_of)) if place.startswith(f"{self.key}/"))
        return next(known, place_of(self.key, part.number))


@dataclass(frozen=True)
class TakeLessonArm(Command):
    """Restore arm and example of the open lesson as at the start of the step; the progress stays."""

    label: ClassVar[str] = "arm of the lesson"

    def apply(self, state: State) -> State:
        """Return the state with the arm of the lesson."""
        part = state[LessonPart]
        return set_up(state, _lesson(state), part.index).replace(replace(part, set_up=part.set_up + 1))


@dataclass(frozen=True)
class CloseLesson(Command):
    """Close the lesson; arm and progress stay, everything locked is free again, and the lesson's overlays go.

    With a lesson of an assignment this is left, which is counted until it is handed in; its clock goes on.
    """

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state without a lesson."""
        part = state[LessonPart]
        if part.lesson is None:
            return state
        if part.work is not None and not part.rests:
            state = state.replace(part.with_work(replace(part.work, left=part.work.left + 1)))
        closed = without_lessons_switches(without_lesson(state))
        return closed if offered(closed) else closed.replace(Former())


@dataclass(frozen=True)
class ReloadLesson(Command):
    """Show the open lesson again after its file has changed; steps that still exist keep their progress."""

    key: str
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the lesson as it is in its file now."""
        part = state[LessonPart]
        if part.open.partition("/")[0] != self.key:
            return state
        return state.replace(replace(part, loaded=part.loaded + 1))


@dataclass(frozen=True)
class ChooseCourse(Command):
    """Choose the course that is shown; which lesson is open and what is done stays.

    Parameters
    ----------
    key : str
    """

    key: str
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the course."""
        courses = {course.key: course for course in lessons().courses}
        known_name("course", self.key, courses)
        part = state[LessonPart]
        return state if part.course == self.key else state.replace(replace(part, course=self.key))


@dataclass(frozen=True)
class SignAs(Command):
    """Set the name with which a student signs the work."""

    name: str
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the name."""
        part, name = state[LessonPart], signed(self.name)
        return state if name == part.student else state.replace(replace(part, student=name))


@dataclass(frozen=True)
class GoToStep(Command):
    """Show a step of the open lesson, done or not, with what it begins with.

    One that begins with nothing of its own goes on with what has become of the step shown before it.

    Parameters
    ----------
    step : int
        Step, from 0.
    """

    step: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the step shown."""
        lesson, part = _lesson(state), state[LessonPart]
        if not 0 <= self.step < len(lesson.steps):
            raise InputError(f"step: expected 1 to {len(lesson.steps)}, got {self.step + 1}")
        if self.step == part.index:
            return state
        shown = replace(part.progress, step=step_names(lesson)[self.step]).anew()
        gone = state.replace(part.with_progress(shown))
        if part.silent:  # a film that plays on would change what the other step is judged by
            gone = gone.replace(replace(gone[Timeline], playing=False))
        put = gone_to(gone, lesson, part.index, self.step)
        if put is not gone:
            put = put.replace(replace(put[LessonPart], set_up=part.set_up + 1))
        return lesson_followed(state, put)

    def ends_history(self, before: State, after: State) -> bool:
        """Return whether the step has put something in place, which no undo is to take away while it is shown."""
        return after[LessonPart].set_up != before[LessonPart].set_up


@dataclass(frozen=True)
class UnlockHint(Command):
    """Show the next hint of the shown step.

    Parameters
    ----------
    of : str, optional
        The step for which it is asked, as `shown_step` tells it; by default the shown one.
    """

    of: str | None = None
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with one more hint, or the same state when all are shown."""
        part = state[LessonPart]
        refuse_of_another(part, self.of)
        step, progress, name = part.step, part.progress, part.name
        shown = progress.hints.get(name, 0)
        if part.assigned is not None and not part.assigned.hints:
            raise InputError("This assignment gives no hints.")
        if step is None or part.rests or shown >= len(step.hints):
            return state
        hints = MappingProxyType({**progress.hints, name: shown + 1})
        return state.replace(part.with_progress(replace(progress, hints=hints)))


@dataclass(frozen=True)
class Answer(Command):
    """Answer the question of the shown step.

    Parameters
    ----------
    text : str
        The answer as typed; an empty one removes it. The first prediction counts and stays.
    of : str, optional
        The step whose question is answered, as `shown_step` tells it; by default the shown one.
    """

    text: str
    of: str | None = None
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the answer."""
        part, typed = state[LessonPart], self.text.strip()[:MOST_TYPED]
        refuse_of_another(part, self.of)
        step, progress, name = part.step, part.progress, part.name
        if step is None or step.question is None:
            raise InputError("answer: there is no question here")
        refuse_late(part, state.at)
        if step.question.hide and name in progress.answers:
            raise InputError("Your prediction is noted; only the first one counts.")
        verdict = step.question.judge(typed)
        if step.question.hide and not verdict.counts:
            raise InputError(still_open(plain(verdict.says)))
        answers = {other: text for other, text in progress.answers.items() if other != name}
        # In an exam what stands last counts: with no verdict in sight one could else try all options.
        right = {other: each for other, each in progress.right.items() if other != name or not part.silent}
        if typed:
            answers[name] = typed
            if verdict.right:
                right.setdefault(name, RightAnswer(typed))
        kept = replace(progress, right=MappingProxyType(right), answers=MappingProxyType(answers))
        return state.replace(part.with_progress(kept))


def still_open(why: str) -> str:
    """Return what is said of a prediction that is no answer: why, and that nothing is lost."""
    return f"{why}{'' if why.endswith(('.', '?', '!')) else '.'} Your prediction is still open."


def _lesson(state: State) -> Lesson:
    lesson = state[LessonPart].lesson
    if lesson is None:
        raise InputError("lesson: no lesson is open")
    return lesson
