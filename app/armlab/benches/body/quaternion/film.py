"""A body that turns twice about the axis of the page Forms, and its quaternion, which turns by half the angle."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.quaternion.state import CLIP_KEY, Quaternions
from armlab.benches.body.quaternion.state_view import QuaternionView
from armlab.kin.quaternions import product, unit
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State

Floats = NDArray[np.float64]

DURATION = 8.0
"""Duration of two whole turns, seconds."""

STOPS = (2.0, 4.0, 6.0)
"""Ends of the half turns, seconds."""

CLOSED = 1.5
"""Time that is shown while the film is closed."""


def film_time(state: State) -> float:
    """Return the time of the film in seconds."""
    timeline = state[Timeline]
    return timeline.time if timeline.clip == CLIP_KEY else CLOSED


def angle_at(time: float) -> float:
    """Return the angle at a time in seconds, radians from 0 to 4 pi."""
    return 4.0 * math.pi * time / DURATION


def turned(axis: Floats, angle: float) -> Floats:
    """Return (cos(angle / 2), sin(angle / 2) r), shape (4,); after one whole turn it is -1."""
    return np.concatenate([[math.cos(0.5 * angle)], math.sin(0.5 * angle) * axis])


def present(state: State) -> Floats:
    """Return the quaternion of the film, shape (4,); on other views than that of the film that of the body."""
    found = state.derived(forms_of)
    return turned(found.axis, angle_at(film_time(state))) if in_film(state) else found.q


def in_film(state: State) -> bool:
    """Return whether the two whole turns are shown."""
    return state[QuaternionView].shown == "cover"


def present_turn(state: State) -> tuple[Floats, float]:
    """Return axis and angle of the present quaternion, radians."""
    found = state.derived(forms_of)
    return found.axis, angle_at(film_time(state)) if in_film(state) else found.angle


def second(state: State) -> Floats:
    """Return the second quaternion, of unit length, shape (4,)."""
    return np.asarray(unit(state[Quaternions].p))


def products(state: State) -> tuple[Floats, Floats]:
    """Return p q and q p of the present quaternion q, shape (4,) each."""
    p, q = second(state), present(state)
    return product(p, q), product(q, p)
