"""Errata on the arm on the table: how far the wrong result is from the right one, and for which arms there is none."""

import math

import numpy as np
import pytest

from armlab.benches.lessons.errata.on_arm import ON_ARM, Drawn, Unfit, on_arm
from armlab.content.errata import errata
from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.rotations import rotation_from_sequence

ROBOTS = catalogue().robots


def drawn(key, robot, q=None):
    arm = ROBOTS[robot].arm
    return on_arm(key, arm, ROBOTS[robot].home if q is None else np.array(q, dtype=float))


def ends(found, wrong):
    return [each for each in found.segments if each.wrong == wrong]


def test_what_is_drawn_are_errata():
    assert ON_ARM.keys() <= errata().keys()
    assert on_arm("6.95", ROBOTS["puma560"].arm, ROBOTS["puma560"].home) is None


@pytest.mark.parametrize("key", ON_ARM)
@pytest.mark.parametrize("robot", ["puma560", "planar_2r", "polar_rrp", "elbow_3r", "panda", "scara", "cartesian_3p"])
def test_each_arm_has_a_drawing_or_a_sentence(key, robot):
    found = drawn(key, robot)
    if isinstance(found, Unfit):
        assert found.why.endswith(".")
        assert not found.robot or isinstance(drawn(key, found.robot), Drawn | Unfit)
        return
    assert found.says.endswith(".")
    assert found.seen or found.unseen.endswith(".") or key == "4.82"
    assert all(np.isfinite([each.start, each.end]).all() for each in found.segments)
    assert math.isfinite(found.away)


def test_the_last_joint_of_a_2r_moves_the_tool_as_fast_as_its_link_is_long():
    found = drawn("5.58", "planar_2r", [0.3, 0.8])
    assert found.away == pytest.approx(1.0)
    (wrong,), (right,) = ends(found, True), ends(found, False)
    # The wrong arrow lacks the column of joint 2, which is across the last link.
    lost = (right.end - right.start) - (wrong.end - wrong.start)
    assert lost[:2] @ [math.cos(1.1), math.sin(1.1)] == pytest.approx(0.0, abs=1e-12)


def test_a_tool_on_the_axis_of_the_last_joint_does_not_show_it():
    found = drawn("5.58", "puma560")
    assert not found.seen
    assert found.unseen.startswith("The tool lies on the axis of joint 6")


def test_a_last_joint_that_slides_needs_no_vector():
    assert drawn("5.58", "cartesian_3p").robot == "planar_2r"


def test_the_axis_of_a_joint_is_z_of_the_frame_before():
    found = drawn("4.1a", "puma560")
    assert found.away == pytest.approx(math.pi / 2)
    assert drawn("4.1a", "planar_2r").unit == "m"
    assert "modified convention" in drawn("4.1a", "panda").why


def test_the_foot_of_a_normal_is_as_far_from_the_axis_before_as_was_checked(truth):
    rows = [("R", 0.0, math.pi / 2, 0.67183, 0), ("R", 0.4318, 0, 0, 0), ("R", 0.0203, -math.pi / 2, 0.15005, 0)]
    found = on_arm("4.1b", Arm.from_dh(rows), np.array([0.3, -0.4, 0.5]))
    assert found.away == pytest.approx(truth["ERR-4.1b"]["printed_value_if_wrong"]["printed_residual"], rel=1e-5)
    one = on_arm("4.1b", Arm.from_dh(rows[:1]), np.zeros(1))
    assert "It takes two joints" in one.why


def test_the_printed_first_angle_puts_the_polar_arm_on_the_other_side():
    found = drawn("4.82", "polar_rrp", [0.5, 0.4, 0.8])
    ((printed, wrong), (right, _)) = found.ghosts
    arm = ROBOTS["polar_rrp"].arm
    assert wrong
    assert np.allclose(arm.position(right), arm.position([0.5, 0.4, 0.8]))
    assert np.linalg.norm(arm.position(printed) - arm.position(right)) == pytest.approx(2 * 0.8 * math.cos(0.4))
    assert found.away == pytest.approx(2 * 0.8 * math.cos(0.4))
    assert "not determined" in drawn("4.82", "polar_rrp", [0.5, math.pi / 2, 0.8]).why


def test_the_printed_elbow_misses_the_point_along_the_ray_from_the_shoulder():
    q = [0.4, -0.5, 2.0]
    found = drawn("4.94", "elbow_3r", q)
    arm = ROBOTS["elbow_3r"].arm
    shoulder = np.array([0.0, 0.0, arm.rows[0].d])
    ((printed, _),) = found.ghosts
    right, wrong = arm.position(q) - shoulder, arm.position(printed) - shoulder
    assert np.cross(right, wrong) == pytest.approx(np.zeros(3), abs=1e-9)
    assert found.away == pytest.approx(abs(np.linalg.norm(wrong) - np.linalg.norm(right)))
    assert "the cosine of the elbow would be" in drawn("4.94", "elbow_3r").why


def test_another_elbow_arm_with_other_lengths_fits_and_one_with_an_offset_does_not():
    rows = [("R", 0, math.pi / 2, 0.4, 0), ("R", 0.7, 0, 0, 0), ("R", 0.6, 0, 0, 0)]
    q = np.array([0.4, -0.3, 1.2])
    assert isinstance(on_arm("4.94", Arm.from_dh(rows), q), Drawn)
    assert isinstance(on_arm("4.94", Arm.from_dh([rows[0], ("R", 0.7, 0, 0.1, 0), rows[2]]), q), Unfit)


def test_angle_rates_are_off_by_as_much_as_was_checked(truth):
    """Roll, pitch and yaw of the tool are 0.3, 0.8 and -0.5; their rates are those of the check."""
    tool = np.eye(4)
    tool[:3, :3] = rotation_from_sequence("xyz", [0.3, 0.8, -0.5], fixed=True)
    found = on_arm("5.43", Arm.from_dh([("R", 0.5, 0, 0, 0)], tool=tool), np.zeros(1))
    assert found.away == pytest.approx(truth["ERR-5.43"]["printed_value_if_wrong"]["printed_residual"], rel=1e-5)


def test_the_sign_of_a_quaternion_is_seen_where_the_differences_differ():
    assert drawn("3.78", "polar_rrp").seen
    assert not drawn("3.78", "puma560").seen


def test_a_tool_that_points_down_shows_the_singular_case():
    assert drawn("3.94", "scara").away == pytest.approx(math.pi)
    assert not drawn("3.94", "planar_2r").seen
    assert "neither straight up nor straight down" in drawn("3.94", "puma560").why


def test_no_turn_has_no_axis():
    assert "no axis" in drawn("3.66", "planar_2r", [0.0, 0.0]).why
