"""Finds out which orientations are possible where, while somebody looks."""

from __future__ import annotations

from dataclasses import replace

from armlab.benches.workspace.dexterous.state import Dexterous, question_of, study_of
from armlab.benches.workspace.dexterous.study import Question, Study, studying
from armlab.session.job import Job, Wanted
from armlab.session.parts.joints import Joints
from armlab.session.state import State

PANEL = "dexterous"


def wanted(state: State, panels: frozenset[str]) -> Wanted | None:
    """Return what to compute while the page is seen and nobody has stopped it."""
    if PANEL not in panels:
        return None
    question, found = state.derived(question_of), state.derived(study_of)
    if question is None or question == state[Dexterous].stopped or (found is not None and found.finished):
        return None
    return Wanted(question, question)


def delivered(state: State, question: Question, found: Study) -> State:
    """Return the state with what was found so far; what belongs to another arm, or was stopped, is let go."""
    part = state[Dexterous]
    if question.arm is not state[Joints].arm or question == part.stopped:
        return state
    return state.replace(replace(part, found={**part.found, question.method: found}))


def studied(state: State) -> State:
    """Return the state with everything found, at once: for tests and for those who can wait."""
    question = question_of(state)
    if question is None:
        return state
    for found in studying(question):
        state = state if found is None else delivered(state, question, found)
    return state


JOB = Job("dexterous", "The study of orientations", wanted, studying, delivered)
