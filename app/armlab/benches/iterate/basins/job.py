"""The job that computes the requested map of basins of attraction, whether or not its page stays open."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from armlab.benches.iterate.basins.maps import Map, Question
from armlab.benches.iterate.basins.state import Basins
from armlab.errors import InputError
from armlab.kin.ik.branches import branch_names
from armlab.kin.ik.solutions import IkSolutions
from armlab.kin.ik.solve_all import solve_all
from armlab.session.job import Job, Wanted
from armlab.session.state import State


def wanted(state: State, panels: frozenset[str]) -> Wanted | None:
    """Return the map that is being computed."""
    question = state[Basins].drawing
    return None if question is None else Wanted(question, question)


def run(question: Question) -> Iterator[Map | None]:
    """Yield the map each time rows have been added."""
    known = known_solutions(question)
    yield None
    pieces = question.pieces(None if known is None else known.q)
    names: tuple[str, ...] = ()
    rows = -1
    for found in pieces:
        if found.rows == rows:
            yield None
            continue
        if len(names) != len(found.solutions):
            names = branch_names(question.arm, found.solutions)
        rows = found.rows
        yield Map(question, found, names, "" if known is None else known.sentence)


def known_solutions(question: Question) -> IkSolutions | None:
    """Return all solutions, whose order gives the colours of the map, or None if there is no such list.

    With a joint as a task component, or locked, they are those of the arm with this joint held.
    """
    arm = question.arm if question.task.task == question.arm.task else replace(question.arm, task=question.task.task)
    held = {i + 1: value for i, value in enumerate(question.rest) if question.locked[i]}
    held.update(question.task.joints)
    try:
        found = solve_all(arm, target_of(question), held=held)
    except InputError:
        return None
    # What was sampled of infinitely many are no basins of their own.
    return None if found.completeness == "infinite" else found


def target_of(question: Question) -> NDArray[np.float64]:
    """Return the target pose (4, 4)."""
    return np.frombuffer(question.target).reshape(4, 4).copy()


def delivered(state: State, question: Question, found: Map) -> State:
    """Return the state with the map so far; a cancelled one is dropped."""
    part = state[Basins]
    if part.drawing is not question:
        return state
    return state.replace(replace(part, map=found, drawing=None if found.finished else question))


def drawn(state: State) -> State:
    """Return the state with the whole requested map, for tests and for callers that can wait."""
    question = state[Basins].drawing
    if question is None:
        return state
    for found in run(question):
        state = state if found is None else delivered(state, question, found)
    return state


JOB = Job("basins", "The map of basins", wanted, run, delivered)
