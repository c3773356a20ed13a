"""The two links of the notes' experiments, and states with runs, for tests of kinematic control."""

import math

import numpy as np

from armlab.benches.control.follow.commands import SetValue
from armlab.benches.control.follow.job import with_outcomes
from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.control import LineReference, Settings, plant, simulate
from armlab.session.state import State, apply

TWO_R = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)] * 2)


def bent(elbow):
    """Return the joint values of the tool at (1.9, 0)."""
    q2 = elbow * math.acos((1.9**2 - 2.0) / 2.0)
    return np.array([-q2 / 2.0, q2])


def notes_line(degrees, elbow=1):
    """Return start and reference of the line from (1.9, 0) at 0.6 m/s for 6 s."""
    q = bent(elbow)
    along = math.radians(degrees)
    return q, LineReference(TWO_R.fk(q), [0.6 * math.cos(along), 0.6 * math.sin(along), 0.0], 6.0)


def notes_run(degrees, elbow=1, law="open_loop", limit=None, **settings):
    """Return the run of the notes' experiment; ``limit`` in degrees a second clips each joint."""
    q, line = notes_line(degrees, elbow)
    clipped = {} if limit is None else {"plant": plant(TWO_R, saturation="clip", speed_limits=math.radians(limit))}
    return simulate(TWO_R, law, line, q, Settings(**{"inverse": "inverse", **clipped, **settings}))


def opened(key="planar_2r"):
    """Return the first state of a robot."""
    return State.initial(catalogue()[key])


def done(state, *commands):
    """Return the state after commands, with all its runs made."""
    for command in commands:
        state = apply(state, command)
    return with_outcomes(state)


def short_run():
    """Return a state with a run of 0.5 s in coarse steps."""
    return done(opened(), SetValue("duration", 0.5), SetValue("step", 0.01))
