"""The job that finds the requested fastest intervals of a spline."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from armlab.benches.motion.curves.fastest import Asked, Fastest, fastest
from armlab.benches.motion.curves.state import Curves
from armlab.session.job import Job, Wanted
from armlab.session.state import State


def wanted(state: State, panels: frozenset[str]) -> Wanted | None:
    """Return the open question."""
    asked = state[Curves].asked
    return None if asked is None else Wanted(asked, asked)


def run(asked: Asked) -> Iterator[Fastest]:
    """Yield the answer, which is found in one piece."""
    yield fastest(asked)


def delivered(state: State, asked: Asked, found: Fastest) -> State:
    """Return the state with the answer; one to an earlier question is dropped."""
    part = state[Curves]
    return state.replace(replace(part, asked=None, fastest=found)) if part.asked == asked else state


def with_fastest(state: State) -> State:
    """Return the state with the answer, at once, for tests and for callers that can wait."""
    asked = state[Curves].asked
    return state if asked is None else delivered(state, asked, fastest(asked))


JOB = Job("curves", "The search for the fastest intervals", wanted, run, delivered)
