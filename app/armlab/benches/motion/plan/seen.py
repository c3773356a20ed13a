"""What a lesson sees of the planned motion: the facts its checks and live values ask for."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np

from armlab.benches.motion.plan.question import Planned
from armlab.benches.motion.plan.state import CLIP_KEY, Plan, default_limits, planned, question
from armlab.content.lesson import Lesson, Step
from armlab.content.live import OF_MOTION
from armlab.content.seen_motion import SeenMotion, SeenMove
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State

KEPT = 64
"""Plans whose facts are kept; a class at work asks for those of the same few plans again and again."""

ROUNDING = 1e-9
"""By which a limit may be higher and still be the same: typed in degrees it is rounded a few times."""


def asks_for_motion(lesson: Lesson, step: Step, met: bool) -> bool:
    """Return whether a step looks at the planned motion, in a text, or in its check until that is met."""
    return (checks_motion(step) and not met) or not OF_MOTION.isdisjoint((*step.live, *lesson.live))


def checks_motion(step: Step) -> bool:
    """Return whether the check of a step looks at the planned motion."""
    return step.check is not None and step.check.of_motion


def motion_changed(before: State, now: State) -> bool:
    """Return whether the plan of a state is another one, worked out or not."""
    return now[Plan] is not before[Plan] and now.derived(question) != before.derived(question)


def seen_motion(state: State, played: bool) -> SeenMotion:
    """Return what there is to see of the motion.

    Parameters
    ----------
    state : State
    played : bool
        Whether it was played to its end, as it is.
    """
    part, timeline, plan = state[Plan], state[Timeline], planned(state)
    points = () if part.recorded is not None else part.waypoints
    moves = () if part.recorded is not None else part.moves
    return replace(
        SeenMotion() if plan is None else _facts(plan, part.velocity, part.acceleration),
        waypoints=len(points),
        moves=tuple(SeenMove(move.space, move.path.key, move.law.key) for move in moves),
        played=played,
        time=timeline.time if timeline.clip == CLIP_KEY else None,
        raised=_raised(state),
    )


def _raised(state: State) -> str:
    """Return which limit of a joint is set higher than the arm's own; empty when none is."""
    part = state[Plan]
    own = default_limits(state[Joints].arm)
    for name, values, most in zip(("velocity", "acceleration"), (part.velocity, part.acceleration), own, strict=True):
        for j, (value, limit) in enumerate(zip(values, most, strict=True)):
            if value > limit * (1.0 + ROUNDING):
                return f"The limit of {name} of joint {j + 1} was raised."
    return ""


@lru_cache(maxsize=KEPT)
def _facts(plan: Planned, velocity: tuple[float, ...], acceleration: tuple[float, ...]) -> SeenMotion:
    """Return what follows from a plan that is worked out, and from the whole limits of the joints."""
    samples = plan.samples
    return SeenMotion(
        planned=True,
        whole=plan.whole,
        within=plan.whole and not plan.overruns,
        duration=plan.duration,
        fastest=plan.fastest if math.isfinite(plan.fastest) else 0.0,
        velocity=0.0 if samples is None else _share(samples.qdot, velocity),
        acceleration=0.0 if samples is None else _share(samples.qddot, acceleration),
        deviation=max((leg.deviation for leg in plan.legs), default=0.0),
        trouble=plan.trouble,
    )


def _share(rates: np.ndarray, limits: tuple[float, ...]) -> float:
    """Return the largest part of its limit that a joint uses."""
    return float(np.max(np.abs(rates) / np.array(limits)))
