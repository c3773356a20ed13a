"""What a plan must not lose: the fastest moment of the tool, marked places, beginnings of legs, room for waypoints."""

from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.motion.plan.commands import SetMove, SetMoveOption
from armlab.benches.motion.plan.examples import TakeExample
from armlab.benches.motion.plan.figures import MOST_SPANS
from armlab.benches.motion.plan.job import with_planned
from armlab.benches.motion.plan.laws import CORNERS, SPEED_JUMPS
from armlab.benches.motion.plan.limits import CompareMoves, LastFor, LimitJoint, LimitTool, SampleBy
from armlab.benches.motion.plan.moves import Waypoint
from armlab.benches.motion.plan.paths import places
from armlab.benches.motion.plan.points import (
    DRAG_TRAVEL,
    AddWaypoint,
    DragWaypoint,
    RemoveWaypoint,
    SetAtWaypoint,
    SetWaypointJoint,
    SetWaypointPose,
)
from armlab.benches.motion.plan.question import Feasible, Recorded
from armlab.benches.motion.plan.samples import fastest_tool
from armlab.benches.motion.plan.state import CLIP_KEY, Plan, planned_now
from armlab.benches.motion.plan.words import judged
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin import ik
from armlab.kin.arm import Arm
from armlab.kin.motion import path_type
from armlab.kin.rotations import rotation_about
from armlab.kin.transforms import transform
from armlab.session.parts.joints import Joints, RandomPose
from armlab.session.parts.timeline import OpenClip
from armlab.session.state import State, apply
from support.done import done


def opened(robot="puma560", points=2):
    """Return a state with so many waypoints, the further ones random."""
    state = State.initial(catalogue()[robot])
    for _ in range(points - 2):
        state = done(state, RandomPose(), AddWaypoint())
    return state


def through(state, rows):
    """Return a state with waypoints at configurations, in place of those it has."""
    points = tuple(Waypoint(tuple(map(float, q))) for q in rows)
    return state.replace(replace(state[Plan], waypoints=points))


def worked_out(state):
    return planned_now(with_planned(state))


def speeds(arm, motion):
    """Return the speed of the tool, |J q-dot|, on a dense grid."""
    q, qdot = motion.derivatives(np.linspace(0.0, motion.duration, 40001), (0, 1))
    return np.linalg.norm(np.einsum("kij,kj->ki", arm.jacobian(q)[:, :3], qdot), axis=1)


# -- the speed of the tool -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("apart", [False, True])
@pytest.mark.parametrize("robot", ["planar_2r", "puma560", "panda"])
def test_the_tool_is_nowhere_faster_than_its_limit(robot, apart):
    """A dense grid finds a speed between samples that a single search would miss."""
    for seed in range(6):
        state = opened(robot)
        low, high = state[Joints].arm.limits.T
        rows = low + np.random.default_rng(seed).uniform(0.2, 0.8, (2, len(low))) * (high - low)
        planned = worked_out(done(through(state, rows), SetMove(1, law="quintic", apart=apart), LimitTool(0.1)))
        arm = planned.question.arm
        most = speeds(arm, planned.motion).max()
        assert most <= 0.1 * (1.0 + 1e-8)
        assert most >= 0.1 * (1.0 - 1e-4)
        assert fastest_tool(arm, planned.motion) == pytest.approx(0.1, rel=1e-9)


# -- what is known of a leg ------------------------------------------------------------------------------------------


def test_a_tool_path_is_marked_where_the_wrist_is_nearly_singular_and_only_there():
    ends = [[0.2, 0.6, -2.6, 0.3, 0.7, 0.4], [0.3, 0.6, -2.6, 0.3, 0.1, 0.4]]
    planned = worked_out(done(through(opened("puma560"), ends), SetMove(1, space="cartesian")))
    assert planned.whole, planned.trouble
    leg = planned.legs[0]
    near = leg.worth == int(Feasible.NEAR_SINGULAR)
    assert near[-1]
    assert not near[0]
    # The wrist of this arm is singular where its axes 4 and 6 are one.
    bend = np.abs(np.sin(leg.motion.at(leg.times - leg.start)[:, 4]))
    assert 0.1 < bend[near].max() < 0.4
    assert bend[near].max() <= bend[~near].min() + 0.01


def test_the_path_parameter_of_the_samples_is_where_on_its_leg_the_arm_is():
    planned = worked_out(opened("puma560", points=3))
    samples = planned.samples
    for leg in planned.legs:
        on = (samples.t > leg.start + 1e-9) & (samples.t < leg.start + leg.motion.duration - 1e-9)
        start, end = leg.path.at(0.0), leg.path.at(1.0)
        np.testing.assert_allclose(samples.q[on], start + samples.s[on, None] * (end - start), rtol=0, atol=1e-9)
        assert samples.s[on].min() < 0.05
        assert samples.s[on].max() > 0.95


def test_a_tool_path_begins_where_the_move_before_has_ended():
    """A move that keeps the orientation ends with another one than its waypoint was stored with."""
    state = opened("puma560")
    q = np.array([0.2, 0.6, -2.6, 0.3, 0.7, 0.4])
    near = q + np.array([[0.0] * 6, [0.1, 0.05, 0.05, 0.0, 0.3, 0.2], [0.2, 0.0, 0.1, 0.1, 0.1, 0.0]])
    state = done(opened("puma560", points=3), SetMove(1, stop=True))
    state = done(through(state, near), SetMove(1, space="cartesian", turning="kept"), SetMove(2, space="cartesian"))
    planned = worked_out(state)
    assert planned.whole, planned.trouble
    arm, (first, second) = planned.question.arm, planned.legs
    end = first.motion.at(first.motion.duration)
    assert np.abs(end - near[1]).max() > 0.1
    np.testing.assert_allclose(second.motion.at(0.0), end, rtol=0, atol=1e-9)
    np.testing.assert_allclose(second.tool_path.pose(0.0), arm.fk(end), rtol=0, atol=1e-9)
    np.testing.assert_allclose(second.tool_path.pose(1.0), arm.fk(near[2]), rtol=0, atol=1e-9)


def test_how_far_the_tool_leaves_its_path_does_not_depend_on_how_the_arm_is_mounted():
    planar = catalogue()["planar_2r"]
    base = transform(rotation_about("x", np.pi / 2))
    wall = Arm.from_dh(planar.arm.rows, base=base, limits=planar.arm.limits, task="xy")
    found = []
    for robot in (planar, replace(planar, arm=wall)):
        state = done(State.initial(robot), SetMove(1, space="cartesian"), SampleBy(4))
        found.append(worked_out(state).legs[0].deviation)
    assert found[0] > 1e-4
    assert found[1] == pytest.approx(found[0], rel=1e-9)


# -- waypoints -------------------------------------------------------------------------------------------------------


def test_a_waypoint_dragged_out_of_reach_does_not_jump():
    """The search for the nearest the arm can do ends far away at times; the waypoint stays then."""
    state = opened("puma560")
    arm = state[Joints].arm
    near = np.array(state[Plan].waypoints[1].q)
    rng, far = np.random.default_rng(3), 0
    for k in range(40):
        pose = arm.fk(near).copy()
        pose[:3, 3] = rng.normal(size=3) * 2.0 * arm.length_scale
        moved = np.array(done(state, DragWaypoint(1, pose, k))[Plan].waypoints[1].q)
        found = ik.solve(arm, pose, near, searches=1, complete=False)
        if found.success:
            continue
        far += np.abs(found.q - near).max() > DRAG_TRAVEL
        assert np.abs(moved - near).max() <= DRAG_TRAVEL + 1e-9
    assert far > 0


def test_a_list_that_fits_no_more_is_dropped_and_one_that_fits_is_kept():
    state = done(opened("cartesian_3p", points=4), SetMove(1, path="blends"))
    state = done(state, SetMoveOption(1, "path", "times", (0.0, 1.0, 2.0, 4.0)))
    assert dict(state[Plan].moves[0].path.given)["times"] == (0.0, 1.0, 2.0, 4.0)
    fewer = done(state, RemoveWaypoint(3), RemoveWaypoint(2))
    assert "times" not in dict(fewer[Plan].moves[0].path.given)
    single = done(opened("cartesian_3p", points=4), SetMove(1, path="blends"))
    single = done(single, SetMoveOption(1, "path", "blend", (0.01,)), RemoveWaypoint(3))
    assert dict(single[Plan].moves[0].path.given)["blend"] == (0.01,)


@pytest.mark.parametrize("kind", ["polyline", "spline", "interpolating", "blends"])
def test_a_waypoint_that_a_path_passes_again_at_its_end_is_taken_where_it_is_meant(kind):
    """A path that rests at its end is near its last point for long: room for one sample each would not be enough."""
    points = np.array([[0.0, 0.0], [1.0, 0.0], [1.1, 0.7], [1.0, 0.0]])
    path = path_type(kind).path(points)
    found = places(path, points)
    assert (np.diff(found) > 0.1).all()
    np.testing.assert_allclose(path.at(found), points, rtol=0, atol=0.15 if kind == "blends" else 2e-3)


@pytest.mark.parametrize("joint", [-1, 6, 9])
def test_a_joint_that_the_arm_has_not_is_refused(joint):
    says = f"joint: expected 1 to 6, got {joint + 1}"
    for command in (SetWaypointJoint(1, joint, 0.1), LimitJoint(joint, "velocity", 1.0)):
        with pytest.raises(InputError, match=says):
            apply(opened("puma560"), command)


# -- the whole circle ------------------------------------------------------------------------------------------------


def test_a_whole_circle_passes_its_last_waypoint_and_ends_at_its_first():
    """The tool has the orientation of each waypoint where it passes it, and nothing is done at its end."""
    state = done(opened(), TakeExample("circle"), SetMoveOption(1, "path", "full", True))
    arm, points = state[Joints].arm, state[Plan].waypoints
    turned = points[2].wanted(arm)
    turned[:3, :3] = rotation_about("z", 0.6) @ turned[:3, :3]
    state = done(state, SetWaypointPose(2, turned), SetAtWaypoint(2, "wait", 0.5), SetAtWaypoint(2, "gripper", "close"))
    planned = worked_out(state)
    way = planned.legs[0].tool_path
    at = places(way.position, np.array([point.wanted(arm)[:3, 3] for point in (*points, points[0])]))
    wanted = [points[0].wanted(arm), points[1].wanted(arm), turned, points[0].wanted(arm)]
    np.testing.assert_allclose(way.pose(at), wanted, rtol=0, atol=1e-3)
    np.testing.assert_allclose(arm.fk(planned.motion.at(planned.duration)), wanted[0], rtol=0, atol=1e-6)
    said = "waypoint 3 is only passed by the whole circle: the arm neither waits nor grips there"
    assert judged(planned).lines == (f"move 1 → 3: {said}",)
    assert planned.grips == ()
    assert planned.legs[0].wait == 0.0
    assert planned.duration == planned.legs[0].motion.duration


# -- velocities that jump ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("duration", [None, 20.0])
def test_a_velocity_that_jumps_for_its_law_is_not_blamed_on_a_corner(duration):
    """At the end of a move, or where an independent joint arrives, there is no corner to fly over."""
    three = done(opened("puma560", points=3), *(SetMove(k, law="constant") for k in (1, 2)))
    ending = done(opened("puma560", points=3), SetMoveOption(1, "law", "sdot_end", 0.3))
    apart = done(opened("puma560"), SetMove(1, law="constant", apart=True))
    for state in (three, ending, apart):
        assert worked_out(done(state, LastFor(duration))).unkept == (SPEED_JUMPS,)
    cornered = done(opened("puma560", points=3), *(SetMove(k, path="polyline") for k in (1, 2)), LastFor(duration))
    assert worked_out(cornered).unkept == (CORNERS,)


# -- beside the plan -------------------------------------------------------------------------------------------------


def test_the_plan_beside_one_in_a_given_time_is_as_fast_as_it_can():
    state = with_planned(done(opened(), LastFor(25.0), CompareMoves(True)))
    other = state[Plan].other
    assert planned_now(state).duration == pytest.approx(25.0)
    assert other.question.duration is None
    assert other.duration == pytest.approx(other.fastest)
    assert other.duration < 20.0


def test_the_arm_goes_back_to_where_it_stood_last_not_to_where_it_once_stood():
    state = with_planned(opened())
    state = done(state, OpenClip(CLIP_KEY), OpenClip(""))
    assert state[Plan].before is None
    state = done(state, RandomPose())
    q = state[Joints].q
    again = done(state, OpenClip(CLIP_KEY), OpenClip(""))
    np.testing.assert_allclose(again[Joints].q, q, rtol=0, atol=1e-12)


# -- what is measured ------------------------------------------------------------------------------------------------


def shaking(count):
    """Return a state with a recorded motion of so many swings, each too fast."""
    t = np.arange(2 * count + 1) * 0.02
    q = np.column_stack([0.3 * (np.arange(len(t)) % 2), np.zeros(len(t))])
    state = opened("planar_2r")
    recorded = Recorded(tuple(t.tolist()), tuple(map(tuple, q.tolist())))
    return state.replace(replace(state[Plan], recorded=recorded))


def test_of_very_many_times_at_which_a_limit_is_exceeded_the_first_are_kept_and_all_are_counted():
    planned = worked_out(shaking(400))
    (velocity,) = (each for each in planned.overruns if each.quantity == "velocity")
    every = [violation for violation in planned.violations if violation.quantity == "velocity"]
    assert len(every) > MOST_SPANS == len(velocity.spans)
    assert velocity.count == len(every)
    assert velocity.spans == tuple(sorted((each.start, each.end) for each in every)[:MOST_SPANS])
    assert f"and {len(every) - 2} more times" in " ".join(judged(planned).lines)


def test_a_plan_comes_measured():
    planned = worked_out(opened(points=4))
    for of, rates in (
        (planned.figures.velocity, planned.samples.qdot),
        (planned.figures.acceleration, planned.samples.qddot),
    ):
        most = np.abs(rates).max(axis=0)
        assert (most <= of + 1e-9).all()
        np.testing.assert_allclose(most, of, rtol=0.1)
    assert planned.overruns == ()
