"""A lesson of a student: opened, done, kept, closed."""

import json

import numpy as np
import pytest

from armlab.content.lessons import lessons, parse_lesson
from armlab.content.robots import catalogue
from armlab.errors import ContentError, InputError, UnknownName
from armlab.session.edits import SetCell
from armlab.session.parts import lesson as part_module
from armlab.session.parts.display import Display, Show
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint, TakePose
from armlab.session.parts.lesson import (
    MOST_TYPED,
    Answer,
    CloseLesson,
    GoToStep,
    LessonPart,
    OpenLesson,
    TakeLessonArm,
    check_line,
    has_its_arm,
)
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.target import Target, target_pose
from armlab.session.parts.timeline import OpenClip, Timeline, clips
from armlab.session.session import Redo, Session, StartFresh, Undo
from armlab.session.state import State, apply
from armlab.session.store import state_from_text

PUMA, PLANAR = catalogue()["puma560"], catalogue()["planar_2r"]
FIRST = lessons()["first_arm"]

TEXT = """+++
title = "T"
chapter = "1"
teaches = ["S4.0-2R"]
robot = "planar_2r"
q_deg = [10, 20]
overlays = ["frames", "trace"]
{front}
+++
Intro.
## Read
Only text.
## Same
Move and answer.
```check
kind = "joint_at"
joint = 1
value_deg = 90
tolerance_deg = 1
```
```question
kind = "number"
text = "One and one?"
answer = 2
tolerance = 0.1
```
## Same
```question
kind = "number"
text = "One and two?"
answer = 3
tolerance = 0.1
```
"""


def done(state, *commands):
    for command in commands:
        state = apply(state, command)
    return state


def reloaded(state):
    return state_from_text(json.dumps({"format": 1, "parts": state.to_json()}))


def passed(state):
    part = state[LessonPart]
    return part.progress.passed(part.lesson)


@pytest.fixture
def fresh():
    return State.initial(PUMA)


@pytest.fixture
def first(fresh):
    return done(fresh, OpenLesson("first_arm"))


@pytest.fixture
def own(monkeypatch):
    """Replace the lessons by one of these tests; returns a function that changes it."""

    def use(**texts):
        found = {key: parse_lesson(key, text) for key, text in texts.items()}
        monkeypatch.setattr(part_module, "lessons", lambda: type(lessons())(found, ()))

    use(t=TEXT.format(front=""))
    return use


def test_opening_puts_the_lesson_and_its_arm_on_the_table(first):
    assert first[LessonPart].open == "first_arm"
    assert first[LessonPart].step is FIRST.steps[0]
    assert first[RobotPart].robot is PLANAR
    np.testing.assert_array_equal(first[Joints].q, FIRST.start)
    assert first[Display].switches["frames"]
    assert first[Target].pose is None
    assert has_its_arm(first)
    assert passed(first) == frozenset()


def test_opening_takes_locks_switches_and_playback_along(fresh, own):
    key = next(iter(clips()))
    before = done(
        fresh, ChooseRobot("planar_2r"), LockJoint(0, True), Show("names", False), Show("trace", False), OpenClip(key)
    )
    state = done(before, OpenLesson("t"))
    assert state[Joints].locked == (False, False)
    np.testing.assert_allclose(np.degrees(state[Joints].q), [10.0, 20.0])
    assert dict(state[Display].switches) == {"names": False, "frames": True, "trace": True}
    assert state[Timeline].clip == ""
    assert not state[Timeline].playing


def test_the_target_of_a_lesson_is_where_it_says_and_the_arm_stays(fresh, own):
    own(t=TEXT.format(front="[target]\nposition = [0.5, 1.0, 0.7]\nrpy_deg = [0, 0, 40]"))
    state = done(fresh, OpenLesson("t"))
    T = target_pose(state)
    np.testing.assert_allclose(T[:3, 3], [0.5, 1.0, 0.0], atol=1e-12)  # the arm stays in its plane
    np.testing.assert_allclose(T[:3, :3], state[Joints].tool_pose[:3, :3])
    np.testing.assert_allclose(np.degrees(state[Joints].q), [10.0, 20.0])


def test_opening_what_is_open_changes_nothing(first):
    assert done(first, OpenLesson("first_arm")) is first


def test_an_unknown_lesson_is_refused_with_a_proposal(fresh):
    with pytest.raises(UnknownName, match="did you mean 'first_arm'"):
        done(fresh, OpenLesson("frist_arm"))


def test_a_broken_lesson_says_what_is_wrong(fresh, monkeypatch):
    problem = ContentError("broken.md", "title", "expected a text")
    monkeypatch.setattr(part_module, "lessons", lambda: type(lessons())({}, (problem,)))
    with pytest.raises(ContentError, match=r"broken\.md: title"):
        done(fresh, OpenLesson("broken"))


def test_a_check_passes_when_the_arm_meets_it_and_stays_passed(first):
    nearly = done(first, MoveJoint(0, 0.0))
    assert passed(nearly) == frozenset()
    met, says = check_line(nearly)
    assert not met
    assert "away from (2.000, 0.000, 0.000) m" in says
    there = done(nearly, MoveJoint(1, 0.0))
    assert passed(there) == {0}
    assert check_line(there) == (True, "")
    assert passed(done(there, TakePose("home"))) == {0}


def test_only_the_shown_step_is_checked(first):
    state = done(first, TakePose("right angle"))  # what step 2 asks
    assert passed(state) == frozenset()
    assert passed(done(state, GoToStep(1))) == {1}


def test_wrong_and_right_answers(first):
    asked = done(first, GoToStep(2))
    assert asked[LessonPart].verdict is None
    wrong = done(asked, Answer(" 0.5 "))
    assert not wrong[LessonPart].verdict.right
    assert "Both joints turn" in wrong[LessonPart].verdict.says
    assert passed(wrong) == frozenset()
    right = done(wrong, Answer("86.6 cm"))
    assert right[LessonPart].verdict.right
    assert passed(right) == {2}
    again = done(right, Answer("7"))
    assert not again[LessonPart].verdict.right
    assert passed(again) == {2}  # what was right once is done
    assert done(again, Answer("  "))[LessonPart].verdict is None


def test_a_step_with_check_and_question_needs_both(fresh, own):
    state = done(fresh, OpenLesson("t"))
    assert passed(state) == {0}  # nothing to do but to read
    answered = done(state, GoToStep(1), Answer("2"))
    assert passed(answered) == {0}
    assert passed(done(answered, MoveJoint(0, np.pi / 2))) == {0, 1}


@pytest.mark.parametrize("step", [-1, 3, 10**9])
def test_steps_that_are_not_there_are_refused(first, step):
    with pytest.raises(InputError, match="expected 1 to 3"):
        done(first, GoToStep(step))


@pytest.mark.parametrize("command", [GoToStep(0), TakeLessonArm(), Answer("1")])
def test_without_a_lesson_its_commands_are_refused(fresh, command):
    with pytest.raises(InputError):
        done(fresh, command)


def test_an_answer_where_nothing_is_asked_is_refused(first):
    with pytest.raises(InputError, match="no question"):
        done(first, Answer("1"))


def test_a_reload_keeps_lesson_step_progress_and_answers(first):
    state = done(first, TakePose("stretched"), GoToStep(2), Answer("0.5"))
    again = reloaded(state)
    assert again[LessonPart] == state[LessonPart]
    assert passed(again) == {0}
    assert again[LessonPart].progress.answers == {2: "0.5"}
    assert passed(reloaded(done(again, Answer("0.866")))) == {0, 2}


def test_progress_follows_the_steps_of_a_changed_lesson(fresh, own):
    state = done(fresh, OpenLesson("t"), GoToStep(2), Answer("3"), GoToStep(1), Answer("1"))
    data = json.loads(json.dumps(state.to_json()))
    assert LessonPart.from_json(data["lesson"], PUMA) == state[LessonPart]  # titles that come twice stay apart
    text = TEXT.format(front="")
    own(t=text.replace("## Read", "## Before\nMore.\n## Read"))
    moved = LessonPart.from_json(data["lesson"], PUMA).progress
    assert (moved.step, moved.met, moved.right, dict(moved.answers)) == (2, {1, 3}, {3}, {2: "1", 3: "3"})
    own(t=text.replace("## Same", "## Other"))
    other = LessonPart.from_json(data["lesson"], PUMA).progress
    assert (other.step, other.met, other.right, dict(other.answers)) == (0, {0}, frozenset(), {})
    own(u=text)
    assert LessonPart.from_json(data["lesson"], PUMA) == LessonPart()


@pytest.mark.parametrize("damage", [{"open": "t"}, {"open": "t", "progress": {"t": {"step": "Read"}}}, [], None])
def test_a_damaged_file_raises(own, damage):
    with pytest.raises((KeyError, TypeError)):
        LessonPart.from_json(damage, PUMA)


def test_another_arm_leaves_the_lesson_open_and_unchecked(first):
    state = done(first, ChooseRobot("planar_3r"))
    assert state[LessonPart].open == "first_arm"
    assert not has_its_arm(state)
    assert check_line(state) == (False, "")
    assert passed(done(state, *(MoveJoint(i, 0.0) for i in range(3)))) == frozenset()
    back = done(state, TakeLessonArm())
    assert has_its_arm(back)
    np.testing.assert_array_equal(back[Joints].q, FIRST.start)
    assert passed(done(back, TakePose("stretched"))) == {0}


def test_an_edited_table_is_another_arm(first):
    state = done(first, SetCell(0, "a", 0.5))
    assert state[RobotPart].own
    assert not has_its_arm(state)


def test_closing_keeps_arm_and_progress_and_opening_goes_on(first):
    state = done(first, TakePose("stretched"), GoToStep(1), CloseLesson())
    assert state[LessonPart].lesson is None
    assert state[LessonPart].step is None
    np.testing.assert_array_equal(state[Joints].q, [0.0, 0.0])
    assert done(state, CloseLesson()) is state
    again = done(state, OpenLesson("first_arm"))
    assert (again[LessonPart].progress.step, passed(again)) == (1, {0})
    anew = done(again, OpenLesson("first_arm", anew=True))
    assert (anew[LessonPart].progress.step, passed(anew)) == (0, frozenset())


def test_undo_takes_back_motions_and_no_answer():
    session = Session.fresh("token", PUMA)
    for k, command in enumerate([OpenLesson("first_arm"), TakePose("stretched"), GoToStep(2), Answer("0.866")]):
        session.apply(command, float(k))
    assert session.notice is None
    assert session.history.undo_label == TakePose.label
    session.apply(Undo(), 9.0)
    np.testing.assert_array_equal(session.state[Joints].q, FIRST.start)
    assert passed(session.state) == {0, 2}
    assert session.history.undo_label == OpenLesson.label
    session.apply(Undo(), 10.0)
    assert session.robot is PUMA
    assert session.state[LessonPart].open == "first_arm"
    session.apply(Redo(), 11.0)
    assert session.robot is PLANAR
    assert passed(session.state) == {0, 2}
    session.apply(StartFresh(), 12.0)
    assert session.state[LessonPart] == LessonPart()


def test_long_answers_are_cut(first):
    state = done(first, GoToStep(2), Answer("9" * 10_000))
    assert len(state[LessonPart].progress.answers[2]) == MOST_TYPED
