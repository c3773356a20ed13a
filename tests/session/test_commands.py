"""State and commands: pure, driven in three lines, no browser."""

import json

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError, UnknownName
from armlab.kin.rotations import rotation_about
from armlab.session.fields import Set
from armlab.session.parts.display import Display, Show
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint, RandomPose, TakePose
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.parts.target import (
    DragTarget,
    EndDrag,
    GoAnotherWay,
    PlaceTarget,
    Target,
    TargetToTool,
    target_pose,
    verdict,
)
from armlab.session.state import State, apply, part_types


@pytest.fixture
def state():
    return State.initial(catalogue()["puma560"])


def moved(pose, *shift):
    T = np.array(pose)
    T[:3, 3] += shift
    return T


def test_every_part_is_found_in_order():
    keys = [kind.key for kind in part_types()]
    assert [key for key in keys if key in ("robot", "joints", "target", "display")] == [
        "robot",
        "joints",
        "target",
        "display",
    ]
    assert len(set(keys)) == len(keys)


def test_a_slider_moves_its_joint_and_puts_the_target_back_on_the_tool(state):
    state = apply(state, DragTarget(moved(target_pose(state), 0.05, 0, 0), 1))
    assert state[Target].pose is not None
    after = apply(state, MoveJoint(1, 0.5))
    assert after[Joints].q[1] == 0.5
    assert after[Target].pose is None
    np.testing.assert_array_equal(target_pose(after), after[Joints].tool_pose)
    assert state[Joints].q[1] != 0.5


def test_a_value_beyond_a_limit_stops_at_the_limit(state):
    after = apply(state, MoveJoint(0, 99.0))
    assert after[Joints].q[0] == state[Joints].arm.limits[0, 1]


@pytest.mark.parametrize(
    ("command", "text"),
    [
        (MoveJoint(0, float("nan")), "q: expected 6 finite numbers"),
        (MoveJoint(6, 0.0), "joint: expected 1 to 6, got 7"),
        (TakePose("nowhere"), "pose: unknown name 'nowhere'"),
        (ChooseRobot("puma"), "robot: unknown name 'puma'; did you mean 'puma560'"),
        (Show("<fog>", True), "display: not the name of a switch: '<fog>'"),
        (Set(Target, "method", "magic"), "method: unknown name 'magic'"),
        (Set(Target, "axes", "body"), "axes: unknown name 'body'. Available: tool, world"),
        (PlaceTarget(np.full((4, 4), np.inf)), "target: every entry must be finite"),
        (PlaceTarget(np.zeros((4, 4))), "target: the last row"),
        (DragTarget(np.diag([1.0, 1.0, -1.0, 1.0]), 1), "target: .* is not a rotation"),
    ],
)
def test_what_cannot_be_done_is_refused_with_a_sentence(state, command, text):
    with pytest.raises((InputError, UnknownName), match=text):
        apply(state, command)


def test_an_absurdly_far_target_is_refused(state):
    with pytest.raises(InputError, match="farther than 1000 times the reach"):
        apply(state, PlaceTarget(moved(target_pose(state), 1e6, 0, 0)))


def test_the_arm_follows_the_handle(state):
    wanted = moved(target_pose(state), 0.03, -0.02, 0.01)
    after = apply(state, DragTarget(wanted, 1))
    np.testing.assert_allclose(after[Joints].tool_pose, wanted, atol=1e-6)
    assert after.derived(verdict).reached


def test_out_of_reach_the_target_stays_where_the_hand_put_it(state):
    wanted = moved(target_pose(state), 1.5, 0, 0)
    after = apply(state, EndDrag(wanted, 1))
    np.testing.assert_array_equal(after[Target].pose, wanted)
    assert after.derived(verdict).status in ("closest", "beyond", "limit")
    assert after.derived(verdict).position_error > 0.5


def test_a_drag_too_fast_to_follow_goes_on_while_the_hand_rests():
    state = State.initial(catalogue()["planar_2r"])
    wanted = np.array(target_pose(state))
    wanted[:2, 3] = [-1.2, -0.8]
    state = apply(state, DragTarget(wanted, 1))
    assert state[Target].catching_up
    for _ in range(20):
        state = apply(state, DragTarget(None, 1))
    assert not state[Target].catching_up
    assert state.derived(verdict).reached
    assert apply(state, DragTarget(None, 1)) is state


def test_a_typed_target_is_solved_on_another_branch_when_need_be():
    """Limits leave only the other elbow: going downhill is stuck, solving is not."""
    state = State.initial(catalogue()["planar_2r"])
    wanted = np.array(target_pose(state))
    wanted[:2, 3] = [0.0, -1.3]
    after = apply(state, PlaceTarget(wanted))
    assert after.derived(verdict).reached


def test_another_way_is_taken_where_one_is_found(state):
    """Dragged against a limit, a target that a different configuration reaches."""
    at_limit = apply(state, MoveJoint(4, 1.6))
    T = np.array(target_pose(at_limit))
    T[:3, :3] = T[:3, :3] @ rotation_about("y", -0.5)
    stuck = apply(at_limit, EndDrag(T, 1))
    assert stuck.derived(verdict).status == "limit"
    there = apply(stuck, GoAnotherWay())
    assert there.derived(verdict).reached
    np.testing.assert_array_equal(there[Target].pose, stuck[Target].pose)


def test_no_other_way_is_said_and_nothing_moves(state):
    away = apply(state, EndDrag(moved(target_pose(state), 5.0, 0, 0), 1))
    with pytest.raises(InputError, match=r"There is no other solution\. No solution\."):
        apply(away, GoAnotherWay())


def test_the_target_goes_back_to_the_tool(state):
    away = apply(state, EndDrag(moved(target_pose(state), 2.0, 0, 0), 1))
    back = apply(away, TargetToTool())
    assert back[Target].pose is None
    assert back.derived(verdict).reached
    assert apply(back, TargetToTool()) is back


def test_a_held_joint_is_moved_by_nobody(state):
    held = apply(state, LockJoint(2, True))
    q3 = held[Joints].q[2]
    for command in (TakePose("zero"), RandomPose(), DragTarget(moved(target_pose(held), 0.05, 0.05, 0), 1)):
        assert apply(held, command)[Joints].q[2] == q3
    free = apply(held, LockJoint(2, False))
    assert apply(free, TakePose("zero"))[Joints].q[2] == 0.0


def test_held_joints_are_freed_to_stand_where_an_example_wants_them(state):
    held = apply(state, LockJoint(2, True))[Joints]
    wanted = np.full(6, 0.25)
    freed = held.freed_at(wanted)
    assert freed.locked == (False,) * 6
    np.testing.assert_allclose(freed.q, np.clip(wanted, *held.arm.limits.T), atol=1e-12)


def test_a_whole_move_of_a_slider_is_one_step_and_those_of_two_sliders_are_two():
    assert MoveJoint(0, 0.1).stroke == MoveJoint(0, 0.2).stroke
    assert MoveJoint(0, 0.1).stroke != MoveJoint(1, 0.1).stroke
    assert TakePose("zero").stroke is None


def test_locking_does_not_move_the_target(state):
    away = apply(state, DragTarget(moved(target_pose(state), 0.05, 0, 0), 1))
    assert apply(away, LockJoint(1, True))[Target].pose is not None


def test_random_poses_are_reproducible_and_differ(state):
    once, again = apply(state, RandomPose()), apply(state, RandomPose())
    np.testing.assert_array_equal(once[Joints].q, again[Joints].q)
    assert not np.array_equal(apply(once, RandomPose())[Joints].q, once[Joints].q)


def test_choosing_an_arm_starts_in_its_home_pose_and_keeps_the_picture(state):
    state = apply(apply(state, Show("dark", True)), Set(Target, "axes", "tool"))
    after = apply(state, ChooseRobot("scara"))
    assert after[RobotPart].robot.key == "scara"
    np.testing.assert_array_equal(after[Joints].q, catalogue()["scara"].home)
    assert after[Display].switches["dark"]
    assert after[Target].axes == "tool"
    assert apply(after, ChooseRobot("scara")) is after


def test_a_command_that_changes_nothing_returns_the_same_state(state):
    for command in (Set(Target, "axes", "world"), LockJoint(0, False), TakePose("home")):
        assert apply(state, command) is state


def test_a_second_command_is_not_taken_for_the_time(state):
    with pytest.raises(TypeError, match="one command is applied at a time; MoveJoint stands in place of the time"):
        apply(state, MoveJoint(0, 0.1), MoveJoint(1, 0.2))


def test_only_the_touched_parts_are_new(state):
    after = apply(state, Show("frames", True))
    assert after[Joints] is state[Joints]
    assert after[Target] is state[Target]
    assert after[Display] is not state[Display]


def test_derived_values_are_computed_once(state):
    calls = []

    def count(_state):
        calls.append(1)
        return 7

    assert state.derived(count) == state.derived(count) == 7
    assert len(calls) == 1


def test_arrays_in_the_state_are_read_only(state):
    state = apply(state, DragTarget(moved(target_pose(state), 0.01, 0, 0), 1))
    for array in (state[Joints].q, state[Target].pose):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0


def test_every_state_can_be_written_down_and_read_back(robot):
    state = State.initial(robot)
    commands = [RandomPose(), EndDrag(moved(target_pose(state), 0.1, 0.2, 0.3), 1), LockJoint(0, True)]
    commands += [Show("trace", True), Set(Target, "axes", "tool"), Set(Target, "method", "gradient")]
    for command in commands:
        state = apply(state, command)
        text = json.dumps(state.to_json())
        again = State.from_json(json.loads(text), robot)
        assert again.to_json() == state.to_json()


def test_random_commands_never_break_the_state(rng):
    state = State.initial(catalogue()["puma560"])
    keys = list(catalogue().robots)
    for _ in range(300):
        n = state[Joints].arm.n
        T = moved(target_pose(state), *(0.3 * rng.normal(size=3)))
        T[:3, :3] = rotation_about("xyz"[rng.integers(3)], rng.normal()) @ T[:3, :3]
        command = [
            ChooseRobot(keys[rng.integers(len(keys))]),
            MoveJoint(int(rng.integers(n)), float(3 * rng.normal())),
            RandomPose(),
            TakePose("zero"),
            LockJoint(int(rng.integers(n)), bool(rng.integers(2))),
            DragTarget(T, 1),
            EndDrag(T, 1),
            PlaceTarget(T),
            TargetToTool(),
            Set(Target, "handle", "turn"),
            Show("frames", bool(rng.integers(2))),
        ][rng.integers(11)]
        state = apply(state, command)
        joints = state[Joints]
        assert joints.arm is state[RobotPart].robot.arm
        assert joints.arm.within_limits(joints.q)
        assert np.all(np.isfinite(target_pose(state)))
        state.derived(verdict)
