"""Geometric Jacobian and manipulability."""

from functools import cache

import numpy as np
import pytest

from armlab.kin.arm import Arm
from armlab.kin.task import NAMED, task_named
from armlab.kin.task_choice import default_task
from support.arms import jacobian_by_differences, random_arm, random_q


def test_every_robot_agrees_with_central_differences(robot, rng):
    for q in random_q(robot.arm, rng, 5):
        np.testing.assert_allclose(robot.arm.jacobian(q), jacobian_by_differences(robot.arm, q), rtol=0, atol=1e-7)


@pytest.mark.parametrize("n", [1, 4, 8, 12])
def test_random_arms_agree_with_central_differences(n, rng):
    for _ in range(4):
        arm = random_arm(rng, n)
        q = random_q(arm, rng)
        np.testing.assert_allclose(arm.jacobian(q), jacobian_by_differences(arm, q), rtol=0, atol=1e-7)


@pytest.mark.parametrize("name", ["RRP", "elbow"])
def test_the_jacobians_of_the_notes(truth, name):
    case = truth[f"C5.1.1-geomJ-{name}"]
    arm = Arm.from_dh([tuple(row) for row in case["inputs"]["dh"]])
    np.testing.assert_allclose(arm.jacobian(case["inputs"]["q"]), case["expected"]["J"], rtol=0, atol=case["tol"])


def test_the_2r_of_the_notes(truth):
    case = truth["C5.1.1-J-2R"]
    arm = Arm.from_dh([("R", case["inputs"]["l1"], 0, 0, 0), ("R", case["inputs"]["l2"], 0, 0, 0)])
    J = arm.jacobian(case["inputs"]["q"])[[0, 1, 5]]
    expected = np.array(case["expected"]["J"])
    np.testing.assert_allclose(J[: len(expected)], expected, rtol=0, atol=case["tol"])
    rates = J[: len(case["expected"]["rdot"])] @ case["inputs"]["qdot"]
    np.testing.assert_allclose(rates, case["expected"]["rdot"], rtol=0, atol=case["tol"])


def test_the_column_of_an_inner_joint_uses_its_own_lever(truth):
    """p from frame 1 to E, not from the base (erratum 5.58)."""
    case = truth["C5.1.1-p_last"]
    arm = Arm.from_dh([("R", 1, 0, 0, 0)] * 2)
    q = case["inputs"]["q"]
    np.testing.assert_allclose(arm.fk(q)[:3, 3] - arm.frames(q)[1, :3, 3], case["expected"]["p_1E"], atol=case["tol"])
    np.testing.assert_allclose(arm.jacobian(q)[:3, 1], case["expected"]["J_L_col2"], rtol=0, atol=case["tol"])


def task_jacobian(arm, q, task=None):
    """Return the Jacobian of a task, the arm's own when left out, from the geometric one, by its definition."""
    R0, task = arm.base[:3, :3], task or arm.task
    J = arm.jacobian(q)
    linear, angular = R0.T @ J[:3], R0.T @ J[3:]
    tool = R0.T @ arm.fk(q)[:3, :3]
    rows = [linear[k] for k in task.coordinates]
    rows += {
        "none": [],
        "phi": [angular[2]],
        "approach": list(tool[:, :2].T @ angular),
        "full": list(angular),
    }[task.rotation]
    return np.array(rows)


def volume(J):
    m, n = J.shape
    return np.sqrt(max(np.linalg.det(J @ J.T if m <= n else J.T @ J), 0.0))


def test_manipulability_is_the_volume_of_the_task_jacobian(robot, rng):
    for q in random_q(robot.arm, rng, 20):
        assert robot.arm.manipulability(q) == pytest.approx(volume(task_jacobian(robot.arm, q)), rel=1e-9, abs=1e-12)


@cache
def drawn(n):
    """Return three arms and a configuration of each, for all tasks: their Jacobian, compiled once, knows of none."""
    rng = np.random.default_rng(20260)
    arms = [random_arm(rng, n, special=special) for special in (False, True, bool(rng.integers(2)))]
    return [(arm, random_q(arm, rng)) for arm in arms]


@pytest.mark.parametrize("key", list(NAMED))
@pytest.mark.parametrize("n", [2, 3, 5, 6, 7, 9, 12])
def test_every_task_of_every_arm(key, n):
    for drawn_arm, q in drawn(n):
        arm = Arm.from_dh(
            drawn_arm.rows, drawn_arm.convention, drawn_arm.base, drawn_arm.tool, drawn_arm.limits, task=key
        )
        expected = volume(task_jacobian(drawn_arm, q, arm.task))
        assert float(arm.manipulability(q)) == pytest.approx(expected, rel=1e-6, abs=1e-8)


def test_a_2r_has_l1_l2_sine_of_the_elbow(rng):
    arm = Arm.from_dh([("R", 0.7, 0, 0, 0), ("R", 0.4, 0, 0, 0)])
    q = random_q(arm, rng, 50)
    np.testing.assert_allclose(arm.manipulability(q), 0.28 * np.abs(np.sin(q[:, 1])), rtol=0, atol=1e-15)


def test_a_redundant_arm_is_never_below_zero_and_zero_when_singular():
    arm = Arm.from_dh([("R", 1, 0, 0, 0)] * 3, task="xy")
    assert float(arm.manipulability([0.3, 0.0, 0.0])) == pytest.approx(0.0, abs=1e-15)
    assert float(arm.manipulability([0.3, np.pi, 0.0])) == pytest.approx(0.0, abs=1e-15)
    assert float(arm.manipulability([0.3, 1.0, 0.5])) > 0.1


H = np.pi / 2


GEOMETRIES = [
    ([("R", 1, 0, 0, 0)], "phi"),
    ([("R", 1, 0, 0, 0)] * 2, "xy"),
    ([("R", 1, 0, 0, 0)] * 3, "xy phi"),
    ([("R", 1, 0, 0, 0)] * 4, "xy phi"),
    ([("R", 0.3, 0, 0.4, 0), ("R", 0.3, np.pi, 0, 0), ("P", 0, 0, 0, 0), ("R", 0, 0, 0, 0)], "xyz phi"),
    ([("R", 0, H, 0.6, 0), ("R", 0.8, 0, 0, 0), ("R", 0.5, 0, 0, 0)], "xyz"),
    ([("R", 0, H, 0.5, 0), ("R", 0, H, 0, H), ("P", 0, 0, 0, 0)], "xyz"),
    ([("P", 0, H, 0, np.pi), ("P", 0, H, 0, -H), ("P", 0, 0, 0, 0)], "xyz"),
    ([("P", 0, 0, 0, 0)], "z"),
    ([("P", 0, 0, 0, 0), ("R", 0, 0, 0, 0)], "z phi"),
    ([("P", 0, H, 0, 0), ("P", 0, -H, 0, 0), ("R", 0, 0, 0, 0)], "yz phi"),
    ([("P", 0, H, 0, 0), ("R", 1, 0, 0, 0)], "xz"),
    ([("R", 0, H, 0.3, 0), ("R", 0.5, 0, 0, 0)], "xyz"),
    ([("R", 0, H, 0.3, 0), *[("R", 0.5, 0, 0, 0)] * 2, ("R", 0, H, 0, 0), ("R", 0, 0, 0.1, 0)], "xyz"),
    ([("R", 0.1, H, 0.1, 0)] * 5, "xyz approach"),
    ([("R", 0.1, H, 0.1, 0)] * 6, "pose"),
    ([("R", 0.1, H, 0.1, 0)] * 8, "pose"),
    ([("R", 0.1, 0, 0, 0)] * 8, "xy phi"),
]
"""Tables with the default task of each."""


@pytest.mark.parametrize(("rows", "key"), GEOMETRIES)
def test_the_default_task_fits_the_geometry(rows, key):
    assert Arm.from_dh(rows).task is task_named(key)


@pytest.mark.parametrize("size", [1e-10, 1e-4, 1e5, 1e10])
@pytest.mark.parametrize(("rows", "key"), GEOMETRIES)
def test_the_default_task_does_not_depend_on_the_size_of_the_arm(rows, key, size):
    sized = [(kind, size * a, alpha, size * d, theta) for kind, a, alpha, d, theta in rows]
    assert Arm.from_dh(sized).task is task_named(key)


def test_the_default_task_of_a_robot_is_what_its_file_says_or_the_same(robot):
    chosen = default_task(robot.arm.rows, robot.arm.convention, robot.arm.tool)
    assert robot.arm.task == chosen
