"""`solve`: its record, all methods, the last word of the list of all solutions, bad input."""

import itertools
import math

import numpy as np
import pytest

import armlab
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.ik.at_once import at_once
from armlab.kin.ik.turned_over import TURNED_OVER
from armlab.kin.ik.verdict import task_error_of
from armlab.kin.rotations import rotation_about
from armlab.kin.transforms import transform
from support.arms import random_q

TWO_R = Arm.from_dh([("R", 1, 0, 0, 0)] * 2)
UNEVEN = Arm.from_dh([("R", 1, 0, 0, 0), ("R", 0.5, 0, 0, 0)])
COMPILED, ITERATIVE = list(ik.methods()), list(ik.iteration_methods())


def at(*position):
    return transform(position=[*position, 0.0])


def test_everything_is_there_under_armlab_ik():
    for name in ("solve", "solve_all", "solve_batch", "self_motion", "iterate", "basins", "IkResult", "IkSolutions"):
        assert name in armlab.ik.__all__
        assert callable(getattr(armlab.ik, name))
    arm = armlab.load("planar_2r")
    assert armlab.ik.solve(arm, arm.fk([0.4, 0.9]), None, "dls", None, 0).success


# Methods.


@pytest.mark.parametrize(
    ("method", "key"),
    [(method, key) for method in ITERATIVE for key in ("planar_2r", "elbow_3r", "polar_rrp")]
    + [(method, key) for method in ("newton", "dls_error", "dls_w") for key in ("puma560", "ur10e", "panda")]
    + [("null_space_limits", "panda"), ("broyden", "ur10e")],
)
def test_every_iterative_method_solves_with_restarts(method, key, rng):
    arm = catalogue()[key].arm
    T = arm.fk(arm.limits.mean(axis=1) + 0.3 * np.ptp(arm.limits, axis=1) * rng.uniform(-1, 1, arm.n))
    first, second = (ik.solve(arm, T, method=method, seed=3, searches=26) for _ in range(2))
    assert first.success, first.reason
    assert arm.within_limits(first.q)
    assert max(first.position_error, first.rotation_error) < 1e-6
    assert first.q.tolist() == second.q.tolist()
    assert first.iterations > 0


def test_the_first_start_of_an_iterative_method_is_the_given_one_and_its_answer_the_near_one():
    for q2 in (0.9, -0.9):
        result = ik.solve(TWO_R, TWO_R.fk([0.4, q2]), q0=[0.3, 0.8 * q2], method="newton", searches=1)
        np.testing.assert_allclose(result.q, [0.4, q2], rtol=0, atol=1e-6)
    turned = ik.solve(TWO_R, TWO_R.fk([0.4, 0.9]), q0=[0.3, 0.8], method="newton", searches=1, trace=True)
    iterated = ik.iterate(TWO_R, TWO_R.fk([0.4, 0.9]), [0.3, 0.8], "newton", tolerance=(5e-7, 5e-7), limits="none")
    assert turned.trace.q.tolist() == iterated.q.tolist()
    assert turned.iterations == iterated.iterations


def test_a_method_that_cannot_be_used_says_so_and_the_rest_goes_on():
    far = ik.solve(TWO_R, at(0.3, 1.0), q0=[0.1, 0.2], method="newton", locked=[True, False])
    assert not far.success
    assert "Newton needs as many joints as task components (2 task components, 1 free joint)" in far.reason
    assert far.proven
    assert "there is no solution with these joints locked" in far.reason
    near = ik.solve(TWO_R, TWO_R.fk([0.1, 1.2]), q0=[0.1, 1.0], method="newton", locked=[True, False])
    assert near.success
    np.testing.assert_allclose(near.q, [0.1, 1.2], rtol=0, atol=1e-5)


# The record.


def test_no_record_is_kept_unless_asked_for_and_it_changes_nothing(robot, rng):
    T = robot.arm.fk(random_q(robot.arm, rng))
    # Without a start there are no steps where a closed form is quick.
    start = None if at_once(robot.arm) is None else random_q(robot.arm, rng)
    plain, recorded = (ik.solve(robot.arm, T, start, seed=5, trace=wanted) for wanted in (False, True))
    assert plain.trace is None
    assert plain.q.tolist() == recorded.q.tolist()
    assert plain.iterations == recorded.iterations
    trace = recorded.trace
    assert trace.success
    assert trace.position_error[-1] < 1e-6
    assert trace.rotation_error[-1] < 1e-6
    turns = (trace.q[-1] - recorded.q)[robot.arm.revolute] / (2 * math.pi)
    np.testing.assert_allclose(turns, np.round(turns), rtol=0, atol=1e-9)
    assert 1 <= trace.iterations <= plain.iterations


def test_the_record_of_damped_least_squares_is_its_formula():
    """dq = J^T (J J^T + mu I)^-1 e with mu = 0.1 |e|^2 + 1e-13; the length scale of the arm, half its reach, is 1 m."""
    result = ik.solve(TWO_R, at(0.9, 0.7), q0=[0.2, 1.0], trace=True)
    trace = result.trace
    assert (trace.method, trace.parameters) == ("dls", {"gain": 0.1})
    np.testing.assert_allclose(trace.q[0], [0.2, 1.0])
    assert trace.reason == f"converged in {trace.iterations} steps"
    for q, step, damping in zip(trace.q[:-1], trace.step, trace.damping, strict=True):
        J, e = TWO_R.jacobian(q)[:2], [0.9, 0.7] - TWO_R.position(q)[:2]
        assert damping == pytest.approx(0.1 * e @ e + 1e-13, rel=1e-9)
        expected = J.T @ np.linalg.solve(J @ J.T + damping * np.eye(2), e)
        np.testing.assert_allclose(step, expected, rtol=0, atol=1e-9)


def test_the_record_counts_angles_by_their_chord_as_the_compiled_error_does(robot, rng):
    """Two implementations of one error: compiled expressions, and arrays."""
    arm = robot.arm
    T, q = arm.fk(random_q(arm, rng)), random_q(arm, rng)
    trace = ik.solve(arm, T, q, trace=True, searches=1, complete=False).trace
    task = task_error_of(arm)
    for k, one in enumerate(trace.q):
        J, _, errors = task.at(one.tolist(), task.target(T))
        assert 2 * trace.cost[k] == pytest.approx(errors.cost, rel=1e-6, abs=1e-15)
        assert trace.position_error[k] == pytest.approx(errors.position, abs=1e-12)
        # Near 180 degrees sin(theta/2) is flat, and so the angle is told to few digits.
        assert trace.rotation_error[k] == pytest.approx(errors.rotation, abs=1e-6 if errors.rotation < 3.1 else 1e-3)
        assert trace.sigma_max[k] == pytest.approx(np.linalg.svd(J, compute_uv=False)[0], rel=1e-9)


def test_a_failing_search_leaves_the_record_of_its_last_descent():
    result = ik.solve(TWO_R, at(3.0, 0.0), q0=[0.3, 0.4], trace=True)
    assert not result.success
    assert result.trace.status == "out of reach"
    newton = ik.solve(TWO_R, at(3.0, 0.0), q0=[0.3, 0.4], method="newton", trace=True)
    assert newton.trace.method == "newton"
    assert not newton.trace.success


# The last word of the list of all solutions.


def test_where_the_search_fails_the_solution_nearest_to_the_start_is_taken_from_the_list(rng):
    arm = catalogue()["puma560"].arm
    taken = 0
    for _ in range(12):
        T, q0 = arm.fk(random_q(arm, rng)), random_q(arm, rng)
        result = ik.solve(arm, T, q0, method="gradient", searches=1)
        assert result.success
        if result.reason == "reached":
            continue
        taken += 1
        assert result.reason == "reached; found in the list of all solutions, not by this search"
        found = ik.solve_all(arm, T)
        inside = found.q[found.within_limits]
        turns = [found.equivalents(int(k)) for k in np.flatnonzero(found.within_limits)]
        distances = [np.linalg.norm(one - q0, axis=1).min() for one in turns]
        assert np.linalg.norm(result.q - q0) == pytest.approx(min(distances), abs=1e-6)
        assert len(inside) >= 1
        assert not ik.solve(arm, T, q0, method="gradient", searches=1, complete=False).success
    assert taken >= 4


def test_that_there_is_no_solution_is_proven_where_it_can_be():
    hole = ik.solve(UNEVEN, at(0.2, 0.1), q0=[0.3, 2.0], searches=5)
    assert (hole.success, hole.proven) == (False, True)
    assert hole.reason == "closest possible from here; proven: there is no solution"
    assert hole.position_error == pytest.approx(0.5 - math.hypot(0.2, 0.1), abs=1e-6)
    unproven = ik.solve(UNEVEN, at(0.2, 0.1), q0=[0.3, 2.0], searches=5, complete=False)
    assert (unproven.proven, unproven.reason) == (False, "closest possible from here")
    assert unproven.q.tolist() == hole.q.tolist()


def test_beyond_the_reach_no_search_is_made_and_that_is_a_proof():
    result = ik.solve(TWO_R, at(3.0, 0.0), q0=[0.3, 0.4])
    assert result.proven
    assert result.reason == "out of reach: farther than the fully stretched arm"
    assert result.iterations < 100
    # The stretched arm itself is a solution, and rounding makes it no target beyond.
    for angle in np.linspace(0, 2 * math.pi, 17):
        stretched = ik.solve(TWO_R, TWO_R.fk([angle, 0.0]))
        assert stretched.success, stretched.reason


PHI = ["planar_3r", "planar_3r_unequal", "scara"]


def turned_by(key, angle):
    """Return a pose of the tool that an arm reaches, turned about the tool's x axis."""
    arm = catalogue()[key].arm
    middle = arm.limits.mean(axis=1) + np.where(arm.revolute, 0.3, 0.0)
    return arm, arm.fk(middle) @ transform(rotation_about("x", angle))


@pytest.mark.parametrize("key", PHI)
@pytest.mark.parametrize("angle", [math.pi, 1.6, -1.6])
def test_a_tool_that_is_turned_over_in_the_target_is_named_as_the_reason(key, angle):
    arm, T = turned_by(key, angle)
    result = ik.solve(arm, T)
    assert (result.success, result.proven) == (False, True)
    assert result.reason == f"closest possible from here; proven: {TURNED_OVER}"
    every = ik.solve_all(arm, T)
    assert every.completeness == "none"
    assert every.sentence == f"No solution. I{TURNED_OVER[1:]}."


@pytest.mark.parametrize("key", PHI)
def test_a_tool_that_is_tilted_less_than_a_quarter_turn_is_no_hindrance_to_phi(key):
    arm, T = turned_by(key, 1.5)
    assert ik.solve(arm, T).success
    assert len(ik.solve_all(arm, T)) == 2


def test_an_arm_with_joints_to_spare_proves_it_too_and_a_far_target_is_far_all_the_same():
    four = Arm.from_dh([("R", 0.4, 0.0, 0.0, 0.0)] * 4, base=transform(rotation_about("y", 2.0)))
    T = four.fk([0.3, 0.4, 0.5, 0.6]) @ np.diag([1.0, -1.0, -1.0, 1.0])
    assert four.task.rotation == "phi"
    assert ik.solve(four, T).proven
    assert ik.solve_all(four, T).sentence.endswith(f"I{TURNED_OVER[1:]}.")
    T[:3, 3] += four.base[:3, 0] * 5.0
    assert ik.solve(four, T).reason.startswith("out of reach")


def test_solutions_outside_the_limits_are_named_with_the_nearest_one():
    arm = Arm.from_dh(TWO_R.rows, limits=[[-0.5, 0.5], [0.0, 1.0]])
    # Elbow down is (0, 1.2), 0.2 rad = 11.5 degrees above the limit of joint 2.
    result = ik.solve(arm, TWO_R.fk([0.0, 1.2]), searches=5)
    assert result.proven
    assert result.reason.endswith(
        "proven: all 2 solutions are outside the limits, the nearest has joint 2 by 11.5° above"
    )
    one = Arm.from_dh([("R", 1, 0, 0, 0)], limits=[[-0.5, 0.5]], task="phi")
    single = ik.solve(one, one.fk([1.0]), searches=3)
    assert single.reason.endswith("proven: the only solution is outside the limits, joint 1 by 28.6° above")


def test_a_general_six_joint_arm_has_the_last_word_too(rng):
    arm = catalogue()["manseur_doty"].arm
    T, q0 = arm.fk(random_q(arm, rng)), random_q(arm, rng)
    assert ik.solve(arm, T, q0, method="gradient", searches=1).success
    far = np.array(T)
    far[:3, 3] *= 0.98 * arm.reach / np.linalg.norm(far[:3, 3])
    result = ik.solve(arm, far, q0, searches=3)
    assert result.success or "proven: there is no solution" in result.reason


def test_with_locked_joints_the_list_is_that_of_the_arm_that_is_left():
    arm = Arm.from_dh([("R", 1, 0, 0, 0)] * 3, task="xy")
    q0 = np.array([0.2, 0.3, 0.4])
    lock = [False, False, True]
    T = arm.fk([0.9, -0.5, 0.4])
    found = ik.solve(arm, T, q0, method="gradient", locked=lock, searches=1)
    assert found.success
    assert found.q[2] == 0.4
    none = ik.solve(arm, at(0.01, 0.0), q0=[0.2, 0.3, 0.1], locked=lock, searches=2)
    assert none.proven
    assert none.reason.endswith("proven: there is no solution with these joints locked")
    assert not ik.solve(arm, at(0.01, 0.0), q0=[0.2, 0.3, 0.1], searches=20).proven


def test_nothing_is_claimed_about_arms_without_a_complete_solver():
    for key in ("panda", "stanford"):
        arm = catalogue()[key].arm
        T = np.array(arm.fk(arm.limits.mean(axis=1)))
        T[:3, 3] = arm.base[:3, 3] + np.array([0.0, 0.0, 0.02])
        result = ik.solve(arm, T, arm.limits.mean(axis=1), searches=3)
        if not result.success and key == "panda":
            assert not result.proven
            assert "proven" not in result.reason


def test_no_solution_that_is_known_is_ever_proven_away(robot, rng):
    for method in ("gradient", "dls"):
        q0 = random_q(robot.arm, rng)
        result = ik.solve(robot.arm, robot.arm.fk(random_q(robot.arm, rng)), q0, method=method, searches=1)
        assert not result.proven
        assert result.success or "proven" not in result.reason


# Bad input.


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ({"weights": [1.0]}, r"weights: expected 2 positive numbers, got \[1\]"),
        ({"weights": [1.0, -1.0]}, "weights: expected 2 positive numbers"),
        ({"weights": [1.0, 0.0]}, "weights: expected 2 positive numbers"),
        ({"weights": [1.0, np.inf]}, "weights: expected 2 positive numbers"),
        ({"weights": "heavy"}, "weights: expected 2 positive numbers, got 'heavy'"),
        ({"weights": [1.0, 1e-9]}, r"weights: expected a ratio of at most 1e\+06"),
        ({"method": []}, "method: unknown name"),
        ({"method": "magic"}, "Available: broyden, ccd, dls, dls_bias, .*newton"),
        ({"seed": -1}, "seed: expected a whole number"),
        ({"searches": 0}, "searches: expected a whole number"),
    ],
)
def test_wrong_input_of_solve_is_named(arguments, text):
    with pytest.raises(InputError, match=text):
        ik.solve(TWO_R, np.eye(4), **arguments)
    if "weights" in arguments:
        with pytest.raises(InputError, match=text):
            ik.judge(TWO_R, np.eye(4), [0, 0], **arguments)


def test_the_weights_of_an_orientation_are_one_number():
    arm = catalogue()["puma560"].arm
    with pytest.raises(InputError, match=r"one number for all components of the orientation, got \[1.0, 2.0, 1.0\]"):
        ik.solve(arm, arm.fk(np.zeros(6)), weights=[1, 1, 1, 1, 2, 1])


AWKWARD = {
    "no lengths": Arm.from_dh([("R", 0, 0, 0, 0)] * 3, task="xyz"),
    "equal limits": Arm.from_dh([("R", 1, 0, 0, 0)] * 2, limits=[[0.3, 0.3], [0.5, 0.5]]),
    "one slide": Arm.from_dh([("P", 0, 0, 0, 0)]),
    "one turn": Arm.from_dh([("R", 0, 0, 0, 0)]),
    "eight joints": Arm.from_dh([("R", 0.1, math.pi / 2, 0.2, 0)] * 8),
    "tiny": Arm.from_dh([("R", 1e-9, 0, 0, 0)] * 2),
    "huge": Arm.from_dh([("R", 1e9, 0, 0, 0)] * 2),
}


@pytest.mark.parametrize("method", COMPILED + [key for key in ITERATIVE if key not in COMPILED])
@pytest.mark.parametrize("name", AWKWARD)
def test_awkward_arms_get_an_answer_and_never_a_wrong_one(name, method):
    arm = AWKWARD[name]
    turned = transform(rotation_about("x", 1.0), [0.3, 0.2, 0.1])
    targets = [np.eye(4), turned, at(1e6, 0.0), at(1e300, 1e300), arm.fk(arm.limits.mean(axis=1))]
    if method not in COMPILED:  # Slow ones take turns: each meets every arm and every target.
        turn = list(AWKWARD).index(name) + ITERATIVE.index(method)
        targets = [targets[turn % 5], targets[(turn + 2) % 5]]
    for T, locked in itertools.product(targets, (None, [True] * arm.n)):
        q0 = arm.limits.mean(axis=1) + 0.1
        result = ik.solve(arm, T, q0, method=method, searches=1, locked=locked)
        assert np.isfinite(result.q).all()
        assert result.reason
        if locked is not None:
            assert result.q.tolist() == q0.tolist()
        if result.success:
            E = arm.fk(result.q)
            assert np.linalg.norm((E - T)[arm.task.coordinates, 3]) < 1e-6
            assert arm.within_limits(result.q)
            assert not result.proven
