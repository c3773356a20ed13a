"""Cyclic coordinate descent and null-space projection."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.ik.iterate.problem import Problem
from armlab.kin.transforms import transform
from support.arms import random_q

TWO_R = Arm.from_dh([("R", 1, 0, 0, 0)] * 2)
THREE_R = Arm.from_dh([("R", 1, 0, 0, 0)] * 3, task="xy")
NULL_SPACE = [key for key, method in ik.iteration_methods().items() if method.objective]


def test_a_sweep_of_coordinate_descent_on_the_2r_by_hand():
    # From (0, 90 deg) joint 2 at (1, 0) turns the tool (1, 1) towards the target (2, 1), seen from it at 45 deg; joint
    # 1 then turns the tool (1 + cos 45, sin 45), seen from the origin at 22.5 deg, towards atan2(1, 2).
    trace = ik.iterate(TWO_R, transform(position=[2.0, 1.0, 0.0]), [0.0, math.pi / 2], "ccd", most=1)
    expected = [math.atan2(1, 2) - math.pi / 8, math.pi / 4]
    np.testing.assert_allclose(trace.q[1], expected, rtol=0, atol=1e-9)


def test_a_sweep_stops_at_a_limit_by_hand():
    arm = Arm.from_dh(TWO_R.rows, limits=[[0.0, 0.05], [1.0, 3.0]])
    trace = ik.iterate(arm, transform(position=[2.0, 1.0, 0.0]), [0.0, math.pi / 2], "ccd", most=1)
    # Joint 2 stops at 1 rad instead of 45 deg: the tool (1 + cos 1, sin 1) is seen at 0.5 rad, above the target at
    # 0.464 rad, so joint 1, which would turn back, stays at 0.
    np.testing.assert_allclose(trace.q[1], [0.0, 1.0], rtol=0, atol=1e-9)


def test_a_sliding_joint_goes_to_the_foot_of_the_target_at_once_and_no_further_than_its_stroke():
    slide = Arm.from_dh([("P", 0, 0, 0, 0)], limits=[[0.0, 1.0]])
    inside = ik.iterate(slide, transform(position=[0.0, 0.0, 0.73]), [0.2], "ccd")
    assert (inside.iterations, inside.status) == (1, "converged")
    assert inside.q[-1, 0] == pytest.approx(0.73, abs=1e-12)
    outside = ik.iterate(slide, transform(position=[0.0, 0.0, 0.9]), [0.2], "ccd", limits="none")
    assert outside.success
    short = Arm.from_dh([("P", 0, 0, 0, 0)], limits=[[0.0, 0.5]])
    stopped = ik.iterate(short, transform(position=[0.0, 0.0, 0.45]), [0.2], "ccd")
    assert stopped.success
    beyond = ik.iterate(
        Arm.from_dh([("P", 0, 0, 0, 0)], limits=[[-2.0, 0.5]]), transform(position=[0, 0, 0.9]), [0], "ccd"
    )
    assert beyond.q[-1, 0] == 0.5
    assert (beyond.status, beyond.reason) == ("limit", "stopped at the limits of joint 1")


def test_coordinate_descent_never_raises_its_cost(robot, rng):
    T = robot.arm.fk(random_q(robot.arm, rng))
    trace = ik.iterate(robot.arm, T, random_q(robot.arm, rng), "ccd", most=12)
    assert np.all(np.diff(trace.cost) <= 0)
    assert trace.cost[-1] < trace.cost[0]
    assert all(robot.arm.within_limits(q) for q in trace.q)


def test_each_joint_of_a_sweep_is_at_the_best_value_of_all(rng):
    """No other value of the joint that moved last, the first, makes the cost smaller: a search over a whole turn."""
    arm = catalogue()["puma560"].arm
    for _ in range(5):
        T, q0 = arm.fk(random_q(arm, rng)), random_q(arm, rng)
        trace = ik.iterate(arm, T, q0, "ccd", most=1, limits="none")
        others = np.tile(trace.q[1], (400, 1))
        others[:, 0] += np.linspace(-math.pi, math.pi, 400)
        costs = Problem(arm, T, ik.task_vector(arm), range(6), clamp=False, chord=True).cost(others)
        assert trace.cost[1] <= costs.min() + 1e-12


def test_the_cost_of_coordinate_descent_counts_angles_by_their_chord():
    arm = Arm.from_dh([("R", 0, 0, 0, 0)], task="phi")
    trace = ik.iterate(arm, arm.fk([2.0]), [0.5], "ccd", most=0)
    assert trace.cost[0] == pytest.approx(0.5 * (2 * math.sin(0.75)) ** 2, abs=1e-14)
    assert ik.iterate(arm, arm.fk([2.0]), [0.5], "gradient", most=0).cost[0] == pytest.approx(0.5 * 1.5**2, abs=1e-14)


def test_a_null_space_step_is_the_formula_by_hand():
    """dq = J# e + (I - J# J) k grad H, with grad H = -(q - middle) / (n range^2) on the 3R with limits of pi."""
    q, n = np.array([0.4, 0.9, -0.7]), 3
    target = THREE_R.position(q) + np.array([0.01, -0.02, 0.0])
    trace = ik.iterate(THREE_R, transform(position=target), q, "null_space_limits", parameters={"k": 2.0}, most=1)
    J = THREE_R.jacobian(q)[:2]
    inverse = J.T @ np.linalg.inv(J @ J.T)
    gradient = -q / (n * (2 * math.pi) ** 2)
    expected = inverse @ [0.01, -0.02] + (np.eye(3) - inverse @ J) @ (2.0 * gradient)
    np.testing.assert_allclose(trace.step[0], expected, rtol=0, atol=1e-12)
    assert trace.objective[0] == pytest.approx(-np.sum((q / (2 * math.pi)) ** 2) / (2 * n), abs=1e-14)


def test_the_objective_of_large_manipulability_is_w_and_its_slope_that_of_w():
    q, h = np.array([0.4, 0.9, -0.7]), 1e-6
    target = transform(position=THREE_R.position(q))
    trace = ik.iterate(THREE_R, target, q, "null_space_w", parameters={"k": 0.01}, most=1)
    assert trace.objective[0] == pytest.approx(THREE_R.manipulability(q), abs=1e-12)
    slope = np.array(
        [(THREE_R.manipulability(q + h * d) - THREE_R.manipulability(q - h * d)) / (2 * h) for d in np.eye(3)]
    )
    J = THREE_R.jacobian(q)[:2]
    own = (np.eye(3) - np.linalg.pinv(J) @ J) @ slope * 0.01
    np.testing.assert_allclose(trace.step[0], own, rtol=0, atol=1e-8)


@pytest.mark.parametrize("method", NULL_SPACE)
@pytest.mark.parametrize("key", ["planar_3r_xy", "panda", "iiwa7", "r4"])
def test_a_self_motion_leaves_the_tool_where_it_is_and_serves_its_objective(method, key, rng):
    arm = THREE_R if key == "planar_3r_xy" else catalogue()[key].arm
    improved = 0
    for _ in range(2):
        q = arm.limits.mean(axis=1) + 0.35 * np.ptp(arm.limits, axis=1) * rng.uniform(-1, 1, arm.n)
        trace = ik.iterate(arm, arm.fk(q), q, method)
        if trace.sigma_min.min() < 0.02:
            continue  # Beside a singularity the self-motion of one step turns sharply.
        assert trace.position_error.max() < 0.02 * arm.length_scale
        assert trace.rotation_error.max() < 0.02
        assert trace.objective[-1] > trace.objective[0]
        improved += trace.success
    assert improved >= 1


def test_the_same_solution_is_reached_with_more_room_to_the_limits_than_by_gauss_newton(rng):
    arm = catalogue()["panda"].arm
    better = 0
    for _ in range(6):
        q = random_q(arm, rng)
        q0 = arm.clip(q + 0.2 * rng.normal(size=7))
        plain, aware = (ik.iterate(arm, arm.fk(q), q0, key) for key in ("gauss_newton", "null_space_limits"))
        if plain.success and aware.success:
            objective = ik.iteration_method("null_space_limits").objective
            ends = np.array([plain.q[-1], aware.q[-1]])
            of_plain, of_aware = -np.sum(((ends - arm.limits.mean(axis=1)) / np.ptp(arm.limits, axis=1)) ** 2, axis=1)
            assert objective is not None
            better += of_aware > of_plain
    assert better >= 3


@pytest.mark.parametrize("method", NULL_SPACE)
def test_without_joints_to_spare_null_space_projection_is_gauss_newton(method):
    arm, q = catalogue()["ur10e"].arm, np.array([0.3, -1.2, 1.4, -0.8, 0.9, 0.2])
    own = ik.iterate(arm, arm.fk(q + 0.1), q, method, most=3)
    plain = ik.iterate(arm, arm.fk(q + 0.1), q, "gauss_newton", most=3)
    np.testing.assert_allclose(own.q, plain.q, rtol=0, atol=1e-9)
