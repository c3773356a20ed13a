"""What can be reached inside the limits is reached, by one solution and by the list of all."""

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin import ik
from armlab.kin.arm import Arm
from support.arms import limited_arm, random_q


@pytest.mark.parametrize(
    ("n", "seed"),
    [(8, 7), (9, 4), (10, 2), (10, 3), (10, 4), (10, 7), (11, 0), (12, 2), (12, 5), (12, 7)],
)
def test_random_arms_with_limits_reach_what_is_inside_them(n, seed):
    """Descents that know no limits end inside them once in a hundred times here."""
    rng = np.random.default_rng([n, seed])
    arm = limited_arm(rng, n)
    for _ in range(3):
        T = arm.fk(random_q(arm, rng))
        found = ik.solve(arm, T)
        assert found.success
        assert arm.within_limits(found.q)
        assert ik.judge(arm, T, found.q).reached
        everything = ik.solve_all(arm, T)
        assert everything.within_limits.all()
        assert "limits" not in everything.sentence


@pytest.mark.parametrize("seed", [26, 83, 144, 268])
def test_a_long_arm_is_led_along_its_limits(seed):
    arm, rng = catalogue()["trunk9"].arm, np.random.default_rng(11)
    T = arm.fk(random_q(arm, rng, seed + 1)[-1])
    assert ik.solve(arm, T, seed=seed).success


def test_every_robot_reaches_its_poses(robot, rng):
    for k in range(10):
        T = robot.arm.fk(random_q(robot.arm, rng))
        found = ik.solve(robot.arm, T, seed=k)
        assert found.success
        assert not found.proven


def test_a_start_is_followed_inside_the_limits_before_others_are_tried():
    """The descent from the start alone leaves the limits; along them the start leads to a solution beside it."""
    arm = catalogue()["panda"].arm
    rng = np.random.default_rng(4)
    led = 0
    for _ in range(40):
        q = arm.clip(random_q(arm, rng) * 1.4)
        start = arm.clip(q + rng.normal(scale=0.05, size=arm.n))
        found = ik.solve(arm, arm.fk(q), start, searches=1, complete=False)
        led += found.success
        if found.success:
            assert float(np.abs(found.q - start).max()) < 1.0
    assert led >= 38


def test_the_same_seed_gives_the_same_answer_and_another_begins_elsewhere():
    arm = catalogue()["panda"].arm
    T = arm.fk([0.3, 0.2, -0.4, -1.5, 0.3, 1.9, 0.2])
    first, second = ik.solve(arm, T, seed=5), ik.solve(arm, T, seed=5)
    assert first.q.tobytes() == second.q.tobytes()
    assert first.iterations == second.iterations
    assert len({ik.solve(arm, T, seed=k).q.round(6).tobytes() for k in range(4)}) > 1


def test_a_pose_that_redundant_arms_cannot_reach_is_not_called_proven_without_a_proof():
    panda = catalogue()["panda"].arm
    middle = panda.limits.mean(axis=1, keepdims=True)
    arm = Arm.from_dh(panda.rows, panda.convention, limits=np.hstack([middle - 0.2, middle + 0.2]))
    found = ik.solve(arm, arm.fk(panda.limits[:, 0]), searches=10)
    assert not found.success
    assert not found.proven
    assert arm.within_limits(found.q)
    far = np.eye(4)
    far[0, 3] = 9.0
    assert ik.solve(arm, far, searches=10).proven


@pytest.mark.parametrize("degrees", [(0, 60, 60, 60, -180, 180, 30), (-60, -180, 150, 60, -30, 120, -60)])
def test_solutions_at_a_limit_are_kept_there(degrees):
    """All solutions inside have a joint exactly at its limit; polished freely they slip over it by 1e-8 rad."""
    arm = catalogue()["iiwa7"].arm
    found = ik.solve_all(arm, arm.fk(np.radians(degrees)))
    assert found.within_limits.all()
    assert np.any(np.abs(found.q[:, :, None] - arm.limits) < 1e-9)


@pytest.mark.parametrize(
    "q",
    [
        [1.772, 0.045, 0.0, 0.0, 0.429, -0.494, 1.208],
        [1.937, -0.521, 0.0, 0.0, -1.289, 0.435, 0.819],
        [1.771, 0.663, 0.0, 0.0, -0.026, 0.001, 1.834],
        [-0.42, -0.771, 0.0, 0.0, -0.431, 1.506, 1.671],
    ],
)
def test_a_straight_elbow_of_seven_joints_is_reached(q):
    """Axes 3 and 5 are then one line, and damped descents creep: each step takes a smaller part of the error away."""
    arm = catalogue()["gen3"].arm
    found = ik.solve(arm, arm.fk(q))
    assert found.success
    assert arm.within_limits(found.q)
    assert ik.judge(arm, arm.fk(q), found.q).reached


@pytest.mark.parametrize(
    "q",
    [
        [0.31, -1.85, 0.0, 0.0, -0.39, -1.01, 2.28],
        [1.54, -2.25, 0.0, 0.0, 1.96, 2.1, 0.9],
        [0.34, -1.46, 0.0, 0.0, 6.3, -2.1, 1.38],
        [-1.72, -0.23, 0.0, 0.0, 3.02, 0.87, 6.3],
        [1.11, -2.2497, 0.0, 0.0, 1.72, -1.75, -6.283],
    ],
)
def test_what_descents_creep_towards_is_found_along_their_valley(q):
    """The elbow is straight and its offsets in one plane: joints 3 and 5 turn far against each other for an error of
    1e-5, and every descent stops somewhere on the way, some of them at a limit."""
    arm = catalogue()["gen3"].arm
    T = arm.fk(arm.clip(np.array(q)))
    found = ik.solve(arm, T)
    assert found.success
    assert arm.within_limits(found.q)
    assert ik.judge(arm, T, found.q).reached
