"""Works out the plan of the motion, while somebody looks at it, a lesson asks for it, or it is on."""

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
from armlab.session.parts.lesson import LessonPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State

MOTION = "motion"
"""By which lessons ask for the plan."""

PANELS = "motion"
"""How the keys of panels that show the plan begin."""


class Asked(NamedTuple):
    """The plan, and the one it is compared with."""

    plan: Question | None
    other: Question | None


class Found(NamedTuple):
    """What has been worked out so far."""

    plan: Planned | None = None
    other: Planned | None = None


def asked(state: State) -> Asked:
    """Return what is still to be worked out."""
    part, whole = state[Plan], state.derived(question)
    other = other_way(whole) if part.compared else None
    return Asked(
        None if part.planned is not None and part.planned.question == whole else whole,
        None if other is None or (part.other is not None and part.other.question == other) else other,
    )


def wanted(state: State, panels: frozenset[str]) -> Wanted | None:
    """Return what to work out while it is seen, is on, or a lesson asks for it."""
    seen = any(key.startswith(PANELS) for key in panels)
    if not (seen or state[Timeline].clip == CLIP_KEY or MOTION in state[LessonPart].asked):
        return None
    missing = state.derived(asked)
    if missing == Asked(None, None):
        return None
    return Wanted((state.derived(question), state[Plan].compared), missing)


def run(missing: Asked) -> Iterator[Found | None]:
    """Yield all that is worked out so far: of several deliveries only the newest counts."""
    found = Found()
    for name, whole in zip(missing._fields, missing, strict=True):
        if whole is None:
            continue
        for plan in measuring(making(whole)):
            found = found if plan is None else found._replace(**{name: plan})
            yield None if plan is None else found


def delivered(state: State, missing: Asked, found: Found) -> State:
    """Return the state with what was found, the arm where the new motion has it if the old one had put it there."""
    part = state[Plan]
    here = ARM.untouched(state)
    now = state.replace(replace(part, planned=found.plan or part.planned, other=found.other or part.other))
    return ARM.shown(now) if here else now


def with_planned(state: State) -> State:
    """Return the state with its plan worked out, at once: for tests and for those who can wait."""
    missing = asked(state)
    for found in run(missing):
        state = state if found is None else delivered(state, missing, found)
    return state


JOB = Job("plan", "The planning of the motion", wanted, run, delivered)
