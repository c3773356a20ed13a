"""Weights of the task components: which configuration counts as the closest."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.ik.closest import closest_of
from armlab.kin.ik.verdict import task_error_of
from armlab.kin.ik.weights import checked_weights
from armlab.kin.transforms import transform
from support.arms import random_q

TWO_R = Arm.from_dh([("R", 1, 0, 0, 0)] * 2)


def at(*position):
    return transform(position=[*position, 0.0])


def random_weights(arm, rng):
    weights = rng.uniform(0.2, 3.0, arm.task.m)
    weights[len(arm.task.position) :] = rng.uniform(0.2, 3.0)
    return weights


def test_weights_decide_which_configuration_is_the_closest():
    """Against a search over a grid: the target (2.5, 1.5) is 0.9 m beyond the reach of a 2R."""
    target = np.array([2.5, 1.5])
    angles = np.linspace(-math.pi, math.pi, 100_001)
    for weights in ([1.0, 1.0], [1.0, 0.2], [0.2, 1.0], [5.0, 1.0]):
        circle = 2.0 * np.column_stack([np.cos(angles), np.sin(angles)])
        best = circle[np.argmin(np.sum(((circle - target) * weights) ** 2, axis=1))]
        result = ik.solve(TWO_R, at(*target), q0=[0.4, 0.5], weights=weights)
        np.testing.assert_allclose(TWO_R.position(result.q)[:2], best, rtol=0, atol=2e-3)
        assert result.proven
        assert result.verdict.status == "beyond"
    x_first = ik.solve(TWO_R, at(*target), q0=[0.4, 0.5], weights=[1.0, 0.1])
    y_first = ik.solve(TWO_R, at(*target), q0=[0.4, 0.5], weights=[0.1, 1.0])
    assert abs(TWO_R.position(x_first.q)[0] - 2.5) < abs(TWO_R.position(y_first.q)[0] - 2.5)
    assert abs(TWO_R.position(y_first.q)[1] - 1.5) < 0.02


def test_weights_trade_position_against_orientation():
    arm = catalogue()["ur10e"].arm
    q0 = np.array([0.2, -1.0, 1.3, -0.6, 0.5, 0.3])
    T = np.array(arm.fk(q0))
    T[:3, 3] *= 1.6
    position, rotation = (
        ik.solve(arm, T, q0, weights=[p] * 3 + [r] * 3, complete=False, searches=2) for p, r in ((1, 0.05), (0.05, 1))
    )
    assert position.position_error < rotation.position_error - 0.02
    assert rotation.rotation_error < position.rotation_error - 0.02


def test_weights_do_not_change_what_is_reached(robot, rng):
    T, weights = robot.arm.fk(random_q(robot.arm, rng)), random_weights(robot.arm, rng)
    plain, weighted = (ik.solve(robot.arm, T, seed=1, weights=w) for w in (None, weights))
    assert weighted.success
    assert weighted.q.tolist() == plain.q.tolist()
    assert (weighted.position_error, weighted.rotation_error) == (plain.position_error, plain.rotation_error)


def test_only_the_ratios_of_weights_matter():
    target = at(2.5, 1.5)
    first, second = (ik.solve(TWO_R, target, q0=[0.4, 0.5], weights=w) for w in ([2.0, 1.0], [2000.0, 1000.0]))
    assert first.q.tolist() == second.q.tolist()
    none, equal = (ik.solve(TWO_R, target, q0=[0.4, 0.5], weights=w) for w in (None, [7.0, 7.0]))
    assert none.q.tolist() == equal.q.tolist()


def test_the_weighted_slope_and_curvature_are_the_derivatives_of_the_weighted_cost(robot, rng):
    arm, h = robot.arm, 1e-6
    weights = checked_weights(arm, random_weights(arm, rng))
    task, closest = task_error_of(arm, weights), closest_of(arm, weights)
    q, free = random_q(arm, rng), [1.0] * arm.n
    target = task.target(arm.fk(random_q(arm, rng)))
    scales = np.where(arm.revolute, 1.0, arm.length_scale)
    slope, H, errors = closest.curve(q.tolist(), target, free)
    np.testing.assert_allclose(task.slope(q.tolist(), target, free)[0], slope, rtol=0, atol=1e-12)
    of = np.ones(arm.task.m) if weights is None else np.array(weights)
    _, e, _ = task_error_of(arm).at(q.tolist(), target)
    if errors.rotation < 1.5:
        assert errors.cost == pytest.approx(np.sum((of * e) ** 2), rel=1e-6, abs=1e-12)
    for i in range(arm.n):
        move = h * scales[i] * np.eye(arm.n)[i]
        after, before = (task.slope((q + sign * move).tolist(), target, free) for sign in (1, -1))
        assert slope[i] == pytest.approx((before[1].cost - after[1].cost) / (4 * h), abs=1e-7 * (1 + errors.cost))
        np.testing.assert_allclose(H[i], (before[0] - after[0]) / (2 * h), rtol=0, atol=1e-6)


def test_a_closest_configuration_by_weights_is_judged_by_them():
    result = ik.solve(TWO_R, at(2.5, 1.5), q0=[0.4, 0.5], weights=[1.0, 0.2])
    assert ik.judge(TWO_R, at(2.5, 1.5), result.q, weights=[1.0, 0.2]).status == "beyond"
    assert ik.judge(TWO_R, at(2.5, 1.5), result.q).status == "moving"
