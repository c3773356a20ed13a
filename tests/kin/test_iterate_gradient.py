"""Gradient descent by steps and as a continuous scheme: bounds, balance, Lyapunov function."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.transforms import transform

TWO_R = Arm.from_dh([("R", 1, 0, 0, 0)] * 2)
CARTESIAN = Arm.from_dh([("P", 0, math.pi / 2, 0, math.pi), ("P", 0, math.pi / 2, 0, -math.pi / 2), ("P", 0, 0, 0, 0)])


def at(*position):
    return transform(position=[*position, 0.0])


def test_a_gradient_step_is_alpha_times_the_transpose_by_hand():
    # J at (0, pi/2) has columns (-1, 1) and (-1, 0); e = (0.1, -0.2): J^T e = (-0.3, -0.1).
    trace = ik.iterate(TWO_R, at(1.1, 0.8), [0.0, math.pi / 2], "gradient", parameters={"alpha": 0.5}, most=1)
    np.testing.assert_allclose(trace.step[0], [-0.15, -0.05], rtol=0, atol=1e-14)
    assert "as they are" in trace.scaling


def test_on_the_cartesian_arm_the_bound_on_alpha_is_exact(truth):
    given = truth["ERR-4.129"]["inputs"]["check"]
    assert "α=2.5, 40 steps" in given
    target, start = transform(CARTESIAN.fk([0, 0, 0])[:3, :3], [1.0, 1.0, 1.0]), [0.0, 0.0, 0.0]

    def run(alpha):
        return ik.iterate(CARTESIAN, target, start, "gradient", parameters={"alpha": alpha}, most=40, limits="none")

    bad = run(2.5)
    # J = I: every step multiplies the error by 1 - 2.5; the first error is sqrt 3.
    assert bad.position_error[-1] == pytest.approx(math.sqrt(3) * 1.5**40, rel=1e-9)
    assert bad.position_error[-1] == pytest.approx(
        truth["ERR-4.129"]["printed_value_if_wrong"]["printed_residual"], rel=1e-4
    )
    assert bad.status == "diverged"
    assert bad.reason == "diverged: the step size α = 2.5 is above 2/σ_max² = 2"
    for alpha in (0.5, 1.0, 1.9):
        assert np.all(np.diff(run(alpha).position_error) < 0)
    assert run(0.5).success


def test_near_a_solution_the_gradient_diverges_above_the_bound_and_converges_below():
    solution = np.array([0.3, 1.1])
    T = TWO_R.fk(solution)
    largest = np.linalg.svd(TWO_R.jacobian(solution)[:2], compute_uv=False)[0]
    bound = 2 / largest**2
    start = solution + np.array([1e-4, -1e-4])
    below = ik.iterate(TWO_R, T, start, "gradient", parameters={"alpha": 0.98 * bound}, most=1000)
    assert below.success
    above = ik.iterate(TWO_R, T, start, "gradient", parameters={"alpha": 1.05 * bound}, most=40)
    assert above.position_error[-1] > 3 * above.position_error[0]
    assert above.status == "diverged"
    assert "above 2/σ_max²" in above.reason
    assert "m⁻²" in above.reason


def test_a_run_that_comes_closer_has_not_diverged_though_an_iterate_exceeds_the_bound():
    T, start = at(0.5, 0.5), np.radians([70.0, 10.0])
    alpha = {"alpha": 0.6}
    few = ik.iterate(TWO_R, T, start, "gradient", parameters=alpha, most=30, limits="none")
    assert 0.6 * few.sigma_max[15:].max() ** 2 > 2.0
    assert few.reason == "not reached in 30 steps, still converging: more steps may reach it"
    assert ik.iterate(TWO_R, T, start, "gradient", parameters=alpha, limits="none").success
    for most in (40, 60, 100):
        far = {"parameters": {"alpha": 1.2}, "most": most, "limits": "none"}
        assert ik.iterate(TWO_R, at(0.9, 0.7), np.radians([20.0, 60.0]), "gradient", **far).status == "diverged"


def test_the_stretched_arm_pulled_along_its_own_line_stays_stuck_and_says_so(truth):
    case = truth["C4.4.2-gradient-stuck"]
    for turn in (0.0, 0.3, 2.0):
        q0 = np.array(case["inputs"]["q0"]) + np.array([turn, 0.0])
        T = at(math.cos(turn), math.sin(turn))
        # A secondary objective may push an arm off the balance; all other methods stay.
        for method in (key for key, one in ik.iteration_methods().items() if one.objective is None):
            trace = ik.iterate(TWO_R, T, q0, method)
            assert trace.status == "stuck", method
            assert trace.reason == "stuck at a singular configuration: Jᵀe = 0, although the error e is not 0"
            np.testing.assert_allclose(trace.q[-1], q0, rtol=0, atol=1e-9)
            assert trace.position_error[-1] == pytest.approx(case["expected"]["error"], abs=1e-9)


def test_the_line_search_never_raises_the_cost_and_reaches_where_a_fixed_step_fails(rng):
    arm = catalogue()["elbow_3r"].arm
    for _ in range(10):
        T = arm.fk(rng.uniform(*arm.limits.T))
        trace = ik.iterate(arm, T, rng.uniform(*arm.limits.T), "gradient_search", most=500)
        assert np.all(np.diff(trace.cost) <= 0)
    fixed = ik.iterate(arm, arm.fk([0.3, 0.5, 0.7]), [0, 0.2, 0.4], "gradient", parameters={"alpha": 3.0})
    searched = ik.iterate(arm, arm.fk([0.3, 0.5, 0.7]), [0, 0.2, 0.4], "gradient_search")
    assert fixed.status == "diverged"
    assert searched.success


def test_the_slope_is_the_exact_derivative_of_the_cost_for_every_robot(robot, rng):
    arm = robot.arm
    q, other = rng.uniform(*arm.limits.T), rng.uniform(*arm.limits.T)
    T = arm.fk(other)
    trace = ik.iterate(arm, T, q, "gradient", parameters={"alpha": 1.0}, most=1, limits="none")
    units = np.where(arm.revolute, 1.0, trace.length)
    slope = trace.step[0] / units

    def cost(at):
        return ik.iterate(arm, T, at, "gradient", most=0, limits="none").cost[0]

    h = 1e-6
    for i in range(arm.n):
        move = h * units[i] * np.eye(arm.n)[i]
        difference = (cost(q - move) - cost(q + move)) / (2 * h)
        assert slope[i] == pytest.approx(difference, abs=2e-7 * (1 + abs(difference)))


def test_the_lyapunov_function_never_rises_and_falls_as_its_formula_says(robot, rng):
    arm = robot.arm
    q = rng.uniform(*arm.limits.T)
    flow = ik.transpose_flow(arm, arm.fk(rng.uniform(*arm.limits.T)), q, gain=0.5, duration=0.5, dt=0.01)
    assert np.all(np.diff(flow.V) <= 1e-12)
    assert flow.V[-1] < flow.V[0]
    assert np.all(flow.V_dot <= 0)
    # dV/dt by central differences of the run itself.
    measured = (flow.V[2:] - flow.V[:-2]) / 0.02
    np.testing.assert_allclose(measured, flow.V_dot[1:-1], rtol=5e-3, atol=2e-3 * np.abs(flow.V_dot).max())


def test_the_continuous_scheme_on_one_sliding_joint_is_the_exponential(truth):
    assert "t=.5" in truth["ERR-4.127"]["inputs"]["check"]
    arm = Arm.from_dh([("P", 0, 0, 0, 0)])
    flow = ik.transpose_flow(arm, transform(position=[0, 0, 1.0]), [0.0], duration=0.5, dt=0.01)
    # q' = K (1 - q): q(t) = 1 - exp(-t).
    np.testing.assert_allclose(flow.q[:, 0], 1 - np.exp(-flow.t), rtol=0, atol=1e-10)
    np.testing.assert_allclose(flow.V, 0.5 * np.exp(-2 * flow.t), rtol=0, atol=1e-10)


def test_a_gain_matrix_weighs_the_components_in_v():
    flow = ik.transpose_flow(TWO_R, at(0.9, 0.7), [0.2, 1.0], gain=[1.0, 4.0], duration=40.0)
    e = flow.components
    np.testing.assert_allclose(flow.V, 0.5 * (e[:, 0] ** 2 + 4 * e[:, 1] ** 2), rtol=1e-12)
    assert np.all(np.diff(flow.V) < 0)
    assert flow.status == "converged"


def test_the_continuous_scheme_says_why_it_ends():
    assert ik.transpose_flow(TWO_R, at(1.0, 0.0), [0.0, 0.0]).reason == "at rest, but not at the target: JᵀKe = 0"
    assert ik.transpose_flow(TWO_R, at(5.0, 0.0), [0.1, 0.2], duration=1.0).reason.startswith("out of reach")
    short = ik.transpose_flow(TWO_R, at(0.9, 0.7), [0.2, 1.0], duration=1.0)
    assert (short.status, short.reason) == ("going", "not at the target after 1.00 s")
    coarse = ik.transpose_flow(TWO_R, at(0.9, 0.7), [0.2, 1.0], gain=5.0, dt=1.0, duration=30.0)
    assert coarse.status == "unstable"
    assert "dt K σ_max²" in coarse.reason
    locked = ik.transpose_flow(TWO_R, at(0.9, 0.7), [0.2, 1.0], locked=[True, True])
    assert (locked.status, len(locked.t)) == ("locked", 1)


def test_bad_gains_and_times_are_refused():
    for gain in (0.0, -1.0, math.nan, [1.0], [1.0, 2.0, 3.0], "much"):
        with pytest.raises(InputError, match="gain: expected a positive number or 2 of them"):
            ik.transpose_flow(TWO_R, at(1, 1), [0, 1], gain=gain)
    arm = catalogue()["puma560"].arm
    with pytest.raises(InputError, match="one number for all components of the orientation"):
        ik.transpose_flow(arm, arm.fk(np.zeros(6)), np.zeros(6), gain=[1, 1, 1, 1, 2, 1])
    for duration, dt in ((1.0, 0.0), (-1.0, 0.1), (1e9, 1e-3), (math.inf, 0.1)):
        with pytest.raises(InputError, match="duration"):
            ik.transpose_flow(TWO_R, at(1, 1), [0, 1], duration=duration, dt=dt)


@pytest.mark.parametrize(
    ("method", "reason"),
    [
        ("gauss_newton", "closest point from here: Jᵀe = 0, and J has no more rank in other configurations"),
        ("dls_constant", "closest point from here: Jᵀe = 0, and J has no more rank in other configurations"),
        ("newton", "no step: J is singular in every configuration, and Newton has to invert it"),
    ],
)
def test_what_is_lost_in_every_configuration_is_not_put_down_to_a_singular_one(method, reason):
    """The tool of a planar arm never leaves its plane."""
    arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)] * 3, task="xyz")
    T = arm.fk([0.3, 0.5, 0.4])
    T[2, 3] = 0.3
    assert ik.iterate(arm, T, [0.1, 0.9, 0.4], method, most=200).reason == reason
    # Stretched, and pulled along its own line, it is singular indeed.
    stretched = ik.iterate(arm, transform(position=[2.0, 0.0, 0.0]), [0.0, 0.0, 0.0], method, most=200).reason
    assert "singular configuration" in stretched or "the configuration is singular" in stretched
