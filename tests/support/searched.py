"""A state after the work that runs beside the commands: all solutions of its target."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.benches.target.solutions import job
from armlab.benches.target.solutions.found import Row
from armlab.benches.target.solutions.state import Solutions
from armlab.content.robots import catalogue
from armlab.session.parts.joints import TakePose
from armlab.session.parts.target import target_pose
from armlab.session.state import State, apply

OPEN = frozenset({"solutions"})


def opened(key: str, pose: str | None = None) -> State:
    """Return a state with an arm, at home or in one of its poses."""
    state = State.initial(catalogue()[key])
    return state if pose is None else apply(state, TakePose(pose))


def searched(state: State, panels: frozenset[str] = OPEN) -> State:
    """Return the state after the job has done all that it is wanted for."""
    for _ in range(5):
        wanted = job.wanted(state, panels)
        if wanted is None:
            return state
        pieces = list(job.run(wanted.inputs))
        if not pieces:
            return state
        for piece in pieces:
            state = job.delivered(state, wanted.inputs, piece)
    raise AssertionError("the job does not come to an end")


def moved(state: State, *by: float) -> NDArray[np.float64]:
    """Return the target moved by metres along the world's axes."""
    T = np.array(target_pose(state))
    T[:3, 3] += by
    return T


def rows(state: State) -> Sequence[Row]:
    """Return the list."""
    found = state[Solutions].found
    assert found is not None
    return found.rows
