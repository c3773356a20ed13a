"""Damped least squares: each variant against its formula, and what damping is for."""

import math

import numpy as np
import pytest

from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.ik.verdict import task_error_of
from armlab.kin.transforms import transform
from support.arms import random_q

TWO_R = Arm.from_dh([("R", 1, 0, 0, 0)] * 2)
ELBOW = [0.0, math.pi / 2]
T = transform(position=[1.1, 0.8, 0.0])
DAMPED = [key for key in ik.iteration_methods() if key.startswith("dls")]

# At (0, pi/2) the tool is at (1, 1): e = (0.1, -0.2), J = [[-1, -1], [1, 0]], J J^T = [[2, -1], [-1, 1]], w = |det J|
# is 1 and sigma_min^2 = (3 - sqrt 5) / 2. With lambda = 1 the inverse of J J^T + I is [[2, 1], [1, 3]] / 5, so that
# y = ((0.2 - 0.2) / 5, (0.1 - 0.6) / 5) = (0, -0.1) and dq = J^T y = (-0.1, 0).
LAMBDA_ONE = {
    "dls_constant": {"lambda": 1.0},
    "dls_w": {"lambda_0": 4.0, "w_0": 2.0},  # 4 (1 - 1/2)^2
    "dls_sigma": {"lambda_max": 2.0 / (math.sqrt(5.0) - 1.0), "epsilon": 1.0},  # 1 - sigma_min^2 = (sqrt 5 - 1) / 2
    "dls_error": {"g": 40.0},  # e^T e / 2 = 0.025
    "dls_bias": {"b": 0.975},  # 0.025 + 0.975
}


@pytest.mark.parametrize("method", DAMPED)
def test_each_variant_makes_the_step_computed_by_hand(method):
    trace = ik.iterate(TWO_R, T, ELBOW, method, parameters=LAMBDA_ONE[method], most=1)
    assert trace.damping[0] == pytest.approx(1.0, abs=1e-12)
    np.testing.assert_allclose(trace.step[0], [-0.1, 0.0], rtol=0, atol=1e-13)


@pytest.mark.parametrize(("method", "parameters"), [("dls_w", {"w_0": 0.9}), ("dls_sigma", {"epsilon": 0.6})])
def test_in_the_open_damping_by_w_and_sigma_is_newtons_step(method, parameters):
    # w = 1 > 0.9 and sigma_min = 0.618 > 0.6.
    trace = ik.iterate(TWO_R, T, ELBOW, method, parameters=parameters, most=1)
    assert trace.damping[0] == 0.0
    np.testing.assert_allclose(trace.step[0], [-0.2, 0.1], rtol=0, atol=1e-13)


@pytest.mark.parametrize(
    ("method", "formula"),
    [
        ("dls_constant", lambda p, e, w, s: p["lambda"]),
        ("dls_w", lambda p, e, w, s: p["lambda_0"] * max(0.0, 1 - w / p["w_0"]) ** 2),
        ("dls_sigma", lambda p, e, w, s: p["lambda_max"] * max(0.0, 1 - (s / p["epsilon"]) ** 2)),
        ("dls_error", lambda p, e, w, s: p["g"] * e @ e / 2),
        ("dls_bias", lambda p, e, w, s: e @ e / 2 + p["b"]),
    ],
)
def test_every_step_on_every_robot_is_the_formula(method, formula, robot, rng):
    """J^T (J J^T + lambda I)^-1 e with J and e of another path: the compiled ones, whose error agrees where small."""
    arm = robot.arm
    q = random_q(arm, rng)
    near = arm.clip(q + 1e-4 * rng.normal(size=arm.n))
    trace = ik.iterate(arm, arm.fk(near), q, method, most=1, limits="none", tolerance=(1e-12, 1e-12))
    J, e, _ = task_error_of(arm).at(q.tolist(), task_error_of(arm).target(arm.fk(near)))
    scales, length = np.where(arm.revolute, 1.0, arm.length_scale), arm.length_scale
    if trace.length == 1.0:
        # Only one kind occurs and nothing is scaled.
        unit = length if arm.task.position else 1.0
        J, e = J * unit / (scales if not arm.revolute.all() else 1.0), e * unit
        scales = np.ones(arm.n)
    sigma = np.linalg.svd(J, compute_uv=False)
    damping = formula(trace.parameters, e, np.prod(sigma), sigma[-1])
    assert trace.damping[0] == pytest.approx(damping, rel=1e-5, abs=1e-12)
    assert trace.sigma_min[0] == pytest.approx(sigma[-1], abs=1e-9)
    if sigma[-1] > 1e-3:
        expected = J.T @ np.linalg.solve(J @ J.T + damping * np.eye(len(J)), e) * scales
        np.testing.assert_allclose(trace.step[0], expected, rtol=0, atol=1e-6 * np.abs(expected).max())


@pytest.mark.parametrize("method", DAMPED)
def test_beside_a_singularity_a_damped_step_stays_short_where_newtons_is_long(method):
    # Pulled along its own line a nearly stretched arm has to move its elbow by 0.2 / sin(q2): 200 rad.
    start, target = [0.0, 1e-3], transform(position=[1.8, 0.0, 0.0])
    newton = ik.iterate(TWO_R, target, start, "newton", most=1, limits="none")
    damped = ik.iterate(TWO_R, target, start, method, most=1, limits="none")
    assert np.abs(newton.step[0]).max() > 100.0
    assert np.abs(damped.step[0]).max() < 1.0


def test_without_damping_the_step_is_the_pseudo_inverse_also_at_a_singularity():
    for start in (ELBOW, [0.3, 0.0]):
        zero = ik.iterate(TWO_R, T, start, "dls_constant", parameters={"lambda": 0.0}, most=1, limits="none")
        gauss = ik.iterate(TWO_R, T, start, "gauss_newton", most=1, limits="none")
        np.testing.assert_allclose(zero.step, gauss.step, rtol=0, atol=1e-12)


def test_damping_by_error_ends_quadratically_and_constant_damping_linearly():
    tight = (1e-13, 1e-13)
    by_error = ik.iterate(TWO_R, transform(position=[0.9, 0.7, 0]), [0.2, 1.0], "dls_error", tolerance=tight)
    constant = ik.iterate(TWO_R, transform(position=[0.9, 0.7, 0]), [0.2, 1.0], "dls_constant", tolerance=tight)
    assert by_error.success
    assert constant.success
    ratios = constant.position_error[1:] / constant.position_error[:-1]
    # lambda / (sigma^2 + lambda) of the smaller singular value is left of the error at every step.
    sigma = constant.sigma_min[-1]
    assert ratios[-3] == pytest.approx(0.01 / (sigma**2 + 0.01), rel=0.05)
    assert by_error.iterations < constant.iterations
    assert by_error.position_error[-1] < 20 * by_error.position_error[-2] ** 2 + 1e-15


def test_gauss_newton_takes_the_part_of_the_step_it_is_told():
    half = ik.iterate(TWO_R, T, ELBOW, "gauss_newton", parameters={"gamma": 0.5}, most=1)
    np.testing.assert_allclose(half.step[0], [-0.1, 0.05], rtol=0, atol=1e-13)


def test_gauss_newton_drops_directions_below_its_cutoff():
    """Only the direction of the large singular value is left: the step is sigma^-1 v u^T e of that one."""
    trace = ik.iterate(TWO_R, T, ELBOW, "gauss_newton", parameters={"cutoff": 0.5}, most=1)
    U, sigma, Vt = np.linalg.svd([[-1.0, -1.0], [1.0, 0.0]])
    assert sigma[1] / sigma[0] < 0.5
    np.testing.assert_allclose(trace.step[0], Vt[0] / sigma[0] * (U[:, 0] @ [0.1, -0.2]), rtol=0, atol=1e-13)
