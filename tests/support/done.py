"""What a student has done, one command after the other."""

from __future__ import annotations

from armlab.session.session import apply
from armlab.session.state import Command, State


def done(state: State, *commands: Command, at: float = 0.0) -> State:
    """Return the state after commands, all given at one time, seconds."""
    for command in commands:
        state = apply(state, command, at)
    return state
