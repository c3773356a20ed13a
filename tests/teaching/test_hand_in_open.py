"""Saved work is opened again, at another computer: with the arm as it stood, and judged anew."""

import json

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.parts.display import Display, Show
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.state import State
from armlab.teaching.hand_in import hand_in, judge
from armlab.teaching.hand_in_open import OpenWork
from armlab.teaching.lesson_commands import Answer, GoToStep, OpenLesson, SignAs, UnlockHint
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.shelf import ToSandbox
from support.done import done
from support.small_lessons import library_fixture

own = pytest.fixture(library_fixture, name="own")


@pytest.fixture
def fresh():
    """Another computer: another arm on the table, a dark screen."""
    return done(State.initial(catalogue()["puma560"]), Show("dark", True))


@pytest.fixture
def saved(own):
    """Variant 3, begun: the first step done, the prediction made, the arm moved on in the last step."""
    state = done(State.initial(catalogue()["ur10"]), SignAs("Ada"), OpenLesson("v", variant=3), UnlockHint())
    goal = state[LessonPart].lesson.values["goal"]
    state = done(state, MoveJoint(0, np.radians(goal)), GoToStep(1), Answer("1"), GoToStep(2), MoveJoint(1, 0.77))
    return hand_in(state)


def passed(state):
    part = state[LessonPart]
    return part.progress.passed(part.lesson)


def test_work_goes_on_where_it_was_left(fresh, saved):
    state = done(fresh, OpenWork(saved))
    part = state[LessonPart]
    assert (part.open, part.index, part.student) == ("v/3", 2, "Ada")
    assert passed(state) == {0, 1}
    assert part.progress.hints == {"Turn": 1}
    assert state[Joints].q[1] == pytest.approx(0.77)
    assert state[Display].switches["dark"]
    finished = done(state, Answer(part.step.question.right_answer))
    assert judge(hand_in(finished)).passed == 3


def test_what_the_file_only_claims_is_not_done(fresh, saved):
    data = json.loads(saved)
    data["progress"] |= {"met": ["Turn", "Predict", "Double"], "evidence": {}, "right": {"Double": ["1", 2.0]}}
    state = done(fresh, OpenWork(json.dumps(data)))
    assert passed(state) == {1}
    assert "Double" not in state[LessonPart].progress.right


def test_what_was_done_here_stays_done(fresh, saved):
    state = done(fresh, SignAs("Ada L"), OpenLesson("v", variant=3), GoToStep(2))
    right = state[LessonPart].step.question.right_answer
    state = done(state, Answer(right), GoToStep(1), Answer("7"), OpenWork(saved))
    assert passed(state) == {0, 1, 2}
    assert state[LessonPart].progress.answers["Predict"] == "7"  # the first one counts, also with a file at hand
    assert state[LessonPart].student == "Ada L"


@pytest.mark.parametrize("parts", [None, 3, {}, {"joints": 1}, {"robot": {"key": "gone"}}, {"shelf": {}, "lesson": {}}])
def test_an_arm_that_is_not_usable_is_as_the_lesson_has_it(fresh, saved, parts):
    state = done(fresh, OpenWork(json.dumps({**json.loads(saved), "parts": parts})))
    assert passed(state) == {0, 1}
    np.testing.assert_allclose(np.degrees(state[Joints].q), [0.0, 20.0])


def test_with_an_open_prediction_the_arm_does_not_come_along(fresh, saved):
    data = json.loads(saved)
    data["progress"] |= {"step": "Predict", "answers": {}}
    state = done(fresh, OpenWork(json.dumps(data)))
    assert state[LessonPart].hides
    np.testing.assert_allclose(np.degrees(state[Joints].q), [0.0, 20.0])


def test_the_arm_of_somebody_else_is_not_taken(fresh, saved):
    other = State.initial(catalogue()["planar_3r"]).to_json()
    state = done(fresh, OpenWork(json.dumps({**json.loads(saved), "parts": other})))
    assert state[Joints].arm.n == 2


@pytest.mark.parametrize("text", ["", "x", "{}", "\0", "[]", '{"format": 1}'])
def test_what_is_no_work_is_refused_and_changes_nothing(fresh, own, text):
    with pytest.raises(InputError):
        done(fresh, OpenWork(text))


def test_in_the_sandbox_it_is_refused(fresh, saved):
    with pytest.raises(InputError, match="go back to your own work"):
        done(fresh, OpenLesson("v", variant=1), ToSandbox(), OpenWork(saved))
