"""Copies of waypoints: behind the waypoint, to be dragged or shifted, and what the plan says until then."""

import json

import pytest

from armlab.benches.motion.plan.commands import SetMove
from armlab.benches.motion.plan.job import with_planned
from armlab.benches.motion.plan.moves import MOST_WAYPOINTS
from armlab.benches.motion.plan.points import (
    AddWaypoint,
    CopyWaypoint,
    RemoveWaypoint,
    SetWaypointJoint,
    ShiftWaypoint,
)
from armlab.benches.motion.plan.state import Plan, planned_now
from armlab.benches.motion.plan.words import judged
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.session.parts.joints import RandomPose
from armlab.session.state import State, apply
from support.done import done


def opened(robot, points=2):
    """Return a state with so many waypoints, the further ones random."""
    state = State.initial(catalogue()[robot])
    for _ in range(points - 2):
        state = done(state, RandomPose(), AddWaypoint())
    return state


def worked_out(state):
    return planned_now(with_planned(state))


def test_a_copy_comes_behind_its_waypoint_with_its_move_and_is_selected_to_be_dragged():
    state = done(opened("puma560", 4), SetMove(1, space="cartesian"))
    points, moves = state[Plan].waypoints, state[Plan].moves
    for k in range(4):
        part = done(state, CopyWaypoint(k))[Plan]
        assert part.waypoints == (*points[: k + 1], points[k], *points[k + 1 :])
        assert part.moves == (*moves[:k], moves[max(k - 1, 0)], *moves[k:])
        assert (part.selected, part.handled) == (k + 1, True)


def test_a_copy_in_the_same_place_is_said_and_runs_once_it_is_elsewhere():
    state = done(opened("puma560", 3), CopyWaypoint(1))
    said = judged(worked_out(state))
    assert said.kind == "no"
    assert any("waypoint 3: the same as waypoint 2" in line for line in said.lines)
    shifted = done(state, ShiftWaypoint(2, 1))
    assert judged(worked_out(shifted)).kind == "ok"
    typed = done(state, SetWaypointJoint(2, 0, 0.3))
    assert judged(worked_out(typed)).kind == "ok"
    read = Plan.from_json(json.loads(json.dumps(state[Plan].to_json())), catalogue()["puma560"])
    assert read.waypoints == state[Plan].waypoints


def test_a_single_waypoint_can_be_copied_and_not_more_than_there_may_be():
    alone = done(opened("planar_2r"), RemoveWaypoint(1), CopyWaypoint(0))
    assert len(alone[Plan].waypoints) == 2
    assert len(alone[Plan].moves) == 1
    full = opened("planar_2r", MOST_WAYPOINTS)
    with pytest.raises(InputError, match=f"at most {MOST_WAYPOINTS}"):
        apply(full, CopyWaypoint(0))
    with pytest.raises(InputError, match="waypoint: expected 1 to 2, got 4"):
        apply(opened("planar_2r"), CopyWaypoint(3))
