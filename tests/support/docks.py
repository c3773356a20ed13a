"""The dock of a lesson in all its states, without a browser: what the lab says in it besides the lesson's own texts."""

from __future__ import annotations

import contextlib
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

from armlab.commands._translated import heard
from armlab.content.actions import Move
from armlab.content.assignment import said_date
from armlab.content.lesson import Lesson
from armlab.content.lessons import Lessons, lessons
from armlab.content.robots import catalogue
from armlab.content.stand_ins import without_numbers
from armlab.session.edits import RemoveJoint
from armlab.session.parts.joints import LockJoint, MoveJoint
from armlab.session.parts.robot import ChooseRobot
from armlab.session.parts.target import PlaceTarget
from armlab.session.state import Command, State, apply
from armlab.teaching.assignment_commands import HandIn, LookAtClock, OpenAssignment, OpenTask, TakeUp
from armlab.teaching.lesson_commands import Answer, GoToStep, OpenLesson, SignAs, TakeLessonArm, UnlockHint
from armlab.teaching.parts.lesson import LessonPart
from armlab.ui.asking import Draft, asked
from armlab.window.lesson import end, page
from support.assigned import NOON, folder_fixture
from support.bare_gui import BareGui, content
from support.check_talk import said_of_checks
from support.forms import BareForm
from support.own_lessons import ARM, QUESTIONS
from support.own_lessons import lesson as written
from support.saying import Listener
from support.small_lessons import library_fixture
from support.verdicts import predictions_refused, questions, verdicts

LESSONS = ("first_arm", "ik_2r")
"""Lessons of the course whose docks are looked at."""

LESSON = "lesson"
"""The place of what is said in these docks."""

MONTH = 30.5 * 24.0 * 3600.0
"""Seconds."""

LOCKED = (
    'locked = ["robot", "table", "joints"]',
    'locked = ["target"]\nlocked_joints = [1]',
    'locked = ["joints", "target"]',
    "locked_joints = [1, 2]",
)
"""What lessons lock."""

ASSIGNMENTS = {
    "once": "exam = true\nminutes = 30\nattempts = 1",
    "often": "attempts = 3\nlast_hint_percent = 50",
    "any": "",
    "practice": "hints = false",
}
"""Fields of assignments besides an exam and homework."""


class BareDock:
    """The dock of a student, and what the student does.

    Parameters
    ----------
    listener : Listener
        Hears all that is shown, and why something is refused.
    """

    def __init__(self, listener: Listener) -> None:
        self._listener, self._gui = listener, BareGui()
        self._gui.page, self._gui.again = "lesson", lambda: None
        self.page = page.LessonPage(self._gui, lambda command: None)
        self.state, self.at = State.initial(catalogue()["puma560"]), NOON
        self._known: set[str] = set()

    @property
    def part(self) -> LessonPart:
        """The open lesson."""
        return self.state[LessonPart]

    def do(self, *commands: Command) -> None:
        """Do something, and listen to what is shown then, or to why it is refused."""
        for command in commands:
            self._listener.try_out(lambda command=command: self._do(command))
            self.hear()

    def _do(self, command: Command) -> None:
        self.state = apply(self.state, command, self.at)

    def hear(self) -> None:
        """Listen to what the dock shows."""
        if self.part.lesson is None:
            return
        if self.part.open not in self._known:
            self._known.add(self.part.open)
            title = () if self.part.assigned is None else (self.part.assigned.title,)
            self._listener.knows((*_of_lesson(self.part.lesson), *title))
        self.page.show(self.state)
        self._listener.hear_markup(self.shown)

    @property
    def shown(self) -> list[str]:
        """The markup of the dock."""
        return [content(fields) for fields in self._gui.has] + [
            each.handle._impl.props.content for each in self._gui.said
        ]

    def solve(self, predicts: str = "") -> None:
        """Go through the open lesson as its solutions say, with hints and wrong answers on the way.

        Parameters
        ----------
        predicts : str
            An answer to the questions of which the first one counts; the right one if empty.
        """
        found = self.part.lesson
        assert found is not None
        for i, step in enumerate(found.steps):
            self.do(GoToStep(i), *[UnlockHint()] * len(step.hints), MoveJoint(0, 0.3))
            if step.question is not None:
                wrong = ("1/0", predicts) if step.question.hide else tuple(each.typed for each in step.question.wrong)
                self.do(*(Answer(text) for text in ("foo", *wrong, step.question.right_answer, "77")))
            for action in step.solution:
                if isinstance(action, Move):
                    self.do(*(MoveJoint(j, float(value)) for j, value in enumerate(action.q)))


def _of_lesson(found: Lesson) -> list[str]:
    """Return the texts of a lesson in the form of messages."""
    return [without_numbers(found.chapter).text, *heard(found, [])[0]]


def every_dock(listener: Listener) -> None:
    """Listen to what is said of answers and checks, and to the docks of some lessons, of an exam and of homework."""
    listener.at(LESSON)
    for html in verdicts():
        listener.speech.markup(html)
    for text in predictions_refused():
        listener.speech.text(text)
    for question, _ in questions():
        listener.speech.markup(asked(BareForm(), question, "", Draft(question.form, ""), settled=False))
    for month in range(12):
        listener.speech.text(said_date(NOON + month * MONTH))
    for text in said_of_checks():
        listener.speech.text(text)
    with docks_that_know(lambda: None):
        for key in LESSONS:
            of_the_course(listener, key)
    with lessons_of_a_test(), docks_that_know(lessons):
        of_a_test(listener)


@contextlib.contextmanager
def docks_that_know(read: Callable[[], Lessons | None]) -> Iterator[None]:
    """Let docks know some lessons at noon, whatever has been read before and however late it is."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(page, "now", lambda: NOON)
        for module in (page, end):
            patch.setattr(module, "lessons_read", read)
        yield


def of_the_course(listener: Listener, key: str) -> None:
    """Listen to the dock of a lesson of the course, with another arm, and when it fails."""
    dock = BareDock(listener)
    dock.do(OpenLesson(key))
    dock.solve(predicts="1")
    dock.do(ChooseRobot("scara"), TakeLessonArm(), MoveJoint(0, 0.1), SignAs("Ada"))
    dock.page.fail()
    listener.hear_markup(dock.shown)


@contextlib.contextmanager
def lessons_of_a_test() -> Iterator[None]:
    """Have small lessons, an exam and homework in place of the course."""
    with pytest.MonkeyPatch.context() as patch, tempfile.TemporaryDirectory() as folder:
        use = next(library_fixture(Path(folder), patch))
        locked = {f"locked{i}": written(front=f"{ARM}{text}\n") for i, text in enumerate(LOCKED)}
        place = folder_fixture(use, Path(folder))
        for key, fields in ASSIGNMENTS.items():
            (place / f"{key}.toml").write_text(f'title = "Of a test"\n{fields}\n[[tasks]]\nlesson = "v"\npoints = 1\n')
        use(questions=written(QUESTIONS), unlisted=written(front=f"{ARM}listed = false\n"), **locked)
        yield


def of_a_test(listener: Listener) -> None:
    """Listen to what is said in these."""
    listener.knows([each for found in lessons().lessons.values() for each in _of_lesson(found)])
    for key in ("questions", "v", "t"):
        dock = BareDock(listener)
        dock.do(Answer("1"), GoToStep(1), OpenLesson(key, variant=10**6), OpenLesson(key), GoToStep(99))
        dock.solve()
        dock.do(Answer("1"))
    for i in range(len(LOCKED)):
        dock = BareDock(listener)
        dock.do(OpenLesson(f"locked{i}"), MoveJoint(0, 0.1), MoveJoint(1, 0.1), LockJoint(0, False))
        dock.do(ChooseRobot("scara"), RemoveJoint(0), PlaceTarget(np.eye(4)))
    all_done(listener)
    for key in ("exam", "homework", *ASSIGNMENTS):
        on_assignment(listener, key)


def all_done(listener: Listener) -> None:
    """Listen to the end of a course, and to what is said where nothing is open."""
    dock = BareDock(listener)
    dock.do(HandIn(), OpenLesson("unlisted"))
    for found in lessons().listed:
        dock.do(OpenLesson(found.key))
        dock.solve(predicts="77")
        if found.key == "t":  # which has no solution
            dock.do(GoToStep(1), MoveJoint(0, np.pi / 2))


def on_assignment(listener: Listener, key: str) -> None:
    """Listen to an assignment from before it opens until it is over, handed in by the student or by the clock."""
    dock = BareDock(listener)
    for dock.at in (NOON - 60.0, NOON + 9000.0, NOON):
        dock.do(OpenAssignment(key, 3))
        if dock.part.assigned is not None:
            break
    for task in range(len(dock.part.assigned.tasks) if dock.part.assigned is not None else 0):
        dock.do(OpenTask(task), HandIn())
        dock.solve()
    dock.do(OpenTask(9), OpenLesson("t"), OpenAssignment("exam"), OpenAssignment("homework"), SignAs("Ada"))
    listener.try_out(dock.part.refuse_forgetting)
    begun = dock.state
    dock.do(HandIn(), Answer("1"), TakeUp(), HandIn(), TakeUp(), OpenAssignment(key, 5))
    for state in (dock.state, begun):
        dock.state, dock.at = state, NOON + 9000.0
        dock.do(Answer("1"), HandIn(), LookAtClock(), TakeUp())
