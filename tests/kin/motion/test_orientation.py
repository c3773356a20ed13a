"""Orientation by Euler angles and about one axis, through several, and tool paths with a decoupled wrist."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.euler import SEQUENCES
from armlab.kin.motion.law_types import law_type
from armlab.kin.motion.orientation import about_one_axis, by_euler_angles, held, swept, wandering
from armlab.kin.motion.path_types import path_type
from armlab.kin.motion.tool_path import ToolPath
from armlab.kin.rotations import rotation_about, rotation_from_axis_angle, rotation_from_sequence, skew

STEP = 1e-5
S = np.linspace(0.02, 0.98, 25)


def rotation(rng):
    return Rotation.random(random_state=int(rng.integers(1 << 30))).as_matrix()


def check_angular(orientation, s=S):
    """Angular velocity and its derivative against central differences."""
    omega, change = orientation.angular(s)
    slope = (orientation.rotation(s + STEP) - orientation.rotation(s - STEP)) / (2 * STEP)
    turned = slope @ np.swapaxes(orientation.rotation(s), 1, 2)
    size = np.abs(omega).max() + 1
    np.testing.assert_allclose(skew(omega), turned, rtol=0, atol=1e-7 * size**3)
    differences = (orientation.angular(s + STEP)[0] - orientation.angular(s - STEP)[0]) / (2 * STEP)
    np.testing.assert_allclose(change, differences, rtol=0, atol=1e-7 * size**3)


def test_about_one_axis_it_is_scipys_slerp(rng):
    for _ in range(20):
        A, B = rotation(rng), rotation(rng)
        orientation = about_one_axis(A, B)
        judge = Slerp([0, 1], Rotation.from_matrix([A, B]))(S).as_matrix()
        np.testing.assert_allclose(orientation.rotation(S), judge, rtol=0, atol=1e-9)
        np.testing.assert_allclose(orientation.rotation([0.0, 1.0]), [A, B], rtol=0, atol=1e-12)
        check_angular(orientation)
        assert swept(orientation) == pytest.approx(orientation.angle, abs=1e-12)


def test_the_other_way_round_also_arrives(rng):
    A, B = rotation(rng), rotation(rng)
    short, long = about_one_axis(A, B), about_one_axis(A, B, other_way=True)
    np.testing.assert_allclose(long.rotation(1.0), B, rtol=0, atol=1e-12)
    assert short.angle - long.angle == pytest.approx(2 * math.pi)
    check_angular(long)


def test_a_half_turn_needs_a_choice_and_it_is_said(truth):
    """theta(0) = 0, and theta_AB = pi has two axes."""
    assert "±r" in truth["ERR-6.152"]["expected"]["correct"]
    A, B = np.eye(3), rotation_from_axis_angle([1.0, 2.0, -1.0], math.pi)
    one, other = about_one_axis(A, B), about_one_axis(A, B, other_way=True)
    for orientation, way in ((one, "Chosen: r."), (other, "Chosen: −r.")):
        np.testing.assert_allclose(orientation.rotation([0.0, 1.0]), [A, B], rtol=0, atol=1e-9)
        assert way in orientation.remarks[0]
    np.testing.assert_allclose(one.angular(0.0)[0], -other.angular(0.0)[0], rtol=0, atol=1e-6)
    assert about_one_axis(A, rotation_about("x", 3.1)).remarks == ()


@pytest.mark.parametrize("axes", SEQUENCES)
@pytest.mark.parametrize("fixed", [False, True])
def test_euler_angles_arrive_and_turn_as_they_say(axes, fixed, rng):
    for _ in range(5):
        A, B = rotation(rng), rotation(rng)
        orientation = by_euler_angles(A, B, axes, fixed=fixed)
        np.testing.assert_allclose(orientation.rotation([0.0, 1.0]), [A, B], rtol=0, atol=1e-12)
        assert np.abs(orientation.end - orientation.start).max() <= math.pi + 1e-12
        check_angular(orientation)


@pytest.mark.parametrize("fixed", [False, True])
@pytest.mark.parametrize(("axes", "middles"), [("zxz", [0.0, math.pi]), ("zyx", [math.pi / 2, -math.pi / 2])])
def test_from_and_to_a_singular_orientation_euler_angles_still_arrive(axes, middles, fixed, rng):
    for middle in middles:
        singular = rotation_from_sequence(axes, [0.7, middle, 0.4], fixed=fixed)
        other = rotation(rng)
        for A, B in ((singular, other), (other, singular), (singular, singular @ rotation_about("z", 1e-3))):
            orientation = by_euler_angles(A, B, axes, fixed=fixed)
            np.testing.assert_allclose(orientation.rotation([0.0, 1.0]), [A, B], rtol=0, atol=1e-9)
            assert any("singular" in remark for remark in orientation.remarks)


def test_euler_angles_wander_where_one_axis_does_not(rng):
    """They turn at least as far, and mostly farther."""
    farther = 0
    for _ in range(30):
        A, B = rotation(rng), rotation(rng)
        straight, euler = about_one_axis(A, B), by_euler_angles(A, B)
        assert swept(euler) >= straight.angle - 1e-9
        farther += swept(euler) > 1.05 * straight.angle
    assert farther > 15
    assert wandering(about_one_axis(A, B), about_one_axis(A, B)) < 1e-7


def test_in_time_the_angular_acceleration_is_that_of_differences(rng):
    orientation, law = by_euler_angles(rotation(rng), rotation(rng), "xyz"), law_type("quintic").law(2.0)
    t = np.linspace(0.1, 1.9, 19)
    R, omega, alpha = orientation.in_time(law, t)
    before, after = (orientation.in_time(law, t + shift) for shift in (-STEP, STEP))
    turned = (after[0] - before[0]) / (2 * STEP) @ np.swapaxes(R, 1, 2)
    np.testing.assert_allclose(skew(omega), turned, rtol=0, atol=1e-7)
    np.testing.assert_allclose(alpha, (after[1] - before[1]) / (2 * STEP), rtol=0, atol=1e-6)


def test_a_tool_path_moves_as_its_twist_says(rng):
    position = path_type("helix").path([[0, 0, 0], [0.3, 0.2, 0.5]])
    tool = ToolPath(position, by_euler_angles(rotation(rng), rotation(rng)), [0.1, -0.2, 0.3])
    slope = (tool.pose(S + STEP) - tool.pose(S - STEP)) / (2 * STEP)
    twist = tool.twist(S)
    np.testing.assert_allclose(twist[:, :3], slope[:, :3, 3], rtol=0, atol=1e-6)
    rate = (tool.twist(S + STEP) - tool.twist(S - STEP)) / (2 * STEP)
    np.testing.assert_allclose(tool.twist_rate(S), rate, rtol=0, atol=1e-5)
    carried = tool.pose(S)[:, :3, :3] @ tool.point + tool.pose(S)[:, :3, 3]
    np.testing.assert_allclose(carried, position.at(S), rtol=0, atol=1e-12)


def test_with_the_wrist_planned_apart_its_centre_stays_on_the_line(rng):
    """The wrist centre of a PUMA goes straight, the tool does not: position and orientation share only s."""
    arm = catalogue()["puma560"].arm
    start, end = arm.fk([0.1, -0.5, 0.3, 0.2, 0.6, 0.1]), arm.fk([0.5, -0.7, 0.5, 0.4, -0.5, 1.0])
    wrist = np.linalg.inv(start) @ arm.frames([0.1, -0.5, 0.3, 0.2, 0.6, 0.1])[4]
    offset = wrist[:3, 3]
    centres = [T[:3, :3] @ offset + T[:3, 3] for T in (start, end)]
    turn = about_one_axis(start[:3, :3], end[:3, :3])
    tool = ToolPath(path_type("line").path(centres), turn, offset)
    np.testing.assert_allclose(tool.pose(0.0), start, rtol=0, atol=1e-9)
    np.testing.assert_allclose(tool.pose(1.0), end, rtol=0, atol=1e-9)


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (lambda: about_one_axis(2 * np.eye(3), np.eye(3)), "R_A: expected a 3 x 3 rotation"),
        (lambda: by_euler_angles(np.eye(3), np.diag([1, 1, -1])), "R_B: expected a 3 x 3 rotation"),
        (lambda: by_euler_angles(np.eye(3), np.eye(3), "xxz"), "axes: unknown name 'xxz'"),
        (lambda: about_one_axis(np.eye(3), np.eye(3), other_way=True), "other_way: both orientations are the same"),
        (lambda: ToolPath(path_type("line").path([[0, 0], [1, 1]]), held(np.eye(3))), "3 coordinates, got 2"),
    ],
)
def test_what_is_no_orientation_is_refused(make, told):
    with pytest.raises(InputError, match=told):
        make()
