"""The curve of each joint alone against forward kinematics at values of that joint."""

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.sweeps import arc, sweeps
from support.arms import random_arm, random_q, tool_by_products

EXACT = 1e-9


def check(arm, q):
    """Compare the closed form with the product of matrices at five values of every joint."""
    found = sweeps(arm, q)
    low, high = arm.limits.T
    for part in np.linspace(0.0, 1.0, 5):
        values = low + part * (high - low)
        points = found.at(values)
        for i in range(arm.n):
            alone = np.array(q)
            alone[i] = values[i]
            np.testing.assert_allclose(points[i], tool_by_products(arm, alone)[:3, 3], atol=EXACT * (1.0 + arm.reach))
    np.testing.assert_allclose(found.at(q), np.tile(tool_by_products(arm, q)[:3, 3], (arm.n, 1)), atol=EXACT)


@pytest.mark.parametrize("seed", range(30))
@pytest.mark.parametrize("special", [False, True])
def test_curves_of_random_arms(seed, special):
    rng = np.random.default_rng(seed)
    arm = random_arm(rng, int(rng.integers(1, 8)), special=special)
    check(arm, random_q(arm, rng))


@pytest.mark.parametrize("key", sorted(catalogue().robots))
def test_curves_of_the_robots_at_home_and_at_zero(key):
    robot = catalogue()[key]
    check(robot.arm, np.array(robot.home))
    check(robot.arm, robot.arm.clip(np.zeros(robot.arm.n)))


@pytest.mark.parametrize("seed", range(5))
def test_axes_are_rotations_and_the_curve_is_tangent_to_the_column_of_the_jacobian(seed):
    rng = np.random.default_rng(seed)
    arm = random_arm(rng, 6)
    q = random_q(arm, rng)
    found = sweeps(arm, q)
    np.testing.assert_allclose(np.swapaxes(found.axes, 1, 2) @ found.axes, np.tile(np.eye(3), (6, 1, 1)), atol=EXACT)
    np.testing.assert_allclose(np.linalg.det(found.axes), 1.0, atol=EXACT)
    h = 1e-6
    velocity = (found.at(q + h) - found.at(q - h)) / (2.0 * h)
    np.testing.assert_allclose(velocity.T, arm.jacobian(q)[:3], atol=1e-7)


def test_a_tool_point_on_the_axis_has_radius_zero_and_stays():
    arm = Arm.from_dh([("R", 0.0, 0.0, 0.4, 0.0), ("R", 0.0, 0.0, 0.3, 0.0), ("P", 0.0, 0.0, 0.1, 0.0)])
    found = sweeps(arm, [0.3, -0.2, 0.5])
    assert found.radius.tolist() == [0.0, 0.0, 0.0]
    np.testing.assert_allclose(found.at([1.0, 2.0, 0.5]), [[0.0, 0.0, 1.3]] * 3, atol=EXACT)
    np.testing.assert_allclose(np.linalg.norm(found.axes, axis=1), 1.0, atol=EXACT)


@pytest.mark.parametrize("q", [[0.1], [[0.1, 0.2]], [0.1, float("nan")], "zero"])
def test_wrong_configurations_are_refused(q):
    arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("R", 0.5, 0.0, 0.0, 0.0)])
    with pytest.raises(InputError, match="q"):
        sweeps(arm, q)


@pytest.mark.parametrize("angle", [-4.0, -0.01, 0.0, 1e-12, 0.35, 6.9])
def test_an_arc_has_both_ends_its_radius_and_small_steps(angle):
    points = arc(angle, 0.7, largest_step=0.2)
    np.testing.assert_allclose(np.linalg.norm(points, axis=1), 0.7, atol=1e-12)
    np.testing.assert_allclose(points[0], [0.7, 0.0, 0.0], atol=1e-12)
    np.testing.assert_allclose(points[-1], [0.7 * np.cos(angle), 0.7 * np.sin(angle), 0.0], atol=1e-12)
    turns = np.unwrap(np.arctan2(points[:, 1], points[:, 0]))
    assert np.abs(np.diff(turns)).max() <= 0.2
    assert turns[-1] == pytest.approx(angle, abs=1e-9)
