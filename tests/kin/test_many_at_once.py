"""Batches of configurations: the same error and Jacobian as the compiled formulas, and what searches find with them."""

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.ik.many_at_once import damped_steps, many_at_once
from armlab.kin.ik.many_starts import many_starts
from armlab.kin.ik.verdict import task_error_of
from armlab.kin.transforms import inverse
from support.arms import random_arm, random_pose, random_q
from support.solutions import contains


@pytest.mark.parametrize("task", [None, "xyz", "pose", "xy", "xy phi", "xyz approach"])
def test_error_and_jacobian_are_those_of_the_formulas(task, rng):
    for k in range(12):
        arm = random_arm(rng, int(rng.integers(1, 9)), special=k % 2 == 0)
        if task is not None:
            arm = Arm.from_dh(arm.rows, arm.convention, base=arm.base, tool=arm.tool, task=task)
        T, q = random_pose(rng), random_q(arm, rng, 4)
        J, e = many_at_once(arm).linearised(q, np.asarray(inverse(arm.base) @ T))
        formulas = task_error_of(arm)
        for row, jacobian, error in zip(q, J, e, strict=True):
            wanted_J, wanted_e, _ = formulas.at(row.tolist(), formulas.target(T))
            assert np.allclose(jacobian, wanted_J, atol=1e-11)
            assert np.allclose(error, wanted_e, atol=1e-9)


def test_damped_steps_are_the_formula(rng):
    J, e = rng.normal(size=(5, 3, 7)), rng.normal(size=(5, 3))
    for damping in (0.3, rng.uniform(0.1, 1.0, 5)):
        mu = np.broadcast_to(damping, 5)
        for k, step in enumerate(damped_steps(J, e, damping)):
            assert np.allclose(step, J[k].T @ np.linalg.inv(J[k] @ J[k].T + mu[k] * np.eye(3)) @ e[k])


@pytest.mark.parametrize("key", ["stanford", "puma560", "elbow_3r"])
def test_searches_arrive_and_find_what_is_known(key, rng):
    arm = catalogue()[key].arm
    q = random_q(arm, rng)
    G = np.asarray(inverse(arm.base) @ arm.fk(q))
    found = many_starts(arm, G)
    assert len(found) > 100
    assert contains(arm, found, q, 1e-4)
    error = many_at_once(arm).linearised(found, G)[1]
    assert np.linalg.norm(error, axis=1).max() < 2e-7
    assert many_starts(arm, G).tobytes() == found.tobytes()
    assert many_starts(arm, G, seed=1).tobytes() != found.tobytes()


def test_held_joints_do_not_move(rng):
    arm = catalogue()["panda"].arm
    q = random_q(arm, rng)
    found = many_starts(arm, np.asarray(inverse(arm.base) @ arm.fk(q)), held={2: float(q[2])})
    assert len(found) > 0
    assert np.all(found[:, 2] == q[2])


def test_out_of_reach_nothing_arrives():
    assert many_starts(catalogue()["puma560"].arm, np.diag([1.0, 1.0, 1.0, 1.0]) + 9.0 * np.eye(4, k=3)).shape == (0, 6)


def test_an_arm_that_is_exactly_singular_has_steps_however_small_the_damping():
    J, e = np.array([[[1.0, 2.0, 3.0]] * 2, [[1e6, 0.0, 0.0]] * 2]), np.array([[1.0, 1.0], [2.0, 2.0]])
    for damping in (1e-30, np.array([1e-15, 1e-18])):
        steps = damped_steps(J, e, damping)
        np.testing.assert_allclose(np.einsum("kmn,kn->km", J, steps), e, rtol=1e-9)
