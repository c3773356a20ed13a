"""What one count of every joint makes of the tool: by J and by forward kinematics, over the kinds of arms."""

import itertools
import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import MAX_JOINTS, Arm
from armlab.kin.control.encoder import encoder
from armlab.kin.drive.joint_drives import LEAD, joint_drives
from armlab.kin.drive.tool_error import by_jacobian, by_kinematics, corners, inside, shares, worst
from support.arms import random_q

KINDS = ["planar_3r", "scara", "puma560", "ur5e", "iiwa7", "stanford", "panda", "trunk9"]
"""Planar, SCARA, spherical wrist, offset 6R, 7R, prismatic, modified; and one with many joints."""

ONE = Arm.from_dh([("R", 0.5, 0.0, 0.0, 0.0)])


def arms():
    return [ONE, *(catalogue()[key].arm for key in KINDS)]


def half_of(arm, share=1.0):
    return share * np.where(arm.revolute, math.radians(0.02), 2e-4)


@pytest.mark.parametrize("arm", arms(), ids=lambda arm: arm.name or "one joint")
def test_the_cloud_by_j_is_that_of_sampled_forward_kinematics_to_second_order(arm, rng):
    for q in random_q(arm, rng, 3):
        J, unit = arm.jacobian(q), np.vstack([corners(arm.n)[:512], inside(arm.n, 100)])
        apart = []
        for share in (1.0, 0.5):
            dq = unit * half_of(arm, share)
            (p, turned), (exact_p, exact_turned) = by_jacobian(J, dq), by_kinematics(arm, q, dq)
            apart.append((np.abs(p - exact_p).max(), np.abs(turned - exact_turned).max()))
            size = np.abs(dq).sum(axis=1).max()
            assert apart[-1][0] < arm.reach * size**2
            assert apart[-1][1] < size**2
        # Half of every error is a quarter of the difference, unless that is rounding.
        for whole, half in zip(*apart, strict=True):
            assert half == pytest.approx(whole / 4.0, rel=0.05, abs=1e-13)


@pytest.mark.parametrize("arm", arms(), ids=lambda arm: arm.name or "one joint")
def test_no_point_of_the_box_is_worse_than_the_worst_corner(arm, rng):
    for q in random_q(arm, rng, 3):
        J, half = arm.jacobian(q), half_of(arm)
        for block in (J[:3], J[3:]):
            found = worst(block, half)
            points = inside(arm.n, 2000, 7)
            assert np.linalg.norm((points * half) @ block.T, axis=1).max() <= found.size + 1e-15
            np.testing.assert_allclose(block @ (found.signs * half), found.vector, rtol=0, atol=1e-15)
            assert np.linalg.norm(found.vector) == pytest.approx(found.size, abs=1e-15)
            # At most the sum of what the joints do by themselves, at least the largest of these.
            alone = shares(block, half)
            assert alone.max() - 1e-15 <= found.size <= alone.sum() + 1e-15


def test_every_corner_is_looked_at():
    """A worst case that a search by the signs of one direction, or joint by joint, would miss."""
    rng = np.random.default_rng(5)
    for _ in range(20):
        J, half = rng.normal(size=(3, 6)), rng.uniform(0.1, 1.0, 6)
        every = [np.linalg.norm(J @ (np.array(signs) * half)) for signs in itertools.product((-1.0, 1.0), repeat=6)]
        assert worst(J, half).size == pytest.approx(max(every), rel=1e-12)


def test_twelve_joints_have_4096_corners():
    found = corners(MAX_JOINTS)
    assert found.shape == (4096, 12)
    assert len(np.unique(found, axis=0)) == 4096
    np.testing.assert_array_equal(found, -found[::-1])
    with pytest.raises(ValueError, match="1 to 12"):
        corners(13)


def test_points_inside_are_the_same_each_time():
    np.testing.assert_array_equal(inside(6, 10), inside(6, 10))
    assert np.abs(inside(6, 500)).max() <= 1.0


def test_one_count_of_a_stretched_arm():
    """Two links of 1 m, stretched along x: joint 1 moves the tool by 2 m times its error, joint 2 by 1 m, along y."""
    arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)] * 2)
    drives = joint_drives(arm, [100.0, 50.0], [4000.0, 1000.0])
    count = 2.0 * math.pi / np.array([400_000.0, 50_000.0])
    np.testing.assert_allclose(drives.count, count, rtol=1e-15)
    J = arm.jacobian([0.0, 0.0])
    np.testing.assert_allclose(shares(J[:3], drives.half_width), [2.0 * count[0], count[1]], rtol=1e-12)
    found = worst(J[:3], drives.half_width)
    assert found.size == pytest.approx(2.0 * count[0] + count[1])
    np.testing.assert_allclose(np.abs(found.vector), [0.0, found.size, 0.0], rtol=0, atol=1e-15)
    assert worst(J[3:], drives.half_width).size == pytest.approx(count.sum())


def test_an_encoder_at_the_motor_does_not_see_the_backlash():
    arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("P", 0.0, 0.0, 0.0, 0.0)])
    drives = joint_drives(arm, 100.0, 1000.0, [True, True], [2e-3, 1e-4], 0.005)
    np.testing.assert_allclose(drives.count, [2.0 * math.pi / 1e5, 5e-8], rtol=1e-12)
    np.testing.assert_allclose(drives.half_width - drives.count, [1e-3, 5e-5], rtol=0, atol=1e-12)
    joint = joint_drives(arm, 100.0, 1000.0, [False, False], [2e-3, 1e-4], 0.005)
    np.testing.assert_allclose(joint.count, [2.0 * math.pi / 1e3, 5e-6], rtol=1e-12)
    np.testing.assert_array_equal(joint.half_width, joint.count)


def test_one_count_is_that_of_the_encoders_of_a_control_run():
    arm = catalogue()["scara"].arm
    for shaft in ("motor", "link"):
        drives = joint_drives(arm, 80.0, 2048.0, shaft == "motor", 0.0, LEAD)
        np.testing.assert_allclose(drives.count, encoder(2048, shaft, 80.0).resolution(arm.revolute), rtol=1e-14)


def test_speeds_and_torques_of_the_motors_have_the_power_of_the_joints(truth):
    case = truth["C2.2-ideal-gear"]
    arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("P", 0.0, 0.0, 0.0, 0.0)])
    drives = joint_drives(arm, [case["inputs"]["n"], 2.0], 1000.0, True, 0.0, 0.01)
    qdot, tau = np.array([case["expected"]["theta_dot_u"], 0.2]), np.array([case["expected"]["tau_u"], 300.0])
    speeds, torques = drives.motor_speeds(qdot), drives.motor_torques(tau)
    assert speeds[0] == pytest.approx(case["inputs"]["theta_dot_m"], abs=case["tol"])
    assert torques[0] == pytest.approx(case["inputs"]["tau_m"], abs=case["tol"])
    # 0.2 m/s are 20 turns of the screw a second, 40 of the motor; 300 N over 10 mm are 3 J a turn of the screw.
    assert speeds[1] == pytest.approx(40.0 * 2.0 * math.pi)
    assert torques[1] == pytest.approx(3.0 / (2.0 * 2.0 * math.pi))
    np.testing.assert_allclose(speeds * torques, qdot * tau, rtol=1e-12)


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"ratio": 0.0}, "ratio of joint 1: expected a positive number, got 0"),
        ({"ratio": [50.0, -1.0]}, "ratio of joint 2: expected a positive number, got -1"),
        ({"counts": [1000.0, 0.0]}, "counts of the encoder of joint 2: expected a positive number, got 0"),
        ({"backlash": -1e-3}, "backlash of joint 1: expected no negative number"),
        ({"lead": 0.0}, "lead of the screw of joint 1: expected a positive number"),
        ({"ratio": [1.0, 2.0, 3.0]}, "ratio: expected 2 numbers"),
        ({"at_motor": [True, False, True]}, "encoder at the motor: expected 2 values, true or false, got shape"),
        ({"at_motor": None}, "encoder at the motor: expected 2 values, true or false, got None"),
        ({"at_motor": [2, 0]}, r"encoder at the motor: expected 2 values, true or false, got \[2, 0\]"),
        ({"counts": math.inf}, "counts of the encoder of joint 1: expected a positive number, got inf"),
    ],
)
def test_drives_that_cannot_be_are_refused_in_words(change, told):
    arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)] * 2)
    with pytest.raises(InputError, match=told):
        joint_drives(arm, **({"ratio": 100.0, "counts": 1000.0} | change))
