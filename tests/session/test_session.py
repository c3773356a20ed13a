"""One student: undo, mailbox, worker."""

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.session.edits import SetCell
from armlab.session.history import PAUSE
from armlab.session.mailbox import MOST, Mailbox
from armlab.session.parts.display import Display, Show
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint, TakePose
from armlab.session.parts.robot import ChooseRobot
from armlab.session.parts.target import DragTarget, EndDrag, target_pose
from armlab.session.parts.timeline import OpenClip, Seek, Timeline
from armlab.session.session import LONGEST_NOTICE, Redo, Refuse, Session, StartFresh, Undo
from armlab.session.state import Command

PUMA = catalogue()["puma560"]


@pytest.fixture
def session():
    return Session.fresh("token", PUMA)


def drag(session, drag_id, start, count=10):
    """Drag the handle as a hand does; returns the last target."""
    T = np.array(target_pose(session.state))
    for k in range(count):
        T = T.copy()
        T[0, 3] += 0.01
        session.apply(DragTarget(T, drag_id), start + 0.05 * k)
    session.apply(EndDrag(T, drag_id), start + 0.05 * count + 3.0)
    return T


def test_one_drag_is_one_step_of_undo(session):
    before = session.state
    drag(session, object(), 0.0)
    assert len(session.history.past) == 1
    session.apply(Undo(), 100.0)
    assert session.state is before


def test_two_drags_are_two_steps_however_quick(session):
    drag(session, object(), 0.0)
    middle = session.state
    drag(session, object(), 0.1)
    session.apply(Undo(), 1.0)
    assert session.state is middle


def test_one_slide_is_one_step_and_a_pause_begins_another(session):
    for k in range(20):
        session.apply(MoveJoint(0, 0.01 * k), 0.05 * k)
    assert len(session.history.past) == 1
    session.apply(MoveJoint(0, 0.5), 1.0 + 2 * PAUSE)
    assert len(session.history.past) == 2
    session.apply(MoveJoint(1, 0.5), 1.1 + 2 * PAUSE)
    assert len(session.history.past) == 3


def test_redo_brings_back_and_a_new_step_forgets_it(session):
    session.apply(TakePose("zero"), 0.0)
    zero = session.state
    session.apply(Undo(), 1.0)
    assert session.history.redo_label == "move"
    session.apply(Redo(), 2.0)
    assert session.state is zero
    session.apply(Undo(), 3.0)
    session.apply(Show("frames", True), 4.0)
    assert session.history.redo_label == "move"
    session.apply(LockJoint(0, True), 5.0)
    assert session.history.redo_label is None


def test_undo_leaves_the_switches_of_the_picture_as_they_are(session):
    session.apply(TakePose("zero"), 0.0)
    session.apply(Show("dark", True), 1.0)
    assert session.history.undo_label == "move"
    session.apply(Undo(), 2.0)
    assert session.state[Joints].q.tolist() == PUMA.home.tolist()
    assert session.state[Display].switches["dark"]
    session.apply(Show("dark", False), 3.0)
    session.apply(Redo(), 4.0)
    assert session.state[Joints].q.tolist() == [0.0] * 6
    assert not session.state[Display].switches["dark"]


def test_a_switch_of_the_picture_during_a_sweep_is_no_step(session):
    for k, command in enumerate((OpenClip("sweep", play=True), Show("dark", True), Seek(1.0))):
        session.apply(command, float(k))
    swept = session.state
    session.apply(Undo(), 9.0)
    assert session.state is swept


def test_undo_with_nothing_to_undo_changes_nothing(session):
    before = session.state
    session.apply(Undo(), 0.0)
    session.apply(Redo(), 0.0)
    assert session.state is before
    assert session.notice is None


def test_undo_crosses_a_choice_of_arm(session):
    session.apply(TakePose("zero"), 0.0)
    session.apply(ChooseRobot("scara"), 1.0)
    session.apply(Undo(), 2.0)
    assert session.robot is PUMA
    assert session.state[Joints].q.tolist() == [0.0] * 6


def test_a_command_without_effect_is_no_step(session):
    session.apply(LockJoint(0, False), 0.0)
    assert session.history.undo_label is None


def test_the_history_is_bounded(session):
    for k in range(500):
        session.apply(LockJoint(0, k % 2 == 0), float(k))
    assert len(session.history.past) == 200


def test_start_fresh_forgets_everything(session):
    session.apply(ChooseRobot("scara"), 0.0)
    session.apply(StartFresh(), 1.0)
    assert session.robot is PUMA
    assert session.history.undo_label is None


def test_a_refused_command_leaves_the_state_and_a_sentence(session):
    before = session.state
    session.apply(MoveJoint(0, float("nan")), 0.0)
    assert session.state is before
    assert "expected 6 finite numbers" in session.notice.text
    session.apply(Refuse("x: expected a number"), 0.0)
    assert session.notice.number == 2
    assert session.notice.text == "x: expected a number"


class Broken(Command):
    """A command with a bug."""

    def apply(self, state):
        return 1 / 0


def test_a_failing_command_leaves_the_state_and_a_notice_and_the_log_a_line(session, caplog):
    before = session.state
    session.apply(Broken(), 0.0)
    assert session.state is before
    assert "Broken failed inside the lab" in session.notice.text
    assert "Broken failed: ZeroDivisionError: division by zero (test_session.py:" in caplog.text
    assert "Traceback" not in caplog.text


def test_a_notice_is_short(session):
    session.tell("9" * 400_000)
    assert len(session.notice.text) == LONGEST_NOTICE
    assert session.notice.text.endswith("...")


def taken(mailbox):
    """Return all that waits."""
    return [letter.command for letter in iter(mailbox.take, None)]


def test_of_waiting_snapshots_only_the_newest_counts():
    mailbox = Mailbox()
    for k in range(5):
        mailbox.post(MoveJoint(0, float(k)))
    mailbox.post(MoveJoint(1, 9.0))
    assert taken(mailbox) == [MoveJoint(0, 4.0), MoveJoint(1, 9.0)]
    assert mailbox.take() is None


def test_events_keep_their_place_among_snapshots():
    mailbox = Mailbox()
    posted = [MoveJoint(0, 1.0), Show("frames", True), MoveJoint(0, 2.0), Show("frames", False), MoveJoint(0, 3.0)]
    for command in posted:
        mailbox.post(command)
    assert taken(mailbox) == posted


def test_catching_up_replaces_no_pose_of_the_hand_that_waits():
    mailbox, poses = Mailbox(), [DragTarget(np.eye(4), "drag"), DragTarget(2.0 * np.eye(4), "drag")]
    on = DragTarget(None, "drag")
    for command in (on, poses[0], on, poses[1], on):
        mailbox.post(command)
    assert taken(mailbox) == [poses[1]]


def test_a_mailbox_holds_so_many_and_no_more():
    mailbox = Mailbox()
    assert all(mailbox.post(Show("frames", True)) for _ in range(MOST))
    assert not mailbox.post(Show("frames", False))
    assert len(taken(mailbox)) == MOST
    assert mailbox.post(Show("frames", False))


def test_what_is_refused_changes_nothing_or_is_taken_back_is_counted_for_the_pages(session):
    for count, command in enumerate((Refuse("no"), LockJoint(0, False), TakePose("nowhere"), Undo()), start=1):
        session.apply(command, float(count))
        assert session.untaken == count
    session.apply(TakePose("zero"), 9.0)
    assert session.untaken == 4
    # Pages that have not been shown the pose may think that nothing has changed.
    session.apply(Undo(), 10.0)
    assert session.untaken == 5


def test_undo_of_an_edit_leaves_the_timeline_where_it_is(session):
    session.apply(OpenClip("film"), 0.0)
    session.apply(Seek(12.0), 1.0)
    session.apply(SetCell(1, "a", 0.5), 2.0)
    session.apply(Undo(), 3.0)
    assert session.robot is PUMA
    assert session.state[Timeline].time == 12.0
    session.apply(Redo(), 4.0)
    assert session.state[Timeline].time == 12.0


def test_undo_to_another_arm_begins_its_film_anew(session):
    session.apply(ChooseRobot("scara"), 0.0)
    session.apply(OpenClip("film"), 1.0)
    session.apply(Seek(5.0), 2.0)
    session.apply(Undo(), 3.0)
    assert session.robot is PUMA
    assert (session.state[Timeline].clip, session.state[Timeline].time) == ("film", 0.0)
