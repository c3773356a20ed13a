"""Inverse kinematics: one solution, following a hand, and the verdict."""

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.ik.loop import wrapped
from armlab.kin.ik.solve import come_closer, problem_of
from armlab.kin.ik.target import feasible
from armlab.kin.ik.verdict import task_error_of
from armlab.kin.rotations import axis_angle, rotation_about
from armlab.kin.transforms import transform
from support.arms import random_arm, random_pose, random_q

H = np.pi / 2
TURN = 2 * np.pi
TWO_R = Arm.from_dh([("R", 1, 0, 0, 0), ("R", 1, 0, 0, 0)])
METHODS = list(ik.methods())


def controlled_difference(arm, T, q):
    """Return how far the tool is from a target in metres and radians, in the components of the task, by definition."""
    R0 = arm.base[:3, :3]
    tool = arm.fk(q)
    p = R0.T @ (tool[:3, 3] - T[:3, 3])
    position = np.linalg.norm(p[arm.task.coordinates])
    turn = R0.T @ tool[:3, :3].T @ T[:3, :3] @ R0
    if arm.task.rotation == "none":
        return position, 0.0
    if arm.task.rotation == "approach":
        cosine = tool[:3, 2] @ T[:3, 2]
        return position, np.arccos(np.clip(cosine, -1, 1))
    return position, float(axis_angle(turn)[1])


def test_every_robot_solves_its_own_poses(robot, rng):
    for k in range(40):
        T = robot.arm.fk(random_q(robot.arm, rng))
        result = ik.solve(robot.arm, T, seed=k)
        assert result.success, (robot.key, result.reason)
        assert robot.arm.within_limits(result.q)
        position, rotation = controlled_difference(robot.arm, T, result.q)
        assert position < 1e-6
        assert rotation < 2e-6
        assert result.reason == "reached"


@pytest.mark.parametrize("method", METHODS)
def test_every_method_solves_near_the_start(method, robot, rng):
    steps = 0
    for _ in range(5):
        spread = np.ptp(robot.arm.limits, axis=1) / 30
        q = robot.arm.clip(robot.arm.limits.mean(axis=1) + spread * rng.normal(size=robot.arm.n))
        T = robot.arm.fk(q)
        q0 = robot.arm.clip(q + 0.02 * rng.normal(size=robot.arm.n))
        problem = problem_of(robot.arm, ik.method_named(method))
        rest = come_closer(problem, problem.target(T), q0, [1.0] * robot.arm.n)
        before = task_error_of(robot.arm).at(q0.tolist(), problem.target(T))[2].cost
        assert rest.errors.cost < 0.25 * before
        steps += rest.iterations
    assert steps > 0


@pytest.mark.parametrize("n", [2, 3, 4, 5, 6, 7, 9])
def test_random_arms_solve_their_own_poses(n, rng):
    solved = 0
    for k in range(12):
        arm = random_arm(rng, n, special=bool(k % 2))
        T = arm.fk(random_q(arm, rng))
        result = ik.solve(arm, T, seed=k)
        solved += result.success
        if result.success:
            position, rotation = controlled_difference(arm, T, result.q)
            assert position < 1e-6
            assert rotation < 3e-6
    assert solved >= 11


def test_the_same_call_gives_the_same_answer():
    arm = Arm.from_dh([("R", 0.1, H, 0.2, 0)] * 6)
    T = arm.fk([0.3, -0.4, 0.5, 1.0, -0.8, 0.2])
    first, second = (ik.solve(arm, T, seed=7) for _ in range(2))
    assert first.q.tolist() == second.q.tolist()
    assert ik.solve(arm, T, seed=8).q.tolist() != first.q.tolist()


def test_the_solution_near_the_start_is_found():
    for q2 in (0.9, -0.9):
        result = ik.solve(TWO_R, TWO_R.fk([0.4, q2]), q0=[0.3, 0.8 * q2])
        np.testing.assert_allclose(result.q, [0.4, q2], rtol=0, atol=1e-7)


def test_angles_are_shifted_by_a_turn_into_the_limits():
    arm = Arm.from_dh(TWO_R.rows, limits=[[3.0, 4.0], [-1.0, 1.0]])
    result = ik.solve(arm, arm.fk([3.6, 0.5]))
    assert result.success
    np.testing.assert_allclose(result.q, [3.6, 0.5], rtol=0, atol=1e-6)


@pytest.mark.parametrize(
    ("near", "expected"),
    [
        ([0.0, 0.0, 0.0], [7.0 - TURN, 2.5 - TURN, 5.0]),
        ([6.0, 2.5, 0.0], [7.0, 2.5 - TURN, 5.0]),
        ([-9.0, -3.0, 0.0], [7.0 - 2 * TURN, 2.5 - TURN, 5.0]),
        ([99.0, 0.0, 0.0], [7.0, 2.5 - TURN, 5.0]),
    ],
)
def test_wrapping_takes_the_turn_nearest_to_a_value_inside_the_limits(near, expected):
    limits = np.array([[-10.0, 10.0], [-4.0, -3.0], [-1.0, 1.0]])
    q = wrapped([7.0, 2.5, 5.0], np.array(near), np.array([True, True, False]), limits)
    np.testing.assert_allclose(q, expected)


def test_wrapping_keeps_half_a_turn_positive_and_a_rounding_at_a_limit_in_its_turn():
    limits = np.array([[-np.pi, np.pi]] * 3)
    q = wrapped([-np.pi, np.pi, np.pi + 1e-12], np.array([0.0, 0.0, np.pi]), np.array([True] * 3), limits)
    np.testing.assert_allclose(q, [np.pi] * 3, rtol=0, atol=1e-11)


def test_a_start_that_is_a_solution_is_the_solution(rng):
    """Also where a joint is more than half a turn from its zero: the flange must not spin round."""
    arm = catalogue()["ur10"].arm
    q = np.radians([200.0, -100.0, 80.0, -250.0, 60.0, 200.0])
    np.testing.assert_allclose(ik.solve(arm, arm.fk(q), q0=q).q, q, rtol=0, atol=1e-12)
    near = ik.solve(arm, arm.fk(q), q0=q + 0.02 * rng.normal(size=6))
    np.testing.assert_allclose(near.q, q, rtol=0, atol=1e-5)


@pytest.mark.parametrize(
    ("limits", "low", "width"),
    [
        ([-10.0, 10.0], -np.pi, TURN),
        ([3.5, 5.5], 3.5, 2.0),
        ([-1.0, 20.0], -1.0, TURN),
        ([-20.0, 1.0], 1.0 - TURN, TURN),
        ([-0.5, 4.0], -0.5, 4.5),
        ([0.3, 0.3], 0.3, 0.0),
    ],
)
def test_random_starts_are_drawn_from_one_turn_inside_the_limits(limits, low, width):
    arm = Arm.from_dh([("R", 1, 0, 0, 0), ("P", 0, 0, 0, 0)], limits=[limits, [-9.0, 9.0]])
    starts = task_error_of(arm).starts
    np.testing.assert_allclose(starts, [[low, -9.0], [width, 18.0]], atol=1e-12)


def test_success_keeps_its_promise_whatever_the_size_of_the_arm(rng):
    arm = Arm.from_dh([("R", 4200.0, 0, 0, 0), ("R", 3200.0, 0, 0, 0)])
    for k in range(30):
        T = arm.fk(random_q(arm, rng))
        result = ik.solve(arm, T, seed=k)
        assert result.success
        assert result.position_error < 1e-6
        assert controlled_difference(arm, T, result.q)[0] < 1e-6


def test_out_of_reach_counts_the_controlled_coordinates_only():
    assert ik.judge(TWO_R, transform(position=[0.3, 0.0, 50.0]), [0.0, np.pi]).status == "moving"
    arm = Arm.from_dh(TWO_R.rows, limits=[[-0.1, 0.1], [0.0, 0.1]])
    result = ik.solve(arm, transform(position=[0.0, 1.5, 50.0]), q0=[0.0, 0.05], searches=3)
    assert result.verdict.status == "limit"
    far = transform(position=[3.0, 0.0, 0.0])
    assert ik.judge(TWO_R, far, [0.0, 0.0]).status == "beyond"


def test_held_joints_keep_their_value(rng):
    arm = Arm.from_dh([("R", 1, 0, 0, 0)] * 3, task="xy")
    q0 = np.array([0.2, 0.3, 0.4])
    result = ik.solve(arm, arm.fk([0.9, -0.5, 0.4]), q0=q0, locked=[False, False, True])
    assert result.success
    assert result.q[2] == 0.4


def test_all_joints_held_moves_nothing_and_says_so():
    result = ik.solve(TWO_R, TWO_R.fk([1.0, 1.0]), q0=[0.0, 0.5], locked=[True, True])
    assert not result.success
    assert result.q.tolist() == [0.0, 0.5]
    assert result.verdict.status == "closest"


def test_a_target_beyond_the_reach_gets_the_stretched_arm():
    T = transform(position=[3.0, 0.0, 0.0])
    result = ik.solve(TWO_R, T, q0=[0.5, 0.5])
    assert not result.success
    assert result.verdict.status == "beyond"
    assert result.position_error == pytest.approx(1.0, abs=1e-5)
    np.testing.assert_allclose(TWO_R.position(result.q)[:2], [2.0, 0.0], atol=1e-2)


def test_a_target_behind_a_limit_names_the_joint():
    arm = Arm.from_dh(TWO_R.rows, limits=[[-0.5, 0.5], [0.0, 0.1]])
    result = ik.solve(arm, TWO_R.fk([1.2, 0.05]), q0=[0.0, 0.05])
    assert not result.success
    assert result.verdict.status == "limit"
    assert result.verdict.limits[0] == 0
    assert result.reason.startswith("limit on joint")
    assert arm.within_limits(result.q)


def test_equal_limits_hold_a_joint():
    arm = Arm.from_dh(TWO_R.rows, limits=[[0.3, 0.3], [-3.0, 3.0]])
    result = ik.solve(arm, TWO_R.fk([0.3, 1.0]))
    assert result.success
    np.testing.assert_allclose(result.q, [0.3, 1.0], atol=1e-6)


def test_an_arm_without_lengths_is_told_apart_from_an_error():
    arm = Arm.from_dh([("R", 0, 0, 0, 0), ("R", 0, 0, 0, 0)], task="xy")
    result = ik.solve(arm, transform(position=[0.5, 0.0, 0.0]))
    assert not result.success
    assert result.position_error == pytest.approx(0.5)


@pytest.mark.parametrize("distance", [1e3, 1e6, 1e200, 1e308])
def test_a_target_far_away_is_an_answer_not_an_error(robot, distance):
    T = np.array(robot.arm.fk(robot.home))
    T[0, 3] += distance
    result = ik.solve(robot.arm, T, q0=robot.home, searches=3)
    assert not result.success
    assert np.all(np.isfinite(result.q))
    assert robot.arm.within_limits(result.q)


@pytest.mark.parametrize("method", METHODS)
def test_half_a_turn_is_not_mistaken_for_reached(method):
    """The error vector of a turn by exactly 180 degrees vanishes; the angle does not."""
    arm = Arm.from_dh([("R", 0.1, H, 0.2, 0), ("R", 0.4, 0, 0, 0), ("R", 0, H, 0, 0)] * 2)
    q = np.array([0.3, 0.4, -0.5, 0.6, 0.7, -0.2])
    T = arm.fk(q)
    T[:3, :3] = T[:3, :3] @ rotation_about("z", np.pi)
    errors = task_error_of(arm).at(q.tolist(), task_error_of(arm).target(T))[2]
    assert errors.rotation == pytest.approx(np.pi, abs=1e-6)
    assert not ik.judge(arm, T, q).reached
    result = ik.solve(arm, T, q0=q, method=method, searches=40)
    position, rotation = controlled_difference(arm, T, result.q)
    assert result.success == (position < 1e-6 and rotation < 2e-6)


@pytest.mark.parametrize(
    ("T", "arguments", "text"),
    [
        (np.full((4, 4), np.nan), {}, "T: every entry must be finite"),
        (np.diag([1.0, 1.0, -1.0, 1.0]), {}, "T: .* not a rotation"),
        (np.eye(4), {"q0": [0.0]}, "q0: expected 2 finite numbers"),
        (np.eye(4), {"q0": [0.0, np.inf]}, "q0: expected 2 finite numbers"),
        (np.eye(4), {"locked": [True, False]}, "locked: give q0"),
        (np.eye(4), {"q0": "a"}, "q0: expected 2 finite numbers, got 'a'"),
        (np.eye(4), {"q0": [[0.0], [0.0, 1.0]]}, "q0: expected 2 finite numbers"),
        (np.eye(4), {"q0": [0.0, 10**400]}, "q0: expected 2 finite numbers"),
        (np.eye(4), {"q0": [0.0, 0.0], "locked": [True]}, r"locked: expected 2 times True or False, got \[True\]"),
        (np.eye(4), {"q0": [0.0, 0.0], "locked": True}, "locked: expected 2 times True or False, got True"),
        (np.eye(4), {"seed": -1}, "seed: expected a whole number, at least 0, got -1"),
        (np.eye(4), {"seed": "a"}, "seed: expected a whole number, at least 0, got 'a'"),
        (np.eye(4), {"searches": 0}, "searches: expected a whole number, at least 1, got 0"),
        (np.eye(4), {"method": "magic"}, "method: unknown name 'magic'.*Available: broyden, ccd, dls, dls_bias"),
    ],
)
def test_wrong_input_is_named(T, arguments, text):
    with pytest.raises(InputError, match=text):
        ik.solve(TWO_R, T, **arguments)


@pytest.mark.parametrize(
    ("T", "q", "locked", "text"),
    [
        (np.eye(3), [0.0, 0.0], None, r"T: expected shape \(4, 4\), got \(3, 3\)"),
        (np.eye(4), [0.0], None, r"q: expected 2 finite numbers, got \[0\]"),
        (np.eye(4), [0.0, np.nan], None, r"q: expected 2 finite numbers, got \[0, nan\]"),
        (np.eye(4), [0.0, 0.0], [True] * 3, "locked: expected 2 times True or False"),
    ],
)
def test_a_verdict_names_wrong_input(T, q, locked, text):
    with pytest.raises(InputError, match=text):
        ik.judge(TWO_R, T, q, locked)


def test_the_scaled_jacobian_is_the_slope_of_the_scaled_error(robot, rng):
    """Where the error is small, e changes by -J dq: the linearisation every method rests on."""
    arm = robot.arm
    q = random_q(arm, rng)
    dq = 1e-6 * rng.normal(size=arm.n)
    task = task_error_of(arm)
    target = task.target(arm.fk(q))
    J, e, _ = task.at((q + dq).tolist(), target)
    scaled = np.where(arm.revolute, dq, dq / arm.length_scale)
    np.testing.assert_allclose(e, -J @ scaled, rtol=0, atol=1e-10)


def follow(arm, q, targets, travel=0.6):
    """Follow a hand as the lab does; returns all configurations."""
    problem = problem_of(arm, ik.method_named("dls"))
    path = [np.array(q)]
    for T in targets:
        reachable = feasible(arm, T, arm.fk(path[-1]))
        path.append(np.array(come_closer(problem, problem.target(reachable), path[-1], [1.0] * arm.n, travel).q))
    return np.array(path)


def test_no_drag_makes_an_arm_jump_or_leave_its_limits(robot, rng):
    """Wild targets, far outside and through singular poses: every step is bounded, finite and inside."""
    arm = robot.arm
    start = np.array(arm.fk(robot.home))
    t = np.arange(0, 120, 3)[:, None]
    course = start[:3, 3] + arm.reach * np.sin(t * [0.11, 0.07, 0.05] + [0.0, 1.0, 2.0]) - arm.reach * np.sin([0, 1, 2])
    targets = []
    for k, p in enumerate(course):
        T = start.copy()
        T[:3, 3] = p
        T[:3, :3] = rotation_about("xyz"[k % 3], 0.05 * k) @ T[:3, :3]
        targets.append(T)
    path = follow(arm, robot.home, targets)
    assert np.all(np.isfinite(path))
    scale = np.where(arm.revolute, 1.0, arm.length_scale)
    assert np.max(np.abs(np.diff(path, axis=0)) / scale) <= 0.6 + 1e-12
    assert all(arm.within_limits(q) for q in path)


def test_a_resting_hand_out_of_reach_leaves_the_arm_at_rest(robot):
    """No jitter: following the same unreachable target again and again moves the tool by nothing one could see."""
    arm = robot.arm
    T = np.array(arm.fk(robot.home))
    T[:3, 3] += arm.reach * np.array([0.7, -0.5, 0.6])
    path = follow(arm, robot.home, [T] * 60)
    tool = arm.position(path[-20:])
    assert np.max(np.ptp(tool, axis=0)) < 1e-4 * arm.reach


def test_a_drag_keeps_its_branch():
    arm = Arm.from_dh(TWO_R.rows, limits=[[-3.1, 3.1], [-3.1, 3.1]])
    angles = np.linspace(0.0, 2.0, 60)
    targets = [transform(position=[1.2 * np.cos(a), 1.2 * np.sin(a), 0]) for a in angles]
    path = follow(arm, ik.solve(arm, targets[0], q0=[-0.5, 1.5]).q, targets)
    assert np.all(path[:, 1] > 0.5)


def test_the_closest_configuration_is_a_minimum(rng):
    """No random neighbour of where the arm comes to rest is closer to an unreachable target."""
    rows = [("R", 0, H, 0.6, 0), ("R", 0.8, 0, 0, 0), ("R", 0.5, 0, 0, 0)]
    arm = Arm.from_dh(rows, limits=[[-2, 2], [-1, 2], [-2, 2]])
    T = transform(position=[1.5, 1.0, 1.5])
    problem = problem_of(arm, ik.method_named("dls"))
    rest = np.array(come_closer(problem, problem.target(T), [0.1, 0.5, -0.8], [1.0] * 3).q)
    distance = np.linalg.norm(arm.position(rest) - T[:3, 3])
    neighbours = arm.clip(rest + 0.02 * rng.normal(size=(2000, 3)))
    distances = np.linalg.norm(arm.position(neighbours) - T[:3, 3], axis=1)
    assert distances.min() > distance - 1e-6


def test_targets_are_brought_to_what_the_arm_controls(rng):
    scara = Arm.from_dh([("R", 0.3, 0, 0.4, 0), ("R", 0.2, np.pi, 0, 0), ("P", 0, 0, 0, 0), ("R", 0, 0, 0, 0)])
    tool = scara.fk([0.2, 0.3, 0.1, 0.4])
    wanted = random_pose(rng)
    T = feasible(scara, wanted, tool)
    np.testing.assert_allclose(T[:3, 3], wanted[:3, 3])
    np.testing.assert_allclose(T[:3, 2], [0, 0, -1], atol=1e-12)
    approach = Arm.from_dh([("R", 0.1, H, 0.1, 0)] * 5, task="xyz approach")
    np.testing.assert_allclose(feasible(approach, wanted, approach.fk([0.1] * 5)), wanted)
    planar = feasible(TWO_R, wanted, TWO_R.fk([0.1, 0.2]))
    np.testing.assert_allclose(planar[:3, 3], [*wanted[:2, 3], 0.0])
    np.testing.assert_allclose(planar[:3, :3], TWO_R.fk([0.1, 0.2])[:3, :3])


def test_targets_of_a_tilted_base_are_taken_in_its_axes():
    base = transform(rotation_about("x", H), [0.0, 0.0, 0.5])
    arm = Arm.from_dh(TWO_R.rows, base=base)
    result = ik.solve(arm, arm.fk([0.4, 0.9]), q0=[0.3, 0.8])
    np.testing.assert_allclose(result.q, [0.4, 0.9], atol=1e-6)
    moved = feasible(arm, transform(position=[1.0, 0.7, 1.0]), arm.fk([0.1, 0.2]))
    np.testing.assert_allclose(moved[:3, 3], [1.0, 0.0, 1.0], atol=1e-12)
