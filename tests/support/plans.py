"""States with a plan of a motion."""

from armlab.benches.motion.files.read import motion_csv
from armlab.benches.motion.plan.commands import SetMove
from armlab.benches.motion.plan.job import with_planned
from armlab.benches.motion.plan.points import AddWaypoint
from armlab.benches.motion.plan.state import planned_now
from armlab.content.robots import catalogue
from armlab.session.parts.joints import Joints, RandomPose
from armlab.session.state import State, apply

ROBOTS = ["puma560", "ur10e", "panda", "planar_2r", "scara", "cartesian_3p"]
"""One of each kind."""


def opened(key="puma560", points=2, law=None):
    """Return the state of an arm with a plan of so many waypoints, worked out."""
    state = State.initial(catalogue()[key])
    for _ in range(points - 2):
        state = apply(apply(state, RandomPose()), AddWaypoint())
    if law is not None:
        state = apply(state, SetMove(1, law=law))
    return with_planned(state)


def table(state, rate=200.0):
    """Return the planned motion as a table of joint samples."""
    return motion_csv(state[Joints].arm, planned_now(state).motion, rate)
