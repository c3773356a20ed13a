"""A lesson of a student: opened, done, kept, closed."""

import json

import numpy as np
import pytest

from armlab.content.lessons import lessons
from armlab.content.robots import catalogue
from armlab.errors import ContentError, InputError, UnknownName
from armlab.session.edits import SetCell
from armlab.session.panel_commands import OpenPanel
from armlab.session.parts.display import Display, Show
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint, TakePose
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.target import Target, target_pose
from armlab.session.parts.timeline import OpenClip, Seek, Timeline, clips, duration
from armlab.session.session import Redo, Session, StartFresh, Undo
from armlab.session.state import State, apply
from armlab.session.store import state_from_text
from armlab.teaching.lesson_commands import (
    Answer,
    CloseLesson,
    GoToStep,
    OpenLesson,
    ReloadLesson,
    SignAs,
    TakeLessonArm,
    UnlockHint,
)
from armlab.teaching.lesson_progress import MOST_TYPED
from armlab.teaching.parts.lesson import LessonPart, check_line, has_its_arm, observed
from armlab.teaching.signature import LONGEST_NAME
from support.done import done
from support.small_lessons import TWO_STEPS, library_fixture

PUMA, PLANAR = catalogue()["puma560"], catalogue()["planar_2r"]


def first_arm():
    return lessons()["first_arm"]


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


own = pytest.fixture(library_fixture, name="own")


# --- Opening and closing


def test_opening_puts_the_lesson_and_its_arm_on_the_table(first):
    assert first[LessonPart].open == "first_arm/0"
    assert first[LessonPart].step is lessons()["first_arm"].steps[0]
    assert first[RobotPart].robot is PLANAR
    np.testing.assert_array_equal(first[Joints].q, first_arm().start)
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
    own(t=TWO_STEPS.replace("overlays", "target = {position = [0.5, 1.0, 0.7], rpy_deg = [0, 0, 40]}\noverlays"))
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


def test_a_broken_lesson_says_what_is_wrong(fresh, own):
    own(broken=TWO_STEPS.replace('"T"', "1"))
    with pytest.raises(ContentError, match=r"broken\.md, line 2: title"):
        done(fresh, OpenLesson("broken"))


def test_closing_keeps_arm_and_progress_and_opening_goes_on(first):
    state = done(first, TakePose("stretched"), GoToStep(1), CloseLesson())
    assert state[LessonPart].lesson is None
    assert state[LessonPart].step is None
    assert state[LessonPart].name == ""
    np.testing.assert_array_equal(state[Joints].q, [0.0, 0.0])
    assert done(state, CloseLesson()) is state
    again = done(state, OpenLesson("first_arm"))
    assert (again[LessonPart].index, passed(again)) == (1, {0})
    anew = done(again, OpenLesson("first_arm", anew=True))
    assert (anew[LessonPart].index, passed(anew)) == (0, frozenset())


@pytest.mark.parametrize("command", [GoToStep(0), TakeLessonArm(), Answer("1")])
def test_without_a_lesson_its_commands_are_refused(fresh, command):
    with pytest.raises(InputError):
        done(fresh, command)


def test_without_a_lesson_there_is_no_hint(fresh):
    assert done(fresh, UnlockHint()) is fresh


# --- Checks and answers


def test_a_check_passes_when_the_arm_meets_it_and_stays_passed(first):
    nearly = done(first, MoveJoint(0, 0.0))
    assert passed(nearly) == frozenset()
    met, says = check_line(nearly)
    assert not met
    assert "bends away" in says
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


@pytest.mark.parametrize("step", [-1, 4, 10**9])
def test_steps_that_are_not_there_are_refused(first, step):
    with pytest.raises(InputError, match="expected 1 to 4"):
        done(first, GoToStep(step))


def test_an_answer_where_nothing_is_asked_is_refused(first):
    with pytest.raises(InputError, match="no question"):
        done(first, Answer("1"))


def test_long_answers_are_cut(first):
    state = done(first, GoToStep(2), Answer("9" * 10_000))
    part = state[LessonPart]
    assert len(part.progress.answers[part.name]) == MOST_TYPED


def test_another_arm_leaves_the_lesson_open_and_unchecked(first):
    state = done(first, ChooseRobot("planar_3r"))
    assert state[LessonPart].open == "first_arm/0"
    assert not has_its_arm(state)
    assert check_line(state) == (False, "")
    assert passed(done(state, *(MoveJoint(i, 0.0) for i in range(3)))) == frozenset()
    back = done(state, TakeLessonArm())
    assert has_its_arm(back)
    np.testing.assert_array_equal(back[Joints].q, first_arm().start)
    assert passed(done(back, TakePose("stretched"))) == {0}


def test_an_edited_table_is_another_arm(first):
    state = done(first, SetCell(0, "a", 0.5))
    assert state[RobotPart].own
    assert not has_its_arm(state)
    same = done(state, SetCell(0, "a", 1.0))
    assert has_its_arm(same)  # the table counts, not how it came about


def test_an_arm_edited_in_a_lesson_may_stand_where_nothing_is_checked(fresh):
    state = done(fresh, OpenLesson("workspace_2r"), GoToStep(5), SetCell(1, "a", 1.0))
    assert state[LessonPart].step.check is None
    assert has_its_arm(state)
    assert not has_its_arm(done(state, GoToStep(0)))


# --- What is kept


def test_a_reload_keeps_lesson_step_progress_and_answers(first):
    state = done(first, TakePose("stretched"), GoToStep(2), Answer("0.5"), SignAs("Ada"))
    again = reloaded(state)
    assert passed(again) == {0}
    one, other = again[LessonPart], state[LessonPart]
    assert (one.open, one.index, one.student, one.progress.answers) == ("first_arm/0", 2, "Ada", {one.name: "0.5"})
    assert one.to_json() == other.to_json()
    assert one.progress.evidence == other.progress.evidence
    assert passed(reloaded(done(again, Answer("0.866")))) == {0, 2}


def test_progress_follows_the_names_of_the_steps(fresh, own):
    state = done(fresh, OpenLesson("t"), GoToStep(2), Answer("3"), GoToStep(1), Answer("1"))
    part = state[LessonPart]
    assert (part.name, set(part.progress.right), dict(part.progress.answers)) == (
        "Same",
        {"Same#2"},
        {"Same": "1", "Same#2": "3"},
    )
    data = json.loads(json.dumps(part.to_json()))
    assert LessonPart.from_json(data, PUMA).to_json() == part.to_json()
    own(t=TWO_STEPS.replace("## Read", "## Before\nMore.\n## Read"))
    moved = LessonPart.from_json(data, PUMA)
    assert moved.index == 2
    assert moved.progress.passed(moved.lesson) == {1, 3}
    own(t=TWO_STEPS.replace("## Same", "## Other"))
    other = LessonPart.from_json(data, PUMA)
    assert (other.index, other.progress.met, other.progress.right, dict(other.progress.answers)) == (
        0,
        {"Read"},
        {},
        {},
    )


def test_a_lesson_that_is_not_there_is_not_open_and_its_progress_is_written_down_as_it_was(own):
    data = {"open": "u", "progress": {"u": {"step": "A", "met": [], "right": [], "answers": {}}}}
    part = LessonPart.from_json(data, PUMA)
    assert part == LessonPart(aside=data["progress"])
    assert part.to_json()["progress"] == data["progress"]


@pytest.mark.parametrize(
    "damage",
    [
        [],
        None,
        {"open": "t"},
        {"open": 3, "progress": {}},
        {"open": "t", "progress": []},
        {"open": "t", "progress": {"t": {"step": "Read"}}},
        {"open": "t", "progress": {"t": {"step": "Read", "met": 3, "right": [], "answers": {}}}},
        {"open": "t", "progress": {"t": {"step": "Read", "met": [[]], "right": [], "answers": {}}}},
        {"open": "t", "progress": {"t": {"step": "Read", "met": [], "right": [], "answers": []}}},
        {"open": "t", "progress": {}, "number": -1},
        {"open": "t", "progress": {}, "number": "x"},
    ],
)
def test_a_damaged_file_raises(own, damage):
    with pytest.raises((KeyError, TypeError, AttributeError, ValueError)):
        LessonPart.from_json(damage, PUMA)


def test_a_changed_file_shows_at_once_and_keeps_what_was_done(fresh, own):
    state = done(fresh, OpenLesson("t"), GoToStep(1), Answer("2"), MoveJoint(0, np.pi / 2))
    assert own(t=TWO_STEPS.replace("## Read", "## Before\nMore.\n## Read")) == {"t"}
    again = done(state, ReloadLesson("t"))
    assert again is not state
    assert again[LessonPart].loaded == state[LessonPart].loaded + 1
    assert again[LessonPart].index == 2  # still the step named Same
    assert passed(again) == {1, 2}
    assert done(again, ReloadLesson("other")) is again


def test_a_lesson_whose_file_is_gone_goes_on(fresh, own):
    state = done(fresh, OpenLesson("t"), GoToStep(1))
    own(t=None)
    assert "t" not in lessons().lessons
    assert passed(done(state, Answer("2"), MoveJoint(0, np.pi / 2))) == {0, 1}


def test_undo_takes_back_motions_and_no_answer():
    session = Session.fresh("token", PUMA)
    opening = OpenLesson("first_arm", variant=0)
    for k, command in enumerate([opening, TakePose("stretched"), GoToStep(2), Answer("0.866")]):
        session.apply(command, float(k))
    assert session.notice is None
    assert session.history.undo_label == TakePose.label
    session.apply(Undo(), 9.0)
    np.testing.assert_array_equal(session.state[Joints].q, first_arm().start)
    assert passed(session.state) == {0, 2}
    assert session.history.undo_label == OpenLesson.label
    session.apply(StartFresh(), 12.0)
    number = session.state[LessonPart].number
    assert session.state[LessonPart] == LessonPart(number=number)


def test_undo_ends_where_a_lesson_began_and_goes_on_to_ones_own_work_when_it_is_closed():
    session = Session.fresh("token", PUMA)
    session.apply(MoveJoint(0, 0.3), 0.0)
    session.apply(OpenLesson("first_arm"), 1.0)
    opened = session.state
    for k, command in enumerate([Undo(), MoveJoint(0, 0.5), Undo(), Undo()], start=2):
        session.apply(command, 2.0 * k)
    np.testing.assert_array_equal(session.state[Joints].q, opened[Joints].q)
    assert session.refusal(session.history.undone) == session.notice.text == "Undo ends where this lesson began."
    assert session.history.redo_label == MoveJoint.label
    for k, command in enumerate([OpenLesson("joint_types"), Undo(), CloseLesson(), Undo(), Undo()], start=6):
        session.apply(command, 2.0 * k)
    assert (session.robot, session.state[Joints].q[0]) == (PUMA, 0.3)


def test_no_undo_takes_away_what_a_step_has_put_in_place(own):
    own(t=TWO_STEPS.replace("Move and answer.\n", 'Move.\n```start\n[[do]]\nkind = "move"\nq_deg = [-30, 40]\n```\n'))
    session = Session.fresh("token", PUMA)
    for k, command in enumerate([OpenLesson("t"), MoveJoint(0, 0.5), GoToStep(1), Undo(), Redo()]):
        session.apply(command, 2.0 * k)
    np.testing.assert_allclose(np.degrees(session.state[Joints].q), [-30.0, 40.0])
    for k, command in enumerate([MoveJoint(0, 0.5), GoToStep(2), Undo(), Undo()], start=10):
        session.apply(command, 2.0 * k)
    np.testing.assert_allclose(np.degrees(session.state[Joints].q), [-30.0, 40.0])
    assert session.state[LessonPart].index == 2, "it goes on with what has become of the one before"


def test_a_student_signs_on_one_line(fresh):
    state = done(fresh, SignAs("  Ada \n  Lovelace "))
    assert state[LessonPart].student == "Ada Lovelace"
    assert done(state, SignAs("Ada Lovelace")) is state
    assert len(done(state, SignAs("x" * 999))[LessonPart].student) == LONGEST_NAME


# --- Evidence, time, films, panels


def test_evidence_is_what_was_seen_when_the_check_was_met_first(fresh, own):
    state = apply(done(fresh, OpenLesson("t"), GoToStep(1)), MoveJoint(0, np.pi / 2), 7.5)
    evidence = state[LessonPart].progress.evidence
    assert list(evidence) == ["Same"]
    np.testing.assert_allclose(np.degrees(evidence["Same"]["q"]), [90.0, 20.0])
    assert evidence["Same"]["seconds"] == 7.5
    assert set(evidence["Same"]["switches"]) >= {"frames", "trace"}
    later = done(state, MoveJoint(0, 1.0), MoveJoint(0, np.pi / 2))
    assert later[LessonPart].progress.evidence == evidence


def test_seconds_count_from_when_the_step_was_shown(fresh, own):
    state = apply(fresh, OpenLesson("t"), 100.0)
    state = apply(state, GoToStep(1), 130.0)
    assert observed(state).seconds == 0.0
    assert observed(apply(state, MoveJoint(1, 0.1), 134.5)).seconds == 4.5
    assert observed(apply(state, GoToStep(2), 140.0)).seconds == 0.0
    again = apply(reloaded(state), MoveJoint(1, 0.2), 3.0)  # the clock of another process
    assert observed(again).seconds == 0.0


def test_a_film_counts_when_it_was_played_to_its_end_in_this_step(fresh, own):
    state = done(fresh, OpenLesson("t"), OpenClip("film"))
    half = done(state, Seek(duration(state) / 2.0))
    assert observed(half).films == frozenset()
    whole = done(half, Seek(duration(half)))
    assert observed(whole).films == {"film"}
    assert observed(done(whole, Seek(0.0))).films == {"film"}
    assert observed(done(whole, Seek(0.0), GoToStep(1))).films == frozenset()


def test_the_panel_that_is_looked_at_is_seen(fresh, own):
    state = done(fresh, OpenLesson("t"), OpenPanel("film"))
    assert observed(state).panel == "film"
