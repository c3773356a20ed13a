"""What a lesson asks of its students: variants, hints, predictions, and what it keeps as it is."""

import json
import re

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.dh import Row
from armlab.session.edits import AddJoint, NewArm, RemoveJoint, SetCell, SetLimits
from armlab.session.panel_commands import OpenPanel
from armlab.session.parts.display import Display, Show
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint, RandomPose, TakePose
from armlab.session.parts.panels import Panels
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.target import PlaceTarget, Target
from armlab.session.session import Redo, Session, Undo
from armlab.session.state import State
from armlab.session.store import state_from_text
from armlab.teaching.lesson_commands import Answer, CloseLesson, GoToStep, OpenLesson, TakeLessonArm, UnlockHint
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.shelf import Shelf, ToSandbox
from support.done import done
from support.lesson_texts import RICH
from support.small_lessons import TWO_STEPS, VARIED, library_fixture

PUMA = catalogue()["puma560"]

own = pytest.fixture(library_fixture, name="own")


def passed(state):
    part = state[LessonPart]
    return part.progress.passed(part.lesson)


@pytest.fixture
def fresh():
    return State.initial(PUMA)


def locked(line, more=""):
    return TWO_STEPS.replace("overlays", f"{line}\noverlays").replace("+++\nIntro", f"{more}\n+++\nIntro")


# --- Variants


def test_each_variant_has_its_own_values_and_progress(fresh, own):
    one = done(fresh, OpenLesson("v", variant=1))
    assert one[LessonPart].open == "v/1"
    goal = one[LessonPart].lesson.values["goal"]
    one = done(one, MoveJoint(0, np.radians(goal)), GoToStep(2), Answer(f"{2 * goal:g}"))
    assert passed(one) == {0, 2}
    two = done(one, OpenLesson("v", variant=2))
    assert two[LessonPart].lesson.values["goal"] != goal
    assert passed(two) == frozenset()
    assert not done(two, GoToStep(2), Answer(f"{2 * goal:g}"))[LessonPart].verdict.right
    back = done(two, OpenLesson("v", variant=1))
    assert passed(back) == {0, 2}
    assert back[LessonPart].index == 2


def test_who_asks_for_none_gets_the_last_or_their_own(fresh, own):
    part = fresh[LessonPart]
    mine = fresh.replace(LessonPart(part.open, part.progress_of, number=17))
    assert done(mine, OpenLesson("v"))[LessonPart].open == "v/17"
    other = done(mine, OpenLesson("v", variant=3), CloseLesson())
    assert done(other, OpenLesson("v"))[LessonPart].open == "v/3"


def test_a_number_means_nothing_to_a_lesson_that_does_not_vary(fresh, own):
    assert done(fresh, OpenLesson("t", variant=5))[LessonPart].open == "t"


@pytest.mark.parametrize("variant", [-1, 10_000])
def test_variants_have_numbers_the_lab_knows(fresh, own, variant):
    with pytest.raises(InputError, match="expected 0 to 9999"):
        done(fresh, OpenLesson("v", variant=variant))


def test_students_get_variants_that_differ():
    numbers = {Session.fresh(f"token {i}", PUMA).state[LessonPart].number for i in range(50)}
    assert len(numbers) > 40
    assert Session.fresh("token 1", PUMA).state[LessonPart].number in numbers


def test_progress_of_variants_is_saved(fresh, own):
    state = done(fresh, OpenLesson("v", variant=4), UnlockHint(), GoToStep(2), Answer("1"))
    data = state.to_json()["lesson"]
    part = LessonPart.from_json(data, PUMA)
    assert part.open == "v/4"
    assert (part.name, dict(part.progress.hints), dict(part.progress.answers)) == (
        "Double",
        {"Turn": 1},
        {"Double": "1"},
    )
    for place in ("v", "v/x", "t/1", "/", "v/-1"):
        part = LessonPart.from_json({"open": place, "progress": {place: data["progress"]["v/4"]}}, PUMA)
        assert (part.open, dict(part.progress_of)) == ("", {})


# --- Hints and predictions


def test_hints_are_unlocked_one_after_the_other(fresh, own):
    state = done(fresh, OpenLesson("v", variant=0))
    counts = []
    for _ in range(3):
        state = done(state, UnlockHint())
        counts.append(state[LessonPart].progress.hints["Turn"])
    assert counts == [1, 2, 2]
    assert done(state, UnlockHint()) is state
    other = done(state, GoToStep(1))
    assert done(other, UnlockHint()) is other  # no hints there


def test_a_prediction_counts_once_right_or_not(fresh, own):
    state = done(fresh, OpenLesson("v", variant=0), GoToStep(1))
    assert state[LessonPart].hides == ("arm", "values")
    assert passed(state) == frozenset()
    wrong = done(state, Answer("30"))
    assert wrong[LessonPart].hides == ()
    assert passed(wrong) == {1}
    assert not wrong[LessonPart].verdict.right
    assert "all of it" in wrong[LessonPart].verdict.says
    for again in ("15", ""):
        with pytest.raises(InputError, match="first one counts"):
            done(wrong, Answer(again))
    right = done(state, Answer("15"))
    assert passed(right) == {1}
    assert set(right[LessonPart].progress.right) == {"Predict"}


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("", "I cannot read '': write a number such as 0.5, 1/2 or sqrt(2)."),
        ("1/0", "'1/0': division by zero."),
        ("30 m", "This is a length; the question asks for a pure number."),
    ],
)
def test_what_is_no_answer_is_no_prediction_and_says_why(fresh, own, text, why):
    state = done(fresh, OpenLesson("v", variant=0), GoToStep(1))
    with pytest.raises(InputError) as refused:
        done(state, Answer(text))
    assert str(refused.value) == f"{why} Your prediction is still open."


def test_a_prediction_survives_a_reload(fresh, own):
    state = done(fresh, OpenLesson("v", variant=0), GoToStep(1), Answer("30"))
    part = LessonPart.from_json(state.to_json()["lesson"], PUMA)
    assert part.progress.committed(part.lesson, 1)
    assert part.hides == ()


# --- Locks

MOVED_TARGET = np.array([[0.0, -1, 0, 0.5], [1, 0, 0, 1.0], [0, 0, 1, 0], [0, 0, 0, 1]])

REFUSED = {
    "robot": [ChooseRobot("planar_3r")],
    "table": [SetCell(0, "a", 0.5), AddJoint(1)],
    "joints": [MoveJoint(0, 0.3), TakePose("stretched"), RandomPose()],
    "target": [PlaceTarget(MOVED_TARGET)],
}
"""What each lock refuses; all of it is possible without."""


@pytest.mark.parametrize(("lock", "command"), [(lock, each) for lock, found in REFUSED.items() for each in found])
def test_a_lock_refuses_what_it_names_and_nothing_else(own, lock, command):
    own(t=locked(f'locked = ["{lock}"]'), u=locked(f"locked = {[name for name in REFUSED if name != lock]}"))
    session = Session.fresh("token", PUMA)
    session.apply(OpenLesson("t"), 0.0)
    assert session.notice is None
    state = session.state
    session.apply(command, 1.0)
    assert session.state is state
    assert "This lesson keeps" in session.notice.text
    assert "sandbox" in session.notice.text
    session.apply(CloseLesson(), 2.0)
    session.apply(command, 3.0)
    assert session.notice.number == 1  # free again
    assert session.state is not state


def test_with_locked_joints_the_handle_still_moves_the_arm(fresh, own):
    own(t=locked('locked = ["joints"]'))
    state = done(fresh, OpenLesson("t"))
    moved = done(state, PlaceTarget(MOVED_TARGET))
    assert not np.allclose(moved[Joints].q, state[Joints].q)
    np.testing.assert_allclose(moved[Joints].tool_pose[:2, 3], [0.5, 1.0], atol=1e-6)


def test_with_a_locked_target_the_joints_still_move(fresh, own):
    own(t=locked('locked = ["target"]', "[target]\nposition = [0.5, 1, 0]\nrpy_deg = [0, 0, 0]"))
    state = done(fresh, OpenLesson("t"))
    assert done(state, MoveJoint(0, 0.5))[Joints].q[0] == 0.5
    with pytest.raises(InputError, match="keeps the target"):
        done(state, PlaceTarget(MOVED_TARGET))
    assert state[Target].pose is not None


def test_a_locked_joint_stays_and_cannot_be_freed(fresh, own):
    own(t=locked("locked_joints = [2]"))
    state = done(fresh, OpenLesson("t"))
    assert state[Joints].locked == (False, True)
    with pytest.raises(InputError, match="keeps joint 2 where it stands"):
        done(state, LockJoint(1, False))
    assert done(state, MoveJoint(1, 0.0)) is state
    assert done(state, TakePose("stretched"))[Joints].q.tolist() == [0.0, state[Joints].q[1]]
    assert done(state, MoveJoint(0, 1.0))[Joints].q[0] == 1.0
    dragged = done(state, PlaceTarget(MOVED_TARGET))
    assert dragged[Joints].q[1] == state[Joints].q[1]
    assert done(state, CloseLesson())[Joints].locked == (False, False)


def test_a_locked_joint_stays_on_an_edited_table_and_another_arm_has_none(fresh, own):
    own(t=locked("locked_joints = [2]"))
    state = done(fresh, OpenLesson("t"), MoveJoint(0, 0.3))
    for edit in (SetLimits(1, -0.2, 0.0), RemoveJoint(0), AddJoint(1)):
        with pytest.raises(InputError, match="keeps joint 2 where it stands"):
            done(state, edit)
    longer = done(state, SetCell(0, "a", 1.5))
    assert done(longer, MoveJoint(1, 0.0)) is longer
    other = done(state, ChooseRobot("planar_3r"))
    assert done(other, MoveJoint(1, 0.4))[Joints].q[1] == 0.4
    short = done(other, RemoveJoint(0), RemoveJoint(0), Show("dark", True))
    assert (short[Joints].arm.n, short[Display].switches["dark"]) == (1, True)


def test_an_arm_that_a_student_makes_is_not_that_which_a_lesson_brings(fresh, own):
    own(t=re.sub(r"locked = .*\n", "", RICH))
    state = done(fresh, OpenLesson("t"))
    with pytest.raises(InputError, match="keeps joint 2"):
        done(state, LockJoint(1, False))
    made = done(state, ChooseRobot("planar_2r"), NewArm((Row("R", 0.0, 0.0, 1.0, 0.0),), "standard"))
    assert done(made, MoveJoint(0, 0.3))[Joints].q.tolist() == [0.3]


def test_an_undo_does_not_go_round_a_lock(own):
    own(t=locked('locked = ["robot"]'))
    session = Session.fresh("token", PUMA)
    session.apply(OpenLesson("t"), 0.0)
    opened = session.state
    session.apply(Undo(), 1.0)
    assert session.state is opened
    assert session.history.undo_label == OpenLesson.label  # the step is still there, for when the lesson is closed
    session.apply(CloseLesson(), 2.0)
    assert session.refusal(session.history.undone) == ""
    session.apply(Undo(), 3.0)
    assert session.robot is PUMA


def test_an_undo_does_not_hold_joints_of_a_lesson_that_is_closed(own):
    own(t=locked("locked_joints = [2]"))
    session = Session.fresh("token", PUMA)
    seen = []
    last = OpenLesson("v", variant=0), CloseLesson(), Undo()
    for k, command in enumerate(
        [OpenLesson("t"), MoveJoint(0, 0.5), CloseLesson(), Undo(), Redo(), OpenLesson("t"), *last]
    ):
        session.apply(command, 2.0 * k)
        seen.append((*np.degrees(session.state[Joints].q[:1]).round(), *session.state[Joints].locked))
    moved = 29.0, False, False
    assert seen[2:5] == [moved, (10.0, False, False), moved]
    assert seen[5:] == [(10.0, False, True), (0.0, False, False), (0.0, False, False), (10.0, False, False)]
    assert session.state[LessonPart].lesson is None


def test_the_lesson_itself_may_do_everything(fresh, own):
    own(t=locked('locked = ["robot", "table", "joints", "target"]\nlocked_joints = [1, 2]'))
    state = done(fresh, OpenLesson("t"))
    assert done(state, TakeLessonArm())[RobotPart].robot is state[RobotPart].robot
    again = done(state, OpenLesson("t", anew=True))
    np.testing.assert_allclose(np.degrees(again[Joints].q), [10.0, 20.0])
    assert done(again, OpenLesson("v", variant=0), MoveJoint(0, 0.4))[Joints].q[0] == 0.4


def test_a_saved_state_keeps_its_locks(fresh, own):
    own(t=locked("locked_joints = [2]"))
    state = done(fresh, OpenLesson("t"))
    again = state_from_text(json.dumps({"format": 1, "parts": state.to_json()}))
    with pytest.raises(InputError, match="keeps joint 2"):
        done(again, LockJoint(1, False))
    assert done(again, MoveJoint(1, 0.0)) is again


# --- Before anything is done


def test_what_is_wrong_is_said_only_after_something_was_moved(fresh, own):
    own(t=TWO_STEPS)
    state = done(fresh, OpenLesson("t"), GoToStep(1))
    assert not state[LessonPart].progress.tried
    assert not done(state, UnlockHint(), Answer("2"))[LessonPart].progress.tried
    moved = done(state, MoveJoint(0, 0.3))
    assert moved[LessonPart].progress.tried
    assert not done(moved, GoToStep(2), GoToStep(1))[LessonPart].progress.tried


def test_overlays_of_the_lesson_before_go_and_the_dark_screen_stays(fresh, own):
    own(t=TWO_STEPS, v=VARIED)
    state = done(fresh, Show("dark", True), OpenLesson("t"))
    assert {name for name, on in state[Display].switches.items() if on} == {"dark", "frames", "trace"}
    assert {name for name, on in done(state, OpenLesson("v"))[Display].switches.items() if on} == {"dark"}
    closed = done(state, CloseLesson(), OpenLesson("v"))
    assert {name for name, on in closed[Display].switches.items() if on} == {"dark"}


def test_the_sandbox_waits_for_the_prediction(fresh, own):
    own(v=VARIED)
    state = done(fresh, OpenLesson("v", variant=3), GoToStep(1))
    assert state[LessonPart].hides
    with pytest.raises(InputError, match="answer first"):
        done(state, ToSandbox())
    assert done(state, Answer("1"), ToSandbox())[Shelf].place == "sandbox"


def test_a_lesson_that_hides_the_open_page_brings_one_to_the_front_that_is_there(fresh, own):
    own(t=TWO_STEPS.replace("overlays", 'hidden = ["film"]\noverlays'))
    state = done(fresh, OpenPanel("film"), OpenLesson("t"))
    assert state[Panels].last not in ("", "film")
    assert done(fresh, OpenPanel("table"), OpenLesson("t"))[Panels].last == "table"
