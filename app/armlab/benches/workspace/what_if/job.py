"""The job that compares the workspace of the arm with that of the supposed arm, while the page is open."""

from __future__ import annotations

from dataclasses import replace

from armlab.benches.workspace.what_if.found import Compared, Question, comparing
from armlab.benches.workspace.what_if.state import WhatIf, is_present
from armlab.session.job import Job, Wanted
from armlab.session.state import State


def wanted(state: State, panels: frozenset[str]) -> Wanted | None:
    """Return the two arms until the comparison is complete."""
    part = state[WhatIf]
    done = part.found is not None and part.found.finished and is_present(state)
    if PAGE not in panels or done:
        return None
    return Wanted((part.arm, part.other), Question(part.arm, part.other))


def delivered(state: State, question: Question, found: Compared) -> State:
    """Return the state with the results; those of other arms are dropped."""
    part = state[WhatIf]
    if part.arm is not question.before or part.other is not question.after:
        return state
    return state.replace(replace(part, found=found))


def compared(state: State) -> State:
    """Return the state with the complete comparison, for tests and for callers that can wait."""
    job = wanted(state, frozenset({PAGE}))
    if job is None:
        return state
    for found in comparing(job.inputs):
        state = state if found is None else delivered(state, job.inputs, found)
    return state


PAGE = "what_if"
JOB = Job("what_if", "The comparison of two workspaces", wanted, comparing, delivered)
