"""How an iteration ends and what it says then; limits, locks, task vectors, units; every robot by every method."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.rotations import rotation_about
from armlab.kin.transforms import inverse, transform
from support.arms import random_q

TWO_R = Arm.from_dh([("R", 1, 0, 0, 0)] * 2)
THREE_R = Arm.from_dh([("R", 1, 0, 0, 0)] * 3)
METHODS = list(ik.iteration_methods())
NUMBERS = (
    "q",
    "components",
    "position_error",
    "rotation_error",
    "step",
    "sigma_min",
    "sigma_max",
    "w",
    "damping",
    "cost",
)


def at(*position):
    return transform(position=[*position, 0.0])


@pytest.mark.parametrize("method", METHODS)
def test_every_method_on_every_robot_gives_numbers_and_a_reason(method, robot, rng):
    arm = robot.arm
    q = random_q(arm, rng)
    far = np.array(arm.fk(robot.home))
    far[:3, 3] += 1e6
    for T, most in ((arm.fk(arm.clip(q + 0.1 * rng.normal(size=arm.n))), 4), (far, 1)):
        trace = ik.iterate(arm, T, q, method, most=most)
        for name in NUMBERS:
            assert np.isfinite(getattr(trace, name)).all(), name
        assert len(trace.q) == trace.iterations + 1 == len(trace.damping) + 1 <= most + 1
        assert all(arm.within_limits(one) for one in trace.q)
        assert trace.reason
        assert trace.success == (trace.status == "converged")
        if trace.success:
            assert max(trace.position_error[-1], trace.rotation_error[-1]) <= 1e-6
    assert trace.status in ("out of reach", "unfit", "converged")  # The last target; a task without position has none.


@pytest.mark.parametrize("method", METHODS)
def test_a_start_at_the_target_needs_no_step(method):
    trace = ik.iterate(TWO_R, TWO_R.fk([0.4, 0.9]), [0.4, 0.9], method)
    assert (trace.status, trace.iterations) == ("converged", 0)
    assert trace.reason == "at the target already: no step needed"


@pytest.mark.parametrize("method", METHODS)
def test_locked_joints_keep_their_value_to_the_last_digit_also_outside_their_limits(method):
    arm = Arm.from_dh(THREE_R.rows, limits=[[-2, 2], [-2, 2], [-1, 1]], task="xy")
    for third in (0.4, 1.7):
        T = arm.fk([0.9, -0.5, third])
        given = {"alpha": 0.1} if method == "gradient" else None  # 2 / sigma_max^2 is below the default here.
        locked = [False, False, True]
        trace = ik.iterate(arm, T, [0.2, 0.3, third], method, locked=locked, most=300, parameters=given)
        assert np.all(trace.q[:, 2] == third)
        assert np.abs(trace.q[:, :2]).max() <= 2.0
        assert trace.position_error[-1] < 0.5 * trace.position_error[0]


def test_all_joints_locked_is_a_reason():
    for method in METHODS:
        trace = ik.iterate(TWO_R, at(1, 1), [0.1, 0.2], method, locked=[True, True])
        assert (trace.status, trace.reason, trace.iterations) == ("locked", "all joints are locked", 0)
        assert trace.w[0] == trace.sigma_min[0] == 0.0
    here = ik.iterate(TWO_R, TWO_R.fk([0.1, 0.2]), [0.1, 0.2], "newton", locked=[True, True])
    assert here.success


def test_locking_a_joint_makes_newton_unfit_and_leaves_gauss_newton():
    newton = ik.iterate(TWO_R, at(1, 1), [0.1, 1.4], "newton", locked=[False, True])
    assert newton.status == "unfit"
    assert "2 task components, 1 free joint)" in newton.reason
    assert ik.iterate(TWO_R, TWO_R.fk([0.3, 1.4]), [0.1, 1.4], "gauss_newton", locked=[False, True]).success


@pytest.mark.parametrize("method", METHODS)
def test_steps_end_at_the_limits_and_it_says_at_which(method):
    arm = Arm.from_dh(TWO_R.rows, limits=[[0.0, 0.5], [0.4, 2.0]])
    trace = ik.iterate(arm, TWO_R.fk([1.4, 1.0]), [0.2, 1.0], method)
    assert all(arm.within_limits(q) for q in trace.q)
    # What Broyden's matrix learns at a limit is that the joint there moves nothing.
    assert trace.status == ("singular" if method == "broyden" else "limit"), trace.reason
    assert "invert J" in trace.reason if method == "broyden" else "limits of joint" in trace.reason
    free = ik.iterate(arm, TWO_R.fk([1.4, 1.0]), [0.2, 1.0], method, limits="none", most=500)
    assert free.success or method == "broyden"
    assert not arm.within_limits(free.q[-1])


def test_a_start_outside_the_limits_is_moved_inside_and_joints_with_equal_limits_stay():
    arm = Arm.from_dh(TWO_R.rows, limits=[[0.3, 0.3], [-3, 3]])
    for method in METHODS:
        trace = ik.iterate(arm, arm.fk([0.3, 1.0]), [2.0, 0.8], method, most=500)
        assert np.all(trace.q[:, 0] == 0.3)
        assert trace.status in ("converged", "limit", "most")
        if method in ("gauss_newton", "gradient", "gradient_search", "ccd", "dls_error"):
            assert trace.position_error[-1] < trace.position_error[0]


@pytest.mark.parametrize("method", METHODS)
def test_out_of_reach_is_said(method):
    trace = ik.iterate(TWO_R, at(3.0, 1.0), [0.3, 0.4], method, most=20, limits="none")
    assert (trace.status, trace.reason) == ("out of reach", "out of reach: farther than the fully stretched arm")


@pytest.mark.parametrize("method", ["gradient", "dls_error"])
def test_no_target_is_out_of_reach_of_a_slide_whose_limits_are_not_kept(method):
    arm = catalogue()["cartesian_3p"].arm
    far = transform(arm.fk(np.zeros(3))[:3, :3], [2.0, 2.5, 3.0])
    short = ik.iterate(arm, far, np.zeros(3), method, most=3, limits="none")
    assert (short.status, short.reason) == ("most", "not reached in 3 steps, still converging: more steps may reach it")
    assert ik.iterate(arm, far, np.zeros(3), method, most=300, limits="none").success
    assert ik.iterate(arm, far, np.zeros(3), method, most=3).status == "out of reach"
    flow = ik.transpose_flow(arm, far, np.zeros(3), duration=1.0)
    assert (flow.status, flow.reason) == ("going", "not at the target after 1.00 s")


def test_too_few_steps_and_going_to_and_fro_are_told_apart():
    few = ik.iterate(TWO_R, at(0.9, 0.7), [0.2, 1.0], "gradient", most=5)
    assert (few.status, few.reason) == ("most", "not reached in 5 steps, still converging: more steps may reach it")
    # The hole of a 2R with links of 1 and 0.5 m: Gauss-Newton jumps about around the circle it cannot leave.
    arm = Arm.from_dh([("R", 1, 0, 0, 0), ("R", 0.5, 0, 0, 0)])
    hole = ik.iterate(arm, at(0.2, 0.0), [0.3, 2.0], "dls_constant", parameters={"lambda": 1e-4}, limits="none")
    assert hole.status in ("most", "jumped")
    assert hole.reason.startswith(("not reached in 200 steps: the iterates oscillate", "jumped"))


def test_iterates_whose_cost_only_falls_do_not_oscillate():
    arm = catalogue()["planar_3r"].arm
    T, start = arm.fk([-2.8, -0.7, -0.8]), [3.0, -0.3, -1.1]
    slow = ik.iterate(arm, T, start, "ccd", limits="none", most=60)
    assert np.all(np.diff(slow.cost) < 0)
    assert slow.reason == "not reached in 60 steps: the iterates come closer very slowly, if at all"
    assert ik.iterate(arm, T, start, "ccd", limits="none", most=1000).success


def test_a_first_step_beyond_all_bounds_is_told_without_counting_to_zero():
    trace = ik.iterate(TWO_R, TWO_R.fk([0.3, 1.0]), [0.1, 1e-10], "newton", limits="none")
    assert (trace.status, len(trace.q)) == ("diverged", 1)
    assert trace.reason == "diverged: almost singular, even the first step would exceed all bounds"


def test_arms_without_lengths_and_with_a_missing_direction_say_that_they_are_stuck():
    dot = Arm.from_dh([("R", 0, 0, 0, 0)] * 2, task="xy")
    slide = Arm.from_dh([("P", 0, 0, 0, 0)], task="xy", limits=[[-1, 1]])
    for method in METHODS:
        for arm, q in ((dot, [0.1, 0.2]), (slide, [0.2])):
            trace = ik.iterate(arm, transform(position=[1e-3, 0.0, 0.2]), q, method, most=5)
            assert trace.status in ("stuck", "out of reach", "unfit", "converged"), (method, trace.reason)
            assert not trace.success


def test_more_components_than_joints_end_where_the_slope_vanishes():
    trace = ik.iterate(
        TWO_R, transform(rotation_about("z", 2.0), [1.2, 0.5, 0.0]), [0.1, 1.0], "gauss_newton", task="xy phi"
    )
    assert trace.status in ("stuck", "most")
    assert "no closer" in trace.reason or "more task components than joints" in trace.reason


def test_singular_euler_angles_end_the_iteration_with_what_to_do():
    """Where the middle one is 90 degrees, z-y-x angles have no unique first and third; the rotation vector has."""
    q = np.array([0.3, -1.2, 1.4, -0.8, 0.9, 0.2])
    plain = catalogue()["ur10e"].arm
    turned = transform(plain.fk(q)[:3, :3].T @ plain.base[:3, :3] @ rotation_about("y", math.pi / 2))
    arm = Arm.from_dh(plain.rows, base=plain.base, tool=plain.tool @ turned)
    T = arm.fk(q + 0.05)
    trace = ik.iterate(arm, T, q, "newton", task=ik.task_vector(arm, "pose", euler="zyx"))
    assert trace.status == "representation"
    assert "choose another sequence, or the rotation vector" in trace.reason
    for task in (ik.task_vector(arm, "pose", euler="zyz"), "pose"):
        assert ik.iterate(arm, T, q, "newton", task=task).success


def test_euler_angles_and_the_rotation_vector_lead_to_the_same_pose_by_different_iterates(rng):
    arm = catalogue()["puma560"].arm
    q = np.array([0.3, -0.7, 2.4, 0.5, 0.9, -0.4])
    T = arm.fk(q)
    vector, euler = (
        ik.iterate(arm, T, q + 0.15, "newton", task=ik.task_vector(arm, "pose", euler=one), limits="none")
        for one in (None, "zyx")
    )
    assert vector.success
    assert euler.success
    assert np.abs(vector.q[1] - euler.q[1]).max() > 1e-4
    np.testing.assert_allclose(vector.q[-1], q, rtol=0, atol=1e-5)
    np.testing.assert_allclose(euler.q[-1], q, rtol=0, atol=1e-5)
    assert euler.names == ("p_x", "p_y", "p_z", "φ", "θ", "ψ")


def test_the_analytic_jacobian_is_the_slope_of_the_euler_angles(rng):
    """The first Newton step from beside a solution leads to it up to the square of the distance."""
    arm = catalogue()["puma560"].arm
    for sequence in ("zyx", "zyz", "xyz"):
        for fixed in (False, True):
            q = np.array([0.3, -0.7, 2.4, 0.5, 0.9, -0.4])
            move = 1e-4 * rng.normal(size=6)
            task = ik.task_vector(arm, "pose", euler=sequence, fixed=fixed)
            trace = ik.iterate(arm, arm.fk(q), q + move, "newton", task=task, most=1, limits="none")
            np.testing.assert_allclose(trace.q[1], q, rtol=0, atol=1e-6)


def test_the_third_joint_as_a_task_component_gives_the_two_arms_of_a_2r():
    """(p_x, p_y, q_3) of the 3R: links 1 and |1 + e^(i q3)|, elbow up and elbow down."""
    q3, p = 0.6, np.array([1.4, 0.9])
    task = ik.task_vector(THREE_R, "xy", joints={3: q3})
    assert task.names == ("p_x", "p_y", "q_3")
    ends = []
    for start in ([0.0, 1.0, 0.0], [1.5, -1.2, 0.0]):
        trace = ik.iterate(THREE_R, at(*p), start, "newton", task=task)
        assert trace.success
        assert trace.q[-1, 2] == pytest.approx(q3, abs=1e-6)
        np.testing.assert_allclose(THREE_R.position(trace.q[-1])[:2], p, rtol=0, atol=2e-6)
        assert trace.kinds == ("m", "m", "rad")
        ends.append(trace.q[-1])
    # By hand: the second link is 2 cos(q3/2) long and turned by q3/2.
    length = 2 * math.cos(q3 / 2)
    elbow = math.acos((p @ p - 1 - length**2) / (2 * length))
    expected = sorted([elbow - q3 / 2, -elbow - q3 / 2])
    np.testing.assert_allclose(sorted(q[1] for q in ends), expected, rtol=0, atol=1e-6)


@pytest.mark.parametrize("method", METHODS)
def test_where_metres_meet_radians_the_size_of_an_arm_changes_nothing(method):
    """Metres and radians are never added: the same SCARA in millimetres makes the same turns."""
    rows = [("R", 0.3, 0, 0.4, 0), ("R", 0.2, math.pi, 0, 0), ("P", 0, 0, 0, 0), ("R", 0, 0, 0, 0)]
    limits, big = np.array([[-3, 3], [-3, 3], [0, 0.3], [-3, 3.0]]), np.array([1.0, 1.0, 1000.0, 1.0])
    small_arm = Arm.from_dh(rows, limits=limits)
    large_arm = Arm.from_dh([(k, 1e3 * a, al, 1e3 * d, t) for k, a, al, d, t in rows], limits=limits * big[:, None])
    q, q0 = np.array([0.3, 1.1, 0.1, 0.4]), np.array([0.1, 0.8, 0.2, 0.0])
    small = ik.iterate(small_arm, small_arm.fk(q), q0, method, most=5, tolerance=(1e-9, 1e-9))
    large = ik.iterate(large_arm, large_arm.fk(q * big), q0 * big, method, most=5, tolerance=(1e-9, 1e-9))
    common = min(len(large.q), len(small.q))  # 1e-9 m is reached a step earlier by the small one.
    assert common > 2
    np.testing.assert_allclose((large.q / big)[:common], small.q[:common], rtol=0, atol=1e-7)
    np.testing.assert_allclose(large.cost[:common], small.cost[:common], rtol=1e-6, atol=1e-14)
    assert large.length == pytest.approx(1000 * small.length)
    assert "lengths are divided by" in small.scaling
    assert f"{small.length:.3f} m" in small.scaling
    tiny = Arm.from_dh([("R", 1e-4, 0.0, 0.0, 0.0)] * 3, task="xy phi")
    assert "divided by 0.000150 m" in ik.iterate(tiny, tiny.fk([0.1, 0.2, 0.3]), [0, 0, 0.5], most=0).scaling


def test_only_metres_or_only_radians_are_left_as_they_are():
    assert ik.iterate(TWO_R, at(1, 1), [0, 1], most=0).scaling == "metres and radians as they are: only one kind occurs"
    slides = catalogue()["cartesian_3p"].arm
    trace = ik.iterate(slides, slides.fk(slides.limits[:, 0]), slides.limits[:, 1], "newton")
    assert (trace.iterations, trace.length) == (1, 1.0)
    mixed = catalogue()["polar_rrp"].arm
    assert "where they meet radians" in ik.iterate(mixed, mixed.fk([0.1, 0.2, 0.3]), [0, 0, 0.5], most=0).scaling


def test_a_prismatic_newton_step_is_the_inverse_times_the_error_by_hand():
    """Polar arm in the plane: p = q2 (cos q1, sin q1). At (0, 2): J = [[0, 1], [2, 0]], so dq = (e_y / 2, e_x)."""
    arm = Arm.from_dh([("R", 0, -math.pi / 2, 0, -math.pi / 2), ("P", 0, 0, 0, 0)], limits=[[-3, 3], [0, 4]], task="xy")
    start = np.array([0.0, 2.0])
    x, y = arm.position(start)[:2]
    along = np.array([x, y]) / 2.0
    across = np.array([-along[1], along[0]])
    target = np.array([x, y]) + 0.1 * along + 0.06 * across
    trace = ik.iterate(arm, at(*target), start, "newton", most=1)
    np.testing.assert_allclose(trace.step[0], [0.03, 0.1], rtol=0, atol=1e-12)


def test_weights_change_the_path_of_a_damped_step_and_not_newtons():
    T, q0 = at(0.9, 0.7), [0.2, 1.0]
    plain, weighted = (ik.iterate(TWO_R, T, q0, "newton", weights=w, most=4) for w in (None, [3.0, 0.5]))
    np.testing.assert_allclose(weighted.q, plain.q, rtol=0, atol=1e-9)
    np.testing.assert_allclose(weighted.components, plain.components, rtol=0, atol=1e-9)
    assert weighted.cost[0] == pytest.approx(0.5 * np.sum((plain.components[0] * [3.0, 0.5]) ** 2), rel=1e-12)
    # By hand: J^T W^2 e with J = [[-1, -1], [1, 0]], e = (0.1, -0.2), W = diag(2, 1): (-0.4 - 0.2, -0.4).
    step = ik.iterate(
        TWO_R, at(1.1, 0.8), [0.0, math.pi / 2], "gradient", weights=[2, 1], parameters={"alpha": 0.5}, most=1
    )
    np.testing.assert_allclose(step.step[0], [-0.3, -0.2], rtol=0, atol=1e-13)


def test_a_base_elsewhere_changes_nothing(rng):
    base = transform(rotation_about("x", 0.7) @ rotation_about("z", 0.4), [0.3, -0.2, 0.9])
    arm = Arm.from_dh(THREE_R.rows, base=base)
    T = THREE_R.fk([0.5, 0.9, -0.3])
    for method in METHODS:
        here = ik.iterate(THREE_R, T, [0.2, 0.7, 0.1], method, most=10)
        there = ik.iterate(arm, base @ T, [0.2, 0.7, 0.1], method, most=10)
        np.testing.assert_allclose(there.q, here.q, rtol=0, atol=1e-7)
    np.testing.assert_allclose(inverse(base) @ base, np.eye(4), atol=1e-12)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("distance", [1e6, 1e200, 1e307])
def test_targets_at_the_end_of_the_numbers_end_in_words(method, distance):
    for key in ("planar_2r", "scara", "puma560"):
        arm = catalogue()[key].arm
        trace = ik.iterate(
            arm, transform(position=[distance, distance, 0.0]), arm.clip(np.full(arm.n, 0.3)), method, most=3
        )
        assert not trace.success
        assert np.isfinite(trace.q).all()
        assert trace.status == "out of reach"


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ({"T": np.full((4, 4), np.nan)}, "T: every entry must be finite"),
        ({"T": np.diag([1, 1, -1, 1])}, "T: .* not a rotation"),
        ({"q0": [0.0]}, "q0: expected 2 finite numbers"),
        ({"q0": [0.0, np.inf]}, "q0: expected 2 finite numbers"),
        ({"method": "magic"}, "method: unknown name 'magic'.*Available: broyden, ccd"),
        ({"method": []}, "method: unknown name"),
        ({"parameters": {"beta": 1}}, "parameters of gradient: unknown name 'beta'.*Available: alpha"),
        ({"parameters": {"alpha": 0}}, "expected 0.0001 to 100, got 0"),
        ({"parameters": {"alpha": "x"}}, "expected a finite number, got 'x'"),
        ({"tolerance": (0, 1)}, "tolerance: expected two positive numbers"),
        ({"tolerance": 1e-6}, "tolerance: expected two positive numbers"),
        ({"most": -1}, "most: expected a whole number, at least 0"),
        ({"limits": "soft"}, "limits: unknown name 'soft'.*Available: clamp, none"),
        ({"weights": [1]}, "weights: expected 2 positive numbers"),
        ({"weights": [1, 0]}, "weights: expected 2 positive numbers"),
        ({"weights": [1, np.nan]}, "weights: expected 2 positive numbers"),
        ({"locked": [True]}, "locked: expected 2 times True or False"),
        ({"task": "xyz roll"}, "task: unknown name 'xyz roll'"),
    ],
)
def test_wrong_input_of_an_iteration_is_named(arguments, text):
    given = {"T": np.eye(4), "q0": [0.1, 0.2], "method": "gradient", **arguments}
    with pytest.raises(InputError, match=text):
        ik.iterate(TWO_R, **given)


def test_the_components_of_an_orientation_share_one_weight():
    arm = catalogue()["puma560"].arm
    for weights in ([1, 1, 1, 1, 2, 1], [1, 2, 3, 1, 1, 1.5]):
        with pytest.raises(InputError, match="weights: expected one number for all components of the orientation"):
            ik.iterate(arm, arm.fk(np.zeros(6)), np.zeros(6), weights=weights)
    assert ik.iterate(arm, arm.fk(np.full(6, 0.4)), np.full(6, 0.5), weights=[1, 2, 3, 2, 2, 2]).success


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ({"task": 3}, "task: unknown name 3"),
        ({"joints": {0: 1.0}}, "joints: expected a whole number, at least 1, got 0"),
        ({"joints": {4: 1.0}}, "joints: expected joints 1 to 3, got 4"),
        ({"joints": {3: math.nan}}, "expected a finite number"),
        ({"euler": "zzx", "task": "pose"}, "euler: expected one of"),
        ({"euler": "zyx", "task": "xy"}, "euler: expected a task with a full orientation, got the task 'xy'"),
    ],
)
def test_wrong_task_vectors_are_named(arguments, text):
    with pytest.raises(InputError, match=text):
        ik.task_vector(THREE_R, **arguments)
