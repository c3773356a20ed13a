"""States of the laboratory of geometry."""

import numpy as np

from armlab.benches.motion.space_curve.commands import GoTo
from armlab.benches.motion.space_curve.state import moment_of
from armlab.content.robots import catalogue
from armlab.session.state import State, apply

S = np.linspace(0.0, 1.0, 41)
"""Places along a curve."""


def opened(robot="puma560"):
    """Return the state of an arm at the beginning."""
    return State.initial(catalogue()[robot])


def after(*commands, state=None):
    """Return a state, the one at the beginning if none is given, after commands."""
    state = state or opened()
    for command in commands:
        state = apply(state, command)
    return state


def at(state, s):
    """Return what is true at a place of the curve."""
    return moment_of(apply(state, GoTo(s)))
