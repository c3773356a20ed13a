"""The job that runs both forms of the chosen erratum while its page is seen."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace

from armlab.benches.lessons.errata.state import Errata, Found
from armlab.session.job import Job, Wanted
from armlab.session.state import State

PANEL = "errata"

PIECE = 0.02
"""Longest work between two results, seconds: points are run one by one, and some take milliseconds."""


def wanted(state: State, panels: frozenset[str]) -> Wanted | None:
    """Return the erratum and its points, while the page is seen and they have not been run."""
    part = state[Errata]
    if PANEL not in panels or part.erratum.unrun or (part.run is not None and part.run.complete):
        return None
    asked = Found(part.chosen, part.seed, part.quiet)
    return Wanted((asked.key, asked.seed, asked.quiet), asked)


def running(asked: Found) -> Iterator[Found | None]:
    """Yield what has been found, and None after some work without anything new to show."""
    from armlab.kin.errata import in_pieces, trials  # with the first run: it needs much of SciPy

    yield None
    trial = trials()[asked.key]
    found, begun = replace(asked, trial=trial), time.perf_counter()
    # Where the error is seen at all inputs, a wish for others, as of a page of another erratum, changes nothing.
    quiet = asked.quiet and trial.quiet is not None
    for printed, correct in in_pieces(trial, asked.seed, quiet=quiet):
        found = replace(found, printed=(*found.printed, printed), correct=(*found.correct, correct))
        if time.perf_counter() - begun > PIECE:
            yield found
            begun = time.perf_counter()
    yield replace(found, complete=True)


def delivered(state: State, asked: Found, found: Found) -> State:
    """Return the state with the results so far; those of another erratum or of other points are dropped."""
    part = state[Errata]
    if (part.chosen, part.seed, part.quiet) != (asked.key, asked.seed, asked.quiet):
        return state
    return state.replace(replace(part, found=found))


def run_at_once(state: State) -> State:
    """Return the state with all residuals, for callers that can wait."""
    looked = wanted(state, frozenset({PANEL}))
    for found in running(looked.inputs) if looked is not None else ():
        if found is not None and looked is not None:
            state = delivered(state, looked.inputs, found)
    return state


JOB = Job("errata", "The run of an erratum", wanted, running, delivered)
