"""The table task: the pose above the object, the place of the table for every arm, and the arm that goes there."""

import math

import numpy as np
import pytest

from armlab.benches.frames.table.commands import (
    DragObject,
    DragTable,
    FollowObject,
    GoAboveObject,
    SetHeight,
    SetObject,
    SetTable,
    SpinTool,
    TurnTable,
)
from armlab.benches.frames.table.examples import EXAMPLES, ChooseTableExample
from armlab.benches.frames.table.facts import FACTS
from armlab.benches.frames.table.place import rounded_length, table_for
from armlab.benches.frames.table.reach import asked_of
from armlab.benches.frames.table.state import DOWN, SHARES, TableTask, corner_of, task, task_of
from armlab.benches.frames.table.ui.scene import corners, span
from armlab.content.robots import catalogue, own_robot
from armlab.errors import InputError
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.rotations import rotation_about
from armlab.kin.transforms import transform
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import ChooseRobot
from armlab.session.parts.target import Target, target_pose
from armlab.session.state import State, apply
from support.done import done

WHOLE = ("puma560", "ur5e", "panda", "scara", "stanford")
"""Arms of different kinds that reach down to a table."""


def opened(*commands, robot="puma560"):
    return done(State.initial(catalogue()[robot]), *commands)


def test_the_tool_stands_where_the_notes_have_it(truth):
    case = truth["C3.4.1-table-task"]
    px, py, h = (case["inputs"][name] for name in ("px", "py", "h"))
    state = opened(SetObject(0, px), SetObject(1, py), SetHeight(h))
    found = task_of(state)
    np.testing.assert_allclose(found.R_te, case["expected"]["R_TE"], rtol=0, atol=1e-15)
    np.testing.assert_allclose(found.p_te, case["expected"]["p_TE"], rtol=0, atol=case["tol"])
    # 3.118: the object lies on the z axis of the tool, at h.
    seen = np.linalg.inv(found.T_we) @ [*found.object, 1.0]
    np.testing.assert_allclose(seen, [0.0, 0.0, h, 1.0], rtol=0, atol=1e-12)
    np.testing.assert_array_equal(DOWN @ DOWN, np.eye(3))


def test_a_turned_tool_and_a_turned_table_leave_the_tool_above_the_object(rng):
    for corner in rng.normal(size=(5, 3)):
        turn, spin = rng.uniform(-3, 3, 2)
        found = task(tuple(corner), turn, (0.4, 0.2), 0.3, spin)
        np.testing.assert_allclose(found.p_te, [0.4, 0.2, 0.3], rtol=0, atol=1e-15)
        np.testing.assert_allclose(found.T_we[:3, 3], found.object + np.array([0, 0, 0.3]), rtol=0, atol=1e-12)
        np.testing.assert_allclose(found.T_we[:3, 2], [0, 0, -1], rtol=0, atol=1e-15)


@pytest.mark.parametrize("key", WHOLE)
def test_the_table_stands_where_the_arm_reaches_the_object(key):
    robot = catalogue()[key]
    found = task_of(State.initial(robot))
    assert corner_of(State.initial(robot)) == table_for(robot, SHARES)
    assert ik.solve(robot.arm, found.T_we, np.array(robot.home, dtype=float)).success


def test_the_button_brings_the_tool_there_and_an_undo_step_is_the_target():
    state = opened(GoAboveObject())
    found = asked_of(state)
    assert found.away < 1e-6
    assert found.turned < 1e-6
    np.testing.assert_allclose(target_pose(state), task_of(state).T_we, rtol=0, atol=1e-12)
    np.testing.assert_allclose(state[Joints].tool_pose, state[Joints].arm.base @ found.T_be, rtol=0, atol=1e-6)


def test_out_of_reach_the_arm_comes_as_near_as_it_can():
    state = opened(ChooseTableExample("far"))
    before = asked_of(state).away
    after = asked_of(apply(state, GoAboveObject())).away
    assert 0.05 < after < before


def test_the_arm_follows_what_is_typed_and_dragged_only_when_it_is_told_to():
    still = opened(SetHeight(0.2))
    assert still[Target].pose is None
    state = opened(FollowObject(True), SetHeight(0.25))
    assert asked_of(state).away < 1e-6
    place = task_of(state).object + np.array([0.02, 0.01, 0.0])
    dragged = apply(state, DragObject(place, 1))
    assert asked_of(dragged).away < 1e-3
    assert not apply(state, FollowObject(False))[TableTask].follows
    for key in EXAMPLES:
        there = apply(state, ChooseTableExample(key))
        np.testing.assert_allclose(target_pose(there), task_of(there).T_we, rtol=0, atol=1e-9)


def test_what_is_dragged_stays_on_the_table_and_the_table_stays_level():
    state = opened(TurnTable(0.5))
    place = task_of(state).object + np.array([0.1, -0.05, 0.7])
    moved = apply(state, DragObject(place, 1))
    np.testing.assert_allclose(task_of(moved).object[:2], place[:2], rtol=0, atol=1e-12)
    assert task_of(moved).object[2] == pytest.approx(corner_of(state)[2])
    pose = transform(rotation_about("z", 0.6) @ rotation_about("x", 0.2), [0.3, 0.2, 0.1])
    table = apply(state, DragTable(pose, 1))
    np.testing.assert_array_equal(task_of(table).T_wt[:3, 2], [0, 0, 1])
    assert corner_of(table) == (0.3, 0.2, 0.1)


def test_another_arm_has_a_table_of_its_own():
    state = apply(opened(SetTable(0, 3.0)), ChooseRobot("ur5e"))
    assert corner_of(state) == table_for(catalogue()["ur5e"], SHARES)
    assert state[TableTask].place == TableTask.initial(catalogue()["ur5e"]).place


@pytest.mark.parametrize(("links", "length", "offset"), [(2, 40.0, 0.0), (3, 100.0, 0.0), (12, 100.0, 100.0)])
def test_the_task_of_a_huge_arm_is_read_again_in_every_example_and_with_its_table_moved(links, length, offset):
    arm = Arm.from_dh([("R", length, 0.3, offset, 0.0)] * links)
    robot, part = own_robot(arm, ""), TableTask.initial(own_robot(arm, ""))
    for each in (part, *(part.with_values(example.values(arm.length_scale)) for example in EXAMPLES.values())):
        assert TableTask.from_json(each.to_json(), robot) == each
    assert part.with_values({"corner": table_for(robot, SHARES)}).corner == table_for(robot, SHARES)


def test_the_table_carries_its_frame_and_the_object():
    state = opened(SetObject(0, -1.0), SetObject(1, 2.0), TurnTable(0.3))
    low, high = span(state)
    assert (low < [-1.0, 0.0]).all()
    assert (high > [0.0, 2.0]).all()
    local = np.linalg.solve(task_of(state).T_wt, np.column_stack([corners(state), np.ones(4)]).T)
    np.testing.assert_allclose(local[2], 0.0, rtol=0, atol=1e-12)


@pytest.mark.parametrize("key", EXAMPLES)
def test_an_example_is_in_place_until_something_is_moved(key):
    state = opened(SetTable(0, 3.0), ChooseTableExample(key))
    assert state[TableTask].example == key
    assert state[TableTask].corner is None
    assert apply(state, SpinTool(0.7))[TableTask].example == ""
    assert apply(state, FollowObject(True))[TableTask].example == key


def test_lengths_at_first_are_round():
    assert [rounded_length(value) for value in (0.2161, 1.349, 0.0)] == [0.22, 1.3, 0.0]


def test_facts_are_those_of_the_task():
    state = opened(TurnTable(math.pi / 2), SetObject(0, 0.4), SetObject(1, 0.2), SetHeight(0.3))
    value = {key: fact.now(state).value for key, fact in FACTS.facts.items()}
    np.testing.assert_allclose(value["position"], [0.4, 0.2, 0.3], rtol=0, atol=1e-15)
    np.testing.assert_allclose(value["object"], [0.4, 0.2, 0.0], rtol=0, atol=1e-15)
    T = np.reshape(value["in_world"], (4, 4))
    np.testing.assert_allclose(T[:3, 3], np.add(value["corner"], [-0.2, 0.4, 0.3]), rtol=0, atol=1e-12)
    np.testing.assert_allclose(np.reshape(value["asked"], (4, 4)), T, rtol=0, atol=1e-12)
    assert value["away"] > 0.05


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (SetTable(3, 1.0), "axis: expected 0 to 2 for x, y and z, got 3"),
        (SetTable(0, 1e6), "table, x: expected at most 10000 m either way, got 1e.06 m"),
        (SetTable(0, math.nan), "table: expected three finite numbers"),
        (SetObject(2, 0.1), "the object lies on the table"),
        (SetHeight(-0.1), "height"),
        (TurnTable(1e9), "turn"),
        (ChooseTableExample("none"), "none"),
    ],
)
def test_what_cannot_be_is_refused_in_words(command, told):
    with pytest.raises(InputError, match=told):
        command.apply(opened())
