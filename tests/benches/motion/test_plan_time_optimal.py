"""The time-optimal law in the lab, corners that are told, and plans that can be sent to another process."""

import copy
import pickle
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest

from armlab.benches.motion.plan.commands import SetMove, SetMoveOption
from armlab.benches.motion.plan.examples import TakeExample
from armlab.benches.motion.plan.job import with_planned
from armlab.benches.motion.plan.limits import LastFor, LimitJerk, LimitTool, SampleBy
from armlab.benches.motion.plan.points import SetWaypointPose
from armlab.benches.motion.plan.state import Plan, planned_now
from armlab.benches.motion.plan.words import judged
from armlab.kin.motion import Limits, Trajectory, follow, law_type, path_type, peaks, violations
from armlab.kin.motion.trajectory import times_at
from armlab.kin.rotations import rotation_about
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.state import apply
from support.plans import ROBOTS, opened


def after(state, *commands):
    for command in commands:
        state = apply(state, command)
    return with_planned(state)


@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("space", ["joint", "cartesian"])
def test_the_time_optimal_law_is_within_the_limits_and_the_fastest(robot, space):
    state = after(opened(robot), SetMove(1, space=space))
    slow, fast = planned_now(state), planned_now(after(state, SetMove(1, law="time_optimal")))
    if not slow.whole:
        return
    assert judged(fast).kind == "ok"
    assert fast.violations == ()
    # A line of joints: what the grid costs, the square of its step.
    assert fast.duration <= slow.duration * (1.0 + 1e-6)
    shares = np.maximum(fast.figures.velocity_share, fast.figures.acceleration_share)
    assert shares.max() == pytest.approx(1.0, abs=1e-6)
    given = planned_now(after(state, SetMove(1, law="time_optimal"), LastFor(2.0 * fast.duration)))
    assert given.duration == pytest.approx(2.0 * fast.duration)
    assert judged(given).kind == "ok"


def test_its_options_and_limits_are_used_and_written():
    state = after(opened("puma560", points=4), SetMove(1, path="spline"), SetMove(2, path="spline"))
    state = after(state, SetMove(1, law="time_optimal"), SetMove(2, law="time_optimal"))
    whole = planned_now(state)
    coarse = planned_now(after(state, SetMoveOption(1, "law", "steps", 50), SetMoveOption(2, "law", "steps", 50)))
    assert coarse.duration == pytest.approx(whole.duration, rel=0.05)
    assert coarse.duration != whole.duration
    read = Plan.from_json(state[Plan].to_json(), state[RobotPart].robot)
    assert (read.moves, read.waypoints) == (state[Plan].moves, state[Plan].waypoints)
    # The figure is of samples, between which the peak of the tool lies.
    tool = planned_now(after(state, LimitTool(0.2)))
    assert tool.figures.tool_speed == pytest.approx(0.2, rel=1e-2)
    jerk = planned_now(after(state, LimitJerk(0.2)))
    assert "the acceleration jumps, so the limit of jerk cannot be kept" in jerk.unkept


@pytest.mark.parametrize("space", ["joint", "cartesian"])
def test_a_corner_is_told_with_its_time_and_the_time_optimal_law_stops_there(space):
    state = opened("scara", points=3)
    for k in (1, 2):
        state = apply(apply(state, SetMove(k, space=space)), SetMove(k, path="polyline"))
    planned = planned_now(with_planned(state))
    (corner,) = {
        each.start for each in planned.violations if each.quantity == "acceleration" and each.start == each.end
    }
    path = planned.legs[0].path if space == "joint" else planned.legs[0].tool_path.position
    assert planned.legs[0].trajectory.law.at(corner) == pytest.approx(path.pieces[0], abs=1e-9)
    said = judged(planned)
    assert said.kind == "no"
    assert f"acceleration limits at {corner:.2f} s" in " ".join(said.lines)
    assert "the velocity jumps at a corner" in " ".join(said.lines)
    stopping = planned_now(after(state, SetMove(1, law="time_optimal"), SetMove(2, law="time_optimal")))
    assert judged(stopping).kind == "ok"
    motion = stopping.motion
    corner = float(times_at(motion.law, path.pieces)[0])
    np.testing.assert_allclose(motion.at([0.0, corner, motion.duration], 1), 0.0, rtol=0, atol=1e-6)


def test_a_square_with_corners_takes_the_same_time_with_any_number_of_samples():
    square = after(opened("puma560"), TakeExample("corner_stop"), SetMove(1, path="polyline"))
    found = [planned_now(after(square, SampleBy(count))) for count in (50, 200)]
    assert [judged(each).kind for each in found] == ["no", "no"]
    few, many = (each.duration for each in found)
    assert few == pytest.approx(many, rel=0.01)
    assert all(each.legs[0].deviation < 1e-5 for each in found)


def test_remarks_on_the_turn_of_the_tool_are_told_with_the_waypoints_of_the_plan():
    square = after(opened("puma560"), TakeExample("corner_stop"))
    square = after(square, SetMove(1, path="spline"), SetMove(1, stop=True))
    pose = square[Plan].waypoints[2].wanted(square[Joints].arm)
    pose[:3, :3] = pose[:3, :3] @ rotation_about("z", np.pi)
    lines = judged(planned_now(after(square, SetWaypointPose(2, pose)))).lines
    assert any("between waypoints 2 and 3: A half turn: about r or −r" in line for line in lines), lines


def looked_at(planned):
    return planned.duration, peaks(planned.motion, 1).peak, planned.figures.way


@pytest.mark.parametrize("law", ["trapezoidal", "double_s", "time_optimal", "cosine"])
def test_a_plan_is_copied_and_sent_to_another_process(law):
    planned = planned_now(after(opened("puma560"), SetMove(1, space="cartesian"), SetMove(1, law=law)))
    for again in (copy.deepcopy(planned), pickle.loads(pickle.dumps(planned))):
        for mine, theirs in zip(looked_at(planned), looked_at(again), strict=True):
            np.testing.assert_array_equal(mine, theirs)
    with ProcessPoolExecutor(1) as pool:
        for mine, theirs in zip(looked_at(planned), pool.submit(looked_at, planned).result(), strict=True):
            np.testing.assert_allclose(mine, theirs, rtol=1e-12)


def test_motions_and_limits_are_copied():
    path = path_type("polynomial").path([[0.0, 1.0], [1.0, -1.0]], degree=15)
    limits = Limits([1.0, 2.0], 5.0)
    motion = Trajectory(path, law_type("time_optimal").along(path, limits))
    again, kept = pickle.loads(pickle.dumps((motion, limits)))
    t = np.linspace(0.0, motion.duration, 50)
    np.testing.assert_array_equal(again.at(t, 2), motion.at(t, 2))
    assert violations(again, kept) == []
    assert repr(kept) == repr(limits)


def test_following_a_line_can_be_copied():
    state = after(opened("puma560"), SetMove(1, space="cartesian"))
    leg = planned_now(state).legs[0]
    found = follow(leg.followed.arm, pickle.loads(pickle.dumps(leg.tool_path)), leg.followed.q[0], 21)
    np.testing.assert_allclose(pickle.loads(pickle.dumps(found)).q, found.q, rtol=0, atol=0)
