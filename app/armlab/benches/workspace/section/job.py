"""The job that finds the section of the workspace while its page is seen."""

from __future__ import annotations

from dataclasses import replace

from armlab.benches.workspace.section.found import Found, Question, finding
from armlab.benches.workspace.section.state import SectionView, question_of
from armlab.session.job import Job, Wanted
from armlab.session.parts.joints import Joints
from armlab.session.state import State

PANEL = "section"


def wanted(state: State, panels: frozenset[str]) -> Wanted | None:
    """Return the request for missing results while the page is seen."""
    question = question_of(state) if PANEL in panels else None
    return None if question is None else Wanted((question.arm, question.colour), question)


def delivered(state: State, question: Question, found: Found) -> State:
    """Return the state with the results so far; those of another arm are dropped."""
    part = state[SectionView]
    if question.arm is not state[Joints].arm:
        return state
    return state.replace(replace(part, found=found))


def found_section(state: State) -> State:
    """Return the state with all results, at once, for tests and for callers that can wait."""
    question = question_of(state)
    for found in finding(question) if question is not None else ():
        if found is not None and question is not None:
            state = delivered(state, question, found)
    return state


JOB = Job("section", "The section of the workspace", wanted, finding, delivered)
