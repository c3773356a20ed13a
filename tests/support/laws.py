"""The bench of timing laws after some commands."""

from __future__ import annotations

from armlab.benches.motion.laws.examples import ChooseLawExample
from armlab.benches.motion.laws.state import Laws
from armlab.content.robots import catalogue
from armlab.session.state import Command, State, apply


def after(*commands: Command, state: State | None = None) -> State:
    """Return the state after commands, from an arm that has just been opened."""
    state = state or State.initial(catalogue()["planar_2r"])
    for command in commands:
        state = apply(state, command)
    return state


def bench(*commands: Command) -> Laws:
    """Return the bench after commands."""
    return after(*commands)[Laws]


def example(key: str) -> Laws:
    """Return the bench with an example in place."""
    return bench(ChooseLawExample(key))
