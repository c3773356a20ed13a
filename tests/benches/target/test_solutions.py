"""All solutions of the present target: found beside the commands, listed in a lasting order, gone to, proved."""

import json
import math

import numpy as np
import pytest

from armlab.benches.target.solutions import job
from armlab.benches.target.solutions.found import _pair
from armlab.benches.target.solutions.question import question
from armlab.benches.target.solutions.state import (
    PRESETS,
    GoToSolution,
    LookAtSolution,
    MoveAlong,
    Prove,
    Solutions,
    TakePreset,
    TurnTo,
    fresh,
    motion_of,
    present_row,
    whole_turns,
)
from armlab.content.robots import catalogue
from armlab.errors import ArmlabError, InputError
from armlab.kin.rotations import rotation_about
from armlab.session.edits import SetCell
from armlab.session.parts.display import Show
from armlab.session.parts.joints import Joints, LockJoint, TakePose
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.target import DragTarget, EndDrag, GoAnotherWay, PlaceTarget, Target, target_pose, verdict
from armlab.session.session import Session, Undo
from armlab.session.state import apply
from armlab.session.way_to_solution import gap
from support.searched import OPEN, moved, opened, rows, searched


def reaches(state, q):
    arm, wanted = state[Joints].arm, state.derived(question)
    other = type(wanted)(arm, arm.fk(q), wanted.held)
    return np.abs(other.aim - wanted.aim).max() < 1e-8


def test_of_two_solutions_that_come_near_an_old_one_only_the_nearer_takes_its_place():
    arm = catalogue()["planar_2r"].arm
    slots = [-1, -1]
    _pair(arm, np.array([[0.2, 0.0], [0.1, 0.0]]), slots, {3: np.array([0.0, 0.0]), 7: np.array([0.9, 0.0])})
    assert slots == [7, 3]
    slots = [-1, -1]
    _pair(arm, np.array([[0.2, 0.0], [0.1, 0.0]]), slots, {3: np.array([0.0, 0.0])})
    assert slots == [-1, 3]


# -- the job -----------------------------------------------------------------------------------------------------


def test_nothing_is_searched_while_nobody_looks():
    state = opened("puma560")
    assert job.wanted(state, frozenset({"joints"})) is None
    assert job.wanted(state, OPEN) is not None
    assert job.wanted(apply(state, Show("ghosts", True)), frozenset()) is not None


@pytest.mark.parametrize(
    ("key", "pose", "count", "completeness"),
    [
        ("planar_2r", None, 2, "complete"),
        ("planar_2r", "folded", None, "infinite"),
        ("elbow_3r", None, 4, "complete"),
        ("elbow_3r", "on the axis", None, "infinite"),
        ("ur10_notes", "eight", 8, "complete"),
        ("manseur_doty", "sixteen", 16, "complete"),
        ("puma560", "zero", None, "infinite"),
        ("panda", None, None, "infinite"),
    ],
)
def test_as_many_as_the_notes_say_and_every_one_reaches_the_target(key, pose, count, completeness):
    state = searched(opened(key, pose))
    found = state[Solutions].found
    assert found.solutions.completeness == completeness
    assert count is None or len(found.rows) == count
    assert all(reaches(state, row.q) for row in found.rows)
    assert sorted(row.index for row in found.rows) == list(range(len(found.rows)))
    assert len({row.slot for row in found.rows}) == len(found.rows)


def test_the_same_target_is_not_searched_twice():
    state = searched(opened("ur10_notes", "eight"))
    before = job.wanted(state, OPEN)
    after = apply(state, GoToSolution(rows(state)[3].slot))
    assert job.wanted(after, OPEN).key == before.key
    assert list(job.run(job.wanted(after, OPEN).inputs)) == []


def test_a_list_for_another_arm_is_thrown_away():
    state = opened("puma560")
    wanted = job.wanted(state, OPEN)
    piece = next(job.run(wanted.inputs))
    other = apply(state, ChooseRobot("scara"))
    assert job.delivered(other, wanted.inputs, piece) is other
    edited = apply(state, SetCell(1, "a", 0.5))
    assert job.delivered(edited, wanted.inputs, piece) is edited
    assert searched(edited)[Solutions].found.question.arm is edited[Joints].arm


def test_the_list_follows_the_target_and_an_old_one_stays_until_the_new_one_comes():
    state = searched(opened("puma560"))
    old = state[Solutions].found
    state = apply(state, DragTarget(moved(state, 0.0, 0.0, 0.02), 1))
    assert state[Solutions].found is old
    assert state.derived(fresh) is None
    state = searched(state)
    assert state.derived(fresh) is state[Solutions].found is not old


# -- an order that lasts -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", ["puma560", "ur10e", "manseur_doty", "elbow_3r", "irb140"])
def test_rows_keep_their_slots_while_the_target_moves(key):
    state = searched(opened(key))
    arm = state[Joints].arm
    rng = np.random.default_rng(3)
    way = rng.normal(size=3)
    way *= 0.004 * arm.reach / np.linalg.norm(way)
    for _ in range(12):
        before = {row.slot: row for row in rows(state)}
        state = searched(apply(state, DragTarget(moved(state, *way), 1)))
        now = {row.slot: row for row in rows(state)}
        for slot in before.keys() & now.keys():
            assert np.abs(gap(arm, now[slot].q, before[slot].q)).max() < 0.6, (slot, before[slot].name, now[slot].name)
        assert [row.slot for row in rows(state)] == sorted(now)
        assert len(before.keys() & now.keys()) >= min(len(before), len(now))


def test_a_name_that_comes_back_has_its_slot_again():
    state = searched(opened("ur10_notes", "eight"))
    slots = {row.name: row.slot for row in rows(state)}
    away = searched(apply(state, PlaceTarget(moved(state, 0.9, 0.4, 0.0))))
    assert len(rows(away)) != 8
    back = searched(apply(away, TakePose("eight")))
    assert {row.name: row.slot for row in rows(back)} == slots


def test_the_arm_is_at_one_row():
    state = searched(opened("ur10_notes", "eight"))
    here = state.derived(present_row)
    np.testing.assert_allclose(gap(state[Joints].arm, here.q, state[Joints].q), 0.0, atol=1e-9)
    far = searched(apply(state, PlaceTarget(moved(state, 9.0, 0.0, 0.0))))
    assert far.derived(present_row) is None


# -- going there -------------------------------------------------------------------------------------------------


def test_the_arm_goes_to_a_row_in_one_step_and_the_target_stays():
    session = Session.fresh("a", catalogue()["ur10_notes"])
    session.state = searched(apply(session.state, TakePose("eight")))
    before, wanted = session.state[Joints].q, target_pose(session.state)
    for row in rows(session.state):
        session.apply(GoToSolution(row.slot), 0.0)
        np.testing.assert_allclose(
            session.state[Joints].q, before if row is rows(session.state)[0] else row.q, atol=1e-12
        )
        np.testing.assert_allclose(target_pose(session.state), wanted, atol=1e-9)
        assert session.state.derived(present_row).slot == row.slot
        assert session.notice is None
    for _ in range(7):
        session.apply(Undo(), 9.0)
    np.testing.assert_array_equal(session.state[Joints].q, before)
    assert session.state[Solutions].found is not None  # what was found is not taken back


def test_a_target_off_the_tool_stays_where_it_is():
    state = opened("elbow_3r")
    state = searched(apply(state, PlaceTarget(moved(state, 0.0, 0.0, -0.1))))
    wanted = state[Target].pose
    for row in rows(state):
        there = apply(state, GoToSolution(row.slot))
        np.testing.assert_allclose(there[Target].pose[:3, 3], wanted[:3, 3], atol=1e-12)
        assert there.derived(verdict).reached
        # The orientation is free: the handle shows the tool's.
        np.testing.assert_allclose(there[Target].pose[:3, :3], there[Joints].tool_pose[:3, :3], atol=1e-12)


def test_a_row_out_of_limits_is_refused_with_the_reason():
    state = searched(opened("puma560"))
    row = next(row for row in rows(state) if not row.within)
    with pytest.raises(InputError, match=r"out of limits: joint \d by [\d.]+° (above|below)"):
        apply(state, GoToSolution(row.slot))


def test_a_row_of_an_old_list_is_solved_for_anew():
    state = searched(opened("ur10_notes", "eight"))
    slot = rows(state)[4].slot
    old = rows(state)[4].q
    state = apply(state, DragTarget(moved(state, 0.01, 0.0, 0.0), 1))
    there = apply(state, GoToSolution(slot))
    assert there.derived(verdict).reached
    assert 1e-6 < np.abs(gap(state[Joints].arm, there[Joints].q, old)).max() < 0.3


def test_a_slot_that_is_not_there_is_refused():
    with pytest.raises(InputError, match="no longer exists"):
        apply(opened("puma560"), GoToSolution(0))
    with pytest.raises(InputError, match="no longer exists"):
        apply(searched(opened("puma560")), GoToSolution(99))


def test_held_joints_are_held_in_every_row():
    state = apply(opened("elbow_3r"), LockJoint(0, True))
    state = searched(state)
    assert 0 < len(rows(state)) < 4
    for row in rows(state):
        assert row.q[0] == state[Joints].q[0]
    loose = searched(opened("elbow_3r"))
    other = next(row for row in rows(loose) if abs(gap(state[Joints].arm, row.q, state[Joints].q)[0]) > 0.1)
    with pytest.raises(InputError, match="joint 1 is held"):
        apply(apply(loose, LockJoint(0, True)), GoToSolution(other.slot))


def test_whole_turns_lead_to_the_same_place():
    state = searched(opened("ur10_notes", "eight"))
    turns = state.derived(whole_turns)
    assert len(turns) > 8
    for k in (0, len(turns) - 1):
        there = apply(state, TurnTo(k))
        np.testing.assert_allclose(there[Joints].q, turns[k], atol=1e-12)
        np.testing.assert_allclose(target_pose(there), target_pose(state), atol=1e-9)
        assert there.derived(present_row).slot == state.derived(present_row).slot
    with pytest.raises(InputError):
        apply(state, TurnTo(len(turns)))


def test_the_nearest_other_way_is_taken_or_refused():
    state = opened("planar_2r")
    other = apply(state, GoAnotherWay())
    np.testing.assert_allclose(target_pose(other)[:3, 3], target_pose(state)[:3, 3], atol=1e-9)
    assert np.abs(other[Joints].q - state[Joints].q).max() > 0.5
    np.testing.assert_allclose(apply(other, GoAnotherWay())[Joints].q, state[Joints].q, atol=1e-9)
    with pytest.raises(InputError, match="The only other solution is outside the limits"):
        apply(opened("cylindrical_rpp"), GoAnotherWay())
    with pytest.raises(InputError, match="There is no other solution"):
        apply(opened("cartesian_3p"), GoAnotherWay())
    with pytest.raises(InputError, match="infinitely many solutions"):
        apply(opened("panda"), GoAnotherWay())


def test_another_way_keeps_held_joints():
    state = apply(opened("elbow_3r"), LockJoint(0, True))
    there = apply(state, GoAnotherWay())
    assert there[Joints].q[0] == state[Joints].q[0]
    assert there.derived(verdict).reached


# -- self-motion -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("key", "pose"), [("panda", None), ("iiwa7", None), ("puma560", "zero"), ("planar_2r", "folded")]
)
def test_the_tool_stands_still_along_the_self_motion(key, pose):
    state = searched(opened(key, pose))
    arm, wanted = state[Joints].arm, np.array(target_pose(state))
    motion = state.derived(motion_of)
    assert motion is not None
    part = motion.part(arm, state[Joints].q)
    np.testing.assert_allclose(apply(state, MoveAlong(part))[Joints].q, state[Joints].q, atol=2e-2)
    far = 0.0
    for k in range(21):
        state = apply(state, MoveAlong(k / 20))
        assert arm.within_limits(state[Joints].q)
        assert reaches(state, state[Joints].q)
        np.testing.assert_allclose(target_pose(state)[:3, 3], wanted[:3, 3], atol=1e-7)
        far = max(far, float(np.abs(state[Joints].q - motion.q[0]).max()))
        assert state.derived(motion_of) is motion
    assert far > 0.3


def test_whole_turns_have_a_self_motion_of_their_own_and_the_arm_does_not_leap_on_it():
    state = searched(opened("gen3"))
    arm, before = state[Joints].arm, state.derived(motion_of)
    turned = np.array(state[Joints].q)
    turned[6] += math.copysign(math.tau, -turned[6])
    state = searched(state.replace(state[Joints].moved_to(turned)))
    motion = state.derived(motion_of)
    assert motion is not None
    assert motion is not before
    part = motion.part(arm, turned)
    np.testing.assert_allclose(apply(state, MoveAlong(part))[Joints].q, turned, rtol=0, atol=2e-2)


def test_a_held_joint_stays_along_the_self_motion():
    state = apply(opened("trunk9"), LockJoint(2, True))
    state = searched(state)
    if state.derived(motion_of) is None:
        pytest.fail("nine joints with one held have a self-motion")
    there = apply(state, MoveAlong(1.0))
    assert there[Joints].q[2] == state[Joints].q[2]
    assert np.abs(there[Joints].q - state[Joints].q).max() > 1e-3


def test_arms_without_spare_joints_have_no_self_motion():
    state = searched(opened("puma560"))
    assert state.derived(motion_of) is None
    assert apply(state, MoveAlong(0.5)) is state
    with pytest.raises(InputError):
        apply(state, MoveAlong(math.nan))


# -- examples, saving, bad input ---------------------------------------------------------------------------------


@pytest.mark.parametrize("name", PRESETS)
def test_the_examples_are_a_click_away(name):
    key, pose, said = PRESETS[name]
    state = searched(apply(opened("scara"), TakePreset(name)))
    assert state[RobotPart].robot.key == key
    np.testing.assert_allclose(state[Joints].q, catalogue()[key].poses[pose], atol=1e-12)
    found = state[Solutions].found.solutions
    count = said.split()[0]
    assert found.completeness == "infinite" if count == "infinitely" else len(found) == int(count)


def test_what_was_found_is_not_saved_and_a_choice_is_not_a_step():
    session = Session.fresh("a", catalogue()["ur10_notes"])
    session.state = searched(session.state)
    session.apply(LookAtSolution(3), 0.0)
    assert session.state[Solutions].chosen == 3
    session.apply(LookAtSolution(3), 1.0)
    assert session.state[Solutions].chosen == -1
    assert not session.history.undo_label
    assert json.loads(json.dumps(session.state[Solutions].to_json())) == {}
    assert Solutions.from_json({"found": "?"}, session.robot).found is None


@pytest.mark.parametrize("key", ["planar_2r", "puma560", "panda", "scara", "stanford", "cartesian_3p", "youbot"])
def test_all_joints_held_and_targets_far_away_give_a_sentence(key):
    state = opened(key)
    n = state[Joints].arm.n
    held = state
    for joint in range(n):
        held = apply(held, LockJoint(joint, True))
    held = searched(held)
    assert held[Solutions].found.solutions.sentence
    with pytest.raises(InputError):
        apply(held, Prove(True))
    with pytest.raises(ArmlabError):
        apply(held, GoAnotherWay())
    axis = "xyz".index(state[Joints].arm.task.position[0])
    by = np.zeros(3)
    by[axis] = 50.0 * state[Joints].arm.reach
    far = searched(apply(state, EndDrag(moved(state, *by), 1)))
    if state[Joints].arm.revolute.all():  # the closed forms hold slides to no limits
        assert len(rows(far)) == 0
    assert far[Solutions].found.solutions.sentence


@pytest.mark.parametrize("key", ["planar_2r", "elbow_3r", "ur10e"])
def test_links_without_length_give_a_sentence(key):
    state = opened(key)
    for i, row in enumerate(state[Joints].arm.rows):
        for field in ("a", "d"):
            if getattr(row, field):
                state = apply(state, SetCell(i, field, 0.0))
    state = searched(state)
    assert state[Solutions].found.solutions.sentence
    turned = np.array(target_pose(state))
    turned[:3, :3] = turned[:3, :3] @ rotation_about("x", 0.3)
    assert searched(apply(state, EndDrag(turned, 1)))[Solutions].found.solutions.sentence
