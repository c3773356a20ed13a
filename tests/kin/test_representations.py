"""A stick by two numbers and by one, and planar 3R arms that have the same three numbers."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.representations import (
    arms_by_third_joint,
    by_third_joint,
    nearest_stick_end,
    stick_angle,
    stick_end,
    stick_residual,
    third_joint_misfit,
)


def test_the_angle_of_the_stick_always_fulfils_the_constraint(rng):
    for theta, length in zip(rng.uniform(-10, 10, 200), rng.uniform(0.1, 5, 200), strict=True):
        x, y = stick_end(theta, length)
        assert stick_residual(x, y, length) == pytest.approx(0.0, abs=1e-13)
        assert math.remainder(stick_angle(x, y) - theta, math.tau) == pytest.approx(0.0, abs=1e-12)


def test_the_residual_and_the_nearest_point_by_hand():
    assert stick_residual(0.9, -0.9, 1.0) == pytest.approx(0.62, abs=1e-15)
    np.testing.assert_allclose(nearest_stick_end(3.0, 4.0, 1.0), [0.6, 0.8], rtol=0, atol=1e-15)
    assert nearest_stick_end(0.0, 0.0, 2.0) == (0.0, -2.0)
    assert stick_angle(0.0, -1.0) == 0.0
    assert stick_angle(1.0, 0.0) == pytest.approx(math.pi / 2)


ARMS = [
    catalogue()["planar_3r"].arm,
    catalogue()["planar_3r_unequal"].arm,
    Arm.from_dh([("R", 1.0, math.pi, 0, 0.3), ("R", 0.7, math.pi, 0, -0.5), ("R", 0.4, 0, 0, 1.0)]),
    Arm.from_dh(
        [("R", 0, 0, 0.2, 0.3), ("R", 0.7, math.pi, 0, -0.5), ("R", 0.4, 0, 0, 1.0)],
        "modified",
        tool=[[1, 0, 0, 0.3], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]],
    ),
]


@pytest.mark.parametrize("arm", ARMS)
def test_two_arms_have_one_r_and_one_of_them_is_the_present(arm, rng):
    for q in rng.uniform(-3.0, 3.0, (60, 3)):
        r = by_third_joint(arm, q)
        found = arms_by_third_joint(arm, r)
        assert len(found) == 2
        for each in found:
            np.testing.assert_allclose(by_third_joint(arm, each), r, rtol=0, atol=1e-9)
        apart = min(np.abs(np.exp(1j * each) - np.exp(1j * q)).max() for each in found)
        assert apart < 1e-6
        # Their tools are in different places, since link 2 points elsewhere, and link 3 with it.
        tools = arm.position(found)
        assert np.linalg.norm(tools[0] - tools[1]) > 1e-6


def test_joint_three_is_where_the_second_link_ends():
    np.testing.assert_allclose(by_third_joint(ARMS[0], [0.0, math.pi / 2, 0.4]), [1, 1, 0.4], rtol=0, atol=1e-15)


def test_at_the_edge_there_is_one_arm_and_beyond_it_none():
    arm = catalogue()["planar_3r"].arm
    np.testing.assert_allclose(arms_by_third_joint(arm, [2.0, 0.0, 0.1]), [[0.0, 0.0, 0.1]], rtol=0, atol=1e-9)
    assert arms_by_third_joint(arm, [2.1, 0.0, 0.1]).shape == (0, 3)
    # Folded onto joint 1 any angle of joint 1 will do.
    np.testing.assert_allclose(arms_by_third_joint(arm, [0.0, 0.0, 0.1]), [[0.0, math.pi, 0.1]], rtol=0, atol=1e-9)


def test_what_is_no_planar_3r_is_told_so():
    assert third_joint_misfit(catalogue()["planar_3r"].arm) is None
    assert "RRRRRR" in str(third_joint_misfit(catalogue()["puma560"].arm))
    assert "not all parallel" in str(third_joint_misfit(catalogue()["elbow_3r"].arm))
    short = Arm.from_dh([("R", 1.0, 0, 0, 0), ("R", 0.0, 0, 0, 0), ("R", 1.0, 0, 0, 0)])
    assert "with a length" in str(third_joint_misfit(short))
    with pytest.raises(InputError, match="arm: expected three joints that turn"):
        arms_by_third_joint(catalogue()["puma560"].arm, [0, 0, 0])
