"""Waits and the gripper at waypoints: the arm rests there, and times, stops, plots, files and checks know it."""

import json
from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.motion.files.commands import ReadMotion, ReadPlan
from armlab.benches.motion.files.read import motion_csv, plan_json
from armlab.benches.motion.files.script import motion_script
from armlab.benches.motion.files.table import read_table
from armlab.benches.motion.plan.clip import CLIP
from armlab.benches.motion.plan.commands import AllMovesLike, SetMove, SetMoveOption
from armlab.benches.motion.plan.figures import TOOL, Binding
from armlab.benches.motion.plan.job import with_planned
from armlab.benches.motion.plan.limits import LastFor, LimitTool, UseShare
from armlab.benches.motion.plan.moves import LONGEST_WAIT, Move, Waypoint
from armlab.benches.motion.plan.points import AddWaypoint, CopyWaypoint, SelectWaypoint, SetAtWaypoint, SetWaypointJoint
from armlab.benches.motion.plan.seen import seen_motion
from armlab.benches.motion.plan.state import Plan, planned_now
from armlab.benches.motion.plan.words import judged, rounded_up
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.parts.joints import Joints, RandomPose
from armlab.session.parts.robot import RobotPart
from armlab.session.state import State, apply
from support.done import done


def opened(robot="puma560", points=3):
    """Return a state with so many waypoints, the further ones random."""
    state = State.initial(catalogue()[robot])
    return done(state, *[command for _ in range(points - 2) for command in (RandomPose(), AddWaypoint())])


def worked_out(state):
    return planned_now(with_planned(state))


@pytest.mark.parametrize("robot", ["puma560", "scara", "planar_2r", "cartesian_3p"])
def test_the_arm_stands_still_for_every_wait_and_else_moves_as_before(robot):
    state = opened(robot)
    before = worked_out(state)
    waiting = done(state, SetAtWaypoint(0, "wait", 0.4), SetAtWaypoint(1, "wait", 0.7), SetAtWaypoint(2, "wait", 0.2))
    found = worked_out(waiting)
    first, second = before.legs[0].motion.duration, before.legs[1].motion.duration
    assert found.duration == pytest.approx(before.duration + 1.3)
    assert found.fastest == pytest.approx(before.fastest + 1.3)
    assert [leg.start for leg in found.legs] == pytest.approx([0.4, 0.4 + first + 0.7])
    arrivals = 0.4 + first, 0.4 + first + 0.7 + second
    for k, (start, end) in enumerate([(0.0, 0.4), (arrivals[0], arrivals[0] + 0.7), (arrivals[1], found.duration)]):
        t = np.linspace(start, end, 9)
        assert np.abs(found.motion.at(t) - waiting[Plan].waypoints[k].q).max() < 1e-9
        assert np.abs(found.motion.at(t[1:-1], 1)).max() == 0.0
    moving = np.linspace(0.0, second, 40)
    assert np.allclose(found.motion.at(arrivals[0] + 0.7 + moving), before.motion.at(first + moving), atol=1e-9)
    assert judged(found).kind == "ok"
    assert CLIP.stops(with_planned(waiting)) == pytest.approx((0.4, arrivals[0], arrivals[0] + 0.7, arrivals[1]))


def test_the_least_time_of_a_typed_ramp_counts_with_the_waits_and_the_slowest_move():
    state = done(opened("planar_2r"), SetMove(2, stop=True), SetMove(1, law="trapezoidal"))
    state = done(state, SetMoveOption(1, "law", "ramp", 0.1), SetAtWaypoint(1, "wait", 0.5))
    least = worked_out(done(state, LastFor(2.0))).least
    assert least > worked_out(state).duration + 0.1
    assert judged(worked_out(done(state, LastFor(rounded_up(least))))).kind == "ok"
    assert judged(worked_out(done(state, LastFor(least - 0.01)))).kind == "no"


def test_where_the_arm_rests_a_path_that_would_go_through_ends_and_the_next_begins():
    state = done(opened(points=4), SetMove(1, path="spline"), AllMovesLike(1))
    assert [(part.first, part.last) for part in state[Plan].parts] == [(0, 3)]
    for command in (SetAtWaypoint(2, "wait", 0.5), SetAtWaypoint(2, "gripper", "close")):
        rests = done(state, command)
        assert [(part.first, part.last) for part in rests[Plan].parts] == [(0, 2), (2, 3)]
        back = done(rests, SetAtWaypoint(2, command.name, None), SelectWaypoint(3, handled=False))
        assert back[Plan].parts == state[Plan].parts
        assert back[Plan].to_json() == state[Plan].to_json()


def test_a_given_time_is_that_of_the_whole_and_waits_keep_theirs():
    state = done(opened(), SetAtWaypoint(1, "wait", 1.5), LastFor(9.0))
    found = worked_out(state)
    assert found.duration == pytest.approx(9.0)
    assert found.legs[1].start - found.legs[0].arrival == pytest.approx(1.5)
    said = judged(worked_out(done(state, LastFor(1.5))))
    assert said.kind == "no"
    assert said.lines[0] == "duration: expected more than the 1.5 s of the waits, got 1.5 s"


def test_what_is_out_of_range_or_unknown_is_refused_in_words_and_nothing_changes():
    state = opened()
    for name, value, words in (
        ("wait", -0.1, "wait: expected"),
        ("wait", LONGEST_WAIT + 1.0, "wait: expected"),
        ("wait", float("nan"), "wait: expected"),
        ("gripper", "throw", "close, leave, open"),
        ("colour", "red", "gripper, wait"),
    ):
        with pytest.raises(InputError, match=words):
            apply(state, SetAtWaypoint(1, name, value))
    with pytest.raises(InputError, match="expected 1 to 3, got 4"):
        apply(state, SetAtWaypoint(3, "wait", 1.0))
    assert apply(state, SetAtWaypoint(1, "wait", None)) is state


def test_a_waypoint_that_is_moved_or_copied_keeps_what_is_done_there():
    state = done(opened(), SetAtWaypoint(1, "wait", 0.5), SetAtWaypoint(1, "gripper", "close"))
    moved = done(state, SetWaypointJoint(1, 0, 0.3))
    assert (moved[Plan].waypoints[1].gripper, moved[Plan].waypoints[1].wait) == ("close", 0.5)
    assert done(state, CopyWaypoint(1))[Plan].waypoints[2].does == {"gripper": "close", "wait": 0.5}


def test_a_plan_without_them_is_written_as_before_and_one_with_them_comes_back():
    state = opened()
    assert all(set(point) == {"q"} for point in state[Plan].to_json()["waypoints"])
    state = done(state, SetAtWaypoint(1, "wait", 0.5), SetAtWaypoint(2, "gripper", "open"))
    written = json.loads(plan_json(state))["plan"]["waypoints"]
    assert [set(point) - {"q"} for point in written] == [set(), {"wait"}, {"gripper"}]
    assert done(opened(), ReadPlan(plan_json(state)))[Plan].waypoints == state[Plan].waypoints
    arm, q = state[Joints].arm, list(state[Plan].waypoints[0].q)
    with pytest.raises(InputError, match="wait"):
        Waypoint.from_json({"q": q, "wait": 1e9}, arm)


def test_a_table_has_the_waits_and_the_gripper_and_is_read_again():
    state = with_planned(done(opened(), SetAtWaypoint(1, "gripper", "close"), SetAtWaypoint(1, "wait", 0.5)))
    planned, arm = planned_now(state), state[Joints].arm
    text = motion_csv(arm, planned.motion, 100.0, planned.grips)
    head, *rows = text.splitlines()
    assert head.endswith(",gripper_closed")
    table = np.array([[float(cell) for cell in row.split(",")] for row in rows])
    arrival = planned.legs[0].arrival
    assert np.array_equal(table[:, -1] > 0.5, table[:, 0] >= arrival - 1e-9)
    resting = (table[:, 0] > arrival) & (table[:, 0] < arrival + 0.5)
    assert resting.sum() > 40
    assert not table[resting, 1 + arm.n : -1].any()
    assert len(read_table(arm, text).t) == len(rows)
    assert "gripper" not in motion_csv(arm, planned.motion, 100.0)


def test_the_script_waits_as_the_plan_does(tmp_path, monkeypatch):
    state = done(opened(), SetAtWaypoint(0, "wait", 0.3), SetAtWaypoint(1, "gripper", "close"))
    state = with_planned(done(state, SetAtWaypoint(1, "wait", 0.5)))
    planned = planned_now(state)
    text = motion_script(state[RobotPart], planned, 50.0, "motion.csv")
    monkeypatch.chdir(tmp_path)
    exec(compile(text, "script", "exec"), {})
    table = np.loadtxt(tmp_path / "motion.csv", delimiter=",", skiprows=1)
    n = state[Joints].arm.n
    assert np.abs(table[:, 1 : 1 + n] - planned.motion.at(table[:, 0])).max() < 1e-6
    assert "At waypoint 2 the gripper closes" in text


def test_checks_of_lessons_see_the_whole_time_and_legs_that_cannot_be_run_take_none():
    state = with_planned(done(opened(), SetAtWaypoint(1, "wait", 2.0)))
    assert seen_motion(state, played=False).duration == pytest.approx(planned_now(state).duration)
    part = state[Plan]
    far = replace(part.waypoints[1], pose=tuple((np.eye(4) + 90.0 * np.eye(4, k=3)).reshape(16)))
    broken = state.replace(replace(part, waypoints=(part.waypoints[0], far, part.waypoints[2])))
    found = worked_out(broken)
    assert found.running == ()
    assert found.boundaries == ()
    assert found.grips == ()
    assert found.leg_at(0.0) is None


def test_a_short_move_between_long_waits_is_looked_at_as_closely_as_one_without_waits():
    state = State.initial(catalogue()["planar_2r"])
    points = tuple(Waypoint(q) for q in ((0.0, 0.3), (0.05, 0.3), (0.1, 0.3)))
    state = state.replace(replace(state[Plan], waypoints=points, moves=(Move(),) * 2))
    state = done(state, LimitTool(0.5))
    moving = worked_out(state).duration
    waits = [SetAtWaypoint(k, "wait", LONGEST_WAIT) for k in range(3)]
    lasted = []
    for rests, commands in ((0.0, []), (3.0 * LONGEST_WAIT, waits)):
        # In seven tenths of the least time the tool is faster than its limit by the inverse of that.
        found = worked_out(done(state, *commands, LastFor(rests + 0.7 * moving)))
        assert found.figures.tool_speed == pytest.approx(0.5 / 0.7, rel=1e-6)
        assert found.figures.way == pytest.approx(0.1 * np.linalg.norm(found.samples.tool[0]), rel=1e-4)
        assert [(overrun.quantity, overrun.count) for overrun in found.overruns] == [("tool speed", 2)]
        assert found.figures.binding == Binding(TOOL, "tool speed")
        assert judged(found).kind == "no"
        lasted.append([end - begin for begin, end in found.overruns[0].spans])
    assert lasted[1] == pytest.approx(lasted[0], rel=1e-3)


def test_a_tool_that_is_too_fast_only_between_two_samples_is_told():
    state = State.initial(catalogue()["planar_2r"])
    points = (Waypoint((0.0, 0.3), wait=0.337), Waypoint((1.0, 0.3)))
    state = state.replace(replace(state[Plan], waypoints=points, moves=(Move(),)))
    # The speed is a triangle, whose top lies between two samples.
    free = done(state, SetMove(1, law="trapezoidal"), UseShare(acceleration=0.2))
    found = worked_out(free)
    limit = found.figures.tool_speed / 1.0005
    assert found.samples.tool_speed.max() < limit
    (overrun,) = worked_out(done(free, LimitTool(limit), LastFor(found.duration))).overruns
    assert (overrun.joint, overrun.quantity, overrun.count) == (TOOL, "tool speed", 1)
    top = found.legs[0].start + 0.5 * found.legs[0].motion.duration
    assert overrun.spans[0][0] < top < overrun.spans[0][1]


def test_the_speeds_that_lessons_look_at_are_those_of_the_moves_whatever_the_waits():
    state = opened("planar_2r", points=2)
    near = done(state, SetWaypointJoint(1, 0, state[Plan].waypoints[0].q[0] + 0.02))
    waiting = done(near, SetAtWaypoint(0, "wait", LONGEST_WAIT))
    seen = [seen_motion(with_planned(each), False) for each in (near, waiting)]
    assert seen[1].velocity == pytest.approx(seen[0].velocity, rel=1e-2)
    assert seen[1].acceleration == pytest.approx(seen[0].acceleration, rel=1e-2)


@pytest.mark.parametrize("wait", [0.0, LONGEST_WAIT])
def test_a_motion_read_from_a_file_is_measured_as_closely_whatever_its_rests(wait):
    points = tuple(Waypoint(q, wait=wait) for q in ((0.0, 0.3), (1.5, 1.0), (0.0, 0.3)))
    state = State.initial(catalogue()["planar_2r"])
    state = state.replace(replace(state[Plan], waypoints=points, moves=(Move(),) * 2))
    own, seen = worked_out(state), seen_motion(with_planned(state), False)
    t = np.unique(
        [0.0, own.duration, *(leg.start + x * leg.motion.duration / 60 for leg in own.legs for x in range(61))]
    )
    rows = np.hstack([t[:, None], *own.motion.derivatives(t, (0, 1, 2))])
    head = "t,q1,q2,qdot1,qdot2,qddot1,qddot2"
    text = "\n".join([head, *(",".join(map(repr, row)) for row in rows.tolist())])
    read = apply(state, ReadMotion(text))
    assert worked_out(read).figures.way == pytest.approx(own.figures.way, rel=1e-4)
    assert seen_motion(with_planned(read), False).velocity == pytest.approx(seen.velocity, rel=1e-2)
