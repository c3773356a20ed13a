"""Inverses of the differential kinematics: what each is by definition, at regular and at singular matrices."""

import math

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.control.decomposed import decomposed, null_directions
from armlab.kin.control.null_term import projected, self_motion
from armlab.kin.control.rate_inverse import rate_inverse, rate_inverses, rate_step
from armlab.kin.control.saturation import saturate
from armlab.kin.control.scaled_task import ScaledTask, turn_vector
from armlab.kin.ik.iterate.problem import Problem
from armlab.kin.ik.iterate.task_vector import TaskVector
from armlab.kin.rotations import rotation_from_axis_angle
from armlab.kin.spare import task_jacobian
from support.arms import random_pose, random_q

SINGULAR = [[-2.0, -1.0], [0.0, 0.0]]


def shapes(rng):
    """Random matrices of many shapes, every third of them almost without full rank."""
    for m, n in ((1, 1), (2, 2), (2, 3), (3, 2), (6, 6), (6, 7), (1, 4), (5, 2)):
        for k in range(6):
            J = rng.normal(size=(m, n))
            if k % 3 == 2:
                U, sigma, Vt = np.linalg.svd(J, full_matrices=False)
                sigma[-1] *= 10.0 ** -rng.integers(3, 12)
                J = U @ np.diag(sigma) @ Vt
            yield J, rng.normal(size=m)


# -- truth cases -----------------------------------------------------------------------------------------------------


def test_c521_damped_least_squares_is_the_same_from_both_sides(truth):
    case = truth["C5.2.1-dls-identity"]
    J, v, damping = np.array(case["inputs"]["J"]), case["inputs"]["v"], case["inputs"]["lam"]
    step = rate_step("dls_constant", J, v, {"lambda": damping})
    np.testing.assert_allclose(step.qdot, case["expected"]["qdot"], rtol=0, atol=case["tol"])
    other = np.linalg.solve(damping * np.eye(3) + J.T @ J, J.T @ v)
    np.testing.assert_allclose(step.qdot, other, rtol=0, atol=1e-12)
    assert step.damping == damping


def test_c522_pseudo_inverse_of_the_3r(truth):
    case = truth["C5.2.2-pinv-3R"]
    step = rate_step("pinv", case["inputs"]["J"], case["inputs"]["v"])
    np.testing.assert_allclose(step.qdot, case["expected"]["qdot"], rtol=0, atol=case["tol"])
    assert np.linalg.norm(step.qdot) == pytest.approx(case["expected"]["norm"], abs=case["tol"])
    columns = [rate_step("pinv", case["inputs"]["J"], e).qdot for e in np.eye(2)]
    np.testing.assert_allclose(np.transpose(columns), case["expected"]["Jpinv"], rtol=0, atol=case["tol"])


def test_c523_null_space_term_leaves_the_tool_alone(truth):
    case = truth["C5.2.3-nullspace"]
    J, v, xi = (np.array(case["inputs"][name]) for name in ("J", "v", "xi"))
    qdot = rate_step("pinv", J, v).qdot + projected(J, xi)
    np.testing.assert_allclose(qdot, case["expected"]["qdot"], rtol=0, atol=case["tol"])
    np.testing.assert_allclose(J @ qdot, case["expected"]["Jqdot"], rtol=0, atol=case["tol"])


@pytest.mark.parametrize("name", ["C5.2.3-sing2R-30", "C5.2.3-sing2R-90"])
def test_c523_stretched_2r_realises_the_projection(truth, name):
    case = truth[name]
    J = np.array(case["expected"]["J"])
    step = rate_step("pinv", J, case["inputs"]["v"])
    np.testing.assert_allclose(step.qdot, case["expected"]["qdot"], rtol=0, atol=case["tol"])
    np.testing.assert_allclose(J @ step.qdot, case["expected"]["v_perp"], rtol=0, atol=case["tol"])
    assert step.sigma_min == pytest.approx(0.0, abs=1e-15)


def test_c521_what_the_plain_inverse_would_command_at_the_closest_point(truth):
    case = truth["C5.2.1-dls-plain-peak"]
    along = math.radians(case["inputs"]["direction_deg"])
    v = 0.6 * np.array([math.cos(along), math.sin(along)])
    away = 1.9 * math.sin(along)
    # At its foot the line is across the arm, whose two links are almost folded.
    q2 = math.acos((away**2 - 2.0) / 2.0)
    foot = 1.9 * np.array([1.0, 0.0]) - 1.9 * math.cos(along) * np.array([math.cos(along), math.sin(along)])
    q1 = math.atan2(foot[1], foot[0]) - q2 / 2.0
    J = [
        [-math.sin(q1) - math.sin(q1 + q2), -math.sin(q1 + q2)],
        [math.cos(q1) + math.cos(q1 + q2), math.cos(q1 + q2)],
    ]
    peak = abs(math.degrees(rate_step("inverse", J, v).qdot[0]))
    assert peak == pytest.approx(case["expected"]["qd1_at_closest_deg_s"], rel=1e-9)


# -- definitions -----------------------------------------------------------------------------------------------------


def test_the_pseudo_inverse_is_that_of_numpy_and_meets_penrose(rng):
    for J, v in shapes(rng):
        n = J.shape[1]
        X = np.transpose([rate_step("pinv", J, e, {"cutoff": 1e-10}).qdot for e in np.eye(len(J))]).reshape(n, len(J))
        # Digits are lost with the condition of J.
        loss = 1e-13 * np.linalg.cond(J)
        np.testing.assert_allclose(X, np.linalg.pinv(J, rcond=1e-10), rtol=loss, atol=loss * np.abs(X).max())
        np.testing.assert_allclose(X @ v, rate_step("pinv", J, v, {"cutoff": 1e-10}).qdot, rtol=1e-6, atol=loss)
        np.testing.assert_allclose(J @ X @ J, J, rtol=0, atol=1e-9 + loss)


def test_the_inverse_is_the_inverse_or_says_why_there_is_none(rng):
    for J, v in shapes(rng):
        step = rate_step("inverse", J, v)
        m, n = J.shape
        if m != n:
            assert step.qdot is None
            assert f"{m} × {n}" in step.says
        else:
            np.testing.assert_allclose(J @ step.qdot, v, rtol=0, atol=1e-12 * np.linalg.cond(J))
    none = rate_step("inverse", SINGULAR, [1.0, 0.0])
    assert none.qdot is None
    assert "J⁻¹ does not exist" in none.says


@pytest.mark.parametrize("key", ["pinv", "dls_constant", "dls_variable", "weighted", "transpose"])
@pytest.mark.parametrize("J", [SINGULAR, [[0.0, 0.0], [0.0, 0.0]], [[1e-9, 0.0], [0.0, 0.0]]])
@pytest.mark.parametrize("v", [[1.0, 0.5], [0.0, 1.0], [0.0, 0.0]])
def test_all_others_have_finite_joint_speeds_at_singular_matrices(key, J, v):
    step = rate_step(key, J, v)
    assert np.isfinite(step.qdot).all()
    assert step.says == ""
    assert np.isfinite(step.sigma_min)


def test_damping_minimises_both_squares(rng):
    for J, v in shapes(rng):
        damping = float(rng.uniform(0.001, 0.5))
        qdot = rate_step("dls_constant", J, v, {"lambda": damping}).qdot

        def cost(x, J=J, v=v, damping=damping):
            return damping * x @ x + (J @ x - v) @ (J @ x - v)

        least = cost(qdot)
        for _ in range(5):
            assert cost(qdot + 1e-3 * rng.normal(size=len(qdot))) > least


def test_variable_damping_is_none_in_the_open_and_largest_at_a_singularity():
    options = {"lambda_max": 0.02, "epsilon": 0.5}
    assert rate_step("dls_variable", np.diag([2.0, 0.6]), [1.0, 1.0], options).damping == 0.0
    assert rate_step("dls_variable", np.diag([2.0, 0.25]), [1.0, 1.0], options).damping == pytest.approx(0.015)
    assert rate_step("dls_variable", SINGULAR, [1.0, 1.0], options).damping == pytest.approx(0.02)
    plain = rate_step("dls_variable", np.diag([2.0, 0.6]), [1.0, 1.0], options).qdot
    np.testing.assert_allclose(plain, [0.5, 1.0 / 0.6])


def test_weights_minimise_their_own_norm_and_make_no_difference_without_redundancy(rng):
    J, v, w = rng.normal(size=(2, 4)), rng.normal(size=2), rng.uniform(0.1, 10.0, 4)
    qdot = rate_step("weighted", J, v, {"weights": w.tolist()}).qdot
    expected = np.linalg.inv(np.diag(w)) @ J.T @ np.linalg.solve(J @ np.linalg.inv(np.diag(w)) @ J.T, v)
    np.testing.assert_allclose(qdot, expected, rtol=1e-12)
    N = null_directions(J, 1e-9)
    assert np.abs(N.T @ (w * qdot)).max() < 1e-12  # no change in the null space makes it shorter
    square = rng.normal(size=(3, 3))
    one = rate_step("weighted", square, [1.0, 2.0, 3.0], {"weights": [1.0, 50.0, 0.1]}).qdot
    np.testing.assert_allclose(one, np.linalg.solve(square, [1.0, 2.0, 3.0]), rtol=1e-9)
    with pytest.raises(InputError, match="expected 4 positive numbers"):
        rate_step("weighted", J, v, {"weights": [1.0, 2.0]})


def test_weights_however_far_apart_lose_no_direction_of_a_regular_matrix():
    far = {"weights": [1e-6, 1e6]}
    np.testing.assert_allclose(rate_step("weighted", np.diag([1.0, 0.5]), [1.0, 1.0], far).qdot, [1.0, 2.0])
    tall = [[1.0, 0.0], [0.0, 0.5], [0.0, 0.0]]
    np.testing.assert_allclose(rate_step("weighted", tall, [1.0, 1.0, 1.0], far).qdot, [1.0, 2.0])
    wide = [[1.0, 0.0, 0.0], [0.0, 0.5, 0.0]]
    qdot = rate_step("weighted", wide, [1.0, 1.0], {"weights": [1e-6, 1e6, 1.0]}).qdot
    np.testing.assert_allclose(qdot, [1.0, 2.0, 0.0], rtol=1e-9, atol=1e-12)


def test_the_transpose_takes_the_step_size_that_serves_best(rng):
    J, v = rng.normal(size=(3, 5)), rng.normal(size=3)
    qdot = rate_step("transpose", J, v).qdot
    best = np.linalg.norm(J @ qdot - v)
    for factor in (0.9, 1.1):
        assert np.linalg.norm(factor * J @ qdot - v) > best
    np.testing.assert_allclose(rate_step("transpose", J, v, {"alpha": 0.3}).qdot, 0.3 * J.T @ v)
    assert rate_step("transpose", SINGULAR, [0.0, 1.0]).qdot.tolist() == [0.0, 0.0]


def test_decomposition_and_null_space_of_any_shape(rng):
    for J, _ in shapes(rng):
        found = decomposed(J)
        np.testing.assert_allclose((found.U * found.sigma) @ found.Vt, J, rtol=0, atol=1e-13)
        assert found.sigma_min == pytest.approx(np.linalg.svd(J, compute_uv=False)[-1], rel=1e-6, abs=1e-14)
        N = null_directions(J, 1e-6)
        assert N.shape[1] == J.shape[1] - np.linalg.matrix_rank(J, tol=1e-6 * found.sigma[0])
        np.testing.assert_allclose(N.T @ N, np.eye(N.shape[1]), atol=1e-12)
    assert decomposed(np.zeros((0, 3))).sigma_min == 0.0
    assert decomposed(np.zeros((0, 3))).singular
    assert rate_step("pinv", np.zeros((0, 3)), np.zeros(0)).qdot.tolist() == [0.0, 0.0, 0.0]


def test_wrong_arguments_are_refused_in_words():
    with pytest.raises(InputError, match="unknown name 'qr'"):
        rate_step("qr", SINGULAR, [1.0, 1.0])
    with pytest.raises(InputError, match="expected 2 finite numbers"):
        rate_step("pinv", SINGULAR, [1.0])
    with pytest.raises(InputError, match="J: expected a matrix"):
        rate_step("pinv", [[np.nan, 1.0]], [1.0])
    with pytest.raises(InputError, match="options of dls_constant"):
        rate_step("dls_constant", SINGULAR, [1.0, 1.0], {"mu": 1.0})
    with pytest.raises(InputError, match="lambda: expected"):
        rate_step("dls_constant", SINGULAR, [1.0, 1.0], {"lambda": -1.0})


def test_every_method_is_described():
    assert list(rate_inverses()) == ["inverse", "pinv", "dls_constant", "dls_variable", "weighted", "transpose"]
    for key, method in rate_inverses().items():
        assert rate_inverse(key) is method
        assert method.title
        assert method.formula


# -- the task of an arm ----------------------------------------------------------------------------------------------


def test_task_jacobian_and_scale_are_those_of_the_iterations(robot, rng):
    arm = robot.arm
    task = ScaledTask(arm)
    problem = Problem(arm, np.asarray(arm.fk(robot.home)), TaskVector(arm.task), range(arm.n))
    q = np.asarray(random_q(arm, rng), dtype=float)
    J = task.jacobian(q)
    lengths = np.where(np.arange(task.m) < len(arm.task.position), arm.length_scale, 1.0)
    np.testing.assert_allclose(J / lengths[:, None], task_jacobian(arm, q), atol=1e-12)
    np.testing.assert_allclose(task.scaled(J), problem.at(q[None]).J[0], atol=1e-12)
    np.testing.assert_allclose(task.jacobians(q[None], arm.fk(q)[None])[0], task.scaled(J), atol=1e-12)


def test_task_errors_are_those_of_the_iterations(robot, rng):
    arm = robot.arm
    task = ScaledTask(arm)
    for _ in range(5):
        q, goal = np.asarray(random_q(arm, rng), dtype=float), np.asarray(arm.fk(random_q(arm, rng)))
        problem = Problem(arm, goal, TaskVector(arm.task), range(arm.n))
        expected = problem.at(q[None]).misfit.components[0]
        np.testing.assert_allclose(task.error(goal, arm.fk(q)), expected, atol=1e-9)
        np.testing.assert_allclose(task.errors(goal[None], arm.fk(q)[None])[0], expected, atol=1e-9)


def test_a_twist_of_joint_speeds_is_the_task_velocity(robot, rng):
    arm = robot.arm
    task, q = ScaledTask(arm), np.asarray(random_q(arm, rng), dtype=float)
    qdot = rng.normal(size=arm.n)
    twist = arm.jacobian(q) @ qdot
    np.testing.assert_allclose(task.rows(arm.fk(q)[:3, :3]) @ twist, task.jacobian(q) @ qdot, atol=1e-12)


def test_rotation_vectors_up_to_half_a_turn(rng):
    for angle in (0.0, 1e-13, 1e-7, 0.4, 3.0, math.pi - 1e-8, math.pi):
        axis = rng.normal(size=3)
        axis /= np.linalg.norm(axis)
        found = turn_vector(rotation_from_axis_angle(axis, angle))
        assert np.linalg.norm(found) == pytest.approx(angle, abs=1e-8)
        np.testing.assert_allclose(np.abs(found @ axis), angle, atol=1e-7)
    assert random_pose(rng).shape == (4, 4)


def test_self_motion_moves_joints_and_not_the_task(rng):
    from armlab.content.robots import catalogue

    arm = catalogue()["iiwa7"].arm
    task, q = ScaledTask(arm), np.asarray(random_q(arm, rng), dtype=float)
    J = task.scaled(task.jacobian(q))
    for key in ("middle", "manipulability"):
        motion = self_motion(key, task, q, J)
        assert np.linalg.norm(motion) > 1e-6
        np.testing.assert_allclose(J @ motion, 0.0, atol=1e-12)
    up = self_motion("manipulability", task, q, J)

    def w(at):
        return np.prod(np.linalg.svd(task.scaled(task.jacobian(at)), compute_uv=False))

    assert w(q + 1e-4 * up / np.linalg.norm(up)) > w(q)
    puma = catalogue()["puma560"].arm
    six, q6 = ScaledTask(puma), np.array([0.3, 0.4, -0.8, 0.5, 0.6, 0.7])
    assert self_motion("middle", six, q6, six.scaled(six.jacobian(q6))).tolist() == [0.0] * 6


# -- saturation ------------------------------------------------------------------------------------------------------


def test_each_joint_by_itself_bends_the_direction_and_all_alike_keep_it():
    qdot, limits = np.array([4.0, -1.0, 0.5]), np.array([2.0, 2.0, np.inf])
    clipped, changed = saturate("clip", qdot, limits)
    assert (clipped.tolist(), changed) == ([2.0, -1.0, 0.5], True)
    scaled, changed = saturate("scale", qdot, limits)
    assert (scaled.tolist(), changed) == ([2.0, -0.5, 0.25], True)
    for key in ("clip", "scale"):
        inside = np.array([1.0, 1.0, 7.0])
        assert np.array_equal(saturate(key, inside, limits).qdot, inside)
        assert not saturate(key, inside, limits).changed
    assert np.array_equal(saturate("none", qdot, limits).qdot, qdot)


@pytest.mark.parametrize("key", ["none", "clip", "scale"])
def test_joint_speeds_are_limited_in_a_known_way_and_may_be_lists(key):
    speeds = {"none": [2.0, 1.0], "clip": [1.0, 1.0], "scale": [1.0, 0.5]}
    assert saturate(key, [2.0, 1.0], [1.0, 1.0]).qdot.tolist() == speeds[key]
    for arguments, words in (
        (("soft", [2.0, 1.0], [1.0, 1.0]), "saturation: unknown name"),
        ((key, "fast", [1.0, 1.0]), "qdot: expected joint speeds"),
        ((key, [2.0, 1.0], [1.0] * 3), "qdot, limits: expected as many of each"),
    ):
        with pytest.raises(InputError, match=words):
            saturate(*arguments)
