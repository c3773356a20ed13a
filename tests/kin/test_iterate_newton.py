"""Newton's and Broyden's method with their full record, and Newton in one dimension."""

import itertools
import math

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.ik.iterate import EXAMPLES
from armlab.kin.transforms import transform

TWO_R = Arm.from_dh([("R", 1, 0, 0, 0)] * 2)
THREE_R = Arm.from_dh([("R", 1, 0, 0, 0)] * 3)


def at(*position):
    return transform(position=[*position, 0.0])


def test_newton_on_the_2r_gives_the_iterates_of_the_notes(truth):
    case = truth["C4.4.1-newton-2R"]
    given, expected = case["inputs"], case["expected"]
    T = at(*given["r_d"])
    trace = ik.iterate(TWO_R, T, given["q0"], "newton", most=given["steps"], tolerance=(1e-16, 1e-16))
    wanted = np.array(expected["q_iterates"])[: len(trace.q)]
    assert len(wanted) >= 6
    np.testing.assert_allclose(trace.q, wanted, rtol=0, atol=case["tol"])
    # The printed first norm is that of the first error: |(0.9, 0.7) - f(q0)|.
    norms = expected["error_norms"]
    count = min(len(norms), len(trace.position_error))
    np.testing.assert_allclose(trace.position_error[:count], norms[:count], rtol=0, atol=case["tol"])
    np.testing.assert_allclose(trace.step, np.diff(trace.q, axis=0), rtol=0, atol=0)


def test_newtons_first_step_is_the_inverse_times_the_error_by_hand():
    # J at (0, pi/2): p = (1, 1), columns (-1, 1) and (-1, 0); e = (0.1, -0.2): dq2 = (e_y - dq1 ...) below.
    trace = ik.iterate(TWO_R, at(1.1, 0.8), [0.0, math.pi / 2], "newton", most=1)
    # -dq1 - dq2 = 0.1 and dq1 = -0.2, so dq = (-0.2, 0.1).
    np.testing.assert_allclose(trace.step[0], [-0.2, 0.1], rtol=0, atol=1e-14)
    # |det J| = 1 and sigma^2 are the roots of s^2 - 3 s + 1.
    assert trace.w[0] == pytest.approx(1.0, abs=1e-12)
    assert trace.sigma_min[0] == pytest.approx(math.sqrt((3 - math.sqrt(5)) / 2), abs=1e-12)
    assert trace.sigma_max[0] == pytest.approx(math.sqrt((3 + math.sqrt(5)) / 2), abs=1e-12)
    assert trace.cost[0] == pytest.approx(0.5 * (0.01 + 0.04), abs=1e-14)


def order_of(errors):
    """Return the slope of log error(k+1) over log error(k) in the end of a convergence, above rounding."""
    log = np.log([error for error in errors if 1e-13 < error < 0.3])
    return (log[-1] - log[-2]) / (log[-2] - log[-3])


def test_newton_converges_with_order_two_and_the_gradient_with_order_one():
    newton = ik.iterate(TWO_R, at(0.9, 0.7), [0.2, 1.0], "newton", tolerance=(1e-14, 1e-14))
    gradient = ik.iterate(TWO_R, at(0.9, 0.7), [0.2, 1.0], "gradient", tolerance=(1e-9, 1e-9))
    assert newton.success
    assert gradient.success
    assert order_of(newton.position_error) == pytest.approx(2.0, abs=0.15)
    assert order_of(gradient.position_error) == pytest.approx(1.0, abs=0.02)
    assert newton.iterations < 7 < 50 < gradient.iterations


def test_newton_converges_with_order_two_on_a_full_pose_too(rng):
    arm = Arm.from_dh([("R", 0.1, math.pi / 2, 0.2, 0), ("R", 0.4, 0, 0, 0), ("R", 0.3, math.pi / 2, 0.1, 0)] * 2)
    orders = []
    for _ in range(20):
        q = rng.uniform(-2, 2, 6)
        trace = ik.iterate(arm, arm.fk(q), q + 0.02, "newton", tolerance=(1e-13, 1e-13), limits="none", most=8)
        errors = trace.position_error + arm.length_scale * trace.rotation_error
        if trace.sigma_min.min() > 0.05:
            orders.append(order_of(errors))
    assert len(orders) >= 5
    assert np.median(orders) == pytest.approx(2.0, abs=0.4)


def test_a_redundant_newton_step_is_the_shortest_that_removes_the_error(truth):
    case = truth["C5.2.2-pinv-3R"]
    J, v = np.array(case["inputs"]["J"]), np.array(case["inputs"]["v"])
    # The case has a Jacobian, not an arm: the same formula on the 3R must give J# of J J^T, not of J^T J (4.116).
    np.testing.assert_allclose(J.T @ np.linalg.inv(J @ J.T) @ v, case["expected"]["qdot"], rtol=0, atol=1e-12)
    q, task = np.array([0.3, 0.8, -0.4]), ik.task_vector(THREE_R, "xy")
    target = THREE_R.position(q) + np.array([0.05, -0.03, 0.0])
    trace = ik.iterate(THREE_R, transform(position=target), q, "newton", most=1, task=task)
    J = THREE_R.jacobian(q)[:2]
    np.testing.assert_allclose(trace.step[0], J.T @ np.linalg.inv(J @ J.T) @ [0.05, -0.03], rtol=0, atol=1e-12)


def test_newton_jumps_near_a_singularity_and_says_so():
    trace = ik.iterate(TWO_R, at(1.2, 0.4), [0.3, 1e-3], "newton", limits="none", most=3)
    assert np.abs(trace.step[0]).max() > math.pi
    assert trace.jumps[0] == 1
    assert trace.status == "jumped"
    assert trace.reason.startswith("jumped: near a singularity a step turned a joint by more than half a turn")
    longer = ik.iterate(TWO_R, at(1.2, 0.4), [0.3, 1e-3], "newton", limits="none")
    assert not longer.success or "after a jump" in longer.reason


@pytest.mark.parametrize(
    ("method", "start", "solution"),
    [
        ("gradient_search", [-0.6, -1.0], [1.3, 0.7]),
        ("dls_sigma", [0.1, 2.4], [2.4, 1.3]),
        ("gauss_newton", [2.1, 2.4], [-1.9, 1.3]),
    ],
)
def test_a_jump_far_from_any_singularity_is_not_put_down_to_one(method, start, solution):
    trace = ik.iterate(TWO_R, TWO_R.fk(solution), start, method, limits="none", most=30)
    before = trace.jumps[0] - 1
    assert trace.sigma_min[before] > 0.4 * trace.sigma_max[before]
    assert trace.reason.startswith("jumped: a step turned a joint by more than half a turn, first in step")


def test_newton_has_no_step_where_the_jacobian_has_no_inverse():
    trace = ik.iterate(TWO_R, at(1.2, 0.4), [0.3, 0.0], "newton")
    assert (trace.status, trace.iterations) == ("singular", 0)
    assert "singular" in trace.reason
    assert "invert J" in trace.reason


@pytest.mark.parametrize("method", ["newton", "broyden"])
def test_newton_with_more_components_than_joints_says_what_to_take_instead(method):
    trace = ik.iterate(TWO_R, TWO_R.fk([0.3, 0.8]), [0.2, 0.9], method, task="xy phi")
    assert trace.status == "unfit"
    assert "3 task components, 2 free joints" in trace.reason
    assert ik.iterate(TWO_R, TWO_R.fk([0.3, 0.8]), [0.2, 0.9], "gauss_newton", task="xy phi").success


def test_broydens_first_step_is_newtons(robot, rng):
    q = robot.arm.limits.mean(axis=1) + 0.1 * np.ptp(robot.arm.limits, axis=1) * rng.uniform(-1, 1, robot.arm.n)
    T = robot.arm.fk(q)
    start = q + 0.02 * rng.uniform(-1, 1, robot.arm.n)
    newton = ik.iterate(robot.arm, T, start, "newton", most=1, limits="none")
    broyden = ik.iterate(robot.arm, T, start, "broyden", most=1, limits="none")
    assert newton.iterations == 1
    np.testing.assert_allclose(broyden.step, newton.step, rtol=1e-9, atol=1e-12)


def test_broydens_matrix_explains_the_last_step_and_converges_faster_than_linearly():
    trace = ik.iterate(TWO_R, at(0.9, 0.7), [0.2, 1.0], "broyden", tolerance=(1e-13, 1e-13))
    assert trace.success
    # By hand: B1 = B0 + (df - B0 dq) dq^T / dq^T dq, second step B1^-1 e1.
    J = TWO_R.jacobian(trace.q[0])[:2]
    dq, e0, e1 = trace.step[0], trace.components[0], trace.components[1]
    B = J + np.outer((e0 - e1) - J @ dq, dq) / (dq @ dq)
    np.testing.assert_allclose(B @ dq, e0 - e1, rtol=0, atol=1e-12)
    np.testing.assert_allclose(trace.step[1], np.linalg.solve(B, e1), rtol=0, atol=1e-12)
    newton = ik.iterate(TWO_R, at(0.9, 0.7), [0.2, 1.0], "newton", tolerance=(1e-13, 1e-13))
    assert newton.iterations < trace.iterations < 15
    ratios = trace.position_error[1:] / trace.position_error[:-1]
    assert ratios[-1] < 0.1 * ratios[2]


def test_newton_in_one_dimension_gives_the_iterates_of_the_notes(truth):
    case = truth["C4.4.1-newton-scalar"]
    steps = ik.newton_1d(lambda x: x * x - 2, lambda x: 2 * x, case["inputs"]["x0"], most=case["inputs"]["steps"])
    np.testing.assert_allclose([s.x for s in steps], case["expected"]["x"], rtol=0, atol=case["tol"])
    # 4.110 as printed, x = f / f', would go to 1/4 - 1/x... and never to the root.
    assert abs(steps[-1].x - math.sqrt(2)) <= truth["ERR-4.110"]["expected"]["corrected_residual"] + 1e-15


def test_each_tangent_touches_the_curve_and_meets_zero_at_the_next_iterate():
    for example in EXAMPLES:
        steps = ik.newton_1d(example.f, example.df, example.x0)
        assert len(steps) > 3, example.key
        for here, after in itertools.pairwise(steps):
            slope, intercept = here.tangent
            assert slope * here.x + intercept == pytest.approx(example.f(here.x), rel=1e-9, abs=1e-12)
            assert slope == pytest.approx(example.df(here.x), rel=1e-12)
            assert here.tangent.root == pytest.approx(after.x, rel=1e-6, abs=1e-9)


def test_the_examples_in_one_dimension_do_what_their_titles_say():
    found = {example.key: ik.newton_1d(example.f, example.df, example.x0) for example in EXAMPLES}
    assert found["root_of_two"][-1].x == pytest.approx(math.sqrt(2), abs=1e-15)
    assert found["one_joint"][-1].x == pytest.approx(math.pi / 3, abs=1e-14)
    assert found["near_flat"][1].x - found["near_flat"][0].x > 4 * math.pi
    assert math.cos(found["near_flat"][-1].x) == pytest.approx(0.5, abs=1e-12)
    assert abs(found["too_far"][-1].x) > 1e6
    assert [step.x for step in found["cycle"][:6]] == [0, 1, 0, 1, 0, 1]


def test_newton_in_one_dimension_ends_at_a_level_tangent_and_refuses_what_is_no_number():
    steps = ik.newton_1d(lambda x: x * x + 1, lambda x: 2 * x, 0.0)
    assert len(steps) == 1
    assert math.isnan(steps[0].tangent.root)
    with pytest.raises(InputError, match="x0: expected a finite number"):
        ik.newton_1d(lambda x: x, lambda x: 1.0, math.nan)
    with pytest.raises(InputError, match="f: expected a function with a finite value"):
        ik.newton_1d(math.log, lambda x: 1 / x, -1.0)
