"""Peaks, shares, what is exceeded when, and the comparison of joint moves with Cartesian ones."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.plan.check_motion_runs import MotionRuns
from armlab.benches.motion.plan.commands import SetMove
from armlab.benches.motion.plan.figures import TOOL, Binding
from armlab.benches.motion.plan.job import with_planned
from armlab.benches.motion.plan.limits import CompareMoves, LastFor, LimitJerk, LimitTool
from armlab.benches.motion.plan.moves import Move, Waypoint
from armlab.benches.motion.plan.question import Recorded
from armlab.benches.motion.plan.seen import seen_motion
from armlab.benches.motion.plan.state import Plan
from armlab.benches.motion.plan.words import judged, rounded_up, sentences
from armlab.benches.motion.plots.drawn import (
    can_compare,
    compared,
    kind_of,
    same_time,
    shares,
)
from armlab.benches.motion.plots.state import FIRST, QUANTITIES, MotionPlots, ShowMotionPlot
from armlab.benches.motion.plots.ui.words import comparison, status
from armlab.content.robots import catalogue
from armlab.errors import UnknownName
from armlab.session.parts.notation import Notation
from armlab.session.state import State, apply
from armlab.ui.units import Units


def planned_state(key, points=None, *commands, law="trapezoidal", space="joint", **changes):
    """Return a state with a plan through configurations, worked out."""
    state = State.initial(catalogue()[key])
    part = state[Plan]
    waypoints = part.waypoints if points is None else tuple(Waypoint(tuple(map(float, q))) for q in points)
    moves = (Move(space=space, law=Chosen(law)),) * (len(waypoints) - 1)
    state = state.replace(replace(part, waypoints=waypoints, moves=moves, **changes))
    for command in commands:
        state = apply(state, command)
    return with_planned(state)


def inside(robot, rng, count):
    low, high = robot.arm.limits.T
    return low + (0.2 + 0.6 * rng.random((count, robot.arm.n))) * (high - low)


UNITS = Units(Notation())

TWO = [[0.0, 0.5], [1.2, 0.5]]
"""Only the first joint of a planar arm moves, by 1.2 rad."""


def test_the_figures_of_a_bang_bang_move_are_those_computed_by_hand():
    """With T = 1 s and D = 1.2 rad the velocity is 2 D / T at T/2 and the acceleration 4 D / T² throughout."""
    state = planned_state("planar_2r", TWO, LastFor(1.0), law="bang_bang", velocity=(2.0, 2.0), acceleration=(6.0, 6.0))
    found = state[Plan].planned.figures
    np.testing.assert_allclose(found.velocity, [2.4, 0.0], atol=1e-9)
    np.testing.assert_allclose(found.acceleration, [4.8, 0.0], atol=1e-9)
    np.testing.assert_allclose(found.velocity_share, [1.2, 0.0], atol=1e-9)
    np.testing.assert_allclose(found.acceleration_share, [0.8, 0.0], atol=1e-9)
    assert found.velocity_at[0] == pytest.approx(0.5, abs=1e-9)
    radius = float(np.hypot(*catalogue()["planar_2r"].arm.position([0.0, 0.5])[:2]))
    assert found.way == pytest.approx(1.2 * radius, rel=1e-5)
    assert found.tool_speed == pytest.approx(2.4 * radius, rel=1e-6)
    assert found.fastest_joint == 1


def test_exceeded_limits_are_told_with_their_times():
    """q̇ = 4 D t / T² passes v = 2 at t = v T² / 4 D = 5/12 s, and again as long before the end."""
    state = planned_state("planar_2r", TWO, LastFor(1.0), law="bang_bang", velocity=(2.0, 2.0), acceleration=(6.0, 6.0))
    (only,) = state[Plan].planned.overruns
    assert (only.joint, only.quantity) == (1, "velocity")
    np.testing.assert_allclose(only.spans, [(5 / 12, 7 / 12)], atol=1e-5)


def test_the_tool_is_too_fast_where_its_speed_passes_the_limit():
    radius = float(np.hypot(*catalogue()["planar_2r"].arm.position([0.0, 0.5])[:2]))
    limits = {"velocity": (9.0, 9.0), "acceleration": (9.0, 9.0)}
    state = planned_state("planar_2r", TWO, LimitTool(1.2 * radius), LastFor(1.0), law="bang_bang", **limits)
    (only,) = state[Plan].planned.overruns
    assert (only.joint, only.quantity) == (TOOL, "tool speed")
    np.testing.assert_allclose(only.spans, [(0.25, 0.75)], atol=1e-3)
    # As fast as allowed it meets its limit and does not exceed it.
    state = planned_state("planar_2r", TWO, LimitTool(1.2 * radius), law="bang_bang", **limits)
    assert state[Plan].planned.overruns == ()
    assert state[Plan].planned.figures.binding == Binding(TOOL, "tool speed")


def test_limits_exceeded_in_several_legs_are_told_once_for_each_joint():
    points = [[0.0, 0.5], [1.0, 0.5], [0.0, 0.5], [1.0, 0.9]]
    state = planned_state("planar_2r", points, LastFor(1.0), velocity=(1.0, 1.0), acceleration=(90.0, 90.0))
    found = [each for each in state[Plan].planned.overruns if each.quantity == "velocity"]
    assert [each.joint for each in found] == [1, 2]
    assert [len(each.spans) for each in found] == [3, 1]
    starts = [0.0, *state[Plan].planned.boundaries, 1.0]
    for (start, end), (first, last) in zip(found[0].spans, itertools.pairwise(starts), strict=True):
        assert first < start < end < last


@pytest.mark.parametrize("key", ["planar_2r", "puma560", "scara", "panda", "cartesian_3p"])
@pytest.mark.parametrize("space", ["joint", "cartesian"])
def test_what_is_as_fast_as_allowed_meets_a_limit_and_exceeds_none(key, space):
    robot = catalogue()[key]
    rng = np.random.default_rng(7)
    start = inside(robot, rng, 1)[0]
    # Near to each other, so that a Cartesian move can be run.
    points = [start, start + 0.04 * (inside(robot, rng, 1)[0] - start)]
    planned = planned_state(key, points, space=space)[Plan].planned
    assert planned.whole, planned.trouble
    found = planned.figures
    assert planned.overruns == ()
    most = max(found.velocity_share.max(), found.acceleration_share.max())
    assert most == pytest.approx(1.0, abs=1e-6)
    assert found.binding is not None
    quantity = {"velocity": found.velocity_share, "acceleration": found.acceleration_share}[found.binding.quantity]
    assert quantity[found.binding.joint - 1] == pytest.approx(1.0, abs=1e-6)
    # The peaks are above all samples, and not by more than those can miss.
    for values, peak in ((planned.samples.qdot, found.velocity), (planned.samples.qddot, found.acceleration)):
        sampled = np.abs(values).max(axis=0)
        assert (sampled <= peak * (1.0 + 1e-9) + 1e-12).all()
        assert (sampled >= 0.9 * peak - 1e-12).all()
    assert found.way >= np.linalg.norm(planned.samples.tool[-1] - planned.samples.tool[0]) * (1.0 - 1e-9)
    first, second = shares(planned)
    assert 0.0 <= min(first.min(), second.min()) <= max(first.max(), second.max()) <= 1.0 + 1e-6


def test_a_motion_with_more_time_than_it_needs_is_held_back_by_nothing():
    planned = planned_state("puma560", None, LastFor(30.0))[Plan].planned
    assert planned.figures.binding is None
    assert planned.overruns == ()


def test_where_all_joints_slide_both_kinds_of_moves_are_one():
    state = planned_state("cartesian_3p", None, CompareMoves(True))
    planned = state[Plan].planned
    other = compared(state, planned)
    assert (kind_of(planned.question), kind_of(other.question)) == ("joint", "cartesian")
    assert same_time(planned, other)
    own, theirs = planned.figures, other.figures
    assert own.way == pytest.approx(theirs.way, rel=1e-6)
    assert own.way == pytest.approx(float(np.linalg.norm(planned.samples.tool[-1] - planned.samples.tool[0])), rel=1e-9)


@pytest.mark.parametrize("key", ["planar_2r", "puma560", "scara"])
def test_an_arm_with_turning_joints_is_slower_along_a_line_of_the_tool(key):
    state = planned_state(key, None, CompareMoves(True))
    planned = state[Plan].planned
    other = compared(state, planned)
    assert not same_time(planned, other)
    assert planned.fastest < other.fastest
    assert planned.figures.way > other.figures.way


def test_only_what_was_asked_for_and_belongs_to_the_plan_is_compared():
    state = planned_state("planar_2r", None, CompareMoves(True))
    planned = state[Plan].planned
    assert compared(state, planned) is state[Plan].other
    assert compared(apply(state, CompareMoves(False)), planned) is None
    changed = with_planned(apply(apply(state, CompareMoves(False)), LimitTool(0.5)))
    stale = apply(changed, CompareMoves(True))
    assert compared(stale, stale[Plan].planned) is None
    assert compared(with_planned(stale), stale[Plan].planned) is not None


def test_a_motion_from_a_file_has_no_other_kind_of_moves():
    recorded = Recorded((0.0, 1.0, 2.0), ((0.0, 0.1), (0.3, 0.2), (0.2, 0.5)))
    state = planned_state("planar_2r", None, CompareMoves(True), recorded=recorded)
    assert can_compare(State.initial(catalogue()["planar_2r"]))
    assert not can_compare(state)
    assert state[Plan].other is None
    assert state[Plan].planned.figures.way > 0.0


def test_nothing_is_told_of_a_plan_that_cannot_be_run():
    state = planned_state("planar_2r", [[0.0, 0.5]])
    assert state[Plan].planned.figures is None
    assert state[Plan].planned.overruns == ()
    assert shares(state[Plan].planned) is None


def test_the_choice_of_plots_is_kept_and_checked():
    robot = catalogue()["planar_2r"]
    state = State.initial(robot)
    assert state[MotionPlots].shown == FIRST
    state = apply(state, ShowMotionPlot("speed", True))
    state = apply(state, ShowMotionPlot("q", False))
    assert state[MotionPlots].shown == ("q_dot", "q_ddot", "speed")
    assert apply(state, ShowMotionPlot("speed", True)) is state
    part = state[MotionPlots]
    assert MotionPlots.from_json(part.to_json(), robot) == part
    assert MotionPlots.from_json(list(reversed(QUANTITIES)), robot).shown == QUANTITIES
    assert state.with_robot(catalogue()["scara"])[MotionPlots] == part
    with pytest.raises(UnknownName, match="plot: unknown name 'torque'"):
        apply(state, ShowMotionPlot("torque", True))
    with pytest.raises(UnknownName, match="plot"):
        MotionPlots.from_json(["q", "torque"], robot)


@pytest.mark.parametrize("path", ["quintic", "cubic"])
@pytest.mark.parametrize("key", ["cartesian_3p", "planar_2r", "scara"])
def test_a_path_with_a_time_of_its_own_is_compared_with_a_move_that_rests_at_its_ends(key, path):
    state = with_planned(apply(State.initial(catalogue()[key]), SetMove(1, path=path)))
    state = with_planned(apply(state, CompareMoves(True)))
    planned = state[Plan].planned
    other = compared(state, planned)
    assert planned.question.moves[0].law.key == "constant"
    assert (other.question.moves[0].law.key, other.unkept) == ("trapezoidal", ())
    np.testing.assert_allclose(np.abs(other.samples.qdot[[0, -1]]).max(), 0.0, atol=1e-9)


@pytest.mark.parametrize(
    "commands", [(SetMove(1, law="constant"), LastFor(2.0)), (LimitJerk(0.1),)], ids=["constant", "jerk"]
)
def test_where_no_time_keeps_the_limits_none_is_called_the_shortest(commands):
    planned = planned_state("planar_2r", None, *commands)[Plan].planned
    assert planned.unkept
    assert np.isfinite(planned.fastest)
    assert np.isnan(planned.least)
    assert "at least" not in " ".join(judged(planned).lines)
    shown = str(status(planned, planned.figures, planned.overruns))
    assert "exceeded" in shown
    assert "Within the limits" not in shown


def swinging_out(duration):
    """Return a plan with a spline that leaves the limits of joint 1 between two waypoints, which no time mends."""
    high = catalogue()["planar_2r"].arm.limits[0, 1]
    points = [[0.0, 0.0], [high - 0.02, 1.0], [high - 0.02, -1.0], [0.0, 0.5]]
    spline = replace(planned_state("planar_2r", points)[Plan], moves=(Move(path=Chosen("spline")),) * 3)
    state = State.initial(catalogue()["planar_2r"]).replace(replace(spline, duration=duration))
    return with_planned(state)


def test_a_joint_outside_its_limits_comes_inside_in_no_time():
    state = swinging_out(20.0)
    planned = state[Plan].planned
    assert [each.quantity for each in planned.overruns] == ["position"]
    assert np.isnan(planned.least)
    assert judged(planned).lines == (sentences(planned.overruns)[0],)
    assert "Within the limits" not in str(status(planned, planned.figures, planned.overruns))
    assert comparison(planned, planned.figures, planned, planned.figures, UNITS).count("as fast as allowed") == 1
    runs, seen = MotionRuns(), seen_motion(state, played=False)
    says = "The motion exceeds a limit that these moves keep in no time: choose another path or law."
    assert runs._missing(seen) == says


def test_where_the_limits_can_be_kept_the_least_time_is_said():
    planned = planned_state("planar_2r", None, LastFor(0.1))[Plan].planned
    assert planned.least == planned.fastest
    assert f"takes at least {rounded_up(planned.least):.2f} s" in " ".join(judged(planned).lines)
