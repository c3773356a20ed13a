"""Jacobians in other axes and of other points, and their derivatives, against central differences."""

from functools import partial

import numpy as np
import pytest

from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.euler import euler_angles
from armlab.kin.velocity.jacobians import (
    analytic_jacobian,
    jacobian_acceleration,
    jacobian_at,
    jacobian_derivative,
    jacobian_rate,
    link_jacobian,
    tool_motion,
)
from armlab.kin.velocity.rigid import angular_velocity
from support.arms import frames_by_products, random_arm, random_q, tool_by_products

H = 1e-5
"""Step of the differences; what they leave out is about its square."""

TOLERANCE = 2e-8


def moving(arm, rng):
    """Return q, its three derivatives, and the values along the polynomial they belong to."""
    q, speeds = random_q(arm, rng), rng.uniform(-1.0, 1.0, arm.n)
    second, third = rng.uniform(-1.0, 1.0, (2, arm.n))
    return q, speeds, second, third, lambda t: q + speeds * t + second * t**2 / 2 + third * t**3 / 6


def slope(function):
    """Return the derivative at 0 by central differences of the fourth order."""
    return (8 * (function(H) - function(-H)) - (function(2 * H) - function(-2 * H))) / (12 * H)


def slope_along(function, q, k):
    """Return the derivative of a function of q by joint k, 0-based."""
    step = np.eye(len(q))[k]
    return slope(lambda t: function(q + t * step))


def test_derivatives_of_every_robot_agree_with_central_differences(robot, rng):
    arm = robot.arm
    for q in random_q(arm, rng, 3):
        found = jacobian_derivative(arm, q)
        assert found.shape == (6, arm.n, arm.n)
        for k in range(arm.n):
            expected = slope_along(arm.jacobian, q, k)
            np.testing.assert_allclose(found[:, :, k], expected, rtol=0, atol=TOLERANCE)


def test_rates_of_every_robot_agree_with_central_differences(robot, rng):
    arm = robot.arm
    for _ in range(3):
        q, speeds, second, third, way = moving(arm, rng)
        rate = jacobian_rate(arm, q, speeds)
        np.testing.assert_allclose(rate, slope(lambda t, way=way: arm.jacobian(way(t))), rtol=0, atol=TOLERANCE)
        np.testing.assert_allclose(rate, jacobian_derivative(arm, q) @ speeds, rtol=0, atol=1e-12)

        def rate_at(t, speeds=speeds, second=second, third=third, way=way):
            return jacobian_rate(arm, way(t), speeds + second * t + third * t**2 / 2)

        faster = jacobian_acceleration(arm, q, speeds, second)
        np.testing.assert_allclose(faster, slope(rate_at), rtol=0, atol=10 * TOLERANCE)


def test_motions_of_every_robot_agree_with_central_differences(robot, rng):
    """Notes 5.67-5.69, the jerk corrected."""
    arm = robot.arm
    q, speeds, second, third, way = moving(arm, rng)

    def motion(t):
        return tool_motion(arm, way(t), speeds + second * t + third * t**2 / 2, second + third * t, third)

    now = motion(0.0)
    linear = slope(lambda t: tool_by_products(arm, way(t))[:3, 3])
    turning = angular_velocity(tool_by_products(arm, q)[:3, :3], slope(lambda t: tool_by_products(arm, way(t))[:3, :3]))
    np.testing.assert_allclose(now.twist, np.concatenate([linear, turning]), rtol=0, atol=TOLERANCE)
    np.testing.assert_allclose(now.acceleration, slope(lambda t: motion(t).twist), rtol=0, atol=10 * TOLERANCE)
    np.testing.assert_allclose(now.jerk, slope(lambda t: motion(t).acceleration), rtol=0, atol=50 * TOLERANCE)


@pytest.mark.parametrize("n", [1, 2, 5, 9, 12])
def test_random_arms_with_sliding_joints_and_both_conventions(n, rng):
    for _ in range(6):
        arm = random_arm(rng, n, special=bool(rng.integers(2)))
        q, speeds, second, _, _ = moving(arm, rng)
        for k in range(n):
            expected = slope_along(arm.jacobian, q, k)
            np.testing.assert_allclose(jacobian_derivative(arm, q)[:, :, k], expected, rtol=0, atol=TOLERANCE)
        rates = jacobian_derivative(arm, q) @ speeds
        np.testing.assert_allclose(jacobian_rate(arm, q, speeds), rates, rtol=0, atol=1e-12)
        assert jacobian_acceleration(arm, q, speeds, second).shape == (6, n)


def test_the_higher_order_example_of_the_notes(truth):
    case = truth["C5.1.2-higher-order"]
    arm, t, expected = Arm.from_dh([("R", 1, 0, 0, 0)] * 2), case["inputs"]["t"], case["expected"]
    tol = case["tol"]
    # q1 = .3 + .5 t + .2 t^2 - .1 t^3, q2 = .8 - .4 t + .3 t^2 + .05 t^3
    ways = [np.poly1d([-0.1, 0.2, 0.5, 0.3]), np.poly1d([0.05, 0.3, -0.4, 0.8])]
    q, speeds, second, third = (
        np.array([way.deriv(order)(t) if order else way(t) for way in ways]) for order in range(4)
    )
    found = tool_motion(arm, q, speeds, second, third)
    np.testing.assert_allclose(found.twist[:2], expected["rdot"], rtol=0, atol=tol)
    np.testing.assert_allclose(found.acceleration[:2], expected["rddot"], rtol=0, atol=tol)
    np.testing.assert_allclose(found.jerk[:2], expected["jerk"], rtol=0, atol=tol)
    np.testing.assert_allclose(jacobian_rate(arm, q, speeds)[:2], expected["Jdot"], rtol=0, atol=tol)
    # 5.69 and 5.71 as they are printed are something else.
    J = arm.jacobian(q)[:2]
    printed = J @ second + 2 * jacobian_rate(arm, q, speeds)[:2] @ speeds
    printed = printed + jacobian_acceleration(arm, q, speeds, second)[:2] @ q
    assert np.abs(printed - expected["jerk"]).max() > 1.0
    assert np.abs(jacobian_rate(arm, q, speeds)[:2] - J).max() > 1.0


def test_constant_joint_speeds_accelerate_the_tool_towards_the_axis():
    arm = Arm.from_dh([("R", 0.5, 0, 0, 0)])
    found = tool_motion(arm, [0.0], [2.0])
    np.testing.assert_allclose(found.twist, [0, 1, 0, 0, 0, 2], atol=1e-15)
    np.testing.assert_allclose(found.acceleration, [-2, 0, 0, 0, 0, 0], atol=1e-15)
    np.testing.assert_allclose(found.jerk, [0, -4, 0, 0, 0, 0], atol=1e-15)


def test_the_second_derivatives_of_the_position_are_symmetric(robot, rng):
    H_v = jacobian_derivative(robot.arm, random_q(robot.arm, rng))[:3]
    np.testing.assert_allclose(H_v, np.swapaxes(H_v, -1, -2), rtol=0, atol=1e-15)


def test_batches_are_each_configuration(robot, rng):
    arm = robot.arm
    q, speeds, second, third = rng.uniform(-1, 1, (4, 2, 3, arm.n))
    motion = tool_motion(arm, q, speeds, second, third)
    derivative, at_point = jacobian_derivative(arm, q), jacobian_at(arm, q, "tool", (0.1, -0.2, 0.3))
    of_link = link_jacobian(arm, q, arm.n - 1, (0.1, -0.2, 0.3))
    for index in np.ndindex(2, 3):
        one = tool_motion(arm, q[index], speeds[index], second[index], third[index])
        np.testing.assert_allclose(motion.twist[index], one.twist, rtol=0, atol=1e-13)
        np.testing.assert_allclose(motion.acceleration[index], one.acceleration, rtol=0, atol=1e-12)
        np.testing.assert_allclose(motion.jerk[index], one.jerk, rtol=0, atol=1e-12)
        np.testing.assert_allclose(derivative[index], jacobian_derivative(arm, q[index]), rtol=0, atol=1e-13)
        single = jacobian_at(arm, q[index], "tool", (0.1, -0.2, 0.3))
        np.testing.assert_allclose(at_point[index], single, rtol=0, atol=1e-13)
        single = link_jacobian(arm, q[index], arm.n - 1, (0.1, -0.2, 0.3))
        np.testing.assert_allclose(of_link[index], single, rtol=0, atol=1e-13)
    # One speed for all configurations.
    both = tool_motion(arm, q, speeds[0, 0])
    np.testing.assert_allclose(
        both.acceleration[1, 2], tool_motion(arm, q[1, 2], speeds[0, 0]).acceleration, atol=1e-12
    )


def tip_of(arm, point, q):
    return (tool_by_products(arm, q) @ [*point, 1.0])[:3]


def point_of(arm, link, point, q):
    return (frames_by_products(arm, q)[link] @ [*point, 1.0])[:3]


def test_other_axes_and_points(rng):
    for _ in range(10):
        arm = random_arm(rng, 6)
        q, point = random_q(arm, rng), rng.uniform(-1, 1, 3)
        world = jacobian_at(arm, q, point=point)
        for k in range(arm.n):
            tip = slope_along(partial(tip_of, arm, point), q, k)
            np.testing.assert_allclose(world[:3, k], tip, rtol=0, atol=TOLERANCE)
        np.testing.assert_array_equal(world[3:], arm.jacobian(q)[3:])
        for axes, R in (("base", arm.base[:3, :3]), ("tool", tool_by_products(arm, q)[:3, :3])):
            found = jacobian_at(arm, q, axes, point)
            np.testing.assert_allclose(R @ found[:3], world[:3], rtol=0, atol=1e-12)
            np.testing.assert_allclose(R @ found[3:], world[3:], rtol=0, atol=1e-12)
        np.testing.assert_array_equal(jacobian_at(arm, q), arm.jacobian(q))


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_points_of_every_link(convention, rng):
    for _ in range(6):
        arm = random_arm(rng, 5, convention=convention)
        q, point = random_q(arm, rng), rng.uniform(-1, 1, 3)
        for link in range(arm.n + 1):
            found = link_jacobian(arm, q, link, point)
            for k in range(arm.n):
                expected = slope_along(partial(point_of, arm, link, point), q, k)
                np.testing.assert_allclose(found[:3, k], expected, rtol=0, atol=TOLERANCE)
            assert np.all(found[:, link:] == 0.0)
        on_tool = link_jacobian(arm, q, arm.n, arm.tool[:3, 3])
        np.testing.assert_allclose(on_tool, arm.jacobian(q), rtol=0, atol=1e-12)


def test_analytic_jacobians_of_every_robot(robot, rng):
    for axes, fixed in (("zyx", False), ("xyz", True), ("zxz", False), ("zyz", True)):
        for q in random_q(robot.arm, rng, 2):
            R = robot.arm.fk(q)[:3, :3]
            if bool(euler_angles(R, axes, fixed=fixed).singular):
                with pytest.raises(InputError, match="one line"):
                    analytic_jacobian(robot.arm, q, axes, fixed)
                continue

            def angles(t, step, axes=axes, fixed=fixed, q=q):
                return euler_angles(robot.arm.fk(q + t * step)[:3, :3], axes, fixed=fixed).solutions[0]

            found = analytic_jacobian(robot.arm, q, axes, fixed)
            np.testing.assert_array_equal(found[:3], robot.arm.jacobian(q)[:3])
            for k in range(robot.arm.n):
                step = np.eye(robot.arm.n)[k]
                expected = slope(lambda t, step=step: np.unwrap([angles(0.0, step), angles(t, step)], axis=0)[1])
                np.testing.assert_allclose(found[3:, k], expected, rtol=0, atol=1e-6 * max(1, np.abs(found).max()))


def test_the_analytic_jacobian_of_the_notes(truth):
    """Notes 5.50-5.51: phidot = q1dot + q2dot comes out, it is not put in."""
    case = truth["C5.1.1-J-2R"]
    arm = Arm.from_dh([("R", case["inputs"]["l1"], 0, 0, 0), ("R", case["inputs"]["l2"], 0, 0, 0)])
    J_r = analytic_jacobian(arm, case["inputs"]["q"], "zyx")[[0, 1, 3]]
    np.testing.assert_allclose(J_r, case["expected"]["J"], rtol=0, atol=case["tol"])
    np.testing.assert_allclose(J_r @ case["inputs"]["qdot"], case["expected"]["rdot"], rtol=0, atol=case["tol"])


@pytest.mark.parametrize("name", ["RRP", "elbow"])
def test_the_geometric_jacobians_of_the_notes_as_those_of_the_last_link(truth, name):
    case = truth[f"C5.1.1-geomJ-{name}"]
    arm = Arm.from_dh([tuple(row) for row in case["inputs"]["dh"]])
    found = link_jacobian(arm, case["inputs"]["q"], arm.n)
    np.testing.assert_allclose(found, case["expected"]["J"], rtol=0, atol=case["tol"])


def test_the_lever_of_the_last_joint_is_not_zero(truth):
    case = truth["C5.1.1-p_last"]
    arm = Arm.from_dh([("R", 1, 0, 0, 0)] * 2)
    np.testing.assert_allclose(
        link_jacobian(arm, case["inputs"]["q"], 2)[:3, 1], case["expected"]["J_L_col2"], rtol=0, atol=case["tol"]
    )


def test_bad_input_says_where():
    arm = Arm.from_dh([("R", 1, 0, 0, 0)] * 2)
    with pytest.raises(UnknownName, match="body"):
        jacobian_at(arm, [0, 0], "body")
    with pytest.raises(InputError, match="point: expected three numbers"):
        jacobian_at(arm, [0, 0], point=[0, 0])
    with pytest.raises(InputError, match="link: expected 0 to 2, got 3"):
        link_jacobian(arm, [0, 0], 3)
    with pytest.raises(InputError, match="qdot: expected shape"):
        jacobian_rate(arm, [0, 0], [1, 2, 3])
    with pytest.raises(InputError, match="qddot: expected shape"):
        tool_motion(arm, [0, 0], [0, 0], [1])
    for call in (jacobian_rate, tool_motion, partial(jacobian_acceleration, qddot=[0, 0])):
        with pytest.raises(InputError, match=r"q, qdot.*: expected as many of each, or one, got .*\(2,\), \(3,\)"):
            call(arm, np.zeros((2, 2)), np.zeros((3, 2)))
    with pytest.raises(InputError, match="q, qdot, qddot, qdddot: expected as many of each"):
        tool_motion(arm, [0, 0], [0, 0], np.zeros((2, 2)), np.zeros((3, 2)))
    one = tool_motion(arm, np.zeros((4, 2)), [1, 1], [1, 0])
    assert one.twist.shape == one.acceleration.shape == one.jerk.shape == (4, 6)
