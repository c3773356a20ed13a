"""The film of the tangents: each tangent is drawn and followed to the axis, and then the line to the curve."""

from __future__ import annotations

import math
from typing import NamedTuple

from armlab.benches.iterate.newton_1d.state import CLIP_KEY, solution
from armlab.kin.easing import eased
from armlab.session.parts.timeline import Clip, Timeline
from armlab.session.state import State

STEP = 2.0
"""Duration of a step, seconds."""

DRAWN, MET = 0.35, 0.75
"""Parts of a step after which the tangent is drawn, and after which it meets the axis."""

NEAR = 1e-9


class Place(NamedTuple):
    """A place in the film.

    Attributes
    ----------
    k : int
        Number of the iterate.
    tangent, root, climb : float
        How much of the tangent is drawn, of the way along it to the axis is done, and from there to the curve: 0 to 1.
    """

    k: int
    tangent: float = 0.0
    root: float = 0.0
    climb: float = 0.0


def place_of(state: State) -> Place:
    """Return the place in the film, or the first iterate with its tangent while the film is closed."""
    if state[Timeline].clip != CLIP_KEY:
        return Place(0, 1.0)
    last, at = state.derived(solution).last, state[Timeline].time / STEP
    k = min(math.floor(at + NEAR), last)
    part = 0.0 if k == last else max(0.0, at - k)
    return Place(
        k,
        1.0 if k == last else _part(part, 0.0, DRAWN),
        _part(part, DRAWN, MET),
        _part(part, MET, 1.0),
    )


def _part(at: float, begin: float, end: float) -> float:
    return eased(min(max((at - begin) / (end - begin), 0.0), 1.0))


def _duration(state: State) -> float:
    return max(STEP * state.derived(solution).last, STEP / 2.0)


def _stops(state: State) -> tuple[float, ...]:
    return tuple(STEP * k for k in range(1, state.derived(solution).last))


CLIP = Clip(CLIP_KEY, "Newton in one variable", _duration, _stops, lambda state, time: state, panel="newton_1d")
