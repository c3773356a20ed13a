"""Jogging in a session: steps of a chosen size, one jog one step of undo, and why it ended."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.fields import Set
from armlab.session.mailbox import Mailbox
from armlab.session.parts.jog import Ended, Jog, JogBy, jog_offers
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint, TakePose, TypeJoint
from armlab.session.parts.robot import ChooseRobot
from armlab.session.parts.target import Target
from armlab.session.session import Redo, Session, Undo
from armlab.session.state import State, apply

PUMA = catalogue()["puma560"]


def opened(mode, robot="puma560"):
    session = Session.fresh("token", catalogue()[robot])
    session.apply(Set(Jog, "mode", mode), 0.0)
    return session


def parts(k, part=1.0, count=6):
    return tuple(part if i == k else 0.0 for i in range(count))


def test_a_press_moves_a_joint_by_the_chosen_step():
    session = opened("joints")
    for key, degrees in (("0.1", 0.1), ("1", 1.0), ("5", 5.0)):
        before = session.state[Joints].q[1]
        session.apply(Set(Jog, "turn", key), 0.0)
        session.apply(JogBy(parts(1, -1.0), int(degrees * 10)), 1.0)
        assert session.state[Joints].q[1] - before == pytest.approx(-math.radians(degrees))


def test_a_sliding_joint_moves_by_the_step_of_lengths():
    session = opened("joints", "scara")
    before = session.state[Joints].q
    sliding = int(np.flatnonzero(~session.state[Joints].arm.revolute)[0])
    session.apply(JogBy(parts(sliding, 1.0, 4), 1), 1.0)
    assert session.state[Joints].q[sliding] - before[sliding] == pytest.approx(0.01)


@pytest.mark.parametrize("mode", ["joints", "base", "tool"])
def test_one_jog_is_one_step_of_undo_and_two_are_two(mode):
    session = opened(mode)
    home = session.state[Joints].q
    for jog in (7, 8):
        for k in range(5):
            session.apply(JogBy(parts(0), jog), 0.1 * k)
    after = session.state[Joints].q
    session.apply(Undo(), 5.0)
    between = session.state[Joints].q
    session.apply(Undo(), 5.0)
    np.testing.assert_array_equal(session.state[Joints].q, home)
    assert session.history.undo_label is None
    assert 0.0 < np.abs(between - home).max() < np.abs(after - home).max()
    session.apply(Redo(), 6.0)
    np.testing.assert_array_equal(session.state[Joints].q, between)


def test_a_joint_stops_at_its_limit_and_says_which_without_a_step_of_undo_of_its_own():
    session = opened("joints")
    high = PUMA.arm.limits[0, 1]
    session.apply(MoveJoint(0, high - math.radians(1.5)), 0.0)
    for k in range(4):
        session.apply(JogBy(parts(0), 5), 1.0 + 0.1 * k)
        assert (session.state[Jog].ended is None) == (k == 0)
    assert session.state[Joints].q[0] == high
    assert session.state[Jog].ended == Ended(5, "limit", (0,))
    session.apply(JogBy(parts(0), 6), 3.0)
    assert session.state[Jog].ended == Ended(6, "limit", (0,))
    assert len(session.history.past) == 2  # the slider and the first jog
    session.apply(JogBy(parts(0, -1.0), 7), 4.0)
    assert session.state[Jog].ended is None
    assert session.state[Joints].q[0] < high


def test_a_held_joint_does_not_move_and_is_named():
    session = opened("joints")
    session.apply(LockJoint(2, True), 0.0)
    before = session.state[Joints]
    session.apply(JogBy(parts(2), 1), 1.0)
    assert session.state[Joints] is before
    assert session.state[Jog].ended == Ended(1, "held", (2,))
    assert jog_offers(session.state) == (True, True, False, True, True, True)


def test_the_tool_moves_along_base_or_tool_and_the_target_goes_with_it():
    for mode, axes in (("base", np.eye(3)), ("tool", PUMA.arm.fk(PUMA.home)[:3, :3])):
        session = opened(mode)
        before = session.state[Joints].tool_pose
        session.apply(JogBy(parts(2), 1), 1.0)
        after = session.state[Joints].tool_pose
        np.testing.assert_allclose(after[:3, 3] - before[:3, 3], 0.01 * axes[:, 2], atol=2e-6)
        np.testing.assert_allclose(after[:3, :3], before[:3, :3], atol=2e-6)
        assert session.state[Target].pose is None


def test_a_step_out_of_reach_is_not_taken_and_said():
    session = opened("base", "planar_2r")
    session.apply(TakePose("zero"), 0.0)
    before = session.state[Joints]
    session.apply(JogBy(parts(0), 3), 1.0)
    assert session.state[Joints] is before
    assert session.state[Jog].ended == Ended(3, "reach")


def test_what_the_arm_does_not_control_is_left_aside():
    session = opened("base", "planar_2r")
    before = session.state
    session.apply(JogBy(parts(2), 1), 1.0)
    assert session.state[Joints] is before[Joints]
    assert session.notice is None


def test_why_a_jog_ended_is_forgotten_when_something_else_moves_the_arm():
    session = opened("joints")
    session.apply(MoveJoint(0, 9.0), 0.0)
    session.apply(JogBy(parts(0), 1), 1.0)
    assert session.state[Jog].ended is not None
    session.apply(TakePose("zero"), 2.0)
    assert session.state[Jog].ended is None


def test_the_choice_is_no_work_it_stays_with_undo_and_another_arm_and_is_not_saved():
    session = opened("tool")
    session.apply(Set(Jog, "turn", "5"), 0.0)
    session.apply(JogBy(parts(0), 1), 1.0)
    session.apply(Undo(), 2.0)
    session.apply(ChooseRobot("scara"), 3.0)
    assert (session.state[Jog].mode, session.state[Jog].turn) == ("tool", "5")
    assert "jog" not in session.state.to_json()


@pytest.mark.parametrize(
    ("mode", "given", "says"),
    [
        ("", parts(0), "choose joints, base or tool first"),
        ("joints", parts(0, 1.0, 5), "expected 6 numbers from -1 to 1"),
        ("joints", parts(0, 1.5), "expected 6 numbers from -1 to 1"),
        ("base", parts(0, math.nan), "expected 6 numbers from -1 to 1"),
        ("tool", (), "expected 6 numbers from -1 to 1"),
    ],
)
def test_what_is_no_jog_is_refused(mode, given, says):
    state = apply(State.initial(PUMA), Set(Jog, "mode", mode))
    with pytest.raises(InputError, match=says):
        apply(state, JogBy(given, 1))


def test_of_the_steps_of_one_jog_that_wait_the_newest_counts_and_every_press_does():
    mailbox = Mailbox()
    for command in (JogBy(parts(0), 1), JogBy(parts(0), 1), JogBy(parts(0), 1), JogBy(parts(0), 2), JogBy(parts(0), 3)):
        mailbox.post(command)
    assert len(mailbox) == 3


def test_two_typed_values_are_two_steps_of_undo_and_a_move_of_a_slider_is_one():
    session = opened("")
    home = session.state[Joints].q
    session.apply(TypeJoint(0, 0.5), 1.0)
    session.apply(TypeJoint(0, 0.7), 1.1)
    for k in range(5):
        session.apply(MoveJoint(1, 0.1 * k), 1.2 + 0.05 * k)
    seen = []
    while session.history.undo_label:
        session.apply(Undo(), 3.0)
        seen.append(session.state[Joints].q[:2].tolist())
    assert seen == [[0.7, home[1]], [0.5, home[1]], home[:2].tolist()]


def test_a_typed_value_beyond_the_limit_is_cut_to_it():
    session = opened("")
    session.apply(TypeJoint(1, 99.0), 1.0)
    assert session.state[Joints].q[1] == PUMA.arm.limits[1, 1]
