"""The plan of a motion: waypoints, moves, limits, and what becomes of them."""

import json
import re

import numpy as np
import pytest

from armlab.benches.motion.plan.commands import AllMovesLike, SetMove, SetMoveOption
from armlab.benches.motion.plan.examples import EXAMPLES, TakeExample
from armlab.benches.motion.plan.job import with_planned
from armlab.benches.motion.plan.limits import LastFor, LimitJerk, LimitJoint, LimitTool, SampleBy, UseShare
from armlab.benches.motion.plan.moves import MOST_WAYPOINTS
from armlab.benches.motion.plan.points import (
    AddWaypoint,
    DragWaypoint,
    GoToWaypoint,
    RemoveWaypoint,
    SelectWaypoint,
    SetWaypointJoint,
    SetWaypointPose,
    ShiftWaypoint,
    TakePresent,
)
from armlab.benches.motion.plan.question import Feasible
from armlab.benches.motion.plan.samples import fastest_tool
from armlab.benches.motion.plan.state import Plan, planned_now
from armlab.benches.motion.plan.words import judged, rounded_up
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.motion import peaks
from armlab.session.parts.joints import Joints, RandomPose
from armlab.session.parts.timeline import OpenClip, Seek, Timeline, duration
from armlab.session.state import State, apply
from support.done import done
from support.plans import ROBOTS


def opened(robot="ur10e"):
    return State.initial(catalogue()[robot])


def with_points(state, count):
    """Return a state with so many waypoints, the further ones random."""
    while len(state[Plan].waypoints) < count:
        state = done(state, RandomPose(), AddWaypoint())
    return state


def worked_out(state):
    return planned_now(with_planned(state))


@pytest.mark.parametrize("robot", list(catalogue().robots))
def test_every_arm_opens_with_a_motion_that_can_be_run(robot):
    planned = worked_out(opened(robot))
    assert planned.whole
    assert 0.05 < planned.duration < 60.0
    assert judged(planned).kind == "ok"


@pytest.mark.parametrize("key", list(EXAMPLES))
def test_every_example_is_what_it_says(key):
    state = with_planned(done(opened("puma560"), TakeExample(key)))
    kind = {"out_of_reach": "no", "given_time": "no"}.get(key, "ok")
    assert judged(planned_now(state)).kind == kind
    assert np.allclose(state[Joints].q, state[Plan].waypoints[0].q)
    assert (state[Plan].other is not None) == EXAMPLES[key].compared


@pytest.mark.parametrize("robot", ["puma560", "scara", "panda", "planar_3r", "cartesian_3p"])
@pytest.mark.parametrize("path", ["line", "spline", "interpolating", "blends"])
def test_as_fast_as_allowed_meets_one_limit_and_exceeds_none(robot, path):
    state = done(with_points(opened(robot), 4), SetMove(1, path=path), UseShare(0.7, 0.4))
    planned = worked_out(state)
    part = state[Plan]
    for leg in planned.legs:
        loads = [
            peaks(leg.motion, order).peak / limits
            for order, limits in ((1, 0.7 * np.array(part.velocity)), (2, 0.4 * np.array(part.acceleration)))
        ]
        assert np.max(loads) == pytest.approx(1.0, abs=1e-6)


def test_the_motion_goes_through_every_waypoint():
    state = done(with_points(opened("puma560"), 5), SetMove(1, path="spline"))
    planned = worked_out(state)
    t = np.linspace(0.0, planned.duration, 20001)
    q = planned.motion.at(t)
    for point in state[Plan].waypoints:
        assert np.abs(q - np.array(point.q)).max(axis=1).min() < 1e-3


def test_a_cartesian_move_keeps_the_tool_on_its_line_and_the_joints_together():
    state = done(opened("puma560"), SetMove(1, space="cartesian"))
    planned = worked_out(state)
    arm, part = state[Joints].arm, state[Plan]
    a, b = (point.wanted(arm)[:3, 3] for point in part.waypoints)
    way = planned.samples.tool - a
    along = (b - a) / np.linalg.norm(b - a)
    assert np.abs(way - (way @ along)[:, None] * along).max() < 1e-6
    assert np.allclose(planned.samples.tool[-1], b, atol=1e-9)
    # The samples of the rates are derivatives of those of the positions.
    step = planned.samples.t[1]
    slopes = np.gradient(planned.samples.q, step, axis=0)[2:-2]
    assert np.abs(slopes - planned.samples.qdot[2:-2]).max() < 0.02 * np.abs(planned.samples.qdot).max()
    speeds = np.linalg.norm(np.gradient(planned.samples.tool, step, axis=0), axis=1)
    assert np.abs(speeds - planned.samples.tool_speed)[2:-2].max() < 0.02 * speeds.max()


def test_a_given_time_is_kept_and_what_it_exceeds_is_said():
    state = done(opened(), LastFor(0.3))
    planned = worked_out(state)
    assert planned.duration == pytest.approx(0.3)
    assert planned.fastest > 0.3
    said = judged(planned)
    assert said.kind == "no"
    assert any("velocity" in line for line in said.lines)
    least = re.search(r"takes at least ([\d.]+) s", " ".join(said.lines))
    assert planned.fastest <= float(least[1]) < planned.fastest + 0.01
    assert judged(worked_out(done(state, LastFor(float(least[1]))))).kind == "ok"
    assert Feasible.OVER_LIMIT in planned.legs[0].worth
    # The time that is said to be enough is enough.
    slow = worked_out(done(state, LastFor(float(np.ceil(100 * planned.fastest * 1.3) / 100))))
    assert not slow.violations


def test_limits_of_tool_speed_and_jerk_are_kept():
    slow = worked_out(done(opened(), LimitTool(0.05)))
    assert fastest_tool(slow.question.arm, slow.motion) == pytest.approx(0.05, rel=1e-6)
    assert judged(slow).kind == "ok"
    smooth = worked_out(done(opened(), SetMove(1, law="septic"), LimitJerk(0.2)))
    jerk = np.array(smooth.question.limits.acceleration) / 0.2
    assert (peaks(smooth.motion, 3).peak / jerk).max() <= 1.0 + 1e-9
    jumps = worked_out(done(opened(), LimitJerk(0.2)))
    assert any("jerk cannot be kept" in text for text in jumps.unkept)
    assert judged(jumps).kind == "no"
    assert "the speed jumps" in " ".join(judged(worked_out(done(opened(), SetMove(1, law="constant")))).lines)


def test_joints_by_themselves_are_all_at_a_limit_and_those_there_first_wait():
    together = opened("puma560")
    alone = done(together, SetMove(1, apart=True))
    one, other = worked_out(together), worked_out(alone)
    # The slowest joint sets the time of both, if it is the slowest in every respect.
    assert other.duration <= one.duration + 1e-9
    loads = np.maximum(
        peaks(other.motion, 1).peak / alone[Plan].velocity, peaks(other.motion, 2).peak / alone[Plan].acceleration
    )
    np.testing.assert_allclose(loads, 1.0, rtol=1e-6)
    np.testing.assert_allclose(other.motion.at(other.duration), alone[Plan].waypoints[1].q, atol=1e-9)
    assert judged(other).kind == "ok"
    slow = worked_out(done(alone, LastFor(20.0), LimitTool(0.3)))
    assert slow.duration == pytest.approx(20.0)
    assert judged(slow).kind == "ok"


def test_a_joint_move_to_a_waypoint_out_of_reach_cannot_be_run():
    state = opened("planar_2r")
    far = state[Plan].waypoints[1].wanted(state[Joints].arm)
    far[:3, 3] *= 3.0
    planned = worked_out(done(state, DragWaypoint(1, far, object())))
    assert re.search(r"waypoint 2: \d+\.\d mm out of reach", planned.trouble)
    assert planned.motion is None
    assert set(planned.legs[0].worth) == {Feasible.NOT_REACHED}


def test_too_fast_a_tool_is_red_where_it_is():
    planned = worked_out(done(opened("puma560"), LastFor(20.0), LimitTool(0.03)))
    assert not planned.violations
    red = planned.legs[0].worth == Feasible.OVER_LIMIT
    fast = np.interp(planned.legs[0].times, planned.samples.t, planned.samples.tool_speed) > 0.03
    assert red.any()
    assert np.mean(red != fast) < 0.02


def test_a_stop_between_flown_corners_can_be_taken_back():
    state = done(opened("puma560"), TakeExample("corner_fly"))
    stopped = done(state, SetMove(1, stop=True))
    assert [part.move.path.key for part in stopped[Plan].parts] == ["line", "overfly"]
    assert worked_out(stopped).whole
    assert done(stopped, SetMove(1, stop=False))[Plan].parts == state[Plan].parts


@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("law", ["trapezoidal", "double_s", "quintic"])
def test_the_fastest_time_is_enough_when_it_is_given(robot, law):
    state = done(opened(robot), SetMove(1, law=law))
    fastest = worked_out(state).fastest
    given = worked_out(done(state, LastFor(fastest * (1.0 + 1e-9))))
    assert judged(given).kind == "ok"
    slow = worked_out(done(state, LastFor(2.0 * fastest)))
    assert slow.duration == pytest.approx(2.0 * fastest)
    assert judged(slow).kind == "ok"


def test_a_typed_ramp_shapes_the_law_in_a_given_time():
    state = done(opened(), LastFor(4.0), SetMoveOption(1, "law", "ramp", 0.25))
    assert worked_out(state).legs[0].trajectory.law.pieces.tolist() == pytest.approx([1.0, 3.0])


def test_the_least_time_holds_for_the_ramps_that_are_typed():
    state = done(opened("planar_2r"), SetMove(1, law="trapezoidal"), SetMoveOption(1, "law", "ramp", 0.1))
    for given in (0.72, 1.0, 3.0):
        least = worked_out(done(state, LastFor(given))).least
        assert least == pytest.approx(1.1894, abs=1e-4)
        assert judged(worked_out(done(state, LastFor(rounded_up(least))))).kind == "ok"
        assert judged(worked_out(done(state, LastFor(least - 0.01)))).kind == "no"


def test_removing_a_waypoint_keeps_the_selected_one():
    state = done(with_points(opened(), 5), SelectWaypoint(3))
    kept = state[Plan].waypoints[3]
    for k in (1, 4):
        part = done(state, RemoveWaypoint(k))[Plan]
        assert part.waypoints[part.selected] == kept


def test_one_waypoint_is_no_motion():
    said = judged(worked_out(done(opened(), RemoveWaypoint(1))))
    assert said.head == "no motion yet"


def test_a_stretch_goes_through_equal_moves_and_a_stop_divides_it():
    state = done(with_points(opened(), 4), SetMove(1, path="spline"))
    assert [stretch.title for stretch in state[Plan].parts] == ["1 → 4"]
    state = done(state, SetMove(2, stop=True))
    assert [stretch.title for stretch in state[Plan].parts] == ["1 → 3", "3 → 4"]
    planned = worked_out(state)
    at = planned.legs[1].start
    assert np.abs(planned.motion.at(at, 1)).max() < 1e-9
    state = done(state, SetMove(4 - 1, path="line"), AllMovesLike(3))
    assert [stretch.title for stretch in state[Plan].parts] == ["1 → 2", "2 → 3", "3 → 4"]


def test_a_path_with_its_own_time_runs_evenly_and_another_gets_its_law_back():
    state = done(with_points(opened(), 4), SetMove(1, law="quintic"), SetMove(1, path="spline"))
    assert state[Plan].moves[0].law.key == "constant"
    assert done(state, SetMove(1, path="line"))[Plan].moves[0].law.key == "trapezoidal"


def test_waypoints_can_be_moved_removed_and_exchanged():
    state = with_points(opened(), 4)
    points = state[Plan].waypoints
    assert state[Plan].selected == 3
    swapped = done(state, ShiftWaypoint(3, -1))
    assert swapped[Plan].waypoints == (points[0], points[1], points[3], points[2])
    assert swapped[Plan].selected == 2
    assert done(state, RemoveWaypoint(1))[Plan].waypoints == (points[0], points[2], points[3])
    there = done(state, GoToWaypoint(1))
    assert np.allclose(there[Joints].q, points[1].q)
    with pytest.raises(InputError, match="waypoint 2: the same configuration as waypoint 1"):
        done(there, TakePresent(0))


def test_a_typed_waypoint_is_reached_and_one_out_of_reach_is_refused_by_name():
    state = opened("ur10e")
    arm, part = state[Joints].arm, state[Plan]
    pose = part.waypoints[1].wanted(arm)
    pose[2, 3] += 0.05
    typed = done(state, SetWaypointPose(1, pose))
    assert np.allclose(arm.fk(typed[Plan].waypoints[1].q), pose, atol=1e-6)
    pose[0, 3] += 5.0
    with pytest.raises(InputError, match="waypoint 2: "):
        apply(state, SetWaypointPose(1, pose))
    with pytest.raises(InputError, match="waypoint 2: joint 3 goes from −360° to 360°"):
        apply(state, SetWaypointJoint(1, 2, 50.0))


def test_a_dragged_waypoint_follows_and_out_of_reach_it_is_kept_and_said():
    state = done(opened("planar_2r"), SetMove(1, space="cartesian"))
    arm = state[Joints].arm
    pose = state[Plan].waypoints[1].wanted(arm)
    far = pose.copy()
    far[:3, 3] *= 3.0
    drag = object()
    near = done(state, DragWaypoint(1, pose, drag))
    assert worked_out(near).whole
    away = done(near, DragWaypoint(1, far, drag))
    assert np.allclose(away[Plan].waypoints[1].wanted(arm), far)
    planned = worked_out(away)
    assert "out of reach" in planned.trouble
    assert Feasible.NOT_REACHED in planned.legs[0].worth
    # What is in front of the leg that cannot be run is still a motion.
    later = with_planned(
        done(with_points(opened("planar_2r"), 3), SetMove(2, space="cartesian"), DragWaypoint(2, far, drag))
    )
    assert planned_now(later).motion is not None
    assert not planned_now(later).whole


@pytest.mark.parametrize(
    ("commands", "text"),
    [
        ((AddWaypoint(), AddWaypoint()), "waypoint 3: the same configuration as waypoint 2"),
        ((TakePresent(1),), "waypoint 2: the same configuration as waypoint 1"),
        ((LastFor(0.0),), "duration: expected a positive number"),
        ((LastFor(float("nan")),), "duration: expected a positive number"),
        ((LastFor(1e6),), "duration: expected 0.01 to 600 s"),
        ((LimitJoint(2, "velocity", 0.0),), "limit of velocity of joint 3: expected a positive number"),
        ((UseShare(0.0),), "share of the limits: expected 1 to 100 %"),
        ((LimitJoint(2, "velocity", 1e-9),), "limit of velocity of joint 3: too small"),
        ((LimitJerk(1e300),), "jerk time: too large"),
        ((LimitTool(0.0),), "tool speed: expected a positive number"),
        ((LimitJerk(-1.0),), "jerk time: expected a positive number"),
        ((SampleBy(1),), "samples: expected a whole number from 2"),
        ((SetMove(1, path="circle"),), "takes 3 waypoints"),
        ((SetMove(1, path="helix"),), "is not available in joint space"),
        ((SetMove(0, law="cubic"),), "waypoint 1: the motion begins there"),
        ((SetMoveOption(1, "law", "ramp", 0.7),), "ramp"),
        ((SetMoveOption(1, "path", "nonsense", 1.0),), "nonsense"),
        ((RemoveWaypoint(7),), "waypoint: expected 1 to 2, got 8"),
    ],
)
def test_what_makes_no_plan_is_refused_in_a_sentence(commands, text):
    state = done(opened(), GoToWaypoint(0), SelectWaypoint(1))
    if isinstance(commands[0], AddWaypoint):
        state = done(state, GoToWaypoint(1))
    with pytest.raises(InputError, match=text):
        done(state, *commands)


def test_three_points_on_a_line_are_no_circle_and_the_old_plan_stays():
    state = opened("cartesian_3p")
    state = done(state, SetMove(1, space="cartesian"), GoToWaypoint(1))
    middle = 0.5 * (np.array(state[Plan].waypoints[1].q) + np.array(state[Plan].waypoints[0].q))
    state = state.replace(state[Joints].moved_to(middle))
    state = done(state, AddWaypoint())
    with pytest.raises(InputError, match="move 1 → 3: waypoint 3: the three points are on a straight line"):
        apply(state, SetMove(1, path="circle"))
    assert state[Plan].moves[0].path.key == "line"


def test_there_are_not_more_waypoints_than_can_be_told_apart():
    state = with_points(opened("planar_2r"), MOST_WAYPOINTS)
    with pytest.raises(InputError, match=f"at most {MOST_WAYPOINTS}"):
        done(state, RandomPose(), AddWaypoint())


def test_the_clip_moves_the_arm_and_puts_it_back():
    state = with_planned(done(opened(), RandomPose()))
    stood = state[Joints].q
    planned = planned_now(state)
    on = done(state, OpenClip("motion"))
    assert duration(on) == planned.duration
    assert np.allclose(on[Joints].q, planned.motion.at(0.0))
    half = done(on, Seek(0.5 * planned.duration))
    assert np.allclose(half[Joints].q, planned.motion.at(0.5 * planned.duration))
    assert np.array_equal(done(half, OpenClip(""))[Joints].q, stood)
    moved = done(half, RandomPose())
    assert np.array_equal(done(moved, OpenClip(""))[Joints].q, moved[Joints].q)


def test_a_new_plan_takes_the_arm_along_while_it_is_on():
    state = done(with_planned(opened()), OpenClip("motion"), Seek(100.0))
    changed = with_planned(done(state, LastFor(9.0), SetWaypointJoint(1, 0, 0.1)))
    assert duration(changed) == pytest.approx(9.0)
    assert np.allclose(changed[Joints].q, planned_now(changed).motion.at(changed[Timeline].time))


def test_what_is_written_is_read_back():
    state = with_points(opened("puma560"), 4)
    state = done(
        state, SetMove(1, path="spline"), SetMoveOption(1, "path", "ends", "natural"), LimitTool(0.4), LastFor(7.0)
    )
    data = json.loads(json.dumps(state[Plan].to_json()))
    back = Plan.from_json(data, catalogue()["puma560"])
    assert back.to_json() == state[Plan].to_json()
    assert back.waypoints == state[Plan].waypoints
    assert back.moves == state[Plan].moves
    for broken in (
        {**data, "moves": []},
        {**data, "duration": -1.0},
        {**data, "velocity": [1.0]},
        {**data, "samples": 0},
    ):
        with pytest.raises(InputError):
            Plan.from_json(broken, catalogue()["puma560"])


def test_the_same_plan_gives_the_same_motion():
    state = done(with_points(opened("panda"), 3), SetMove(1, space="cartesian"))
    one, other = worked_out(state), worked_out(state)
    assert one.trouble == other.trouble
    assert np.array_equal(one.legs[0].points, other.legs[0].points)
