"""The film of the selected run: the arm at one iterate after the other, with a short glide between them."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.benches.iterate.runs.films import Film
from armlab.benches.iterate.runs.state import CLIP_KEY, Iterations
from armlab.kin.easing import eased
from armlab.session.arm_on_clip import ArmOnClip, standing
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Clip, Timeline
from armlab.session.state import State

SLOW, WHOLE = 0.9, 20.0
"""Longest time from an iterate to the next, and longest film, seconds."""

WAITING = 1.0
"""Duration of a film that is still being made, seconds."""

REST = 0.4
"""Share of the time between two iterates in which the arm rests at the first."""

NEAR = 1e-6
"""Difference of a time from that of an iterate, in lengths of the film, below which they are the same."""

Floats = NDArray[np.float64]


def each(film: Film) -> float:
    """Return the seconds from one iterate to the next."""
    return min(SLOW, WHOLE / film.last) if film.last else 0.0


def duration(state: State) -> float:
    """Return the duration of the film, seconds."""
    film = state[Iterations].film
    return WAITING if film is None or not film.last else film.last * each(film)


def stops(state: State) -> tuple[float, ...]:
    """Return the times of the iterates between the first and the last."""
    film = state[Iterations].film
    return () if film is None else tuple(k * each(film) for k in range(1, film.last))


def place_at(film: Film, time: float) -> tuple[int, float]:
    """Return the present iterate and the share of the way to the next that is done, 0 to 1."""
    if not film.last:
        return 0, 0.0
    k = time / each(film)
    i = min(max(math.floor(k + NEAR * (1.0 + film.last)), 0), film.last)
    if i == film.last:
        return i, 0.0
    return i, eased(max(0.0, (k - i - REST) / (1.0 - REST)))


def configuration(film: Film, place: tuple[int, float]) -> Floats:
    """Return the joint values at a place of a film, (n,).

    Between two iterates the arm takes no whole turns: of a jump by twelve turns one would see nothing.
    """
    i, part = place
    if part == 0.0:
        return np.array(film.q[i])
    way = film.q[i + 1] - film.q[i]
    arm = film.question.arm
    way = way - np.where(arm.revolute, 2.0 * math.pi * np.round(way / (2.0 * math.pi)), 0.0)
    return np.asarray(film.q[i] + part * way)


def place_of(state: State) -> tuple[int, float]:
    """Return the place in the film of a state, or the first iterate while the film is closed."""
    film = state[Iterations].film
    if film is None or state[Timeline].clip != CLIP_KEY:
        return 0, 0.0
    return place_at(film, state[Timeline].time)


def alongside(film: Film, place: tuple[int, float], other: Film) -> tuple[int, float]:
    """Return the place of another run: at the same step or time, else at the same share of its way."""
    i, share = place
    k = i + share
    if film.t is not None and other.t is not None:
        time = float(np.interp(k, np.arange(len(film.t)), film.t))
        k = float(np.interp(time, other.t, np.arange(len(other.t))))
    elif film.t is not None or other.t is not None:
        k = other.last * k / film.last if film.last else 0.0
    k = min(k, float(other.last))
    i = math.floor(k)
    return (i, 0.0) if i == other.last else (i, k - i)


def _stood(state: State, time: float) -> Floats:
    """Return the joint values at a time, (n,), inside the limits; those at the start while the film is being made."""
    part = state[Iterations]
    q = np.array(part.start) if part.film is None else configuration(part.film, place_at(part.film, time))
    return standing(state[Joints].arm, q)


ARM = ArmOnClip(CLIP_KEY, Iterations, duration, _stood)

CLIP = Clip(CLIP_KEY, "Iterations", duration, stops, ARM.at, tab="iterations", closed=ARM.put_back)
