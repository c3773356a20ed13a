"""Iterative methods: each is a rule for one step; loop, limits, stopping and wording are shared.

A rule for NumPy arrays, many configurations at once, that may look at singular values, has named parameters and may
remember. The compiled methods behind a drag are another kind of rule: see `armlab.kin.ik.method`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.checks import finite_floats
from armlab.kin.ik.iterate import methods as _folder
from armlab.kin.ik.iterate.problem import SINGULAR, Point, Problem
from armlab.plugins import discover
from armlab.registry import Registry, known_name

Floats = NDArray[np.float64]
Parameters = Mapping[str, float]
Memory = tuple[Floats, ...]


@dataclass(frozen=True)
class Parameter:
    """One number of a method.

    Attributes
    ----------
    key, symbol, title : str
        The name in programs, the symbol of the notes, and the name in words.
    default, low, high : float
        Smallest and largest value allowed are included.
    unit : str
        ``"1"``; or the unit of ``"sigma"``, ``"sigma²"``, ``"1/sigma²"`` or ``"w"``: that of singular values, which are
        metres or pure numbers (see `Problem.sigma_unit`).
    """

    key: str
    symbol: str
    title: str
    default: float
    low: float
    high: float
    unit: str = "1"


class Move(NamedTuple):
    """The step that a method proposes for B configurations with k free joints.

    Attributes
    ----------
    dq : ndarray, shape (B, k)
        Scaled joint changes (see `Problem`); apply with `Problem.land`.
    damping : ndarray, shape (B,), optional
        The number added to the diagonal of J J^T.
    refused : ndarray of bool, shape (B,), optional
        Configurations without a step, because a matrix cannot be inverted.
    secondary : ndarray, shape (B,), optional
        Length of the part of the step that serves another aim than the task.
    memory : tuple of ndarray
        Arrays that the method needs at the next step, each with B rows.
    """

    dq: Floats
    damping: Floats | None = None
    refused: NDArray[np.bool_] | None = None
    secondary: Floats | None = None
    memory: Memory = ()


Step = Callable[[Problem, Point, Parameters, Memory], Move]
"""``step(problem, point, parameters, memory) -> Move``; memory is ``()`` at the first step."""


@dataclass(frozen=True)
class IterationMethod:
    """One method, the constant ``ITERATION`` of a module in `armlab.kin.ik.iterate.methods`.

    Parameters
    ----------
    key, title : str
        Short name for programs, name of the field for people.
    order : int
        Place in lists.
    step : callable
        See `Step`.
    parameters : tuple of Parameter
    tall : bool
        Whether it can be used with more task components than free joints.
    chord : bool
        Whether its cost measures angles by their chord.
    objective : callable, optional
        ``objective(problem, q (B, n)) -> (B,)``: what a secondary part of the step makes larger. The iteration then
        goes on until that part is small, too.
    warn : callable, optional
        ``warn(problem, parameters, sigma_max of the last iterates) -> str``: why it diverged, or "".
    """

    key: str
    title: str
    order: int
    step: Step
    parameters: tuple[Parameter, ...] = ()
    tall: bool = True
    chord: bool = False
    objective: Callable[[Problem, Floats], Floats] | None = None
    warn: Callable[[Problem, Parameters, Floats], str] | None = None

    def values(self, given: Mapping[str, float] | None = None) -> dict[str, float]:
        """Return all parameters by key, those not given at their defaults.

        Raises
        ------
        InputError
            An unknown parameter, or one that is no number or out of its range.
        """
        values = {parameter.key: parameter.default for parameter in self.parameters}
        ranges = {parameter.key: parameter for parameter in self.parameters}
        for key, value in (given or {}).items():
            known_name(f"parameters of {self.key}", key, ranges)
            number = float(finite_floats(value, f"parameters[{key!r}]", (), "a finite number"))
            low, high = ranges[key].low, ranges[key].high
            if not low <= number <= high:
                raise InputError(f"parameters[{key!r}]: expected {low:g} to {high:g}, got {number:g}")
            values[key] = number
        return values


@cache
def iteration_methods() -> Registry[IterationMethod]:
    """Return all iterative methods by key, in the order of lists."""
    return discover(_folder, "ITERATION", IterationMethod, "method")


def iteration_method(key: str) -> IterationMethod:
    """Return an iterative method by key; `UnknownName` when there is none."""
    return iteration_methods()[key]


def damped_step(point: Point, damping: Floats) -> Floats:
    """Return J^T (J J^T + damping I)^-1 e, (B, k), from the singular values.

    The sum of sigma / (sigma^2 + damping) v u^T e; the same as (J^T J + damping I)^-1 J^T e. Without damping directions
    whose sigma is zero but for rounding get nothing. Notes 5.112-5.115; the second identity matrix of 5.113 should be
    m x m.
    """
    square = point.sigma**2 + damping[:, None]
    nothing = (SINGULAR * point.sigma_max[:, None]) ** 2
    return _spread(point, point.sigma / np.where(square > nothing, square, math.inf))


def inverse_step(point: Point, cutoff: float = 0.0) -> Floats:
    """Return J# e, (B, k); singular values up to ``cutoff`` times the largest are taken as zero."""
    kept = point.sigma > cutoff * point.sigma_max[:, None]
    return _spread(point, np.where(kept, 1.0 / np.where(kept, point.sigma, 1.0), 0.0))


def _spread(point: Point, factors: Floats) -> Floats:
    along = np.einsum("bmr,bm->br", point.U, point.e)
    return np.asarray(np.einsum("brk,br->bk", point.Vt, factors * along))
