"""Inverse kinematics along a path: one branch, and where and why it ends."""

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.motion.follow import follow
from armlab.kin.motion.law_types import law_type
from armlab.kin.motion.limits import Limits
from armlab.kin.motion.orientation import about_one_axis, held
from armlab.kin.motion.path_types import path_type
from armlab.kin.motion.scaling import as_fast_as_allowed
from armlab.kin.motion.task_rows import scaled_error
from armlab.kin.motion.tool_path import ToolPath
from armlab.kin.motion.trajectory import Trajectory
from armlab.kin.rotations import rotation_from_axis_angle

UP, FIFTH = np.array([0, 0, 1e-6]), np.eye(6)[4]
"""A way so short that the tool turns on the spot, and joint 5 alone."""

CARTESIAN = catalogue()["cartesian_3p"].arm


def line(p, q, R=None):
    return ToolPath(path_type("line").path([p, q]), held(np.eye(3) if R is None else R))


def between(arm, q_a, q_b):
    """Return the straight way of the tool between two configurations."""
    A, B = arm.fk(q_a), arm.fk(q_b)
    return ToolPath(path_type("line").path([A[:3, 3], B[:3, 3]]), about_one_axis(A[:3, :3], B[:3, :3]))


def planar(limit=3.1, lengths=(1.0, 1.0)):
    return Arm.from_dh([("R", length, 0.0, 0.0, 0.0) for length in lengths], limits=[(-limit, limit)] * len(lengths))


def on_path(found, tool_path):
    error = scaled_error(found.arm, found.arm.fk(found.q[found.reached]), tool_path.pose(found.s[found.reached]))
    return np.abs(error).max()


def test_every_arm_follows_a_short_line_on_one_branch(robot, rng):
    arm = robot.arm
    middle, half = arm.limits.mean(axis=1), np.minimum(np.ptp(arm.limits, axis=1) / 2, 1.5)
    for _ in range(2):
        q = middle + 0.5 * half * rng.uniform(-1, 1, arm.n)
        tool_path = between(arm, q, arm.clip(q + 0.05 * half * rng.uniform(-1, 1, arm.n)))
        found = follow(arm, tool_path, q, 101)
        assert on_path(found, tool_path) < 1e-9
        assert found.whole or "beside a singularity" in found.reason, found.reason
        np.testing.assert_allclose(found.q[0], q, rtol=0, atol=1e-6)
        assert all(arm.within_limits(row) for row in found.q[found.reached])
        if np.nanmin(found.singular_value) < 0.01:
            continue
        steps = np.abs(np.diff(found.q, axis=0)).max(axis=0)
        assert np.all(steps <= 0.05 + 10 * np.abs(found.slope).max(axis=0) / 100)


@pytest.mark.parametrize("key", ["puma560", "ur10e", "stanford", "cartesian_3p", "scara"])
def test_rates_by_the_jacobian_are_those_of_differences(key, rng):
    arm = catalogue()[key].arm
    q = arm.limits.mean(axis=1) + 0.15 * np.ptp(arm.limits, axis=1) * rng.uniform(-1, 1, arm.n)
    found = follow(arm, between(arm, q, arm.clip(q + 0.1)), q, 1001)
    assert found.whole
    inner = slice(1, -1)
    size = np.abs(found.slope).max()
    np.testing.assert_allclose(found.slope[inner], found.differences[inner], rtol=0, atol=1e-4 * size)


def test_a_joint_that_is_outside_its_limit_only_between_two_nodes_stops_at_it():
    tool_path, limits = line([1.2, -0.8, 0.0], [1.2, 0.9, 0.0]), np.full((2, 2), [-3.1, 3.1])
    free = follow(planar(), tool_path, [-1.3, 1.5])
    top = free.q[:, 1].max()
    assert free.whole
    for count in (1000, 57):
        limits[1, 1] = top - 1e-3
        arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)] * 2, limits=limits)
        found = follow(arm, tool_path, [-1.3, 1.5], count)
        assert not found.whole
        (stop,) = found.stops
        assert (stop.kind, stop.joint) == ("limit", 2)
        assert stop.q[1] == pytest.approx(limits[1, 1], abs=1e-6)
        assert on_path(found, tool_path) < 1e-9
        assert all(arm.within_limits(row) for row in found.q[found.reached])
        assert found.s[found.reached].max() <= stop.s < found.s[~found.reached].min()
        after = follow(arm, tool_path, [-1.3, 1.5], count, carry_on=True)
        assert all(arm.within_limits(row) for row in after.q[after.reached])
        assert after.reached[-1]


def test_a_path_that_begins_at_a_joint_limit_leads_inward_or_ends_there():
    """The start is rounded to micrometres, so that joint 1 is on the path up to 1e-6 rad beyond its limit."""
    for degrees in range(10, 60, 2):
        limit = np.radians(degrees)
        arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)] * 2, limits=[(-np.radians(170), limit), (-3.1, 3.1)])
        start = np.round(arm.position([limit, 1.0]), 6)
        inward, outward = (
            follow(arm, line(start, start + np.array([x, -x, 0.0])), [limit, 1.0], 101) for x in (0.3, -0.3)
        )
        assert inward.whole, inward.reason
        (stop,) = outward.stops
        assert (stop.kind, stop.joint) == ("limit", 1)
        assert stop.s == pytest.approx(0.0, abs=1e-5)
        assert outward.reached.tolist() == [True] + [False] * 100
        for found in (inward, outward):
            assert all(arm.within_limits(row, 2e-6) for row in found.q[found.reached])


def test_the_branch_of_the_start_is_kept():
    """A PUMA keeps shoulder, elbow and wrist although the other solutions are there as well."""
    arm = catalogue()["puma560"].arm
    q = np.array([0.3, -0.6, 0.5, 0.4, 0.7, 0.2])
    end = q + np.array([0.4, 0.2, 0.1, 0.5, 0.4, -0.5])
    tool_path = between(arm, q, end)
    found = follow(arm, tool_path, q)
    assert found.whole, found.reason
    assert np.abs(np.diff(found.q, axis=0)).max() < 0.01
    np.testing.assert_allclose(found.q[-1], end, rtol=0, atol=1e-6)
    again = follow(arm, tool_path, q)
    assert np.array_equal(found.q, again.q)


@pytest.mark.parametrize("elbow", [1.0, -1.0])
def test_both_elbows_follow_their_own_branch(elbow):
    arm = planar()
    found = follow(arm, line([1.2, 0.3, 0], [0.2, 1.0, 0]), [0.0, elbow])
    assert found.whole
    assert np.all(np.sign(found.q[:, 1]) == elbow)


@pytest.mark.parametrize("aside", [0.3, 0.05, 0.01, 0.002, 0.0005])
@pytest.mark.parametrize("elbow", [1.0, -1.0])
def test_close_by_the_base_the_elbow_does_not_flip(aside, elbow):
    """The arm folds nearly: joint 1 must turn by half a turn within a step, and the other elbow is very near."""
    arm = planar(7.0)
    found = follow(arm, line([1, aside, 0], [-1, aside, 0]), [0.0, elbow], 301)
    assert found.whole, found.reason
    assert np.all(np.sign(found.q[:, 1]) == elbow)
    assert found.q[-1, 0] - found.q[0, 0] == pytest.approx(np.pi - 2 * np.arctan(aside), abs=1e-6)


def test_where_a_line_leaves_the_reach_is_said():
    """From (1, 0.5) along x: the circle of radius 2 is met at x = sqrt(4 - 0.25)."""
    arm = planar()
    found = follow(arm, line([1, 0.5, 0], [3, 0.5, 0]), [0, 1])
    (stop,) = found.stops
    x = np.sqrt(4 - 0.25)
    assert stop.kind == "reach"
    assert stop.s == pytest.approx((x - 1) / 2, abs=1e-5)
    np.testing.assert_allclose(stop.point, [x, 0.5, 0], rtol=0, atol=1e-4)
    assert "out of reach" in found.reason
    assert found.reached.tolist() == (found.s <= stop.s).tolist()
    assert np.isnan(found.q[~found.reached]).all()
    assert found.singular_value[found.reached][-1] < 0.05


def test_where_a_joint_meets_its_limit_is_said():
    """Joint 1 ends at 60 degrees: the line y = 1.2 - x of a 2R with the elbow up."""
    arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)] * 2, limits=[(-1.0, 1.0), (-3.1, 3.1)])
    tool_path = line([1.2, 0.0, 0], [0.0, 1.6, 0])
    found = follow(arm, tool_path, [1.0, -1.9])
    (stop,) = found.stops
    assert (stop.kind, stop.joint) == ("limit", 1)
    assert abs(abs(stop.q[0]) - 1.0) < 1e-6
    np.testing.assert_allclose(arm.position(stop.q), tool_path.pose(stop.s)[:3, 3], rtol=0, atol=1e-8)
    assert f"Joint 1 is at its limit at s = {stop.s:.4f}" in stop.sentence
    assert all(arm.within_limits(row) for row in found.q[found.reached])
    # With the elbow down it goes on: a change of branch is needed, and named.
    assert stop.other is not None
    assert "a change of branch (elbow down)" in stop.sentence


def test_a_limit_that_only_needs_a_whole_turn_back_says_so():
    """Round the base with a first joint that goes a little farther than half a turn either way."""
    arm = planar(3.5)
    circle = path_type("circle").path([[1.2, 0, 0], [0, 1.2, 0], [-1.2, 0, 0]], full=True)
    found = follow(arm, ToolPath(circle, held(np.eye(3))), [0.0, 1.5])
    (stop,) = found.stops
    assert (stop.kind, stop.joint) == ("limit", 1)
    assert stop.q[0] == pytest.approx(3.5, abs=1e-6)
    assert "going on needs a whole turn back of joint 1." in stop.sentence
    assert found.s[found.reached][-1] < (3.5 - found.q[0, 0]) / (2 * np.pi) <= stop.s + 1e-6


def test_a_path_that_begins_out_of_reach_is_a_result():
    found = follow(planar(), line([3, 0, 0], [1, 0, 0]), [0, 1])
    assert found.stops[0].kind == "reach"
    assert found.stops[0].s == 0.0
    assert "cannot be begun" in found.reason
    assert not found.reached.any()


def test_carrying_on_tells_what_is_feasible_behind_a_stop():
    """A line through the hole of an arm with unequal links: in, out, and in again on another part."""
    arm = planar(6.0, (1.0, 0.4))
    found = follow(arm, line([1.0, 0.1, 0], [-1.0, 0.1, 0]), [0, 1], 401, carry_on=True)
    x = np.sqrt(0.6**2 - 0.1**2)
    inside = np.abs(1 - 2 * found.s) < x
    clear = np.abs(np.abs(1 - 2 * found.s) - x) > 0.05
    assert not found.reached[inside & clear].any()
    assert found.reached[~inside & clear].all()
    assert len(found.parts) == 2
    assert not found.whole


def turning(arm, q, axis, angle):
    """Return the tool turning on the spot about a world axis, from so much before q to so much after it."""
    T = arm.fk(q)
    first, last = (rotation_from_axis_angle(axis, part) @ T[:3, :3] for part in (-angle, angle))
    # About the wrist centre, so that joints 1 to 3 have nothing to do.
    offset = np.linalg.inv(T) @ np.append(arm.frames(q)[4, :3, 3], 1.0)
    centre = arm.frames(q)[4, :3, 3]
    return ToolPath(path_type("line").path([centre, centre + UP]), about_one_axis(first, last), offset[:3])


def test_through_a_singular_wrist_in_the_direction_of_joint_5_nothing_jumps():
    arm = catalogue()["puma560"].arm
    q = np.array([0.3, -0.6, 0.5, 0.4, 0.0, 0.2])
    found = follow(arm, turning(arm, q, arm.frames(q)[4, :3, 2], 0.3), q + 0.3 * FIFTH, 1000)
    assert found.whole, found.reason
    assert np.nanmin(found.singular_value) < 1e-3
    assert np.abs(np.diff(found.q, axis=0)).max() < 0.01
    assert found.q[0, 4] * found.q[-1, 4] < 0


def test_beside_a_singular_wrist_joint_4_turns_fast_or_meets_its_limit():
    """Turning about an axis a little aside: joint 4 must turn by nearly half a turn, and the branch is still kept."""
    arm = catalogue()["puma560"].arm
    q = np.array([0.3, -0.6, 0.5, 0.4, 0.0, 0.2])
    axis = arm.frames(q)[4, :3, 2]
    aside = rotation_from_axis_angle(arm.frames(q)[4, :3, 0], 1e-3) @ rotation_from_axis_angle(axis, 0.3)
    start = aside @ arm.fk(q)[:3, :3]
    end = rotation_from_axis_angle(axis, -0.6) @ start
    centre, offset = arm.frames(q)[4, :3, 3], np.linalg.inv(arm.fk(q)) @ np.append(arm.frames(q)[4, :3, 3], 1.0)
    line = path_type("line").path([centre, centre + UP])
    found = follow(arm, ToolPath(line, about_one_axis(start, end), offset[:3]), q - 0.3 * FIFTH, 1000)
    if found.whole:
        assert np.ptp(found.q[:, 3]) > 2.5
        assert np.all(np.sign(found.q[:, 4]) == np.sign(found.q[0, 4]))
    else:
        assert "beside a singularity" in found.reason
    assert np.nanmax(np.abs(found.slope[:, 3])) > 20.0


def test_corners_are_followed():
    arm = planar()
    square = path_type("polyline").path([[1.2, 0.2, 0], [1.2, 0.8, 0], [0.6, 0.8, 0], [0.6, 0.2, 0], [1.2, 0.2, 0]])
    tool_path = ToolPath(square, held(np.eye(3)))
    found = follow(arm, tool_path, [0, 1])
    assert found.whole
    assert on_path(found, tool_path) < 1e-9
    np.testing.assert_allclose(found.q[0], found.q[-1], rtol=0, atol=1e-8)


def test_the_joint_path_is_the_fifth_planning_step():
    """Knots, path, samples, inverse kinematics, interpolation: the tool stays on the line between samples."""
    arm = catalogue()["ur10e"].arm
    q = np.array([0.3, -1.2, 1.5, -0.7, 0.9, 0.2])
    tool_path = between(arm, q, q + 0.3)
    found = follow(arm, tool_path, q, 101)
    path = found.joint_path()
    motion = Trajectory(path, law_type("quintic").law(2.0))
    t = np.linspace(0, 2.0, 777)
    tool = arm.fk(motion.at(t))
    wanted = tool_path.pose(motion.law.at(t))
    assert np.linalg.norm(tool[:, :3, 3] - wanted[:, :3, 3], axis=1).max() < 1e-7
    assert path.continuity == 2
    assert motion.continuity_from_rest == 2


def test_a_corner_of_the_tool_path_is_one_of_the_joint_path():
    """It is a sample, behind which a spline of its own begins, so that the tool goes up to it; p' = J q' there."""
    arm = planar()
    corner = path_type("polyline").path([[1.2, 0.2, 0], [1.2, 0.8, 0], [0.6, 0.8, 0]])
    tool_path = ToolPath(corner, held(np.eye(3)))
    found = follow(arm, tool_path, [0, 1], 20)
    assert len(found.s) == 20
    path = found.joint_path()
    np.testing.assert_array_equal(path.corners, corner.pieces)
    place = found.s[found.corners[0]]
    for before in (True, False):
        q, slope = path.derivatives(place, (0, 1), before=before)
        p, way = corner.derivatives(place, (0, 1), before=before)
        np.testing.assert_allclose(arm.position(q), p, rtol=0, atol=1e-9)
        np.testing.assert_allclose(arm.jacobian(q)[:2] @ slope, way[:2], rtol=0, atol=1e-9)
    s = np.linspace(0, 1, 401)
    assert np.linalg.norm(arm.position(path.at(s)) - corner.at(s), axis=1).max() < 1e-4


def test_a_path_not_followed_has_no_joint_path():
    found = follow(planar(), line([1, 0.5, 0], [3, 0.5, 0]), [0, 1])
    with pytest.raises(InputError, match=r"joint_path: Beyond s = 0\.46"):
        found.joint_path()


def test_a_line_in_joint_space_is_no_line_in_space_but_of_a_cartesian_arm():
    """The tool of a 3P stays on the straight line, that of an articulated arm does not."""
    for key, straight in (("cartesian_3p", True), ("elbow_3r", False)):
        arm = catalogue()[key].arm
        q_a, q_b = (arm.limits[:, 0] + part * np.ptp(arm.limits, axis=1) for part in (0.3, 0.6))
        p = arm.position(q_a + np.linspace(0, 1, 101)[:, None] * (q_b - q_a))
        chord = (p[-1] - p[0]) / np.linalg.norm(p[-1] - p[0])
        aside = np.linalg.norm(np.cross(p - p[0], chord), axis=1).max()
        assert (aside < 1e-9) == straight


@pytest.mark.parametrize(
    ("arm", "q_a", "q_b", "same"),
    [
        (CARTESIAN, *(CARTESIAN.limits @ [1 - part, part] for part in (0.3, 0.6)), True),
        (planar(), np.array([0.0, 1.0]), np.array([1.2, 0.5]), False),
    ],
    ids=["3P", "2R"],
)
def test_travel_times_of_the_line_in_joint_space_and_in_space(arm, q_a, q_b, same):
    """The same law, each as fast as the joints allow: equal for a 3P, shorter in joint space for an articulated arm."""
    in_space = follow(arm, between(arm, q_a, q_b), q_a, 201)
    assert in_space.whole, in_space.reason
    paths = path_type("line").path([in_space.q[0], in_space.q[-1]]), in_space.joint_path()
    joint, space = (
        as_fast_as_allowed(Trajectory(path, law_type("quintic").law()), Limits(1.0, 2.0))[0] for path in paths
    )
    if same:
        assert joint.duration == pytest.approx(space.duration, rel=1e-6)
    else:
        assert joint.duration < 0.95 * space.duration


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ({"q0": [0.0]}, "q0: expected 2 finite numbers"),
        ({"q0": [0.0, float("nan")]}, "q0: expected 2 finite numbers"),
        ({"s": 1}, "s: expected a whole number, at least 2"),
        ({"s": [0.0, 0.5, 0.4, 1.0]}, "s: expected increasing numbers"),
        ({"seed": -1}, "seed: expected a whole number"),
    ],
)
def test_wrong_arguments_are_refused(arguments, told):
    with pytest.raises(InputError, match=told):
        follow(planar(), line([1, 0, 0], [1, 1, 0]), **arguments)
