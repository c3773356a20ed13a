"""The job that samples the requested workspace, whether or not its page stays open."""

from __future__ import annotations

from dataclasses import replace

from armlab.benches.workspace.cloud.samples import Question, Sampled, sampling
from armlab.benches.workspace.cloud.state import Workspace
from armlab.session.job import Job, Wanted
from armlab.session.state import State


def wanted(state: State, panels: frozenset[str]) -> Wanted | None:
    """Return the workspace that is being sampled."""
    question = state[Workspace].asked
    return None if question is None else Wanted(question, question)


def delivered(state: State, question: Question, found: Sampled) -> State:
    """Return the state with the samples so far; those of a cancelled workspace are dropped."""
    part = state[Workspace]
    if part.asked != question:
        return state
    # Another colour of the same samples: the chosen one stays chosen.
    same = part.found is not None and _cloud(part.found.question) == _cloud(question)
    chosen = part.chosen if same else None
    return state.replace(replace(part, found=found, chosen=chosen, asked=None if found.finished else question))


def _cloud(question: Question) -> tuple[object, int]:
    return question.arm, question.seed


def sampled(state: State) -> State:
    """Return the state with the whole requested workspace, for tests and for callers that can wait."""
    question = state[Workspace].asked
    if question is None:
        return state
    for found in sampling(question):
        state = state if found is None else delivered(state, question, found)
    return state


JOB = Job("workspace", "The sampling of the workspace", wanted, sampling, delivered)
