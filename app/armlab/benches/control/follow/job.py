"""The job that makes the runs of kinematic control, one after the other, while they are seen."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

from armlab.benches.control.follow.clip import ARM
from armlab.benches.control.follow.runs import Outcome, Question, making
from armlab.benches.control.follow.state import CLIP_KEY, Control, questions
from armlab.benches.motion.api import Planned, last_planned
from armlab.session.job import Job, Wanted
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State

PANEL = "control"


class Todo(NamedTuple):
    """The runs that are still to be made, by colour, the selected one first, and the planned motion if it is known."""

    runs: tuple[tuple[int, Question], ...]
    known: Planned | None = None


def todo(state: State) -> Todo:
    """Return the runs that are still to be made."""
    part = state[Control]
    missing = [
        (run.colour, question)
        for run, question in zip(part.runs, state.derived(questions), strict=True)
        if run.colour not in part.outcomes or part.outcomes[run.colour].question != question
    ]
    return Todo(tuple(sorted(missing, key=lambda each: each[0] != part.run.colour)), last_planned(state))


def wanted(state: State, panels: frozenset[str]) -> Wanted | None:
    """Return the missing runs while the panel or a run is seen."""
    if PANEL not in panels and state[Timeline].clip != CLIP_KEY:
        return None
    missing = state.derived(todo)
    # What has been delivered is missing no longer, and the work on the rest goes on: the key is that of the whole.
    return Wanted(state.derived(questions), missing) if missing.runs else None


def run(missing: Todo) -> Iterator[dict[int, Outcome] | None]:
    """Yield all the runs made so far, again and again; only the newest delivery counts."""
    outcomes: dict[int, Outcome] = {}
    for colour, question in missing.runs:
        outcomes[colour] = yield from making(question, missing.known)
        yield dict(outcomes)


def delivered(state: State, missing: Todo, found: dict[int, Outcome]) -> State:
    """Return the state with the new runs; the arm moves to the new run if the old one had moved it.

    Runs of another arm are dropped.
    """
    part, arm = state[Control], state[Joints].arm
    colours = {run.colour for run in part.runs}
    here = ARM.untouched(state)
    outcomes = {
        colour: outcome
        for colour, outcome in {**part.outcomes, **found}.items()
        if colour in colours and outcome.question.arm is arm
    }
    now = state.replace(replace(part, outcomes=outcomes))
    return ARM.shown(now) if here else now


def with_outcomes(state: State) -> State:
    """Return the state with all runs made, at once, for tests and for callers that can wait."""
    missing = todo(state)
    for found in run(missing):
        state = state if found is None else delivered(state, missing, found)
    return state


JOB = Job("control", "The run of the control", wanted, run, delivered)
