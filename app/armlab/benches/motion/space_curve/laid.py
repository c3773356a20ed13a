"""One computed curve in space with its timing law: geometry over s, and all quantities at one moment."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.space_curve.formula import FARTHEST, formula_path
from armlab.errors import InputError
from armlab.kin.field import Field
from armlab.kin.motion import (
    ArcLength,
    ByLength,
    Frenet,
    Law,
    Path,
    PathType,
    Trajectory,
    frenet,
    law_type,
    path_types,
)
from armlab.kin.motion import standstills as standstills_of
from armlab.kin.motion.peaks import largest_length

Floats = NDArray[np.float64]
Point = tuple[float, float, float]

FORMULA = "formula"
"""Key of the curve that is typed as three functions."""

SAMPLES = 401
"""Number of samples of the curve for drawings and plots."""

LEAST = 1e-6
"""Least extent of a curve, metres; a smaller one would consist of rounding errors."""

SHORTEST, LONGEST = 0.05, 120.0
"""Least and largest duration of a motion, seconds."""


@dataclass(frozen=True)
class Typed:
    """The kind of the typed curve, which has neither points nor options."""

    title: str = "Three functions of s"
    fields: tuple[Field, ...] = ()
    least: int = 0
    most: int | None = 0


def kinds() -> Mapping[str, PathType | Typed]:
    """Return the kinds of curves by key: the paths that can be used in space, and the typed one."""
    paths = {
        key: kind
        for key, kind in path_types().items()
        if "cartesian" in kind.spaces and (not kind.dimensions or 3 in kind.dimensions)
    }
    return {**paths, FORMULA: Typed()}


class Question(NamedTuple):
    """Arguments of a curve and its motion.

    Attributes
    ----------
    curve : Chosen
        One of `kinds`.
    points : tuple of (float, float, float)
        Metres.
    formula : tuple of str
        x(s), y(s), z(s) in metres.
    by_length : bool
    law : Chosen
    duration : float
        Seconds.
    """

    curve: Chosen
    points: tuple[Point, ...]
    formula: tuple[str, str, str]
    by_length: bool
    law: Chosen
    duration: float


@dataclass(frozen=True, eq=False)
class Laid:
    """A curve and its motion.

    Attributes
    ----------
    given : Path
        As it was made.
    path : Path
        The same, or parametrised by its length: then |p'| = L.
    by_length : bool
    law : Law
    motion : Trajectory
    arc : ArcLength
    stands : ndarray, shape (k,)
        The s where p' = 0.
    s : ndarray, shape (N,)
    frame : Frenet
        At those s.
    speed, sigma : ndarray, shape (N,)
        |p'| and the distance gone there, metres.
    """

    given: Path
    path: Path
    by_length: bool
    law: Law
    motion: Trajectory
    arc: ArcLength
    stands: Floats
    s: Floats
    frame: Frenet
    speed: Floats
    sigma: Floats

    @cached_property
    def peaks(self) -> tuple[float, float]:
        """The largest speed in m/s, and acceleration in m/s² where the velocity does not jump."""
        return largest_length(self.motion, 1), largest_length(self.motion, 2)

    @property
    def largest_acceleration(self) -> float:
        """The largest acceleration in m/s²; infinite where the velocity jumps during the motion."""
        return math.inf if self.motion.continuity < 1 else self.peaks[1]


@dataclass(frozen=True, eq=False)
class Moment:
    """Quantities at one moment.

    Attributes
    ----------
    t, s, rate, change : float
        Time, s, s-dot and s-ddot.
    p, d1, d2 : ndarray, shape (3,)
        p, and p', p'' with respect to s, or to the length where that is the parameter.
    frame : Frenet
        At this s.
    sigma : float
        Distance gone, metres.
    velocity, tangential, centripetal : ndarray, shape (3,)
        p' s-dot; p' s-ddot and p'' s-dot², whose sum is the acceleration (notes 6.134-6.135).
    """

    t: float
    s: float
    rate: float
    change: float
    p: Floats
    d1: Floats
    d2: Floats
    frame: Frenet
    sigma: float
    velocity: Floats
    tangential: Floats
    centripetal: Floats


@lru_cache(maxsize=64)
def laid(question: Question) -> Laid:
    """Return the curve and its motion.

    Raises
    ------
    InputError
        Points, options, formulas or a law with which there is none; the text names what is wrong.
    """
    law = made_law(question.law, question.duration)
    given = made_curve(question)
    grid = np.linspace(0.0, 1.0, SAMPLES)
    points = given.at(grid)
    if not np.abs(points).max() <= FARTHEST:
        raise InputError(f"curve: a point of it is farther than {FARTHEST:g} m away")
    if np.ptp(points, axis=0).max() <= LEAST:
        raise InputError(f"curve: it stays at one point, within {1e6 * LEAST:g} µm")
    # Raises where it stands still.
    path = ByLength(given) if question.by_length else given
    motion = Trajectory(path, law)
    arc = path.arc if isinstance(path, ByLength) else ArcLength(given)
    stands = np.zeros(0) if question.by_length else standstills_of(given)
    s = np.unique(np.concatenate([grid, path.pieces[:100]]))
    speed = np.linalg.norm(path.at(s, 1), axis=1)
    sigma = s * arc.length if question.by_length else arc.sigma(s)
    return Laid(
        given,
        path,
        question.by_length,
        law,
        motion,
        arc,
        stands,
        s,
        frenet(path, s),
        speed,
        sigma,
    )


def made_curve(question: Question) -> Path:
    """Return the path with its own parameter."""
    if question.curve.key == FORMULA:
        return formula_path(question.formula)
    return path_types()[question.curve.key].path(question.points, **question.curve.options)


def made_law(law: Chosen, duration: float) -> Law:
    """Return the law; `InputError` if the duration is too short or too long."""
    if not SHORTEST <= duration <= LONGEST:
        raise InputError(f"T: expected {SHORTEST:g} to {LONGEST:g} s, got {duration:g}")
    return law_type(law.key).law(duration, **law.options)


def moment(found: Laid, t: float) -> Moment:
    """Return the quantities at a time in seconds."""
    s, rate, change = (float(value) for value in found.law.derivatives(t, (0, 1, 2)))
    s = min(max(s, 0.0), 1.0)
    if found.by_length:
        return _by_length(found, t, s, rate, change)
    p, d1, d2 = found.path.derivatives(s, (0, 1, 2))
    terms = d1 * rate, d1 * change, d2 * rate**2
    return Moment(t, s, rate, change, p, d1, d2, frenet(found.path, s), float(found.arc.sigma(s)), *terms)


def _by_length(found: Laid, t: float, s: float, rate: float, change: float) -> Moment:
    """Return the quantities if the parameter is the length: p' = t and p'' = kappa n."""
    length = found.arc.length
    sigma = s * length
    frame = frenet(found.given, found.arc.s(sigma))
    d1, d2 = frame.tangent, frame.curvature[..., None] * frame.normal
    terms = d1 * length * rate, d1 * length * change, d2 * (length * rate) ** 2
    return Moment(t, s, rate, change, frame.position, d1, d2, frame, sigma, *terms)
