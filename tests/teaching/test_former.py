"""After a lesson: its overlays go, and the way back leads to arm, pose and work as they were before it."""

import json

import numpy as np
import pytest

from armlab.benches.robot.table.state import Point, SetPoint
from armlab.content.robots import catalogue
from armlab.kin.dh import Row
from armlab.session.edits import NewArm, SetCell
from armlab.session.fields import Set
from armlab.session.parts.display import Display, Show
from armlab.session.parts.joints import Joints, MoveJoint
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.session import Session, StartFresh, Undo
from armlab.session.share import short, state_of_parts
from armlab.teaching.assignment_commands import HandIn, OpenAssignment
from armlab.teaching.hand_in import hand_in
from armlab.teaching.hand_in_open import OpenWork
from armlab.teaching.lesson_commands import CloseLesson, OpenLesson, SignAs
from armlab.teaching.parts.former import BackToFormer, ForgetFormer, Former, offered
from armlab.teaching.parts.lesson import LessonPart
from armlab.teaching.parts.shelf import BackToLesson, OpenShared, Shelf, ToSandbox
from support.assigned import done, folder_fixture, fresh_fixture
from support.small_lessons import library_fixture
from support.trips import UR10, applied, reloaded, written

PUMA = catalogue()["puma560"]


own = pytest.fixture(library_fixture, name="own")
folder = pytest.fixture(folder_fixture, name="folder")
fresh = pytest.fixture(fresh_fixture, name="fresh")


@pytest.fixture
def session():
    return applied(
        Session.fresh("token", PUMA),
        MoveJoint(1, 0.3),
        SetPoint((0.0, 0.0, 0.1)),
        Show("names", True),
        Show("trace", True),
    )


def restarted(session):
    """Return the session of the same student after a restart."""
    again = Session.fresh(session.token, session.opening)
    again.state = reloaded(session.state)
    return again


def test_the_overlays_of_a_lesson_go_with_it_and_those_before_it_come_back(session):
    applied(session, OpenLesson("first_arm"))
    assert session.state[Display].switches["frames"] is True
    applied(session, Show("dark", True), CloseLesson())
    switches = session.state[Display].switches
    assert {name for name, on in switches.items() if on} == {"names", "trace", "dark"}


def test_after_a_lesson_the_way_leads_back_to_arm_pose_and_work(session):
    left = session.state
    applied(session, OpenLesson("first_arm"), MoveJoint(0, 0.5), Set(Notation, "angle", "rad"), CloseLesson())
    assert session.robot.key == "planar_2r", "the arm of the lesson stays until one goes back"
    assert offered(session.state) is PUMA
    applied(session, BackToFormer())
    assert session.state[RobotPart] is left[RobotPart]
    assert session.state[Joints] is left[Joints]
    assert session.state[Point] is left[Point]
    assert session.state[Notation].angle == "rad", "units are the present ones"
    assert offered(session.state) is None
    assert session.state[Former].state is None


def test_progress_in_the_lesson_stays_when_one_goes_back(session):
    applied(session, OpenLesson("first_arm"), CloseLesson())
    progress = session.state[LessonPart].progress_of
    applied(session, BackToFormer())
    assert session.state[LessonPart].progress_of == progress
    assert session.state[LessonPart].lesson is None


def test_the_way_back_is_a_step_of_undo(session):
    applied(session, OpenLesson("first_arm"), MoveJoint(0, 0.5), CloseLesson(), BackToFormer(), Undo())
    assert session.robot.key == "planar_2r"
    assert session.state[Joints].q[0] == 0.5


def test_during_a_lesson_there_is_no_way_back(session):
    applied(session, OpenLesson("first_arm"))
    assert offered(session.state) is None
    state = session.state
    assert applied(session, BackToFormer()).state is state


def test_after_several_lessons_the_way_leads_to_what_was_before_the_first(session):
    applied(
        session, OpenLesson("first_arm"), OpenLesson("joint_types"), CloseLesson(), OpenLesson("ik_2r"), CloseLesson()
    )
    assert offered(session.state) is PUMA
    applied(session, BackToFormer())
    assert session.state[Joints].q[1] == 0.3


def test_switches_set_between_two_lessons_are_there_after_the_second(session):
    applied(session, OpenLesson("first_arm"), CloseLesson(), Show("names", False), OpenLesson("ik_2r"), CloseLesson())
    assert {name for name, on in session.state[Display].switches.items() if on} == {"trace"}


def test_an_arm_whose_file_is_gone_is_not_offered_and_keeps_nobody_out(session):
    applied(session, OpenLesson("first_arm"))
    data = session.state.to_json()
    data["former"]["robot"] = "sold"
    assert state_of_parts(data)[Former].state is None


def test_another_arm_chosen_after_the_lesson_ends_the_offer(session):
    applied(session, OpenLesson("first_arm"), CloseLesson(), ChooseRobot("scara"))
    assert offered(session.state) is None
    applied(session, OpenLesson("joint_types"), CloseLesson())
    assert offered(session.state).key == "scara"


def test_a_new_arm_ends_the_offer_and_an_edit_of_the_lessons_arm_does_not(session):
    applied(session, OpenLesson("first_arm"), CloseLesson(), SetCell(0, "a", 0.7))
    assert offered(session.state) is PUMA
    applied(session, NewArm((Row("R", a=0.3),), "standard"))
    assert offered(session.state) is None


def test_one_can_stay_with_the_arm_of_the_lesson(session):
    applied(session, OpenLesson("first_arm"), CloseLesson(), ForgetFormer())
    assert offered(session.state) is None
    assert session.robot.key == "planar_2r"


def test_where_the_arm_stands_as_before_nothing_is_offered():
    session = applied(Session.fresh("token", catalogue()["planar_2r"]), OpenLesson("first_arm"), CloseLesson())
    np.testing.assert_array_equal(session.state[Joints].q, catalogue()["planar_2r"].home)
    assert offered(session.state) is None
    assert session.state[Former].state is None


def test_it_is_there_after_a_restart(session):
    applied(session, SetCell(1, "a", 0.5), OpenLesson("first_arm"))
    again = restarted(session)
    applied(again, CloseLesson())
    assert offered(again.state).name == "PUMA 560"
    applied(again, BackToFormer())
    assert again.state[RobotPart].robot.arm.rows[1].a == 0.5
    assert again.state[Joints].q[1] == 0.3


def test_it_waits_with_the_lesson_while_the_student_is_in_the_sandbox_even_over_a_restart(session):
    applied(session, OpenLesson("first_arm"), ToSandbox(), ChooseRobot("scara"))
    assert offered(session.state) is None
    again = restarted(session)
    applied(again, BackToLesson(), CloseLesson(), BackToFormer())
    assert again.robot is PUMA
    assert again.state[Joints].q[1] == 0.3
    assert again.state[Shelf].waiting == ""


def test_a_lesson_that_is_opened_from_the_sandbox_follows_the_one_that_waits(session):
    applied(session, OpenLesson("first_arm"), ToSandbox(), ChooseRobot("scara"), OpenLesson("ik_2r"), CloseLesson())
    assert offered(session.state) is PUMA
    applied(session, BackToFormer())
    assert session.state[Joints].q[1] == 0.3


def on(state):
    return {name for name, on in state[Display].switches.items() if on}


def test_an_assignment_or_saved_work_opened_in_a_lesson_leaves_none_of_its_overlays(fresh):
    state = done(fresh, Show("names", True), SignAs("Ada"), OpenLesson("t"))
    work = hand_in(state)
    assert on(done(state, OpenWork(work), CloseLesson())) == {"names"}
    there = done(state, OpenAssignment("homework", 3))
    assert on(done(there, CloseLesson())) == {"names"}
    assert on(done(there, Show("frames", True), OpenAssignment("homework", 5), CloseLesson())) == {"names"}
    handed = hand_in(done(there, HandIn()))
    assert on(done(state, OpenWork(handed), CloseLesson())) == {"names"}


def test_a_shared_arm_knows_nothing_of_it_and_links_do_not_hold_it(session):
    applied(session, OpenLesson("first_arm"), CloseLesson())
    text = short(session.state)
    applied(session, OpenShared(UR10))
    assert offered(session.state) is None
    fresh = applied(Session.fresh("other", PUMA), OpenShared(text))
    assert fresh.state[Former].state is None


def test_work_that_is_handed_in_does_not_hold_it(session):
    applied(session, OpenLesson("first_arm"))
    assert not {"former", "welcome", "shelf", "lesson"} & json.loads(hand_in(session.state))["parts"].keys()


def test_the_next_person_at_the_computer_is_offered_nothing(session):
    applied(session, OpenLesson("first_arm"), CloseLesson(), StartFresh())
    assert offered(session.state) is None


def test_what_is_gone_back_to_is_all_that_was_there(session):
    left = session.state
    applied(session, OpenLesson("first_arm"), CloseLesson(), BackToFormer())
    assert written(session.state) == written(left)
