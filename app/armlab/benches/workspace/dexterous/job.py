"""The job that finds which orientations are possible at which points, while the page is seen."""

from __future__ import annotations

from dataclasses import replace

from armlab.benches.workspace.dexterous.state import Dexterous, question_of, study_of
from armlab.benches.workspace.dexterous.study import Question, Study, studying
from armlab.session.job import Job, Wanted
from armlab.session.parts.joints import Joints
from armlab.session.state import State

PANEL = "dexterous"


def wanted(state: State, panels: frozenset[str]) -> Wanted | None:
    """Return the request while the page is seen and the student has not stopped it."""
    if PANEL not in panels:
        return None
    question, found = state.derived(question_of), state.derived(study_of)
    if question is None or question == state[Dexterous].stopped or (found is not None and found.finished):
        return None
    return Wanted(question, question)


def delivered(state: State, question: Question, found: Study) -> State:
    """Return the state with the results so far; those of another arm or of a stopped request are dropped."""
    part = state[Dexterous]
    if question.arm is not state[Joints].arm or question == part.stopped:
        return state
    return state.replace(replace(part, found={**part.found, question.method: found}))


def studied(state: State) -> State:
    """Return the state with all results, at once, for tests and for callers that can wait."""
    question = question_of(state)
    if question is None:
        return state
    for found in studying(question):
        state = state if found is None else delivered(state, question, found)
    return state


JOB = Job("dexterous", "The study of orientations", wanted, studying, delivered)
