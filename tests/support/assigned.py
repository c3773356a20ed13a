"""An exam and homework of small lessons, and a student who works on them."""

from __future__ import annotations

import numpy as np
import pytest

from armlab.content.as_written import AsWritten, as_part
from armlab.content.lessons import changed, lessons
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.parts.joints import MoveJoint
from armlab.session.state import State, apply
from armlab.teaching.assignment_commands import OpenAssignment
from armlab.teaching.hand_in import hand_in
from armlab.teaching.hand_in_assignment import judge_assignment
from armlab.teaching.lesson_commands import Answer, GoToStep, SignAs
from armlab.teaching.parts.lesson import LessonPart

NOON = 1_800_000_000.0
EXAM = """title = "Exam"
exam = true
pages = ["joints"]
opens = {opens}
closes = {closes}
minutes = 30
attempts = 2

[[tasks]]
lesson = "v"
[tasks.points]
"Turn" = 4
"Predict" = 1
"Double" = 2

[[tasks]]
lesson = "t"
variant = 4
points = 3
"""
HOMEWORK = """title = "Homework"
due = {due}
late_percent = 50

[[tasks]]
lesson = "v"
points = 6
"""


def named(title):
    """Return a teacher's title as it stands in a sentence of the lab."""
    return f"“{as_part(AsWritten(title))}”"


def written(seconds):
    return f"{np.datetime64(int(seconds), 's')}Z"


def folder_fixture(own, tmp_path):
    """Return a folder with an exam of one hour at noon, and homework that is due an hour later."""
    place = tmp_path / "mine"
    (place / "exam.toml").write_text(EXAM.format(opens=written(NOON), closes=written(NOON + 3600)))
    (place / "homework.toml").write_text(HOMEWORK.format(due=written(NOON + 7200)))
    changed()
    assert lessons().problems == ()
    return place


def fresh_fixture(folder):
    return State.initial(catalogue()["puma560"])


def done(state, *commands, at=NOON):
    for command in commands:
        state = apply(state, command, at)
    return state


def refused(state, command, says, at=NOON):
    with pytest.raises(InputError, match=says):
        apply(state, command, at)


def exam(fresh, number=3, name="Ada"):
    return done(fresh, SignAs(name), OpenAssignment("exam", number))


def goal(state):
    return state[LessonPart].lesson.values["goal"]


def solved(state, at=NOON):
    """Return the state with all of task 1 done: 7 points of 10."""
    state = done(state, GoToStep(0), MoveJoint(0, np.radians(goal(state))), GoToStep(1), at=at)
    state = done(state, Answer(f"{goal(state) / 2:g}"), GoToStep(2), at=at)
    return done(state, Answer(f"{2 * goal(state):g}"), at=at)


def points(state, key="exam"):
    return judge_assignment(hand_in(state), key).points
