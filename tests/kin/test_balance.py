"""Arms whose error slopes nowhere: at balance they move on, at rest they stay, and the verdict tells which."""

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.ik.closest import closest_of
from armlab.kin.ik.problem import TaskError
from armlab.kin.ik.solve import come_closer, problem_of
from armlab.kin.ik.target import feasible
from armlab.kin.transforms import transform
from support.arms import random_arm, random_pose, random_q

H = np.pi / 2
TWO_R = Arm.from_dh([("R", 1, 0, 0, 0), ("R", 1, 0, 0, 0)])


def follow(arm, q, targets, travel=0.6):
    """Follow a hand as the lab does; returns all configurations."""
    problem = problem_of(arm, ik.method_named("dls"))
    path = [np.array(q, dtype=float)]
    for T in targets:
        target = problem.target(feasible(arm, T, arm.fk(path[-1])))
        path.append(np.array(come_closer(problem, target, path[-1], None, travel).q))
    return np.array(path)


def at_rest(arm, q, T, most):
    """Return where an arm comes to rest within some events of one hand, the very same joints in three more events.

    An event knows only the joints before it, so those that one of them leaves as they were stay for ever; the three
    more would show that this is no longer so.
    """
    path = follow(arm, q, [T])
    for _ in range(most):
        if path[-1].tolist() == path[-2].tolist():
            break
        path = follow(arm, path[-1], [T])
    assert np.ptp(follow(arm, path[-1], [T] * 3), axis=0).max() == 0.0
    return path[-1]


def displaced(arm, q, by):
    T = np.array(arm.fk(q))
    T[:3, 3] += arm.reach * np.array(by)
    return T


STRETCHED = [
    ("planar_2r", [0, 0], (-1, 0, 0)),
    ("planar_3r", [0, 0, 0], (-1, 0, 0)),
    ("elbow_3r", [0, 0, 0], (-1, 0, 0)),
    ("r4", [0, 0, 0, 0], (-1, 0, 0)),
    ("scara", [0, 0, 0, 0], (-1, 0, 0)),
    ("elbow_3r", [0, H, 0], (0, 0, -1)),
    ("ur10", [0, -H, 0, -H, 0, 0], (0, 0, -1)),
]


@pytest.mark.parametrize("distance", [1e-3, 0.03, 0.1])
@pytest.mark.parametrize(("key", "q", "direction"), STRETCHED)
def test_a_stretched_arm_follows_a_hand_pulling_inwards(key, q, direction, distance):
    arm = catalogue()[key].arm
    T = displaced(arm, q, distance * np.array(direction))
    assert ik.judge(arm, T, q).status == "moving"
    path = follow(arm, q, [T] * 8)
    verdict = ik.judge(arm, T, path[-1])
    assert verdict.reached, verdict
    assert path[-1].tolist() == path[-2].tolist()


@pytest.mark.parametrize("y", [0.2, -0.2])
def test_an_upright_polar_arm_turns_towards_the_hand(y):
    """Neither joint alone comes closer: the first turns about the line the tool is on, the second tilts sideways."""
    arm = catalogue()["polar_rrp"].arm
    q = np.array([0.0, H, 0.7])
    T = transform(position=arm.position([H, H - 0.3, 0.7]) * [1, np.sign(y), 1])
    assert ik.judge(arm, T, q).status == "moving"
    path = follow(arm, q, [T] * 8)
    assert ik.judge(arm, T, path[-1]).reached
    assert path[-1].tolist() == path[-2].tolist()


def test_a_hand_dragged_outwards_and_back_takes_the_arm_along():
    tool = TWO_R.position([0.4, 0.6])
    factors = np.concatenate([np.linspace(1.0, 2.0, 30), np.linspace(2.0, 0.5, 60)])
    path = follow(TWO_R, [0.4, 0.6], [transform(position=tool * factor) for factor in factors])
    np.testing.assert_allclose(TWO_R.position(path[-1]), 0.5 * tool, atol=1e-6)


@pytest.mark.parametrize("travel", [0.05, 0.01, 1e-3])
def test_the_first_step_off_a_balance_is_within_the_travel(travel):
    T = displaced(TWO_R, [0, 0], (-0.2, 0, 0))
    path = follow(TWO_R, [0, 0], [T] * 5, travel)
    steps = np.abs(np.diff(path, axis=0)).max(axis=1)
    assert steps.max() <= travel + 1e-12
    assert steps.min() > 0.3 * travel


def test_a_joint_a_hair_from_its_limit_does_not_keep_the_arm_on_a_balance():
    arm = Arm.from_dh(TWO_R.rows, limits=[[-3, 3], [-1e-5, 2.0]])
    T = displaced(arm, [0, 0], (-0.1, 0, 0))
    assert ik.judge(arm, T, follow(arm, [0, 0], [T] * 5)[-1]).reached


@pytest.mark.parametrize("seed", range(8))
def test_any_arm_comes_to_rest_for_any_target(seed):
    """Random arms and targets in and out of reach: the same joints again and again, and the verdict agrees."""
    rng = np.random.default_rng(seed)
    for k in range(2):
        arm = random_arm(rng, int(rng.integers(1, 8)), special=bool(k % 2))
        q, T = random_q(arm, rng), random_pose(rng)
        T[:3, 3] *= rng.choice([1.0, 10.0, 1000.0])
        T = feasible(arm, T, arm.fk(q))
        assert ik.judge(arm, T, at_rest(arm, q, T, 38)).status != "moving"


@pytest.mark.parametrize(("limits", "sign"), [([0.0, 2.0], 1), ([-2.0, 0.0], -1), ([-1.0, 2.0], 1), ([-2.0, 1.0], -1)])
def test_an_arm_bends_to_the_side_its_limits_leave(limits, sign):
    arm = Arm.from_dh(TWO_R.rows, limits=[[-3, 3], limits])
    T = displaced(arm, [0, 0], (-0.1, 0, 0))
    q = follow(arm, [0, 0], [T] * 5)[-1]
    assert ik.judge(arm, T, q).reached
    assert q[1] * sign > 0.1


def test_a_joint_that_cannot_bend_leaves_the_arm_at_rest():
    arm = Arm.from_dh(TWO_R.rows, limits=[[-3, 3], [0, 0]])
    T = displaced(arm, [0, 0], (-0.1, 0, 0))
    assert ik.judge(arm, T, [0, 0]).status == "closest"
    assert ik.judge(TWO_R, T, [0, 0], locked=[False, True]).status == "closest"
    assert follow(arm, [0, 0], [T] * 3).tolist() == [[0, 0]] * 4


def test_a_stretched_arm_pulled_outwards_is_at_rest():
    T = displaced(TWO_R, [0, 0], (0.3, 0, 0))
    assert ik.judge(TWO_R, T, [0, 0]).status == "beyond"
    assert follow(TWO_R, [0, 0], [T] * 3).tolist() == [[0, 0]] * 4


def test_the_same_hand_out_of_reach_leaves_the_very_same_joints(robot, rng):
    """No jitter and no creeping, however often the event comes again."""
    for _ in range(2):
        way = rng.normal(size=3)
        T = displaced(robot.arm, robot.home, 1.5 * way / np.linalg.norm(way))
        q = at_rest(robot.arm, robot.home, T, 20)
        assert ik.judge(robot.arm, feasible(robot.arm, T, robot.arm.fk(q)), q).status != "moving"


def test_a_small_distance_from_which_the_arm_could_move_is_not_the_closest():
    q = np.array([0.4, 0.9])
    assert ik.judge(TWO_R, TWO_R.fk(q + 1e-4), q).status == "moving"


@pytest.mark.parametrize("n", [2, 4, 6])
def test_slope_and_curvature_are_the_derivatives_of_half_the_squared_scaled_distance(n, rng):
    for k in range(4):
        arm = random_arm(rng, n, special=bool(k % 2))
        closest, target = closest_of(arm), TaskError(arm).target(random_pose(rng))
        q, free, h = random_q(arm, rng), [1.0] * n, 1e-6
        slope, H_, _ = closest.curve(q.tolist(), target, free)
        scales = np.where(arm.revolute, 1.0, arm.length_scale)
        steps = h * np.diag(scales)
        slopes = np.array([[closest.curve((q + s * d).tolist(), target, free)[0] for d in steps] for s in (1, -1)])
        np.testing.assert_allclose((slopes[1] - slopes[0]) / (2 * h), H_, rtol=0, atol=1e-7)
        np.testing.assert_allclose(slope, TaskError(arm).slope(q.tolist(), target, free)[0], rtol=0, atol=1e-12)
