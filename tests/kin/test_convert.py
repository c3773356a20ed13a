"""The same arm in the other convention."""

import math

import numpy as np
import pytest

from armlab.errors import UnknownName
from armlab.kin.arm import Arm
from armlab.kin.convert import Link, converted, remainders, task_kept
from armlab.kin.dh import common_normals
from support.arms import random_arm, random_pose, random_q

H = math.pi / 2
OTHER = {"standard": "modified", "modified": "standard"}


def axes_of(arm, q):
    """Return a point on each joint axis and its direction, each (n, 3)."""
    frames = arm.frames(q)
    frames = frames[:-1] if arm.convention == "standard" else frames[1:]
    return frames[:, :3, 3], frames[:, :3, 2]


def assert_same_arm(before, after, rng):
    for q in random_q(before, rng, 5):
        np.testing.assert_allclose(after.fk(q), before.fk(q), rtol=0, atol=1e-12)
        (p, z), (p_after, z_after) = axes_of(before, q), axes_of(after, q)
        np.testing.assert_allclose(z_after, z, rtol=0, atol=1e-12)
        np.testing.assert_allclose(np.cross(p_after - p, z), 0.0, atol=1e-12)
        standard, modified = (before, after) if before.convention == "standard" else (after, before)
        links = [Link(a, alpha).matrix for a, alpha in common_normals(modified.rows, "modified")[1:]]
        links[-1] = Link(standard.rows[-1].a, standard.rows[-1].alpha).matrix
        behind = modified.frames(q)[1:] @ np.array(links)
        np.testing.assert_allclose(standard.frames(q)[1:], behind, rtol=0, atol=1e-12)
    for name in ("limits", "speed_limits", "acceleration_limits"):
        np.testing.assert_array_equal(getattr(after, name), getattr(before, name))
    assert after.name == before.name


def test_a_converted_robot_is_the_same_arm(robot, rng):
    other = converted(robot.arm, OTHER[robot.arm.convention])
    assert other.convention == OTHER[robot.arm.convention]
    assert_same_arm(robot.arm, other, rng)


def test_there_and_back_gives_every_frame_of_a_robot_back(robot, rng):
    back = converted(converted(robot.arm, OTHER[robot.arm.convention]), robot.arm.convention)
    assert back.task == robot.arm.task
    links = common_normals(robot.arm.rows, robot.arm.convention)
    # A link at an end that has gone into the base, or in front of a tool, cannot be told from it again.
    first = int(links[0] != (0.0, 0.0))
    last = robot.arm.n + (links[-1] == (0.0, 0.0) or np.array_equal(robot.arm.tool, np.eye(4)))
    for q in random_q(robot.arm, rng, 5):
        there, again = robot.arm.frames(q), back.frames(q)
        np.testing.assert_allclose(again[first:last], there[first:last], rtol=0, atol=1e-12)
        np.testing.assert_allclose(back.fk(q), robot.arm.fk(q), rtol=0, atol=1e-12)


@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("special", [False, True])
def test_random_arms_stay_the_same_arm(convention, special, rng):
    for n in (1, 2, 3, 5, 7):
        arm = random_arm(rng, n, convention=convention, special=special)
        other = converted(arm, OTHER[convention])
        assert_same_arm(arm, other, rng)
        assert_same_arm(other, converted(other, convention), rng)


def test_the_present_convention_is_the_arm_itself(robot):
    assert converted(robot.arm, robot.arm.convention) is robot.arm
    assert not remainders(robot.arm, robot.arm).base.moves
    assert not remainders(robot.arm, robot.arm).tool.moves


def test_a_standard_table_without_tool_comes_back():
    rows = [("R", 0.1, H, 0.3, 0.4), ("P", 0.2, -H, 0.0, 0.0), ("R", 0.5, math.pi, 0.7, -H)]
    arm = Arm.from_dh(rows, base=random_pose(np.random.default_rng(1)))
    there = converted(arm, "modified")
    assert [(row.a, row.alpha) for row in there.rows] == [(0.0, 0.0), (0.1, H), (0.2, -H)]
    assert there.tool.tolist() == [[1, 0, 0, 0.5], [0, -1, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1]]
    back = converted(there, "standard")
    assert back.rows == arm.rows
    assert back.tool.tolist() == np.eye(4).tolist()
    np.testing.assert_array_equal(back.base, arm.base)


def test_a_modified_first_link_goes_into_the_base_without_crumbs():
    turned = [[0, -1, 0, 0.5], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    arm = Arm.from_dh([("R", 0.1, -H, 0, 0), ("R", 0.2, H, 0.3, 0)], "modified", base=turned, tool=turned)
    other = converted(arm, "standard")
    assert other.base.tolist() == [[0, 0, -1, 0.5], [1, 0, 0, 0.1], [0, -1, 0, 0], [0, 0, 0, 1]]
    assert not np.signbit(other.base[other.base == 0.0]).any()
    assert [(row.a, row.alpha, row.d) for row in other.rows] == [(0.2, H, 0.0), (0.0, 0.0, 0.3)]
    np.testing.assert_array_equal(other.tool, turned)


def test_remainders_say_what_went_into_base_and_tool(rng):
    for convention in OTHER:
        for _ in range(10):
            before = random_arm(rng, 3, convention=convention)
            after = converted(before, OTHER[convention])
            found = remainders(before, after)
            np.testing.assert_allclose(after.base, before.base @ found.base.matrix, rtol=0, atol=1e-14)
            np.testing.assert_allclose(after.tool, found.tool.matrix @ before.tool, rtol=0, atol=1e-14)
            assert found.base.moves == (convention == "modified")
            assert found.tool.moves == (convention == "standard")


def test_a_tool_taken_into_the_last_row_left_the_tool():
    before = Arm.from_dh([("R", 0, 0, 0, 0), ("R", 0.4, 0, 0, 0)], "modified", tool=Link(0.3, H).matrix)
    after = converted(before, "standard")
    assert (after.rows[-1].a, after.rows[-1].alpha) == (0.3, H)
    assert remainders(before, after).tool == Link(-0.3, -H)


@pytest.mark.parametrize(
    ("task", "twist", "kept"),
    [
        ("pose", 0.3, True),
        ("xyz", 0.3, True),
        ("xyz approach", 0.3, True),
        ("x", 0.3, True),
        ("yz", 0.3, True),
        ("xy", 0.0, True),
        ("xy phi", math.pi, True),
        ("xy", 0.3, False),
        ("xyz phi", 0.3, False),
        ("z phi", -H, False),
        ("phi", H, False),
    ],
)
def test_the_task_stays_where_it_means_the_same(task, twist, kept):
    rows = [("R", 0.1, twist, 0, 0), ("R", 0.5, 0, 0, 0), ("R", 0.4, 0, 0, 0)]
    arm = Arm.from_dh(rows, "modified", tool=Link(0.2, 0.0).matrix, task=task)
    after = converted(arm, "standard").task
    # All axes are parallel, and in the frame 0 that results their common direction is z.
    assert after.key == (task if kept else "xy phi")
    assert task_kept(arm, converted(arm, "standard")) == (kept or task == "xy phi")


@pytest.mark.parametrize("twist", [H, -H])
@pytest.mark.parametrize(
    ("task", "turned"),
    [("xz", "xy"), ("xy", "xz"), ("z", "y"), ("yz", "yz"), ("xyz approach", "xyz approach"), ("pose", "pose")],
)
def test_a_quarter_turn_of_frame_0_exchanges_y_and_z_in_the_task(task, turned, twist, rng):
    rows = [("R", 0.1, twist, 0, 0), ("R", 0.5, 0.3, 0, 0), ("R", 0.4, 0.8, 0.1, 0)]
    arm = Arm.from_dh(rows, "modified", tool=Link(0.2, 0.0).matrix, task=task)
    other = converted(arm, "standard")
    assert other.task.key == turned
    assert task_kept(arm, other)
    for q in random_q(arm, rng, 3):
        assert other.manipulability(q) == pytest.approx(arm.manipulability(q), abs=1e-12)


def test_a_vertical_planar_arm_keeps_its_task():
    arm = Arm.from_dh([("R", 0, H, 0, 0), ("R", 0.5, 0, 0, 0), ("R", 0.4, 0, 0, 0)], "modified")
    assert (arm.task.key, converted(arm, "standard").task.key) == ("xz", "xy")
    lost = Arm.from_dh(arm.rows, "modified", task="xz phi")
    assert not task_kept(lost, converted(lost, "standard"))


def test_the_task_of_a_standard_arm_always_stays(rng):
    for task in ("xy", "z", "xyz phi", "pose"):
        arm = Arm.from_dh([("R", 0.1, 0.4, 0.2, 0), ("R", 0.3, 0.5, 0, 0), ("R", 0.2, 1.0, 0, 0)], task=task)
        assert converted(arm, "modified").task == arm.task


def test_an_unknown_convention_lists_the_two(robot):
    with pytest.raises(UnknownName, match="Available: modified, standard"):
        converted(robot.arm, "craig")
