"""Jogging the tool: a step is taken as a whole, on the same way, or the reason why not is given."""

import math
from dataclasses import replace

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.ik.jog import FARTHEST, directions, displaced, jogged
from armlab.kin.ik.solve import solve
from armlab.kin.ik.verdict import judge
from armlab.kin.rotations import rotation_about
from armlab.kin.task import Task
from armlab.kin.transforms import transform

ARMS = ["planar_2r", "planar_3r", "scara", "puma560", "ur10e", "panda", "cartesian_3p", "polar_rrp"]
SMALL = np.array([0.002] * 3 + [math.radians(0.2)] * 3)


def along(k, size=0.01):
    """Return a step of one coordinate of six."""
    step = np.zeros(6)
    step[k] = size
    return step


def two_links(limits=None, **more):
    """Return two links of a metre in a plane."""
    rows = [("R", 1.0, 0.0, 0.0, 0.0), ("R", 1.0, 0.0, 0.0, 0.0)]
    return Arm.from_dh(rows, limits=limits, **more)


@pytest.mark.parametrize("key", ARMS)
@pytest.mark.parametrize("in_tool", [False, True])
def test_a_step_that_is_taken_brings_the_tool_there_and_one_back_returns_it(key, in_tool):
    arm = catalogue()[key].arm
    rng = np.random.default_rng(19)
    low, high = arm.limits.T
    taken = 0
    for _ in range(12):
        q = rng.uniform(low + 0.1 * (high - low), high - 0.1 * (high - low))
        for k in np.flatnonzero(directions(arm, arm.fk(q), in_tool)):
            step = np.where(np.arange(6) == k, SMALL, 0.0)
            found = jogged(arm, q, step, in_tool)
            if found.why:
                assert np.array_equal(found.q, q)
                continue
            taken += 1
            assert judge(arm, displaced(arm, arm.fk(q), step, in_tool), found.q).reached
            scale = np.where(arm.revolute, 1.0, arm.length_scale)
            assert np.abs((found.q - q) / scale).max() <= FARTHEST
            if in_tool and arm.task.rotation == "none":
                continue  # the axes of a tool that turns as it likes are others then
            back = jogged(arm, found.q, -step, in_tool)
            assert not back.why
            short = judge(arm, arm.fk(q), back.q)
            # Each of the two steps ends within 1e-6 m and rad of where it is to end.
            assert max(short.position_error, short.rotation_error) < 4e-6
    assert taken > 20


@pytest.mark.parametrize("key", ["ur10e", "puma560", "planar_3r"])
def test_a_long_way_there_and_back_ends_in_the_same_configuration(key):
    robot = catalogue()[key]
    arm, q = robot.arm, np.array(robot.home)
    for step in (*[along(1)] * 15, *[along(1, -0.01)] * 15):
        found = jogged(arm, q, step)
        assert not found.why
        q = found.q
    # Each of the 30 steps ends within 1e-6 m and rad; a joint makes at most some 30 times as much of it here.
    np.testing.assert_allclose(q, robot.home, atol=1e-3)


def test_a_displaced_pose_is_what_its_formula_says():
    arm = two_links(base=transform(rotation_about("x", 0.4), [0.1, 0.2, 0.3]))
    T = transform(rotation_about("y", 0.7) @ rotation_about("z", -0.3), [0.5, -0.2, 0.8])
    np.testing.assert_allclose(
        displaced(arm, T, [0.1, 0, 0, 0, 0, 0], False)[:3, 3], T[:3, 3] + 0.1 * arm.base[:3, 0], atol=1e-15
    )
    np.testing.assert_allclose(
        displaced(arm, T, [0, 0, 0.1, 0, 0, 0], True), T @ transform(None, [0, 0, 0.1]), atol=1e-15
    )
    turned = displaced(arm, T, [0, 0, 0, 0.2, 0, 0], True)
    np.testing.assert_allclose(turned, T @ transform(rotation_about("x", 0.2)), atol=1e-15)
    about = displaced(arm, T, [0, 0, 0, 0, 0, 0.2], False)
    expected = arm.base[:3, :3] @ rotation_about("z", 0.2) @ arm.base[:3, :3].T @ T[:3, :3]
    np.testing.assert_allclose(about[:3, :3], expected, atol=1e-15)
    np.testing.assert_array_equal(about[:3, 3], T[:3, 3])


@pytest.mark.parametrize(
    ("key", "in_tool", "offered"),
    [
        ("planar_2r", False, (1, 1, 0, 0, 0, 0)),
        ("planar_3r", False, (1, 1, 0, 0, 0, 1)),
        ("planar_3r", True, (1, 1, 0, 0, 0, 1)),
        ("scara", False, (1, 1, 1, 0, 0, 1)),
        ("scara", True, (1, 1, 1, 0, 0, 1)),
        ("puma560", False, (1, 1, 1, 1, 1, 1)),
        ("puma560", True, (1, 1, 1, 1, 1, 1)),
        ("cartesian_3p", False, (1, 1, 1, 0, 0, 0)),
    ],
)
def test_only_what_the_task_controls_is_offered(key, in_tool, offered):
    robot = catalogue()[key]
    assert directions(robot.arm, robot.arm.fk(robot.home), in_tool) == tuple(map(bool, offered))


def test_a_turn_about_the_approach_axis_is_not_offered_where_only_the_approach_counts():
    arm = replace(catalogue()["puma560"].arm, task=Task("xyz", "approach"))
    T = arm.fk(catalogue()["puma560"].home)
    assert directions(arm, T, True) == (True, True, True, True, True, False)


def test_a_wall_mounted_arm_moves_along_the_axes_of_its_frame_0():
    arm = two_links(base=transform(rotation_about("x", 0.5 * math.pi)))
    found = jogged(arm, [0.3, 0.9], along(1, 0.02))
    assert not found.why
    # y of frame 0 is z of the world here.
    np.testing.assert_allclose(arm.position(found.q) - arm.position([0.3, 0.9]), [0.0, 0.0, 0.02], atol=1e-6)


def test_a_limit_is_named_and_the_arm_stays():
    arm = two_links(limits=[(-3.0, 3.0), (0.5, 2.5)])
    q = np.array([0.0, 0.501])
    found = jogged(arm, q, along(0, 0.05))
    assert (found.why, found.joints) == ("limit", (1,))
    np.testing.assert_array_equal(found.q, q)


def test_a_stretched_arm_cannot_go_farther_and_comes_back():
    arm = two_links()
    assert jogged(arm, [0.4, 0.0], along(0, 0.01), in_tool=True).why == "reach"
    back = jogged(arm, [0.4, 0.0], along(0, -0.01), in_tool=True)
    assert not back.why
    assert np.abs(back.q - [0.4, 0.0]).max() <= FARTHEST


@pytest.mark.parametrize("key", ["puma560", "ur10e", "elbow_3r"])
def test_on_the_way_out_a_step_is_beside_a_singularity_only_if_joints_that_hurry_could_take_it(key):
    robot = catalogue()[key]
    arm, q = robot.arm, np.array(robot.home)
    found = jogged(arm, q, along(0, 0.05))
    while not found.why:
        q = found.q
        found = jogged(arm, q, along(0, 0.05))
    there = solve(arm, displaced(arm, arm.fk(q), along(0, 0.05), False), q, searches=20)
    assert there.success == (found.why == "singular")
    if there.success:
        assert all(abs(there.q[i] - q[i]) > FARTHEST for i in found.joints)


def test_beside_a_singularity_no_joint_hurries():
    robot = catalogue()["puma560"]
    q = np.array(robot.home)
    q[4] = 0.0  # axes 4 and 6 are one line: a turn about the axis across it and axis 5 needs a quarter turn of joint 4
    J = np.asarray(robot.arm.jacobian(q))
    lost = np.linalg.svd(J)[0][:, -1]
    axis = robot.arm.fk(q)[:3, :3].T @ lost[3:]
    step = np.concatenate([np.zeros(3), math.radians(5.0) * axis / np.linalg.norm(axis)])
    found = jogged(robot.arm, q, step, in_tool=True)
    assert found.why == "singular"
    assert set(found.joints) <= {3, 5}
    assert found.joints
    np.testing.assert_array_equal(found.q, q)


def test_held_joints_stay():
    arm = catalogue()["panda"].arm
    q = np.array(catalogue()["panda"].home)
    held = [i == 2 for i in range(7)]
    found = jogged(arm, q, along(0, 0.01), locked=held)
    assert not found.why
    assert found.q[2] == q[2]


@pytest.mark.parametrize(
    ("q", "step", "says"),
    [
        ([0.0], np.zeros(6), "q: expected 2 finite numbers"),
        ([0.0, 0.0], [1.0, math.nan, 0, 0, 0, 0], "step: expected 6"),
    ],
)
def test_what_is_no_step_is_refused(q, step, says):
    with pytest.raises(InputError, match=says):
        jogged(two_links(), q, step)
