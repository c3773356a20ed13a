"""The planned motion as seen by lessons: the facts for checks and live values."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np

from armlab.benches.motion.plan.question import Planned
from armlab.benches.motion.plan.seen_motion import SeenMotion, SeenMove
from armlab.benches.motion.plan.state import CLIP_KEY, Plan, default_limits, planned_now, question
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State

KEPT = 64
"""Number of plans whose facts are kept; a class asks for those of the same few plans again and again."""

ROUNDING = 1e-9
"""Relative difference of two equal limits: one typed in degrees is rounded a few times."""


def motion_changed(before: State, now: State) -> bool:
    """Return whether the plan of a state has changed, computed or not."""
    return now[Plan] is not before[Plan] and now.derived(question) != before.derived(question)


def seen_motion(state: State, played: bool) -> SeenMotion:
    """Return the facts of the motion.

    Parameters
    ----------
    state : State
    played : bool
        Whether it was played to its end, as it is.
    """
    part, timeline, planned = state[Plan], state[Timeline], planned_now(state)
    points = () if part.recorded is not None else part.waypoints
    moves = () if part.recorded is not None else part.laid
    return replace(
        SeenMotion() if planned is None else _facts(planned, part.velocity, part.acceleration),
        waypoints=len(points),
        moves=tuple(SeenMove(move.space, move.path.key, move.law.key) for move in moves),
        played=played,
        time=timeline.time if timeline.clip == CLIP_KEY else None,
        raised=_raised(state),
    )


def _raised(state: State) -> str:
    """Return the limit of a joint that is set higher than the arm's own; empty if there is none."""
    part = state[Plan]
    own = default_limits(state[Joints].arm)
    for name, values, most in zip(("velocity", "acceleration"), (part.velocity, part.acceleration), own, strict=True):
        for j, (value, limit) in enumerate(zip(values, most, strict=True)):
            if value > limit * (1.0 + ROUNDING):
                return f"The limit of {name} of joint {j + 1} was raised."
    return ""


@lru_cache(maxsize=KEPT)
def _facts(planned: Planned, velocity: tuple[float, ...], acceleration: tuple[float, ...]) -> SeenMotion:
    """Return the facts of a planned motion, relative to the full limits of the joints."""
    figures = planned.figures
    return SeenMotion(
        planned=True,
        whole=planned.whole,
        within=planned.whole and not planned.overruns,
        duration=planned.duration,
        fastest=planned.least if math.isfinite(planned.least) else 0.0,
        velocity=0.0 if figures is None else _share(figures.velocity, velocity),
        acceleration=0.0 if figures is None else _share(figures.acceleration, acceleration),
        deviation=max((leg.deviation for leg in planned.legs), default=0.0),
        trouble=planned.trouble,
    )


def _share(peaks: np.ndarray, limits: tuple[float, ...]) -> float:
    """Return the largest share of its limit that a joint uses."""
    return float(np.max(peaks / np.array(limits)))
