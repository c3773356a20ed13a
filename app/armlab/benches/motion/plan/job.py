"""The job that plans the motion, while it is seen, played, or requested by a lesson."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

from armlab.benches.motion.plan.clip import ARM
from armlab.benches.motion.plan.measured import measuring
from armlab.benches.motion.plan.other import other_way
from armlab.benches.motion.plan.planning import making
from armlab.benches.motion.plan.question import Planned, Question
from armlab.benches.motion.plan.state import CLIP_KEY, Plan, question
from armlab.session.job import Job, Wanted
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.teaching.parts.lesson import LessonPart

MOTION = "motion"
"""Name by which lessons request the planned motion."""

PANELS = frozenset({"motion", "motion_files", "motion_pick", "motion_plots", "motion_steps"})
"""The pages that show the planned motion."""


class Asked(NamedTuple):
    """The plan, and the plan it is compared with."""

    plan: Question | None
    other: Question | None


class Found(NamedTuple):
    """The motions planned so far."""

    planned: Planned | None = None
    other: Planned | None = None


def asked(state: State) -> Asked:
    """Return the plans whose motions are still to be computed."""
    part, whole = state[Plan], state.derived(question)
    other = other_way(whole) if part.compared else None
    return Asked(
        None if part.planned is not None and part.planned.question == whole else whole,
        None if other is None or (part.other is not None and part.other.question == other) else other,
    )


def wanted(state: State, panels: frozenset[str]) -> Wanted | None:
    """Return the plans whose motions are missing while they are seen, played, or requested by a lesson."""
    seen = not panels.isdisjoint(PANELS)
    if not (seen or state[Timeline].clip == CLIP_KEY or MOTION in state[LessonPart].asked):
        return None
    missing = state.derived(asked)
    if missing == Asked(None, None):
        return None
    return Wanted((state.derived(question), state[Plan].compared), missing)


def run(missing: Asked) -> Iterator[Found | None]:
    """Yield all results so far; only the newest delivery counts."""
    found = Found()
    for name, whole in zip(Found._fields, missing, strict=True):
        if whole is None:
            continue
        for planned in measuring(making(whole)):
            found = found if planned is None else found._replace(**{name: planned})
            yield None if planned is None else found


def delivered(state: State, missing: Asked, found: Found) -> State:
    """Return the state with the results; the arm moves to the new motion if the old one had moved it."""
    part = state[Plan]
    here = ARM.untouched(state)
    now = state.replace(replace(part, planned=found.planned or part.planned, other=found.other or part.other))
    return ARM.shown(now) if here else now


def with_planned(state: State) -> State:
    """Return the state with its motion planned, at once, for tests and for callers that can wait."""
    missing = asked(state)
    for found in run(missing):
        state = state if found is None else delivered(state, missing, found)
    return state


JOB = Job("plan", "The planning of the motion", wanted, run, delivered)
