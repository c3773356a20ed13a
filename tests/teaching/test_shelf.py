"""The sandbox and shared states: what waits is as it was left, whatever happens elsewhere."""

import json

import numpy as np
import pytest

from armlab.benches.robot.table.state import SetPoint
from armlab.benches.velocity.ellipsoid.state_sweep import SweepJoint
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.edits import SetCell
from armlab.session.fields import Set
from armlab.session.parts.display import Show
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint, RandomPose
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.target import PlaceTarget, Target
from armlab.session.parts.timeline import OpenClip, Play, Seek, Timeline
from armlab.session.session import Session, StartFresh, Undo
from armlab.session.state import State
from armlab.teaching.lesson_commands import Answer, CloseLesson, GoToStep, OpenLesson
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.shelf import (
    HOME,
    SANDBOX,
    SHARED,
    BackFromShared,
    BackToLesson,
    OpenShared,
    Shelf,
    ToSandbox,
)
from support.trips import SCARA, UR10, applied, reloaded, same, written

PUMA, PLANAR = catalogue()["puma560"], catalogue()["planar_2r"]


@pytest.fixture
def session():
    return applied(Session.fresh("token", PUMA), Show("names", True))


@pytest.fixture
def lesson(session):
    T = np.eye(4)
    T[:3, 3] = 1.0, 0.8, 0.0
    return applied(session, OpenLesson("first_arm"), MoveJoint(0, 0.4), PlaceTarget(T), LockJoint(1, True))


def test_a_sandbox_begins_with_the_arm_as_it_is_and_the_lesson_waits(lesson):
    left = lesson.state
    applied(lesson, ToSandbox())
    state = lesson.state
    assert state[Shelf].place == SANDBOX
    assert state[Shelf].waiting == left[LessonPart].open
    assert state[LessonPart].lesson is None
    assert state[LessonPart].progress_of == left[LessonPart].progress_of
    assert state[RobotPart].robot is PLANAR
    assert state[Joints] is left[Joints]
    assert lesson.notice is None


def test_the_lesson_and_the_sandbox_are_as_they_were_left(lesson):
    left = lesson.state
    applied(
        lesson,
        ToSandbox(),
        ChooseRobot("scara"),
        MoveJoint(0, 1.0),
        Show("names", False),
        Set(Notation, "angle", "rad"),
    )
    played = lesson.state
    applied(lesson, BackToLesson())
    same(lesson.state, left)
    assert lesson.state[LessonPart] == left[LessonPart]
    assert lesson.state[Target].pose is left[Target].pose
    applied(lesson, MoveJoint(0, -0.2), ToSandbox())
    same(lesson.state, played)
    applied(lesson, BackToLesson())
    assert lesson.state[Joints].q[0] == -0.2


def test_progress_is_always_the_present_one(lesson):
    applied(lesson, ToSandbox(), ChooseRobot("ur10"), OpenShared(SCARA), BackToLesson(), GoToStep(2), Answer("0.5"))
    answers = lesson.state[LessonPart].progress.answers
    assert list(answers.values()) == ["0.5"]
    applied(lesson, ToSandbox(), BackToLesson())
    assert lesson.state[LessonPart].progress.answers == answers
    applied(lesson, Undo(), Undo(), Undo())
    assert lesson.state[LessonPart].progress.answers == answers


def test_going_and_coming_are_no_steps_of_undo(lesson):
    label, steps = lesson.history.undo_label, len(lesson.history.past)
    applied(lesson, ToSandbox())
    assert lesson.history.undo_label is None
    applied(lesson, ChooseRobot("scara"), Undo())
    assert lesson.robot is PLANAR
    assert lesson.history.undo_label is None
    before = lesson.state
    applied(lesson, Undo())
    assert lesson.state is before
    applied(lesson, OpenShared(UR10), Undo())
    assert lesson.robot.key == "ur10"
    applied(lesson, BackFromShared())
    assert lesson.history.redo_label == ChooseRobot.label
    applied(lesson, BackToLesson())
    assert (lesson.history.undo_label, len(lesson.history.past)) == (label, steps)
    applied(lesson, Undo(), Undo(), Undo())
    np.testing.assert_array_equal(lesson.state[Joints].q, lesson.state[LessonPart].lesson.start)
    assert lesson.state[Shelf].place == HOME
    assert SANDBOX in lesson.state[Shelf].parked


def test_each_shared_state_has_a_history_of_its_own(session):
    applied(session, OpenShared(SCARA), MoveJoint(1, 0.3), OpenShared(UR10))
    assert session.history.undo_label is None
    applied(session, MoveJoint(1, 0.3), Undo(), Undo())
    assert session.robot.key == "ur10"
    applied(session, OpenShared(SCARA))
    assert session.history.undo_label is None


def test_a_shared_state_covers_the_work_and_gives_it_back(session):
    applied(session, SetCell(1, "a", 0.7), MoveJoint(0, 0.3), SetPoint((0.0, 0.0, 0.1)))
    left = session.state
    applied(session, OpenShared(SCARA))
    assert session.robot.key == "scara"
    assert session.state[Joints].q[0] == 0.5
    assert session.state[Shelf].shared == SCARA
    applied(session, MoveJoint(1, 0.2), OpenShared(UR10), MoveJoint(1, 0.2), OpenShared(SCARA), BackFromShared())
    same(session.state, left)
    assert session.state[RobotPart].robot is left[RobotPart].robot
    assert not session.state[Shelf].parked
    assert session.notice is None


def test_opening_the_shared_state_that_is_open_changes_nothing(session):
    state = applied(session, OpenShared(SCARA), MoveJoint(1, 0.2)).state
    assert applied(session, OpenShared(SCARA)).state is state


def test_from_a_shared_state_over_the_sandbox_there_are_two_ways_back(lesson):
    left = lesson.state
    applied(lesson, ToSandbox(), ChooseRobot("stanford"))
    played = lesson.state
    applied(lesson, OpenShared(SCARA), BackFromShared())
    same(lesson.state, played)
    applied(lesson, OpenShared(UR10), BackToLesson())
    same(lesson.state, left)
    applied(lesson, ToSandbox())
    same(lesson.state, played)


def test_what_is_no_state_is_refused_and_leaves_everything(lesson):
    left = lesson.state
    applied(lesson, OpenShared("1AAAA"))
    assert lesson.state is left
    assert "copy the whole link" in lesson.notice.text


def test_what_makes_no_sense_is_refused_with_a_sentence(session):
    applied(session, ToSandbox())
    assert "no lesson is open" in session.notice.text
    applied(session, OpenShared(SCARA), ToSandbox())
    assert "go back to your work first" in session.notice.text
    assert session.state[Shelf].place == SHARED


@pytest.mark.parametrize("command", [BackToLesson(), BackFromShared()])
def test_at_home_there_is_no_way_back(session, command):
    before = session.state
    assert applied(session, command).state is before


def test_in_the_sandbox_there_is_no_way_to_the_sandbox(lesson):
    before = applied(lesson, ToSandbox()).state
    assert applied(lesson, ToSandbox()).state is before
    assert applied(lesson, BackFromShared()).state is before


def test_a_lesson_opened_elsewhere_takes_the_place_of_what_waits_and_undo_brings_that_back(lesson):
    left = lesson.state
    applied(lesson, ToSandbox(), ChooseRobot("scara"))
    played = lesson.state
    applied(lesson, OpenLesson("first_arm"))
    assert lesson.state[Shelf].place == HOME
    assert set(lesson.state[Shelf].parked) == {SANDBOX}
    np.testing.assert_array_equal(lesson.state[Joints].q, lesson.state[LessonPart].lesson.start)
    applied(lesson, Undo())
    np.testing.assert_array_equal(lesson.state[Joints].q, left[Joints].q)
    applied(lesson, ToSandbox())
    same(lesson.state, played)


def test_a_lesson_opened_over_a_shared_state_is_at_home(session):
    applied(session, SetCell(1, "a", 0.7))
    own = session.robot
    applied(session, OpenShared(SCARA), OpenLesson("first_arm"))
    assert session.state[Shelf].place == HOME
    assert not session.state[Shelf].parked
    applied(session, CloseLesson(), Undo())
    assert session.robot is own


def test_closing_the_lesson_at_home_leaves_the_sandbox_where_it_is(lesson):
    applied(lesson, ToSandbox(), ChooseRobot("scara"), BackToLesson(), CloseLesson())
    assert SANDBOX in lesson.state[Shelf].parked
    applied(lesson, OpenLesson("first_arm"), ToSandbox())
    assert lesson.robot.key == "scara"


def test_a_film_that_played_waits_where_it_was(lesson):
    applied(lesson, OpenClip("film"), Seek(2.0), Play(True), ToSandbox())
    assert not lesson.state[Timeline].playing
    applied(lesson, OpenClip(""), BackToLesson())
    timeline = lesson.state[Timeline]
    assert (timeline.clip, timeline.time, timeline.playing) == ("film", 2.0, False)


def test_what_is_drawn_of_a_sweep_on_another_arm_does_not_touch_the_lesson(lesson):
    """The parts react to changes of each other; a state that comes back whole must not be adapted."""
    applied(lesson, LockJoint(1, False), SweepJoint(1), OpenClip("sweep"), Seek(1.0))
    left = lesson.state
    applied(lesson, ToSandbox(), OpenClip(""), ChooseRobot("cartesian_3p"), BackToLesson())
    same(lesson.state, left)


def test_starting_fresh_clears_the_shelf(lesson):
    applied(lesson, ToSandbox(), OpenShared(SCARA), StartFresh(), OpenLesson("first_arm"), ToSandbox())
    assert lesson.robot is PLANAR
    assert lesson.history.undo_label is None


def test_what_waits_does_not_pile_up(lesson):
    for k in range(12):
        applied(lesson, ToSandbox(), RandomPose(), OpenShared((SCARA, UR10)[k % 2]), BackFromShared(), BackToLesson())
    assert set(lesson.state[Shelf].parked) == {SANDBOX}
    for parked in lesson.state[Shelf].parked.values():
        assert parked[Shelf] == Shelf()
        assert not parked[LessonPart].progress_of
    fresh = State.initial(PLANAR).to_json()
    assert len(json.dumps(lesson.state.to_json())) < 2.2 * len(json.dumps(fresh))


@pytest.mark.parametrize(
    "trip",
    [
        (),
        (ToSandbox(), ChooseRobot("scara")),
        (ToSandbox(), ChooseRobot("scara"), BackToLesson()),
        (OpenShared(UR10), MoveJoint(0, 0.1)),
        (ToSandbox(), SetCell(0, "a", 0.3), OpenShared(UR10)),
    ],
)
def test_a_restart_keeps_every_place(lesson, trip):
    state = applied(lesson, *trip).state
    again = reloaded(state)
    assert again[Shelf].to_json() == state[Shelf].to_json()
    assert again[Shelf].place == state[Shelf].place
    before, after = Session("token", PUMA, state), Session("token", PUMA, again)
    for way in (BackFromShared(), BackToLesson(), ToSandbox()):
        applied(before, way)
        applied(after, way)
        assert written(after.state) == written(before.state)
        assert after.state[LessonPart].open == before.state[LessonPart].open


@pytest.mark.parametrize(
    "damage",
    [
        {"own": "elsewhere"},
        {"own": HOME},
        {"shared": "<script>"},
        {"shared": 5},
        {"parked": {}},
        {"parked": []},
        {"parked": {HOME: {}}},
        {"parked": {HOME: {"lesson": "first_arm", "parts": {}}}},
        {"parked": {HOME: {"lesson": "first_arm", "parts": {"robot": "gone"}}}},
        {"parked": {HOME: {"lesson": "first_arm", "parts": {"robot": "puma560", "shelf": Shelf().to_json()}}}},
        {"parked": {"third": {"lesson": "", "parts": {"robot": "puma560"}}}},
    ],
)
def test_a_damaged_shelf_raises(lesson, damage):
    data = applied(lesson, ToSandbox()).state[Shelf].to_json()
    Shelf.from_json(data, PUMA)
    with pytest.raises((InputError, KeyError, TypeError, AttributeError)):
        Shelf.from_json({**data, **damage}, PUMA)


def test_a_lesson_that_is_gone_leaves_its_arm(lesson):
    data = applied(lesson, ToSandbox()).state[Shelf].to_json()
    data["parked"][HOME]["lesson"] = "taken_away"
    shelf = Shelf.from_json(data, PUMA)
    assert shelf.waiting == ""
    assert shelf.parked[HOME][RobotPart].robot is PLANAR
