"""Facts of pick and place that lessons can check: boxes taken, missed and brought to the goal by the planned motion."""

from __future__ import annotations

from armlab.benches.motion.pick.state import Pick, course_of, from_goal, placed
from armlab.benches.motion.plan.job import JOB
from armlab.benches.motion.plan.state import Plan, planned_now
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _placed(state: State) -> int | None:
    return None if planned_now(state) is None else placed(state)


def _picked(state: State) -> int | None:
    return None if planned_now(state) is None else sum(each.taken for each in state.derived(course_of).tries)


def _missed(state: State) -> float | None:
    """Return by how far the gripper misses the nearest box where it first closes on nothing; 0 if it never does."""
    if planned_now(state) is None:
        return None
    return next((each.distance for each in state.derived(course_of).tries if not each.taken), 0.0)


def _apart(state: State) -> float | None:
    apart = from_goal(state)
    return None if planned_now(state) is None or not apart else min(apart)


def _waits(state: State) -> float:
    return sum(point.wait for point in state[Plan].waypoints)


FACTS = Facts(
    __name__,
    (Pick, Plan),
    {
        "boxes": Fact("the number of boxes", lambda s: len(s[Pick].boxes), kind="count"),
        "picked": Fact("the number of boxes that the gripper takes", _picked, kind="count"),
        "placed": Fact("the number of boxes at the goal at the end", _placed, kind="count"),
        "missed": Fact("the distance by which the gripper first misses a box", _missed, "m"),
        "from_goal": Fact("the distance of the nearest box from the goal in the end", _apart, "m"),
        "waits": Fact("the sum of the waits at waypoints", _waits, "s"),
    },
    JOB,
)
