"""Films of iterations for tests: an arm, commands, and all films made at once."""

from armlab.benches.iterate.runs.job import with_films
from armlab.benches.iterate.runs.state import StartIterations
from armlab.content.robots import catalogue
from armlab.session.parts.joints import Joints
from armlab.session.state import State, apply


def opened(key="planar_2r"):
    return State.initial(catalogue()[key])


def done(state, *commands):
    for command in commands:
        state = apply(state, command)
    return with_films(state)


def started(key="planar_2r", q=None):
    state = opened(key)
    return done(state, StartIterations(tuple(state[Joints].q.tolist()) if q is None else q))
