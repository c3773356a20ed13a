"""The job that makes the films of the runs, one after the other, while they are seen."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

from armlab.benches.iterate.runs.arms import Arms, Asked, arms_of
from armlab.benches.iterate.runs.clip import ARM
from armlab.benches.iterate.runs.films import Film, Question, making
from armlab.benches.iterate.runs.state import CLIP_KEY, Iterations, arms_asked, on_film, questions
from armlab.session.job import Job, Wanted
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State

PANEL = "iterations"


class Todo(NamedTuple):
    """The runs without a film of the present question, by colour, the selected one first, and the arms to find."""

    runs: tuple[tuple[int, Question], ...]
    arms: Asked | None

    def __bool__(self) -> bool:
        return bool(self.runs) or self.arms is not None


class Found(NamedTuple):
    """Films and arms made so far."""

    films: dict[int, Film]
    arms: Arms | None = None


def todo(state: State) -> Todo:
    """Return the films that are still to be made."""
    part = state[Iterations]
    missing = [
        (run.colour, question)
        for run, question in zip(part.runs, state.derived(questions), strict=True)
        if run.colour not in part.films or part.films[run.colour].question != question
    ]
    arms = state.derived(arms_asked)
    known = part.arms is not None and part.arms.asked == arms
    return Todo(tuple(sorted(missing, key=lambda each: each[0] != part.run.colour)), None if known else arms)


def wanted(state: State, panels: frozenset[str]) -> Wanted | None:
    """Return the missing films while the panel or the film is seen."""
    if PANEL not in panels and state[Timeline].clip != CLIP_KEY:
        return None
    missing = state.derived(todo)
    # What has been delivered is missing no longer, and the work on the rest goes on: the key is that of the whole.
    return Wanted((state.derived(questions), state.derived(arms_asked)), missing) if missing else None


def run(missing: Todo) -> Iterator[Found | None]:
    """Yield all results so far, again and again; only the newest delivery counts."""
    films: dict[int, Film] = {}
    for colour, question in missing.runs:
        films[colour] = yield from making(question)
        yield Found(dict(films))
    if missing.arms is not None:
        yield Found(films, arms_of(missing.arms))


def delivered(state: State, missing: Todo, found: Found) -> State:
    """Return the state with the new films; the arm moves to the new film if the old one had moved it.

    Films of another arm are dropped.
    """
    part, arm = state[Iterations], state[Joints].arm
    colours = {run.colour for run in part.runs}
    here = ARM.untouched(state)
    films = {
        colour: film
        for colour, film in {**part.films, **found.films}.items()
        if colour in colours and film.question.arm is arm
    }
    arms = found.arms if found.arms is not None and found.arms.asked.arm is arm else part.arms
    now = state.replace(replace(part, films=films, arms=arms))
    return on_film(now) if here else now


def with_films(state: State) -> State:
    """Return the state with everything made, at once, for tests and for callers that can wait."""
    missing = todo(state)
    for found in run(missing):
        state = state if found is None else delivered(state, missing, found)
    return state


JOB = Job("iterations", "The iteration", wanted, run, delivered)
