"""Static forces: torques, wrenches about other points, virtual work, and what needs no torque."""

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.statics import duality, joint_torques, torque_free, virtual_work, wrench_at
from support.arms import random_arm, random_q, tool_by_products


def planar(*lengths):
    return Arm.from_dh([("R", length, 0, 0, 0) for length in lengths], task="xy")


def almost_singular(arm, rng):
    """Return a configuration with some joints within 1e-8 of 0 or of a quarter turn."""
    q = random_q(arm, rng)
    near = rng.random(arm.n) < 0.6
    return np.where(near, rng.choice([0.0, np.pi / 2]) + 1e-8 * rng.normal(size=arm.n), q)


def test_the_torques_of_the_2r_in_the_notes(truth):
    case = truth["C5.4-statics-2R"]
    inputs, expected = case["inputs"], case["expected"]
    arm = planar(inputs["l1"], inputs["l2"])
    J = arm.jacobian(inputs["q"])
    found = joint_torques(J[:2], inputs["F"])
    np.testing.assert_allclose(found, expected["tau"], rtol=0, atol=case["tol"])
    whole = joint_torques(J, [*inputs["F"], 0.0, 0.0, 0.0, 0.0])
    np.testing.assert_allclose(whole, expected["tau"], rtol=0, atol=case["tol"])
    work = virtual_work(J[:2], inputs["F"], [0.3, -0.2])
    assert work.joints - work.tool == pytest.approx(expected["virtual_work_check"], abs=case["tol"])


@pytest.mark.parametrize("n", [1, 2, 3, 6, 7])
def test_virtual_work_is_the_same_at_tool_and_joints(n, rng):
    """For random arms, at almost singular configurations too; by J, and by a small true motion of the tool."""
    for special in (False, True) * 5:
        arm = random_arm(rng, n, special=special)
        q = almost_singular(arm, rng)
        J, F = arm.jacobian(q), rng.normal(size=6)
        dq = rng.normal(size=n)
        work = virtual_work(J, F, dq)
        assert work.tool == pytest.approx(work.joints, abs=1e-9)
        h = 1e-6
        before, after = tool_by_products(arm, q - h * dq), tool_by_products(arm, q + h * dq)
        dp = (after[:3, 3] - before[:3, 3]) / (2.0 * h)
        S = (after[:3, :3] - before[:3, :3]) / (2.0 * h) @ tool_by_products(arm, q)[:3, :3].T
        turned = np.array([S[2, 1] - S[1, 2], S[0, 2] - S[2, 0], S[1, 0] - S[0, 1]]) / 2.0
        assert float(F @ [*dp, *turned]) == pytest.approx(work.joints, abs=1e-6)


def test_many_at_once_are_as_one_by_one(rng):
    arm = random_arm(rng, 5)
    q, F = random_q(arm, rng, 8), rng.normal(size=(8, 6))
    J = arm.jacobian(q)
    each = [joint_torques(J[i], F[i]) for i in range(8)]
    np.testing.assert_allclose(joint_torques(J, F), each, rtol=0, atol=1e-12)
    np.testing.assert_allclose(joint_torques(J, F[0]), [joint_torques(J[i], F[0]) for i in range(8)], atol=1e-12)


def test_the_power_of_a_wrench_does_not_depend_on_the_point(rng):
    for _ in range(100):
        F, twist, r = rng.normal(size=6), rng.normal(size=6), rng.normal(size=3)
        other = np.concatenate([twist[:3] + np.cross(twist[3:], r), twist[3:]])
        assert wrench_at(F, r) @ other == pytest.approx(F @ twist, abs=1e-12)
        np.testing.assert_allclose(wrench_at(wrench_at(F, r), -r), F, atol=1e-12)


def test_a_lever_by_hand():
    """5 N upwards 2 m along x from the point: about that point, −10 N m less."""
    np.testing.assert_allclose(wrench_at([0, 5, 0, 0, 0, 10], [2, 0, 0]), [0, 5, 0, 0, 0, 0], atol=1e-15)


@pytest.mark.parametrize("n", [1, 2, 3, 6, 7])
def test_the_four_subspaces_are_at_right_angles_and_together_everything(n, rng):
    for special in (False, True) * 5:
        arm = random_arm(rng, n, special=special)
        J = arm.jacobian(random_q(arm, rng))
        speeds = rng.uniform(0.2, 3.0, n)
        for rows, length in ((J, arm.length_scale), (J[:3], None), (J[3:], None)):
            found = duality(rows, length, speeds)
            m, rank = rows.shape[0], found.rank
            size = 1.0 + np.abs(rows).max()
            assert found.wrenches.shape == (m, m - rank)
            assert found.torques.shape == (n, rank)
            assert found.motions.shape == (n, n - rank)
            assert found.velocities.shape == (m, rank)
            np.testing.assert_allclose(joint_torques(rows, found.wrenches.T), 0.0, atol=1e-7 * size)
            np.testing.assert_allclose(rows @ found.motions, 0.0, atol=1e-7 * size)
            # Virtual power: a wrench without torque does no work on any possible motion, and so on.
            np.testing.assert_allclose(found.wrenches.T @ found.velocities, 0.0, atol=1e-9)
            np.testing.assert_allclose(found.torques.T @ found.motions, 0.0, atol=1e-9)
            assert np.linalg.matrix_rank(np.hstack([found.velocities, found.wrenches])) == m
            assert np.linalg.matrix_rank(np.hstack([found.torques, found.motions])) == n


def test_length_and_speeds_change_the_basis_but_not_the_space(rng):
    arm = random_arm(rng, 4)
    J = arm.jacobian(random_q(arm, rng))
    one = torque_free(J, 1.0)
    other = torque_free(J, 0.13, rng.uniform(0.1, 4.0, 4))
    assert one.shape == other.shape == (6, 2)
    assert np.linalg.matrix_rank(np.hstack([one, other]), tol=1e-9) == 2


def test_along_the_stretched_arm_a_force_needs_no_torque():
    J = planar(1.0, 1.0).jacobian([0.7, 0.0])
    found = torque_free(J[:3])
    assert found.shape == (3, 2)
    along = np.array([np.cos(0.7), np.sin(0.7), 0.0])
    np.testing.assert_allclose(found @ (found.T @ along), along, atol=1e-12)
    np.testing.assert_allclose(found @ (found.T @ [0.0, 0.0, 1.0]), [0.0, 0.0, 1.0], atol=1e-12)
    assert torque_free(planar(1.0, 1.0).jacobian([0.7, 0.5])[:2]).shape == (2, 0)


def test_a_planar_arm_carries_four_wrenches():
    """f_z, m_x, m_y always, and in the plane a force along the line through both axes."""
    arm = planar(1.0, 0.5)
    q = [0.4, 0.9]
    found = torque_free(arm.jacobian(q), arm.length_scale)
    assert found.shape == (6, 4)
    along = np.array([np.cos(0.4), np.sin(0.4), 0.0])
    carried = wrench_at([*along, 0.0, 0.0, 0.0], arm.position(q))
    np.testing.assert_allclose(joint_torques(arm.jacobian(q), carried), 0.0, atol=1e-12)
    assert np.linalg.matrix_rank(np.column_stack([found, carried]), tol=1e-9) == 4


def test_a_jacobian_of_zeros_has_no_rank():
    found = duality(np.zeros((3, 2)))
    assert found.rank == 0
    assert found.wrenches.shape == (3, 3)
    assert found.motions.shape == (2, 2)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: joint_torques(np.eye(3), [1.0, 2.0]), "wrench: expected 3 numbers"),
        (lambda: joint_torques([1.0, 2.0], [1.0]), "J: expected shape"),
        (lambda: wrench_at([1.0, 2.0], [0.0, 0.0, 0.0]), "wrench and r"),
        (lambda: virtual_work(np.eye(3), np.ones(3), np.ones(2)), "displacement: expected 3 numbers"),
        (lambda: duality(np.ones((6, 2))), "length"),
        (lambda: duality(np.ones((3, 2)), 1.0), "length: only all six rows"),
        (lambda: duality(np.ones((4, 2))), "one to three rows of one unit, or of six"),
        (lambda: duality(np.ones((3, 2)), speeds=[1.0, 0.0]), "speeds"),
        (lambda: duality([[np.nan, 0.0]]), "J: expected a finite matrix"),
        (lambda: duality(np.ones((6, 2)), length="a"), "length: expected metres"),
        (lambda: duality(np.ones((6, 2)), length=[1.0]), "length: expected metres"),
        (lambda: joint_torques(np.ones((2, 6, 3)), np.ones((4, 6))), r"J, wrench: .*\(2,\), \(4,\)"),
        (lambda: wrench_at(np.ones((2, 6)), np.ones((3, 3))), "wrench, r: expected as many of each"),
        (lambda: virtual_work(np.ones((2, 6, 3)), np.ones(6), np.ones((4, 3))), "J, wrench, displacement"),
    ],
)
def test_bad_input_is_refused_with_words(call, words):
    with pytest.raises(InputError, match=words):
        call()
