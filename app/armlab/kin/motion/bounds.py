"""Bounds on a timing law on a path, from the limits of the joints (section 6.1.1 of the notes)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.motion.extremes import extremes
from armlab.kin.motion.limits import Limits, limits_of
from armlab.kin.motion.path import Path

Floats = NDArray[np.float64]

BALANCED = math.sqrt(0.5)
"""Fraction of the largest speed that leaves any acceleration: half of each joint's limit is then used by the curvature
of the path and half for speeding up."""


@dataclass(frozen=True, eq=False)
class LawBounds:
    """Bounds of |s'| and |s''| that keep every joint within its limits.

    Attributes
    ----------
    M_v, M_a : ndarray, shape (m,)
        Largest |dq_i/ds| and |d²q_i/ds²| on [0, 1], end points included.
    M_v_at, M_a_at : ndarray, shape (m,)
        Parameters s of these maxima.
    limits : Limits
        Limits of the joints, one number for each.
    V : float
        Largest |s'|: the smallest v_i / M_v,i, or what the caller chose below it.
    V_joint : int
        The joint (1-based) that sets it; 0 when none does.
    A : float
        Largest |s''| at that V; not positive when V is too large for the bends of the path.
    A_joint : int
        The joint (1-based) that sets it; 0 when none does.
    V_bend : float
        The V above which no |s''| is left at all.
    explanation : str
        Explanation in words.
    """

    M_v: Floats
    M_a: Floats
    M_v_at: Floats
    M_a_at: Floats
    limits: Limits
    V: float
    V_joint: int
    A: float
    A_joint: int
    V_bend: float
    explanation: str

    @property
    def possible(self) -> bool:
        """Whether a law can use V and A, which requires that A is positive."""
        return self.A > 0.0

    @property
    def jerk(self) -> float:
        """A bound of the third derivative of s with M_v alone: it shapes a law but does not ensure the limit."""
        moving = self.M_v > 0.0
        return float((self.limits.jerk[moving] / self.M_v[moving]).min())

    @property
    def usable(self) -> LawBounds:
        """The bounds as a law can use them, with V lowered if necessary."""
        return self if self.possible else self.lowered()

    def lowered(self) -> LawBounds:
        """Return the bounds with V lowered to sqrt(1/2) of V_bend, if that is less, so that some A is left."""
        return _bounds(self, min(self.V, BALANCED * self.V_bend))


def law_bounds(path: Path, limits: Limits | Arm, speed: float | None = None) -> LawBounds:
    """Return how fast a timing law may be on a path.

    Parameters
    ----------
    path : Path
        A path in joint space.
    limits : Limits or Arm
        Limits of the joints; an arm stands for its own limits.
    speed : float, optional
        A V to work with that is smaller than the largest.

    Raises
    ------
    InputError
        Limits of another number of joints, or a speed above the largest.

    Notes
    -----
    |qdot_i| = |dq_i/ds| |s'|, so V = min v_i / M_v,i. |qddot_i| <= M_v,i |s''| + M_a,i V², which holds when
    |s''| <= (a_i - V² M_a,i) / M_v,i. That bound is safe and not sharp: both maxima need not be at the same s.

    References
    ----------
    Notes 6.20-6.44. Two corrections: the maxima may be at the ends of [0, 1], where the next derivative is not zero (in
    the example 6.34 both are); and the bound 6.33 may be zero or negative, which means that V must be lowered first.
    """
    held = limits_of(limits, path.m)
    degree = path.degree
    first = extremes(lambda s: path.at(s, 1), path.edges, degree and max(degree - 1, 0))
    second = extremes(lambda s: path.at(s, 2), path.edges, degree and max(degree - 2, 0))
    if not first.peak.any():
        raise InputError("path: it does not move, so no law is bounded by it")
    raw = LawBounds(first.peak, second.peak, first.peak_at, second.peak_at, held, 0.0, 0, 0.0, 0, 0.0, "")
    largest, _ = _smallest(held.velocity, first.peak)
    if speed is None:
        return _bounds(raw, largest)
    if not 0.0 < speed <= largest * (1.0 + 1e-12):
        raise InputError(f"speed: expected more than 0 and at most V = {largest:.6g}, got {speed:g}")
    return _bounds(raw, float(speed))


def _bounds(raw: LawBounds, V: float) -> LawBounds:
    v_max, a_max = raw.limits.velocity, raw.limits.acceleration
    largest, V_joint = _smallest(v_max, raw.M_v)
    with np.errstate(divide="ignore", invalid="ignore"):
        V_bend = float(np.sqrt(np.where(raw.M_a > 0.0, a_max / raw.M_a, np.inf)).min())
    used = np.where(raw.M_a > 0.0, V * V * np.where(raw.M_a > 0.0, raw.M_a, 1.0), 0.0)
    bounded = np.isfinite(a_max)
    A, A_joint = _smallest(np.where(bounded, np.where(bounded, a_max, 0.0) - used, np.inf), raw.M_v)
    return replace(
        raw,
        V=V,
        V_joint=0 if largest > V else V_joint,
        A=A,
        A_joint=A_joint,
        V_bend=V_bend,
        explanation=_explained(V, A, A_joint, V_bend),
    )


def _smallest(values: Floats, by: Floats) -> tuple[float, int]:
    """Return the smallest quotient and the 1-based joint that has it; 0 when all are infinite."""
    quotients = np.where(by > 0.0, values / np.where(by > 0.0, by, 1.0), np.inf)
    j = int(np.argmin(quotients))
    return float(quotients[j]), 0 if np.isposinf(quotients[j]) else j + 1


def _explained(V: float, A: float, joint: int, V_bend: float) -> str:
    if A > 0.0:
        return f"With |ṡ| ≤ {V:.4g} 1/s and |s̈| ≤ {A:.4g} 1/s² no joint exceeds its limits."
    if math.isinf(V):
        return (
            f"Without a limit of |ṡ| no |s̈| is safe: the bends of the path take the acceleration. Keep |ṡ| below "
            f"{V_bend:.4g} 1/s first; then some |s̈| is left."
        )
    return (
        f"At |ṡ| = {V:.4g} 1/s joint {joint} needs all of its acceleration, or more, only to follow the bends of the "
        "path: "
        f"the bound on |s̈| is {_signed(A)} 1/s². Lower |ṡ| below {V_bend:.4g} 1/s first; then some |s̈| is left."
    )


def _signed(value: float) -> str:
    return f"{value:.4g}".replace("-", "−")
