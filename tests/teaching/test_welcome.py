"""The first visit: who sees the card, and how it is left for good."""

import pytest

from armlab.content.robots import catalogue
from armlab.session.parts.joints import MoveJoint
from armlab.session.parts.robot import ChooseRobot
from armlab.session.session import Session, StartFresh, Undo
from armlab.session.store import Store
from armlab.teaching.lesson_commands import CloseLesson, OpenLesson
from armlab.teaching.parts.shelf import BackFromShared, OpenShared
from armlab.teaching.parts.welcome import CARD, LEFT, STOPS, TOUR, LeaveWelcome, ShowCard, TakeTour, Welcome
from support.trips import UR10, applied, reloaded

PUMA = catalogue()["puma560"]


@pytest.fixture
def session():
    return Session.fresh("token", PUMA)


def restarted(session):
    """Return the session of the same student after a restart."""
    again = Session.fresh(session.token, session.opening)
    again.state = reloaded(session.state)
    return again


def at(session):
    return session.state[Welcome].at


def test_a_new_student_sees_the_card_and_keeps_it_while_looking_round(session):
    assert at(session) == CARD
    applied(session, MoveJoint(0, 0.3), ChooseRobot("scara"), Undo())
    assert at(session) == CARD


def test_the_card_is_left_by_closing_it_or_by_opening_a_lesson(session):
    applied(session, LeaveWelcome())
    assert at(session) == LEFT
    other = applied(Session.fresh("other", PUMA), OpenLesson("first_arm"))
    assert at(other) == LEFT
    assert at(applied(other, CloseLesson(), Undo())) == LEFT


def test_leaving_it_is_no_step_of_undo(session):
    applied(session, MoveJoint(0, 0.3), LeaveWelcome(), Undo())
    assert at(session) == LEFT
    assert session.history.undo_label is None


def test_the_tour_goes_from_stop_to_stop_and_can_be_left_at_each(session):
    for stop in range(STOPS):
        applied(session, TakeTour(stop))
        assert (at(session), session.state[Welcome].stop) == (TOUR, stop)
        assert at(applied(session, LeaveWelcome())) == LEFT


def test_there_is_no_stop_behind_the_last(session):
    state = applied(session, TakeTour(STOPS)).state
    assert session.notice.text == "stop: expected 1 to 4, got 5"
    assert state[Welcome].at == CARD


def test_it_is_found_again(session):
    applied(session, LeaveWelcome(), ShowCard())
    assert at(session) == CARD


def test_a_shared_link_does_not_show_it_and_the_way_home_does(session):
    applied(session, OpenShared(UR10))
    assert at(session) == LEFT
    assert at(applied(session, BackFromShared())) == CARD


def test_whoever_comes_back_to_saved_work_has_left_it(session):
    assert at(restarted(applied(session, MoveJoint(0, 0.3)))) == LEFT


def test_having_closed_it_is_kept_even_without_any_work(tmp_path):
    store = Store(tmp_path, PUMA)
    applied(store.get("token"), LeaveWelcome())
    store.save()
    assert at(Store(tmp_path, PUMA).get("token")) == LEFT
    assert at(Store(tmp_path, PUMA).get("somebody else")) == CARD


def test_the_next_person_at_the_computer_is_welcome(session):
    applied(session, LeaveWelcome(), StartFresh())
    assert at(session) == CARD
