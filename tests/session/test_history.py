"""What undo keeps of one student is bounded, and what it brings back is whole."""

import numpy as np
import pytest

from armlab.benches.motion.files.commands import ReadMotion
from armlab.benches.motion.plan.state import Plan
from armlab.content.robots import catalogue
from armlab.session import history as module
from armlab.session.edits import SetCell
from armlab.session.parts.joints import MoveJoint, TakePose
from armlab.session.parts.robot import ChooseRobot
from armlab.session.parts.target import target_pose
from armlab.session.session import Redo, Session, Undo

SCARA = catalogue()["scara"]


@pytest.fixture
def session():
    return Session.fresh("token", SCARA)


def table(rows, phase):
    """Return a recorded motion of so many rows as a table."""
    t = np.arange(rows) / 100.0
    q = np.column_stack([0.3 * np.sin(t + phase), 0.2 * np.cos(t), 0.1 + 0.02 * np.sin(t), 0.1 * t / t[-1]])
    lines = [",".join(f"{value:.9g}" for value in (at, *row)) for at, row in zip(t, q, strict=True)]
    return "\n".join(["time_s,q1_rad,q2_rad,q3_m,q4_rad", *lines])


def test_recorded_motions_read_again_and_again_are_kept_within_bounds(session, monkeypatch):
    monkeypatch.setattr(module, "HEAVIEST", 2 << 20)
    for k in range(12):
        session.apply(ReadMotion(table(1500, 0.1 * k)), 2.0 * k)
        assert session.notice is None
        session.apply(MoveJoint(0, 0.01 * k), 2.0 * k + 1.0)
    held = sum(step.held for step in session.history.past)
    assert 1 << 20 < held <= 2 << 20
    assert 1 < len(session.history.past) < 24
    motions = {id(step.state[Plan].recorded) for step in session.history.past}
    assert len(motions) < 12


def test_what_is_still_kept_comes_back_whole(session):
    session.apply(ReadMotion(table(200, 0.0)), 0.0)
    first = session.state
    q = np.array(first[Plan].recorded.q)
    session.apply(ReadMotion(table(200, 0.5)), 2.0)
    session.apply(Undo(), 4.0)
    assert session.state is first
    np.testing.assert_array_equal(session.state[Plan].recorded.q, q)
    session.apply(Redo(), 5.0)
    assert not np.array_equal(session.state[Plan].recorded.q, q)


def test_what_follows_from_a_kept_state_is_not_kept_with_it(session):
    before = session.state
    pose = np.array(before.derived(target_pose))
    session.apply(TakePose("zero"), 0.0)
    assert before._derived == {}
    session.apply(Undo(), 1.0)
    np.testing.assert_array_equal(session.state.derived(target_pose), pose)


def test_an_arm_that_was_replaced_counts_and_the_one_on_the_table_does_not(session):
    session.apply(SetCell(0, "a", 0.3), 0.0)
    session.apply(MoveJoint(0, 0.1), 3.0)
    edited, moved = (step.held for step in session.history.past)
    assert edited > 50_000 > 10 * moved


def test_two_hundred_small_steps_are_all_kept(session):
    for k in range(200):
        session.apply(MoveJoint(0, 0.001 * (k + 1)), 3.0 * k)
    session.apply(ChooseRobot("puma560"), 1000.0)
    assert len(session.history.past) == 200


def test_a_slider_that_is_moved_on_after_an_undo_makes_a_step_of_its_own(session):
    session.apply(MoveJoint(0, 0.1), 0.0)
    session.apply(MoveJoint(1, 0.2), 1.0)
    before = session.state
    session.apply(MoveJoint(0, 0.3), 2.0)
    session.apply(Undo(), 2.1)
    session.apply(MoveJoint(0, 0.4), 2.2)
    session.apply(Undo(), 2.3)
    assert session.state is before
