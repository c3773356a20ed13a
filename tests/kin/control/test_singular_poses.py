"""Singular configurations that one joint reaches: by hand on small arms, and singular indeed on every robot."""

import math

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.conditioning import SINGULAR
from armlab.kin.control.rate_inverse import rate_step
from armlab.kin.control.scaled_task import ScaledTask
from armlab.kin.control.singular_poses import FAR, nearest_singular_pose, singular_poses


def inverse_condition(task, q):
    sigma = np.linalg.svd(task.scaled(task.jacobian(q)), compute_uv=False)
    return sigma[-1] / sigma[0]


def test_the_2r_is_singular_stretched_and_folded():
    task = ScaledTask(catalogue()["planar_2r"].arm)
    found = singular_poses(task, [0.3, 1.0])
    assert {pose.place for pose in found} == {1}
    at = sorted(float(pose.q[1]) for pose in found)
    np.testing.assert_allclose(at, [-math.pi, 0.0, math.pi], rtol=0, atol=1e-8)
    assert all(pose.q[0] == 0.3 and pose.away == pytest.approx(pose.q[1] - 1.0) for pose in found)


@pytest.mark.parametrize("q2", [0.3, -0.05, 1e-6, 3.0, -3.1])
def test_the_nearest_of_the_2r(q2):
    task = ScaledTask(catalogue()["planar_2r"].arm)
    found = nearest_singular_pose(task, [0.3, q2])
    there = 0.0 if abs(q2) < 1.0 else math.copysign(math.pi, q2)
    assert found.place == 1
    assert found.q[1] == pytest.approx(there, abs=1e-8)
    assert found.away == pytest.approx(there - q2, abs=1e-8)


def test_where_none_is_near_there_is_none_and_at_one_it_is_here():
    task = ScaledTask(catalogue()["planar_2r"].arm)
    assert nearest_singular_pose(task, [0.3, 1.5]) is None
    here = nearest_singular_pose(task, [0.3, 0.0])
    assert (here.away, here.q.tolist()) == (0.0, [0.3, 0.0])


def test_a_jacobian_that_is_no_number_somewhere_is_not_taken_for_zero():
    task = ScaledTask(catalogue()["planar_2r"].arm)
    J = np.array([[[math.nan, 1.0], [2.0, 3.0]], [[1e-17, 0.0], [0.0, -1e-17]]])
    np.testing.assert_array_equal(task.scaled(J), [J[0], np.zeros((2, 2))])
    np.testing.assert_array_equal(task.scaled(J[0]), J[0])


ONE_ROW = {"x": ((1.0,), [3.0], 0, math.pi), "y": ((1.0, 0.8), [math.pi / 2, 0.1], 1, 0.0)}


@pytest.mark.parametrize("key", ONE_ROW)
def test_a_task_of_one_row_is_singular_where_no_joint_moves_the_tool_along_it(key):
    """The sine of pi and the cosine of a right angle are zero but for rounding, and count as zero."""
    links, q, place, at = ONE_ROW[key]
    arm = Arm.from_dh([("R", length, 0, 0, 0) for length in links], task=key)
    task = ScaledTask(arm)
    found = nearest_singular_pose(task, q)
    assert (found.place, found.q[place]) == (place, pytest.approx(at, abs=1e-8))
    assert any(pose.place == place and pose.q[place] == pytest.approx(at, abs=1e-8) for pose in singular_poses(task, q))
    exact = np.array(q)
    exact[place] = at
    assert nearest_singular_pose(task, exact).away == 0.0
    J = task.scaled(task.jacobian(exact))
    assert task.jacobian(exact).any()
    for method in ("pinv", "transpose", "weighted"):
        assert not rate_step(method, J, [0.1]).qdot.any()


def test_the_wrist_and_the_elbow_of_the_puma():
    robot = catalogue()["puma560"]
    task, q = ScaledTask(robot.arm), robot.home.copy()
    q[4] = math.radians(4.0)
    found = nearest_singular_pose(task, q)
    assert (found.place, found.away) == (4, pytest.approx(-math.radians(4.0), abs=1e-8))
    assert {pose.place for pose in singular_poses(task, robot.home)} >= {2, 4}


def test_all_that_is_found_is_singular_and_inside_the_limits(robot, rng):
    task, arm = ScaledTask(robot.arm), robot.arm
    for q in [robot.home, *rng.uniform(*arm.limits.T, (2, arm.n))]:
        for pose in singular_poses(task, q):
            assert inverse_condition(task, pose.q) <= SINGULAR
            assert arm.within_limits(pose.q)
            others = np.arange(arm.n) != pose.place
            np.testing.assert_array_equal(pose.q[others], q[others])
            # From beside it, what is near is found again, or something nearer.
            beside = pose.q.copy()
            step = 0.02 * task.joint_units[pose.place]
            beside[pose.place] += step if beside[pose.place] + step <= arm.limits[pose.place, 1] else -step
            near = nearest_singular_pose(task, beside)
            if near is not None:
                assert abs(near.away) / task.joint_units[near.place] <= 0.02 + 1e-6
                assert inverse_condition(task, near.q) <= SINGULAR
            elif inverse_condition(task, beside) > 0.0:
                raise AssertionError(f"{robot.key}: nothing found beside joint {pose.place + 1}")


@pytest.mark.parametrize("key", ["elbow_3r", "irb140", "tx60", "ur5e"])
def test_wherever_the_determinant_changes_its_sign_over_the_range_of_a_joint_a_pose_is_found(key, rng):
    arm = catalogue()[key].arm
    task = ScaledTask(arm)
    crossings = 0
    for q in rng.uniform(*np.clip(arm.limits.T, -3.0, 3.0), (4, arm.n)):
        found = singular_poses(task, q)
        for k in range(arm.n):
            along = np.tile(q, (4000, 1))
            along[:, k] = np.linspace(*arm.limits[k], 4000)
            sizes = np.linalg.det(task.jacobians(along, arm.fk(along)))
            signed = np.where(np.abs(sizes) < 1e-12, 0.0, sizes)
            for i in np.flatnonzero(signed[:-1] * signed[1:] < 0.0).tolist():
                crossings += 1
                assert any(pose.place == k and along[i, k] <= pose.q[k] <= along[i + 1, k] for pose in found)
    assert crossings > 8


def test_nonsense_is_refused():
    task = ScaledTask(catalogue()["planar_2r"].arm)
    for call in (nearest_singular_pose, singular_poses):
        with pytest.raises(InputError, match="q: expected 2 finite numbers"):
            call(task, [0.0, math.nan])


def test_what_is_near_is_near(robot, rng):
    """No joint goes farther than FAR."""
    task = ScaledTask(robot.arm)
    for q in rng.uniform(robot.arm.limits[:, 0], robot.arm.limits[:, 1], (6, robot.arm.n)):
        found = nearest_singular_pose(task, q)
        if found is not None:
            assert abs(found.away) <= FAR * task.joint_units[found.place] * (1.0 + 1e-12)
            assert found.q[found.place] - q[found.place] == pytest.approx(found.away, abs=1e-12)


SAMPLED = 2.0 * FAR / 1200
"""Largest distance of two samples, in scaled units."""


def sampled_conditions(task, q):
    J = task.jacobians(q, np.asarray(task.arm.fk(q)))
    sigma = np.linalg.svd(J, compute_uv=False)
    return J, sigma[:, -1] / sigma[:, 0]


def sampled_distance(task, q, reach):
    """Return how far the nearest singular configuration of one joint is on a dense grid, in scaled units; or inf.

    It is where the determinant changes sign, or where the inverse condition dips to nearly zero between samples. What
    is farther than `reach` is not looked for.
    """
    nearest = math.inf
    for k in range(task.n):
        low, high = np.clip(q[k] + np.array([-reach, reach]) * task.joint_units[k], *task.arm.limits[k])
        samples = max(3, math.ceil((high - low) / (SAMPLED * task.joint_units[k])) + 1)
        places = np.linspace(low, high, samples)
        along = np.tile(q, (samples, 1))
        along[:, k] = places
        # A joint that matters is seen to do so by a few of them.
        if np.ptp(sampled_conditions(task, along[:: max(1, samples // 8)])[1]) < 1e-9:
            continue
        J, inverse = sampled_conditions(task, along)
        zero = np.zeros(samples, dtype=bool)
        if task.m == task.n:
            signs = np.sign(np.linalg.det(J))
            zero[1:] = signs[1:] * signs[:-1] < 0.0
        # Beside a zero a sample is at most half as large as the one on its other side, here and in the next.
        middle, beside = inverse[1:-1], np.maximum(inverse[:-2], inverse[2:])
        zero[1:-1] |= (middle <= np.minimum(inverse[:-2], inverse[2:])) & (middle < 0.5 * beside)
        ways = np.abs(places[zero] - q[k]) / task.joint_units[k]
        nearest = min(nearest, float(ways.min(initial=math.inf)))
    return nearest


@pytest.mark.parametrize("key", ["puma560", "ur5e", "scorbot", "stanford"])
def test_no_joint_alone_finds_one_that_is_nearer(key, rng):
    task = ScaledTask(catalogue()[key].arm)
    met = 0
    for q in rng.uniform(*task.arm.limits.T, (24, task.n)):
        found = nearest_singular_pose(task, q)
        if found is None:
            assert sampled_distance(task, q, FAR) > FAR - SAMPLED, q.tolist()
            continue
        assert inverse_condition(task, found.q) <= SINGULAR
        away = abs(found.away) / task.joint_units[found.place]
        # Only what is nearer would be wrong: beyond, a few samples are enough to see a dip from both of its sides.
        sampled = sampled_distance(task, q, min(away + 3 * SAMPLED, FAR))
        assert away <= sampled + SAMPLED, q.tolist()
        met += np.isfinite(sampled)
    assert met >= 6


@pytest.mark.parametrize(
    ("key", "q", "joint", "degrees"),
    [
        ("stanford", [0.3703, -2.9308, 1.1388, 1.7728, -0.3966, 0.2216], 5, 22.7),
        ("ur5e", [-3.3015, -4.0141, 3.0441, 6.1508, 5.7715, 3.1707], 3, 5.6),
        ("kr6r900", [-2.3971, -1.9834, 0.5507, -3.0435, -1.4455, 3.6562], 2, 9.1),
    ],
)
def test_one_that_the_slope_at_the_start_does_not_lead_to(key, q, joint, degrees):
    """The singular value bends on the way, or another singularity lies a little beyond the nearest."""
    found = nearest_singular_pose(ScaledTask(catalogue()[key].arm), q)
    assert found.place == joint - 1
    assert abs(math.degrees(found.away)) == pytest.approx(degrees, abs=0.05)


def test_of_two_that_are_close_to_each_other_the_nearer_one_is_found():
    """UR5e: the shoulder is met 3 degrees beyond the elbow."""
    task = ScaledTask(catalogue()["ur5e"].arm)
    q = np.array([4.7987, -0.325, -3.1806, -2.6124, -0.9815, -2.4196])
    found = nearest_singular_pose(task, q)
    assert (found.place, found.away) == (2, pytest.approx(-math.pi - q[2], abs=1e-8))


@pytest.mark.parametrize("key", ["planar_2r", "planar_2r_unequal"])
def test_farther_than_near_is_none_and_all_that_is_near_is_found(key):
    task = ScaledTask(catalogue()[key].arm)
    for q2 in np.linspace(0.5 - FAR, FAR - 0.001, 20):
        assert nearest_singular_pose(task, [0.3, q2]).away == pytest.approx(-q2, abs=1e-8)
    for q2 in (FAR + 0.01, FAR + 0.1, -FAR - 0.01):
        assert nearest_singular_pose(task, [0.3, q2]) is None


@pytest.mark.parametrize(("q2", "d3", "joint"), [(0.2, 0.25, 2), (0.2, 0.35, 1), (0.15, 0.25, 1)])
def test_metres_of_a_sliding_joint_count_as_their_share_of_the_length_scale(q2, d3, joint):
    """RRP with the tool near z0 and near the centre: 1 rad is as far as 1.5 m."""
    rows = (("R", 0, math.pi / 2, 0, 0), ("R", 0, math.pi / 2, 0, 0), ("P", 0, 0, 0, 0))
    task = ScaledTask(Arm.from_dh(rows, limits=[(-3, 3)] * 3))
    assert task.joint_units.tolist() == [1.0, 1.0, 1.5]
    found = nearest_singular_pose(task, [0.3, q2, d3])
    assert found.place == joint
    assert found.away == pytest.approx(-(q2, d3)[joint - 1], abs=1e-8)


def test_of_an_arm_that_never_has_the_rank_of_its_task_the_poses_of_less_than_its_usual_rank_count():
    links = [("R", 1.0, 0.0, 0.0, 0.0), ("R", 0.8, 0.0, 0.0, 0.0)]
    # No sample of a range falls on a singular pose by chance.
    limits = [(-3.1, 3.3), (-3.2, 3.4), (-3.0, 3.0)]
    flat, whole = (
        ScaledTask(Arm.from_dh([*links, ("R", 0.0, 0.0, 0.0, 0.0)], task=key, limits=limits)) for key in ("xy", "xyz")
    )
    for q in ([0.3, 0.237, 0.1], [0.3, 1.5, 0.1], [0.3, 0.0, 0.1], [0.3, -2.951, 0.1]):
        expected, found = nearest_singular_pose(flat, q), nearest_singular_pose(whole, q)
        assert (found is None) == (expected is None)
        if expected is not None:
            np.testing.assert_allclose(found.q, expected.q, rtol=0, atol=1e-8)
    poses = [[pose.q for pose in singular_poses(task, [0.3, 1.0, 0.1])] for task in (flat, whole)]
    np.testing.assert_allclose(poses[1], poses[0], rtol=0, atol=1e-8)
    assert len(poses[1]) == 3
