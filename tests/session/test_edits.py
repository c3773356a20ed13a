"""Edits of the table: what each makes of the arm, what it keeps, what is refused, and that all of it is undone."""

import json

import numpy as np
import pytest

from armlab.benches.robot.table.state import Point, SetPoint, world_point
from armlab.content.robots import OWN, catalogue
from armlab.content.write_robot import robot_toml
from armlab.content.write_table import FORMATS, write_table
from armlab.errors import ArmlabError, InputError
from armlab.kin.arm import DEFAULT_STROKE, Arm
from armlab.kin.rotations import rotation_from_sequence
from armlab.session.edits import (
    LONGEST,
    AddJoint,
    Convert,
    PasteTable,
    RemoveJoint,
    ReorderJoint,
    RestoreTable,
    SetCell,
    SetEnd,
    SetKind,
    SetLimits,
)
from armlab.session.parts.joints import Joints, LockJoint, MoveJoint, RandomPose
from armlab.session.parts.robot import RobotPart, robot_from_json
from armlab.session.session import Redo, Session, Undo
from armlab.session.state import State, apply
from armlab.session.store import state_from_text
from support.arms import KINDS, random_pose, random_q, tool_by_products

PUMA = catalogue()["puma560"]


@pytest.fixture
def state():
    return State.initial(PUMA)


@pytest.fixture
def rng():
    return np.random.default_rng(7)


def arm_of(state) -> Arm:
    return state[RobotPart].robot.arm


def read_back(state) -> State:
    """Return the state written down and read back as the store does."""
    data = json.loads(json.dumps(state.to_json()))
    return State.from_json(data, robot_from_json(data["robot"]))


def refused(state, command, text):
    """Apply a command that must be refused, in a session, and see that nothing has changed."""
    session = Session("token", PUMA, state)
    session.apply(command, 0.0)
    assert session.state is state
    assert session.history.past == []
    assert session.notice is not None
    assert text in session.notice.text


def random_command(rng, state):
    """Return any edit, wild ones included."""
    n = arm_of(state).n
    i = int(rng.integers(-1, n + 1))
    value = float(rng.choice([0.0, np.pi / 2, rng.normal(), 50.0 * rng.normal(), 1e5, np.nan]))
    low = float(rng.normal())
    pose = random_pose(rng)
    table = write_table(arm_of(state), FORMATS[rng.integers(3)], ("deg", "rad")[rng.integers(2)])
    return [
        SetCell(i, ("a", "alpha", "d", "theta", "b")[rng.integers(5)], value),
        SetKind(i, ("R", "P")[rng.integers(2)]),
        SetLimits(i, low, low + float(rng.normal() + 1.0)),
        AddJoint(i),
        RemoveJoint(i),
        ReorderJoint(i, int(rng.integers(-1, n + 1))),
        SetEnd(("base", "tool")[rng.integers(2)], pose),
        SetEnd("tool", np.full((4, 4), value)),
        Convert(("standard", "modified")[rng.integers(2)]),
        PasteTable(table),
        PasteTable(robot_toml(state[RobotPart].robot)),
        PasteTable(table[: rng.integers(len(table))]),
        RestoreTable(),
        SetPoint((value, 0.1, low)),
        RandomPose(),
        LockJoint(max(i, 0), True),
        MoveJoint(min(max(i, 0), n - 1), 0.3),
    ][rng.integers(17)]


# -- one edit at a time ------------------------------------------------------------------------------------------


def test_a_cell_changes_one_number_and_nothing_else(state):
    after = apply(state, SetCell(1, "a", 0.5))
    assert arm_of(after).rows[1].a == 0.5
    assert [r for i, r in enumerate(arm_of(after).rows) if i != 1] == [r for i, r in enumerate(PUMA.arm.rows) if i != 1]
    assert after[RobotPart].own
    assert (after[RobotPart].robot.key, after[RobotPart].origin) == (OWN, "puma560")
    np.testing.assert_array_equal(after[Joints].q, state[Joints].q)
    np.testing.assert_array_equal(arm_of(after).limits, PUMA.arm.limits)
    assert list(after[RobotPart].robot.poses) == list(PUMA.poses)
    assert after[RobotPart].robot.camera == PUMA.camera


def test_the_cell_of_the_variable_is_its_offset(state):
    after = apply(state, SetCell(0, "theta", 0.25))
    q = state[Joints].q.copy()
    q[0] += 0.25
    np.testing.assert_allclose(after[Joints].tool_pose, PUMA.arm.fk(q), atol=1e-12)


def test_the_same_number_again_is_no_edit(state):
    assert apply(state, SetCell(1, "a", PUMA.arm.rows[1].a)) is state
    assert apply(state, SetKind(1, "R")) is state
    assert apply(state, SetLimits(1, *PUMA.arm.limits[1])) is state
    assert apply(state, SetEnd("tool", PUMA.arm.tool)) is state
    assert apply(state, Convert(PUMA.arm.convention)) is state
    assert apply(state, ReorderJoint(2, 2)) is state
    assert apply(state, ReorderJoint(0, -1)) is state
    assert apply(state, SetPoint((0.0, 0.0, 0.0))) is state


def test_another_kind_of_joint_gets_the_limits_of_its_kind(state):
    after = apply(state, SetKind(2, "P"))
    assert tuple(arm_of(after).limits[2]) == DEFAULT_STROKE
    np.testing.assert_array_equal(np.delete(arm_of(after).limits, 2, 0), np.delete(PUMA.arm.limits, 2, 0))
    q = after[Joints].q
    assert DEFAULT_STROKE[0] <= q[2] <= DEFAULT_STROKE[1]
    np.testing.assert_array_equal(np.delete(q, 2), np.delete(state[Joints].q, 2))


@pytest.mark.parametrize("after_row", [-1, 0, 3, 5])
def test_an_added_joint_leaves_the_others_as_they_were(state, after_row):
    held = apply(state, LockJoint(3, True))
    after = apply(held, AddJoint(after_row))
    at = after_row + 1
    assert arm_of(after).n == 7
    assert arm_of(after).rows[at].revolute
    assert [r for i, r in enumerate(arm_of(after).rows) if i != at] == list(PUMA.arm.rows)
    np.testing.assert_array_equal(np.delete(after[Joints].q, at), state[Joints].q)
    assert [held for i, held in enumerate(after[Joints].locked) if i != at] == [False, False, False, True, False, False]
    assert apply(after, RemoveJoint(at))[RobotPart].robot.arm.rows == PUMA.arm.rows


def test_joints_move_with_their_rows(state):
    moved = apply(apply(state, LockJoint(0, True)), ReorderJoint(0, 2))
    order = [1, 2, 0, 3, 4, 5]
    assert arm_of(moved).rows == tuple(PUMA.arm.rows[i] for i in order)
    np.testing.assert_array_equal(moved[Joints].q, state[Joints].q[order])
    np.testing.assert_array_equal(arm_of(moved).limits, PUMA.arm.limits[order])
    assert moved[Joints].locked == (False, False, True, False, False, False)
    back = apply(moved, ReorderJoint(2, 0))
    assert arm_of(back).rows == PUMA.arm.rows
    np.testing.assert_array_equal(back[Joints].q, state[Joints].q)


def test_limits_move_a_joint_inside(state):
    after = apply(state, SetLimits(0, 0.5, 1.0))
    assert after[Joints].q[0] == 0.5
    assert arm_of(after).within_limits(after[Joints].q)
    for q in after[RobotPart].robot.poses.values():
        assert arm_of(after).within_limits(q)


def test_base_and_tool_are_where_they_were_put(state, rng):
    base, tool = random_pose(rng), random_pose(rng)
    after = apply(apply(state, SetEnd("base", base)), SetEnd("tool", tool))
    hand = np.linalg.inv(PUMA.arm.base) @ PUMA.arm.fk(PUMA.home) @ np.linalg.inv(PUMA.arm.tool)
    np.testing.assert_allclose(after[Joints].tool_pose, base @ hand @ tool, atol=1e-12)


def test_quarter_turns_of_base_and_tool_are_exact(state):
    pose = np.eye(4)
    pose[:3, :3] = rotation_from_sequence("zyx", [np.pi / 2, 0.0, np.pi])
    base = arm_of(apply(state, SetEnd("base", pose))).base
    assert set(np.unique(np.abs(base))) == {0.0, 1.0}


def test_the_tool_point_is_fixed_to_the_tool(state):
    after = apply(apply(state, SetPoint((0.1, -0.2, 0.3))), RandomPose())
    T = after[Joints].tool_pose
    np.testing.assert_allclose(world_point(after), (T @ [0.1, -0.2, 0.3, 1.0])[:3], atol=1e-15)
    assert apply(after, SetCell(0, "d", 0.2))[Point].xyz == (0.1, -0.2, 0.3)


def test_a_task_given_against_the_geometry_stays_with_its_joints(state):
    text = robot_toml(PUMA).replace('task = "pose"', 'task = "xyz"')
    given = apply(state, PasteTable(text))
    assert arm_of(given).task.key == "xyz"
    assert arm_of(apply(given, SetCell(1, "a", 0.5))).task.key == "xyz"
    assert arm_of(apply(given, AddJoint(5))).task.key == "pose"


# -- conventions -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("key", KINDS)
def test_the_other_convention_is_the_same_arm(key, rng):
    state = State.initial(catalogue()[key])
    arm = arm_of(state)
    other = "modified" if arm.convention == "standard" else "standard"
    after = apply(state, Convert(other))
    assert arm_of(after).convention == other
    assert after[RobotPart].moved is not None
    back = apply(after, Convert(arm.convention))
    q = random_q(arm, rng, 20)
    for converted in (arm_of(after), arm_of(back)):
        np.testing.assert_allclose(converted.fk(q), arm.fk(q), atol=1e-12)
        np.testing.assert_allclose([tool_by_products(converted, each) for each in q], arm.fk(q), atol=1e-12)
    np.testing.assert_array_equal(after[Joints].q, state[Joints].q)
    np.testing.assert_array_equal(arm_of(after).limits, arm.limits)


def test_what_a_conversion_moved_is_told_until_the_next_edit():
    state = State.initial(catalogue()["planar_2r"])
    assert state[RobotPart].moved is None
    after = apply(state, Convert("modified"))
    moved = after[RobotPart].moved
    assert (moved.tool.a, moved.tool.alpha, moved.base.moves) == (arm_of(state).rows[1].a, 0.0, False)
    again = read_back(after)[RobotPart]
    assert again.moved == moved
    assert apply(after, MoveJoint(0, 0.1))[RobotPart].moved == moved
    assert apply(after, SetCell(0, "d", 0.1))[RobotPart].moved is None


# -- text --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("format", FORMATS)
@pytest.mark.parametrize("key", ["puma560", "panda", "scara", "trunk9"])
def test_a_copied_table_pasted_is_the_same_table(key, format):
    arm = catalogue()[key].arm
    after = apply(State.initial(PUMA), PasteTable(write_table(arm, format)))
    assert arm_of(after).convention == arm.convention
    for row, expected in zip(arm_of(after).rows, arm.rows, strict=True):
        assert row.kind == expected.kind
        np.testing.assert_allclose(
            [row.a, row.alpha, row.d, row.theta], [expected.a, expected.alpha, expected.d, expected.theta], atol=1e-12
        )
    assert after[RobotPart].own
    assert after[RobotPart].origin == ""


def test_what_was_concluded_from_a_table_is_told(state):
    after = apply(state, PasteTable("0.5, 90, 0, q1\n0.4, 0, 0, q2\n"))
    assert "no header" in after[RobotPart].robot.summary


def test_a_saved_robot_file_comes_back_whole(state):
    edited = apply(apply(state, SetCell(2, "d", 0.4)), SetLimits(0, -1.0, 1.0))
    text = robot_toml(edited[RobotPart].robot)
    again = apply(State.initial(catalogue()["scara"]), PasteTable(text))
    assert robot_toml(again[RobotPart].robot) == text
    assert again[RobotPart].own


def test_back_to_the_table_of_the_file(state):
    moved = apply(state, MoveJoint(0, 0.7))
    edited = apply(moved, SetCell(2, "d", 0.4))
    back = apply(edited, RestoreTable())
    assert back[RobotPart].robot is PUMA
    np.testing.assert_array_equal(back[Joints].q, moved[Joints].q)
    longer = apply(apply(edited, AddJoint(0)), RestoreTable())
    assert longer[RobotPart].robot is PUMA
    assert longer[Joints].q.shape == (6,)


# -- refusals ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("command", "text"),
    [
        (SetCell(2, "a", 101.0), "row 3, a: expected at most 100 m either way, got 101 m"),
        (SetCell(2, "alpha", 70.0), "row 3, α: expected at most 360° either way, got 4010.7°"),
        (SetCell(2, "d", float("nan")), "row 3, d: expected at most 100 m either way, got nan m"),
        (SetCell(6, "a", 0.1), "row: expected 1 to 6, got 7"),
        (SetCell(0, "b", 0.1), "cell: unknown name 'b'"),
        (SetKind(0, "X"), "joint type: unknown name 'X'"),
        (SetKind(-1, "P"), "row: expected 1 to 6, got 0"),
        (SetLimits(1, 1.0, -1.0), "limits of joint 2: the smaller comes first, got 57.2958° to -57.2958°"),
        (SetLimits(1, 0.0, 0.001), "limits of joint 2: expected at least 0.572958° between them"),
        (SetLimits(1, 0.0, float("inf")), "limits of joint 2: expected at most 3600° either way, got inf°"),
        (RemoveJoint(6), "row: expected 1 to 6, got 7"),
        (AddJoint(6), "row: expected 0 to 6, got 7"),
        (ReorderJoint(9, 0), "row: expected 1 to 6, got 10"),
        (SetEnd("elbow", np.eye(4)), "end of the arm: unknown name 'elbow'"),
        (SetEnd("base", 2.0 * np.eye(4)), "base"),
        (Convert("paul"), "convention: unknown name 'paul'"),
        (PasteTable("  \n"), "table: expected a table in CSV, Markdown, LaTeX or TOML, got nothing"),
        (PasteTable("a" * 50_001), "expected at most 50000 characters"),
        (PasteTable("hello\nworld"), "the header"),
        (PasteTable("a, alpha, d, theta\n1, 0, x, q1"), "row 1"),
        (PasteTable("a [m], alpha, d, theta\n1e6, 0, 0, q1"), "row 1, a: expected at most 100 m"),
        (PasteTable("[[joints]]\ntype = 'R'"), "pasted file, line 1: "),
        (PasteTable("a, alpha, d, theta\n1, 0, 0, \ud800"), "UTF-8"),
        (RestoreTable(), "this table does not come from a robot file"),
        (SetPoint((0.0, float("nan"), 0.0)), "tool point, y: expected at most 100 m either way, got nan m"),
    ],
)
def test_a_refusal_says_where_and_changes_nothing(state, command, text):
    refused(state, command, text)


def test_an_arm_keeps_one_joint_and_gets_no_more_than_twelve(state):
    one = apply(State.initial(catalogue()["planar_2r"]), RemoveJoint(0))
    refused(one, RemoveJoint(0), "an arm has at least one joint")
    for _ in range(6):
        state = apply(state, AddJoint(arm_of(state).n - 1))
    assert arm_of(state).n == 12
    refused(state, AddJoint(11), "an arm has at most 12 joints")


@pytest.mark.parametrize(
    "damage",
    [
        {"origin": ["puma560"]},
        {"moved": [[0.0, 1.0]]},
        {"moved": [[0.0, float("inf")], [0.0, 0.0]]},
        {"toml": "not a file"},
    ],
)
def test_a_damaged_saved_table_is_not_read(state, damage):
    data = json.loads(json.dumps({"format": 1, "parts": apply(state, SetCell(0, "a", 0.1)).to_json()}))
    data["parts"]["robot"] |= damage
    with pytest.raises((ArmlabError, TypeError, ValueError)):
        state_from_text(json.dumps(data))


@pytest.mark.parametrize("data", [[1.0, 2.0], [0.0, 0.0, 1e9], ["x", 0.0, 0.0], None])
def test_a_damaged_saved_point_is_not_read(data):
    with pytest.raises((InputError, TypeError, ValueError)):
        Point.from_json(data, PUMA)


# -- any edits in any order --------------------------------------------------------------------------------------


@pytest.mark.parametrize(("key", "seed"), [("puma560", 1), ("planar_2r", 2), ("scara", 3), ("panda", 4)])
def test_random_edits_are_undone_redone_and_written_down(key, seed):
    rng, session = np.random.default_rng(seed), Session("token", PUMA, State.initial(catalogue()[key]))
    visited = [session.state]
    for _ in range(60):
        before, told = session.state, session.notice
        command = random_command(rng, before)
        session.apply(command, 0.0)
        if session.notice is not told:
            assert session.state is before
            assert "failed inside the lab" not in session.notice.text
            continue
        if session.state is before:
            continue
        visited.append(session.state)
        state = session.state
        arm, joints = arm_of(state), state[Joints]
        assert joints.arm is arm
        assert arm.within_limits(joints.q)
        assert np.all(np.isfinite(world_point(state)))
        assert max(abs(row.a) for row in arm.rows) <= LONGEST
        assert_read_back(read_back(state), state)
    assert len(visited) > 24
    steps = len(session.history.past)
    for state in reversed(visited[-steps - 1 : -1]):
        session.apply(Undo(), 0.0)
        assert same_work(session.state, state)
    for state in visited[-steps:]:
        session.apply(Redo(), 0.0)
        assert same_work(session.state, state)


def assert_read_back(again, state):
    """Compare states; angles, which files have in degrees, agree to units in the last place."""
    arm, expected = arm_of(again), arm_of(state)
    for name in ("convention", "task", "name", "revolute", "speed_limits", "acceleration_limits"):
        np.testing.assert_array_equal(getattr(arm, name), getattr(expected, name))
    for row, other in zip(arm.rows, expected.rows, strict=True):
        assert (row.a, row.d) == (other.a, other.d)
        np.testing.assert_allclose([row.alpha, row.theta], [other.alpha, other.theta], rtol=1e-15)
    np.testing.assert_allclose(arm.limits, expected.limits, rtol=1e-15)
    for end in ("base", "tool"):
        np.testing.assert_array_equal(getattr(arm, end)[:, 3], getattr(expected, end)[:, 3])
        np.testing.assert_allclose(getattr(arm, end), getattr(expected, end), atol=1e-15)
    np.testing.assert_allclose(again[Joints].q, state[Joints].q, rtol=1e-15)
    part, before = again[RobotPart], state[RobotPart]
    assert (part.origin, part.moved, part.own) == (before.origin, before.moved, before.own)
    assert list(part.robot.poses) == list(before.robot.poses)
    assert again[Point] == state[Point]
    assert again[Joints].locked == state[Joints].locked


def same_work(state, other) -> bool:
    """Return whether two states are the same in every part that undo brings back."""
    return all(part is other[type(part)] for part in state if not part.kept_by_undo)
