"""Closed forms of the commonest arms in plain floats: the branch near the start, then what the limits allow."""

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.ik.at_once import at_once
from armlab.kin.transforms import inverse
from support.arms import random_pose, random_q

KEYS = ("irb120", "irb140", "kr6r900", "puma560", "tx60", "ur10", "ur10_notes", "ur10e", "ur3e", "ur5e")
TURN = np.pi / 2


def arm_of_a_kind(rng: np.random.Generator, kind: str) -> Arm:
    """Return an arm of a kind with any lengths, offsets and senses of its axes."""
    a, d, theta = (rng.uniform(-0.6, 0.6, 6) for _ in range(3))
    right, flat = TURN * rng.choice([-1.0, 1.0], 6), np.pi * rng.integers(0, 2, 6)
    if kind == "wrist":
        a[3:], d[4] = 0.0, 0.0
        alpha = [right[0], flat[1], right[2], right[3], right[4], rng.uniform(-3, 3)]
    else:
        a[4] = 0.0
        alpha = [right[0], flat[1], flat[2], right[3], right[4], rng.uniform(-3, 3)]
    rows = [("R", *map(float, row)) for row in zip(a, alpha, d, theta, strict=True)]
    return Arm.from_dh(rows, base=random_pose(rng), tool=random_pose(rng))


def test_these_robots_have_it():
    assert tuple(key for key, robot in catalogue().robots.items() if at_once(robot.arm) is not None) == KEYS


@pytest.mark.parametrize("kind", ["wrist", "parallel"])
@pytest.mark.parametrize("seed", range(20))
def test_every_candidate_reaches_the_pose_and_the_first_is_on_the_branch_of_the_start(kind, seed):
    """Lengths are below 1 m; the angles of an elbow or wrist lose digits as one over the sine, here above 0.01."""
    rng = np.random.default_rng([seed, len(kind)])
    arm = arm_of_a_kind(rng, kind)
    solver = at_once(arm)
    for _ in range(20):
        q = rng.uniform(-np.pi, np.pi, 6)
        if np.linalg.svd(arm.jacobian(q), compute_uv=False)[-1] < 0.01:
            continue
        T = arm.fk(q)
        found = list(solver.solutions(inverse(arm.base) @ T, (q + rng.uniform(-1e-3, 1e-3, 6)).tolist()))
        assert 1 <= len(found) <= 8
        for one in found:
            np.testing.assert_allclose(arm.fk(one), T, rtol=0, atol=1e-9)
        np.testing.assert_allclose(np.exp(1j * np.array(found[0])), np.exp(1j * q), rtol=0, atol=1e-8)


@pytest.mark.parametrize("key", KEYS)
def test_it_finds_all_that_the_list_of_all_solutions_has(key):
    arm, rng = catalogue()[key].arm, np.random.default_rng(3)
    for _ in range(5):
        T = arm.fk(random_q(arm, rng))
        listed = ik.solve_all(arm, T)
        found = np.array(list(at_once(arm).solutions(inverse(arm.base) @ T, [0.0] * 6)))
        assert listed.completeness == "complete"
        assert len(found) == len(listed.q)
        for q in listed.q:
            assert np.abs(np.exp(1j * found) - np.exp(1j * q)).max(axis=1).min() < 1e-7


@pytest.mark.parametrize("key", KEYS)
def test_solve_without_a_start_takes_no_steps_and_stays_inside_the_limits(key):
    arm, rng = catalogue()[key].arm, np.random.default_rng(11)
    for k in range(50):
        T = arm.fk(random_q(arm, rng))
        found = ik.solve(arm, T, seed=k)
        assert found.success
        assert found.iterations == 0
        assert arm.within_limits(found.q)
        assert ik.judge(arm, T, found.q).reached
        assert ik.solve(arm, T, seed=k).q.tolist() == found.q.tolist()


@pytest.mark.parametrize("key", ["puma560", "irb120", "ur10e"])
@pytest.mark.parametrize("beside", [0.0, 1e-12, 1e-9, 1e-6, 1e-3])
def test_straight_elbows_and_wrists_are_reached(key, beside):
    arm, rng = catalogue()[key].arm, np.random.default_rng(5)
    for joints in ([2], [4], [2, 4]):
        q = random_q(arm, rng)
        q[joints] = beside
        found = ik.solve(arm, arm.fk(q))
        assert found.success
        assert ik.judge(arm, arm.fk(q), found.q).reached


def test_only_what_nobody_asked_otherwise_for_is_solved_so():
    """A start asks for the solution downhill of it, another method for its steps, and a record for steps, too."""
    arm = catalogue()["puma560"].arm
    T = arm.fk([0.3, -0.5, 0.5, 0.4, 0.7, -0.2])
    assert ik.solve(arm, T).iterations == 0
    assert ik.solve(arm, T, np.zeros(6)).iterations > 0
    assert ik.solve(arm, T, method="gauss_newton").iterations > 0
    assert ik.solve(arm, T, trace=True).iterations > 0


@pytest.mark.parametrize(
    "change",
    [("a", 4, 0.01), ("alpha", 0, 1e-3), ("alpha", 1, 1e-3), ("alpha", 3, 1e-3), ("alpha", 4, 1e-3)],
)
def test_an_arm_that_is_nearly_so_is_not_taken_for_one(change):
    arm = catalogue()["puma560"].arm
    assert at_once(arm) is not None
    field, i, by = change
    rows = [[row.kind, row.a, row.alpha, row.d, row.theta] for row in arm.rows]
    rows[i][{"a": 1, "alpha": 2}[field]] += by
    assert at_once(Arm.from_dh([tuple(row) for row in rows], arm.convention)) is None
