"""The time-optimal law along a path: exact limits, as fast as others find it, and where the path is difficult."""

from itertools import pairwise

import numpy as np
import pytest

import armlab
from armlab.errors import InputError
from armlab.kin.motion import (
    Limits,
    ToolPath,
    Trajectory,
    about_one_axis,
    coordinated,
    follow,
    law_type,
    path_type,
    run_along,
    violations,
)
from armlab.kin.motion.path import PolynomialPath
from armlab.kin.motion.piecewise import Piecewise
from armlab.kin.timing._phase_plane import Bands, tops

LAW = law_type("time_optimal")

GRID = 1.001
"""Times the time of another law, which a grid of 1000 steps may cost."""


def excess(motion, limits, count=50_001):
    """Return by which part a limit is exceeded at most, at dense samples."""
    q_dot, q_ddot = motion.derivatives(np.linspace(0.0, motion.duration, count), (1, 2))
    return max((np.abs(q_dot) / limits.velocity).max(), (np.abs(q_ddot) / limits.acceleration).max()) - 1.0


def drawn(rng, m):
    return Limits(rng.uniform(0.5, 3.0, m), rng.uniform(0.5, 6.0, m))


def test_along_every_path_the_limits_are_kept_and_no_law_is_faster(path_case, rng):
    *_, path = path_case
    limits = drawn(rng, path.m)
    motion = Trajectory(path, LAW.along(path, limits))
    assert violations(motion, limits) == []
    assert excess(motion, limits) <= 1e-9
    np.testing.assert_allclose(motion.at(motion.duration), path.at(1.0), rtol=0, atol=1e-9)
    for other in ("trapezoidal", "quintic"):
        # At a corner these do not stop, so that they may be faster.
        if path.continuity >= 1:
            assert motion.duration <= GRID * law_type(other).along(path, limits, jumps=True).duration


@pytest.mark.parametrize("limits", [Limits(10.0, 1.0), Limits(0.5, 1.0), Limits([0.4, 3.0], [2.0, 0.3])], ids=str)
def test_on_a_straight_line_it_is_the_trapezoid(limits):
    line = path_type("line").path([[0.0, 0.0], [1.0, 0.5]])
    law, trapezoid = LAW.along(line, limits), law_type("trapezoidal").along(line, limits)
    # The grid cuts off the corner of the speed: steps of 1/1000 cost the square of that.
    assert law.duration == pytest.approx(trapezoid.duration, rel=1e-6)
    t = np.linspace(0.0, trapezoid.duration, 500)
    np.testing.assert_allclose(law.at(t), trapezoid.at(t), rtol=0, atol=2e-6)
    assert len(law.pieces) <= 5


def test_ramps_much_shorter_than_a_step_cost_no_more_than_their_time(rng):
    """A trapezoid for each side, which stops at its corners, is as fast up to what the grid costs."""
    for path, limits in (
        (path_type("line").path([[0.0], [1.0]]), Limits(0.1, 10.0)),
        (path_type("line").path([[0.0], [1.0]]), Limits(0.1, 1e4)),
        (path_type("polyline").path(rng.normal(size=(21, 2))), Limits(1.0, 50.0)),
    ):
        corners = path.at(path.edges)
        alone = sum(coordinated(*sides, limits=limits).duration for sides in pairwise(corners))
        motion = Trajectory(path, LAW.along(path, limits))
        assert motion.duration <= GRID * alone
        assert violations(motion, limits) == []


def test_with_twice_the_steps_it_comes_nearer(rng):
    path = path_type("spline").path(rng.normal(size=(6, 3)))
    limits = drawn(rng, 3)
    times = [LAW.along(path, limits, steps=steps).duration for steps in (250, 500, 1000, 4000)]
    best = times[-1]
    assert abs(times[0] / best - 1.0) < 5e-3
    assert abs(times[2] / best - 1.0) < 1e-3


def test_the_arm_stops_at_a_corner(rng):
    corners = rng.normal(size=(4, 2))
    path = path_type("polyline").path(corners)
    limits = drawn(rng, 2)
    law = LAW.along(path, limits)
    motion = Trajectory(path, law)
    for place in path.pieces:
        knot = law.pieces[np.abs(law.at(law.pieces) - place).argmin()]
        np.testing.assert_allclose(motion.derivatives(knot, (1,))[0], 0.0, rtol=0, atol=1e-9)
    lines = [path_type("line").path(corners[k : k + 2]) for k in range(3)]
    # Each side as if it were alone; its corners of the speed are cut off by a share of the 1000 steps.
    alone = sum(law_type("trapezoidal").along(line, limits).duration for line in lines)
    assert law.duration == pytest.approx(alone, rel=1e-5)


def test_where_the_path_stands_still_inside_the_joints_stop():
    # q = s^3 about its middle: q' = 0 there. By its length it is a straight line.
    cubed = PolynomialPath(Piecewise(np.array([0.0, 1.0]), np.array([[-0.125, 0.75, -1.5, 1.0]])[:, :, None]))
    limits = Limits(10.0, 2.0)
    motion = Trajectory(cubed, LAW.along(cubed, limits))
    assert violations(motion, limits) == []
    # Twice 0.125 with an acceleration of 2, each from rest to rest: 4 sqrt(0.125 / 2).
    assert motion.duration == pytest.approx(4.0 * np.sqrt(0.0625), rel=5e-3)
    assert abs(motion.at(0.5 * motion.duration, 1)[0]) < 0.05


@pytest.mark.parametrize("key", ["harmonic", "cycloidal", "polynomial"])
def test_a_path_that_rests_at_its_ends_is_run_as_the_line_it_is(key):
    options = {"degree": 7} if key == "polynomial" else {}
    path = path_type(key).path([[0.0, 0.0], [1.0, -2.0]], **options)
    limits = Limits([1.0, 5.0], 3.0)
    motion = Trajectory(path, LAW.along(path, limits))
    line = run_along(path_type("line").path([[0.0, 0.0], [1.0, -2.0]]), "trapezoidal", limits)
    assert violations(motion, limits) == []
    assert motion.duration == pytest.approx(line.duration, rel=3e-3)
    assert motion.duration >= line.duration * (1.0 - 1e-9)


def test_speeds_at_the_ends_are_kept_or_refused(rng):
    path = path_type("spline").path(rng.normal(size=(5, 3)), ends="natural")
    limits = drawn(rng, 3)
    rest = LAW.along(path, limits)
    law = LAW.along(path, limits, sdot_start=0.1, sdot_end=0.05)
    assert law.at(0.0, 1) == pytest.approx(0.1, rel=1e-9)
    assert law.derivatives(law.duration, (1,), before=True)[0] == pytest.approx(0.05, rel=1e-9)
    assert law.duration < rest.duration
    assert excess(Trajectory(path, law), limits) <= 1e-9
    with pytest.raises(InputError, match=r"sdot_start: expected 0 to [\d.]+ to keep the limits, got 50"):
        LAW.along(path, limits, sdot_start=50.0)
    with pytest.raises(InputError, match=r"sdot_end: expected at most [\d.]+ to keep the limits, got 50"):
        LAW.along(path, limits, sdot_end=50.0)


def test_an_end_speed_that_the_start_cannot_reach_is_refused():
    line = path_type("line").path([[0.0], [1.0]])
    # From rest with 2 m/s^2 over 1 m: at most 2 m/s.
    assert LAW.along(line, Limits(100.0, 2.0), sdot_end=1.999).duration == pytest.approx(1.0, rel=1e-3)
    with pytest.raises(InputError, match=r"sdot_start: expected 0\.9165\d* to"):
        LAW.along(line, Limits(100.0, 2.0), sdot_end=2.2)


def test_an_end_speed_that_the_last_corner_leaves_no_room_for_is_refused():
    path = path_type("polyline").path([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
    # s is 1/2 on the last side of 1 m: with 2 m/s^2 at most 2 m/s at its end, which is 1/s of s.
    assert LAW.along(path, Limits(100.0, 2.0), sdot_end=0.999).at(0.0, 1) == 0.0
    with pytest.raises(InputError, match=r"sdot_end: 1\.1 cannot be reached within the limits on what is left"):
        LAW.along(path, Limits(100.0, 2.0), sdot_end=1.1)


def test_what_it_needs_is_said():
    line = path_type("line").path([[0.0, 0.0], [1.0, 0.5]])
    with pytest.raises(InputError, match="limit of acceleration: the time-optimal law needs one"):
        LAW.along(line, Limits(1.0))
    with pytest.raises(InputError, match="limit of jerk: the acceleration of Time-optimal along the path jumps"):
        LAW.along(line, Limits(1.0, 1.0, 1.0))
    for call in (lambda: LAW.law(1.0), lambda: LAW.within(Limits(1.0, 1.0))):
        with pytest.raises(InputError, match="depends on the path and the limits of the joints: use along"):
            call()
    free = Limits(acceleration=[1.0, np.inf])
    only_second = path_type("polyline").path([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
    with pytest.raises(InputError, match="limits: on a part of the path none of them holds the motion back"):
        LAW.along(only_second, free)


def test_beside_a_singularity_a_line_of_the_tool_keeps_the_limits_of_the_joints():
    arm = armlab.load("puma560")
    # The wrist nearly straight on the way: joints 4 and 6 turn fast.
    start, end = arm.fk([0.3, -0.6, 0.5, 0.4, 0.25, 0.2]), arm.fk([0.5, -0.5, 0.6, 2.2, 0.1, -1.4])
    line = path_type("line").path([start[:3, 3], end[:3, 3]])
    found = follow(
        arm, ToolPath(line, about_one_axis(start[:3, :3], end[:3, :3])), [0.3, -0.6, 0.5, 0.4, 0.25, 0.2], 201
    )
    assert found.whole
    path, limits = found.joint_path(), Limits(2.0, 6.0)
    motion = run_along(path, "time_optimal", limits)
    assert violations(motion, limits) == []
    assert motion.duration < 0.9 * run_along(path, "trapezoidal", limits).duration


def test_the_largest_speed_of_a_step_is_that_of_linear_programming(rng):
    from scipy.optimize import linprog

    for rows in (2, 5, 9):
        A, B = rng.normal(size=(2, 20, rows))
        # A step of a grid: beginning and end push in opposite ways nearly as much.
        B[::2] = -A[::2] + 0.1 * B[::2]
        top, at = tops(Bands(A, B))
        for k in range(20):
            both = np.stack([A[k], B[k]], axis=1)
            sides = np.concatenate([both, -both])
            best = linprog([-1.0, 0.0], A_ub=sides, b_ub=np.ones(2 * rows), bounds=[(None, None), (0.0, None)])
            assert top[k] == pytest.approx(-best.fun, rel=1e-7)
            assert np.abs(A[k] * top[k] + B[k] * at[k]).max() <= 1.0 + 1e-9


def test_it_is_as_fast_as_the_peer(rng):
    toppra = pytest.importorskip("toppra")
    from toppra.algorithm import TOPPRA
    from toppra.constraint import DiscretizationType, JointAccelerationConstraint, JointVelocityConstraint

    places = np.linspace(0.0, 1.0, 1001)
    for m in (1, 3, 7):
        knots = rng.normal(size=(6, m))
        path, limits = path_type("spline").path(knots, ends="natural", spacing="uniform"), drawn(rng, m)
        peer = toppra.SplineInterpolator(np.linspace(0.0, 1.0, 6), knots, bc_type="natural")
        bounds = [np.stack([-each, each], axis=1) for each in (limits.velocity, limits.acceleration)]
        scheme = DiscretizationType.Interpolation
        held = [
            JointVelocityConstraint(bounds[0]),
            JointAccelerationConstraint(bounds[1], discretization_scheme=scheme),
        ]
        _, speeds, _ = TOPPRA(held, peer, gridpoints=places, solver_wrapper="seidel").compute_parameterization(0, 0)
        theirs = float(np.sum(2.0 * np.diff(places) / (speeds[1:] + speeds[:-1])))
        assert LAW.along(path, limits).duration == pytest.approx(theirs, rel=1e-3)
