"""Every robot file proves itself."""

import math

import numpy as np
import pytest

import armlab
from armlab.content.robots import FAMILIES, catalogue
from armlab.errors import UnknownName
from armlab.front.wishes import NAME
from support.arms import random_q

COUNT = 12


def test_there_are_enough_arms_and_none_is_broken():
    assert catalogue().problems == ()
    assert len(catalogue().robots) >= COUNT


def test_the_expected_poses_come_out(robot):
    assert len(robot.expected) >= 2
    for expected in robot.expected:
        T = robot.arm.frames(expected.q)[-1] if expected.flange else robot.arm.fk(expected.q)
        given = ~np.isnan(expected.T)
        np.testing.assert_allclose(
            T[given], expected.T[given], rtol=0, atol=expected.tolerance, err_msg=expected.source
        )


def test_names_and_words(robot):
    assert robot.family in FAMILIES
    assert len(robot.summary) < 130
    assert robot.summary.endswith(".")
    assert len(robot.source) > 30
    assert "home" in next(iter(robot.poses))


def test_its_link_is_served(robot):
    assert NAME.match(robot.key)


def test_the_home_pose_is_a_good_pose(robot):
    """Inside the limits with room to move, and not singular: the first drag must work in every direction."""
    low, high = robot.arm.limits.T
    margin = np.minimum(robot.home - low, high - robot.home)
    assert np.all(margin > 0.02 * (high - low))
    assert float(robot.arm.manipulability(robot.home)) > 1e-3


def test_loading_gives_an_arm():
    assert armlab.load("puma560").n == 6
    assert "puma560" in armlab.robots()
    with pytest.raises(UnknownName, match=r"robot: unknown name 'puma'; did you mean 'puma560'\? Available: "):
        armlab.load("puma")


c, s = math.cos, math.sin

# Independent closed forms, written from drawings and not from the tables: position of frame n.
CLOSED_FORMS = {
    "planar_2r": lambda q: (c(q[0]) + c(q[0] + q[1]), s(q[0]) + s(q[0] + q[1]), 0.0),
    "planar_3r": lambda q: (
        c(q[0]) + c(q[0] + q[1]) + c(sum(q)),
        s(q[0]) + s(q[0] + q[1]) + s(sum(q)),
        0.0,
    ),
    "polar_rrp": lambda q: (q[2] * c(q[1]) * c(q[0]), q[2] * c(q[1]) * s(q[0]), 0.5 + q[2] * s(q[1])),
    "elbow_3r": lambda q: (
        c(q[0]) * (0.8 * c(q[1]) + 0.5 * c(q[1] + q[2])),
        s(q[0]) * (0.8 * c(q[1]) + 0.5 * c(q[1] + q[2])),
        0.6 + 0.8 * s(q[1]) + 0.5 * s(q[1] + q[2]),
    ),
    "r4": lambda q: (
        c(q[0]) * (0.5 * c(q[1]) + 0.4 * c(q[1] + q[2]) + 0.2 * c(q[1] + q[2] + q[3])),
        s(q[0]) * (0.5 * c(q[1]) + 0.4 * c(q[1] + q[2]) + 0.2 * c(q[1] + q[2] + q[3])),
        0.4 + 0.5 * s(q[1]) + 0.4 * s(q[1] + q[2]) + 0.2 * s(q[1] + q[2] + q[3]),
    ),
    "cartesian_3p": lambda q: (q[2], q[1], q[0]),
    "scara": lambda q: (
        0.325 * c(q[0]) + 0.275 * c(q[0] + q[1]),
        0.325 * s(q[0]) + 0.275 * s(q[0] + q[1]),
        0.387 - q[2],
    ),
}


@pytest.mark.parametrize("key", list(CLOSED_FORMS))
def test_closed_forms_prove_the_arms_whose_dimensions_are_our_choice(key, rng):
    arm = catalogue()[key].arm
    for q in random_q(arm, rng, 20):
        np.testing.assert_allclose(arm.frames(q)[-1, :3, 3], CLOSED_FORMS[key](q), rtol=0, atol=1e-12)


def test_the_unimate_is_a_polar_arm_with_a_zyz_wrist(rng):
    from armlab.kin.rotations import rotation_from_sequence

    arm = catalogue()["unimate"].arm
    for q in random_q(arm, rng, 20):
        x = np.array([-s(q[1]) * c(q[0]), -s(q[1]) * s(q[0]), c(q[1])])
        z = np.array([c(q[1]) * c(q[0]), c(q[1]) * s(q[0]), s(q[1])])
        boom = np.column_stack([x, np.cross(z, x), z])
        R = boom @ rotation_from_sequence("zyz", q[3:])
        wrist = q[2] * z + [0.0, 0.0, 0.8]
        T = arm.frames(q)[-1]
        np.testing.assert_allclose(T[:3, :3], R, rtol=0, atol=1e-12)
        np.testing.assert_allclose(T[:3, 3], wrist + 0.2 * R[:, 2], rtol=0, atol=1e-12)
