"""The bench of statics: wrenches along two sets of axes, torques, virtual work, examples."""

import math

import numpy as np
import pytest

from armlab.benches.velocity.statics.examples import EXAMPLES
from armlab.benches.velocity.statics.state import (
    DragForce,
    DrawDisplacement,
    ReleaseWrench,
    SetComponent,
    Statics,
    WriteAlong,
    balance,
    displacement,
    dualities,
    free_forces_at,
    work,
)
from armlab.content.robots import catalogue, own_robot
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.session.bench import PutInPlace
from armlab.session.fields import Set
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint
from armlab.session.parts.robot import ChooseRobot, RobotPart
from armlab.session.state import State, apply
from support.arms import random_pose, random_q, wrist_alone


def state_of(key):
    return State.initial(catalogue()[key])


def put(key):
    return apply(state_of("puma560"), PutInPlace(f"statics/{key}"))


def test_torques_are_those_of_a_lever(robot):
    """Each revolute joint balances force times lever arm about its axis, each prismatic one the force along it."""
    state = state_of(robot.key) if hasattr(robot, "key") else State.initial(robot)
    found = state.derived(balance)
    joints = state[Joints]
    frames = joints.frames if joints.arm.convention == "modified" else joints.frames[:-1]
    frames = frames[1:] if joints.arm.convention == "modified" else frames
    p = joints.tool_pose[:3, 3]
    for i, frame in enumerate(frames):
        z = frame[:3, 2]
        lever = np.cross(p - frame[:3, 3], found.wrench[:3]) + found.wrench[3:]
        expected = z @ lever if joints.arm.revolute[i] else z @ found.wrench[:3]
        assert found.torques[i] == pytest.approx(expected, abs=1e-9)


def test_the_notes_example_reads_as_printed(truth):
    case = truth["C5.4-statics-2R"]
    state = put("torques_2r")
    np.testing.assert_allclose(state.derived(balance).torques, case["expected"]["tau"], rtol=0, atol=1e-12)
    done = state.derived(work)
    assert done.tool == pytest.approx(done.joints, abs=1e-14)


def test_what_the_examples_say_is_so():
    torques = {key: put(key).derived(balance).torques for key in EXAMPLES}
    assert put("along").derived(balance).nothing
    np.testing.assert_allclose(torques["along"], 0.0, atol=1e-12)
    np.testing.assert_allclose(torques["across"], [40.0, 20.0], atol=1e-9)
    np.testing.assert_allclose(torques["toggle"], [0.0, -8.7156], atol=1e-3)
    assert torques["weight"][0] == pytest.approx(0.0, abs=1e-9)
    assert np.abs(torques["weight"][1:3]).min() > 0.1
    assert torques["screwdriver"][5] == pytest.approx(2.0, abs=1e-9)
    np.testing.assert_allclose(torques["press"], [0.0, 0.0, 30.0, 0.0], atol=1e-9)
    assert np.all(np.abs(torques["slide"][1:]) > 0.5)


@pytest.mark.parametrize("key", EXAMPLES)
def test_examples_bring_their_arm_and_are_forgotten_when_something_moves(key):
    state = put(key)
    assert state[RobotPart].robot is catalogue()[EXAMPLES[key].robot]
    assert state[Statics].example == key
    q = EXAMPLES[key].q
    if q:
        np.testing.assert_allclose(state[Joints].q, q, atol=1e-12)
    assert apply(state, MoveJoint(0, float(state[Joints].q[0]) + 0.1))[Statics].example == ""
    assert apply(state, SetComponent("force", 0, 1.25))[Statics].example == ""


def test_an_example_frees_held_joints():
    held = apply(apply(state_of("planar_2r"), MoveJoint(1, 1.2)), LockJoint(1, True))
    state = apply(held, PutInPlace("statics/toggle"))
    assert not any(state[Joints].locked)
    np.testing.assert_allclose(state[Joints].q, EXAMPLES["toggle"].q)


def test_the_first_force_on_a_flat_arm_lies_in_its_plane():
    upright = np.eye(4)
    upright[:3, :3] = [[1, 0, 0], [0, 0, -1], [0, 1, 0]]
    flat = catalogue()["planar_2r"].arm
    arm = Arm.from_dh(flat.rows, base=upright, task=flat.task)
    state = apply(apply(State.initial(own_robot(arm, "upright")), MoveJoint(0, 0.4)), MoveJoint(1, 0.9))
    assert state[Statics].force == (12.0, 0.0, 16.0)
    assert np.abs(state.derived(balance).torques).min() > 1.0


def test_a_wrench_stays_when_it_is_written_along_other_axes(rng):
    state = state_of("puma560")
    for kind in ("force", "moment"):
        for axis in range(3):
            state = apply(state, SetComponent(kind, axis, float(rng.normal())))
    before = state.derived(balance)
    turned = apply(state, WriteAlong("tool"))
    np.testing.assert_allclose(turned.derived(balance).wrench, before.wrench, atol=1e-12)
    back = apply(turned, WriteAlong("world"))
    np.testing.assert_allclose(back[Statics].force, state[Statics].force, atol=1e-12)
    assert apply(turned, WriteAlong("tool")) is turned
    moved = apply(turned, MoveJoint(3, 1.0))
    np.testing.assert_allclose(moved[Statics].force, turned[Statics].force)
    R = moved[Joints].tool_pose[:3, :3]
    np.testing.assert_allclose(moved.derived(balance).wrench[:3], R @ moved[Statics].force, atol=1e-12)


def test_a_drag_keeps_the_scale_and_typing_fits_it():
    state = apply(state_of("puma560"), SetComponent("force", 2, 7.0))
    assert state[Statics].full_force == 10.0
    dragged = apply(state, DragForce((0.0, 3.0, 1.0), object()))
    assert (dragged[Statics].force, dragged[Statics].full_force) == ((0.0, 3.0, 1.0), 10.0)
    assert apply(dragged, SetComponent("force", 1, 0.0))[Statics].full_force == 1.0
    released = apply(dragged, ReleaseWrench())
    assert not released.derived(balance).wrench.any()
    assert not released.derived(balance).nothing
    assert apply(released, ReleaseWrench()) is released
    assert apply(released, DragForce((0.0, 3.0, 0.0), object()))[Statics].full_force == 5.0
    tool = apply(state, WriteAlong("tool"))
    pulled = apply(tool, DragForce((1.0, 2.0, 3.0), object()))
    np.testing.assert_allclose(pulled.derived(balance).wrench[:3], [1.0, 2.0, 3.0], atol=1e-12)


def test_a_wrench_that_is_set_is_drawn_in_a_scale_of_its_own():
    state = apply(state_of("puma560"), Set(Statics, "force", (0.0, 0.0, 300.0)))
    assert state[Statics].full == (500.0, 0.0)
    assert apply(state, Set(Statics, "draws", 4))[Statics].full == (500.0, 0.0)
    assert apply(state, Set(Statics, "moment", (0.0, 2.0, 0.0)))[Statics].full == (500.0, 2.0)


def test_virtual_work_is_the_same_on_both_sides(robot):
    state = State.initial(robot)
    for _ in range(5):
        done = state.derived(work)
        assert done.tool == pytest.approx(done.joints, abs=1e-12)
        state = apply(state, DrawDisplacement())
    assert not np.array_equal(displacement(state), displacement(apply(state, DrawDisplacement())))


def test_dimensions_of_the_four_subspaces(robot):
    found = State.initial(robot).derived(dualities)
    for part, m in ((found.whole, 6), (found.force, 3), (found.moment, 3)):
        assert part.wrenches.shape[1] == m - part.rank
        assert part.motions.shape[1] == robot.arm.n - part.rank
    assert found.whole.rank >= max(found.force.rank, found.moment.rank)
    assert found.whole.rank <= min(6, robot.arm.n)


def test_a_wrist_on_a_tilted_base_carries_every_force(rng):
    for d in (0.1, 0.2, 0.4, 0.5, 0.7):
        arm = wrist_alone(random_pose(rng), d)
        state = State.initial(own_robot(arm, "wrist"))
        assert state.derived(dualities).force.rank == 0
        assert state.derived(dualities).whole.rank == state.derived(dualities).moment.rank
        assert free_forces_at(arm, random_q(arm, rng)).shape == (3, 3)


def test_arms_open_with_a_force_that_their_joints_feel(robot):
    assert np.abs(State.initial(robot).derived(balance).torques).max() > 1e-3


def test_it_is_written_and_read_and_damage_is_noticed():
    robot = catalogue()["puma560"]
    part = apply(apply(state_of("puma560"), SetComponent("moment", 1, -2.5)), WriteAlong("tool"))[Statics]
    assert Statics.from_json(part.to_json(), robot) == part
    for name, bad in (
        ("force", [1.0, 2.0]),
        ("force", [1.0, math.nan, 0.0]),
        ("moment", [1e9, 0.0, 0.0]),
        ("axes", "sideways"),
        ("full", [-1.0, 0.0]),
        ("full", [1.0, math.inf]),
        ("draws", -1),
    ):
        with pytest.raises((InputError, ValueError)):
            Statics.from_json({**part.to_json(), name: bad}, robot)


def test_slips_are_refused_with_words():
    state = state_of("puma560")
    with pytest.raises(InputError, match="force: expected at most 1e\\+06 N"):
        apply(state, SetComponent("force", 0, 1e7))
    with pytest.raises(InputError, match="moment: expected three finite numbers, in N m"):
        apply(state, SetComponent("moment", 0, math.nan))
    with pytest.raises(UnknownName, match="part of a wrench"):
        apply(state, SetComponent("speed", 0, 1.0))
    with pytest.raises(InputError, match="expected 0 to 2, got 3"):
        apply(state, SetComponent("force", 3, 1.0))
    with pytest.raises(UnknownName, match="axes"):
        apply(state, WriteAlong("base"))


def test_the_largest_wrench_along_other_axes_is_read_again_and_can_be_typed_on():
    robot, state = catalogue()["puma560"], state_of("puma560")
    for kind in ("force", "moment"):
        for axis in range(3):
            state = apply(state, SetComponent(kind, axis, 1e6))
    for axes in ("tool", "world", "tool"):
        state = apply(state, WriteAlong(axes))
        part = state[Statics]
        assert Statics.from_json(part.to_json(), robot) == part
    assert max(map(abs, part.force)) > 1e6
    assert apply(state, SetComponent("force", 0, 0.0))[Statics].force == (0.0, *part.force[1:])
    with pytest.raises(InputError, match=r"force: expected a size of at most 1\.73e\+06 N, got 2e\+06 N"):
        Statics.from_json({**part.to_json(), "force": [2e6, 0.0, 0.0]}, robot)


def test_another_arm_begins_with_its_own_wrench_and_an_edited_table_keeps_it():
    state = apply(state_of("puma560"), SetComponent("force", 0, 3.0))
    assert apply(state, ChooseRobot("planar_2r"))[Statics].force[2] == 0.0
    kept = state[Statics].for_edited(catalogue()["puma560"], tuple(range(6)))
    assert kept.force == state[Statics].force
