"""A trial: the printed and the correct form of an erratum at seeded points, both compared with an independent judge."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Inputs = tuple[Any, ...]

POINTS = 20
"""Number of points of a run."""

SEEN = 1e3
"""Factor by which a residual exceeds the tolerance of its trial where an error counts as seen."""


class Forms(NamedTuple):
    """The values of one point.

    Attributes
    ----------
    printed, correct : array_like or None
        Values of both forms; None of one that does not exist, such as a product of matrices whose sizes do not fit.
    judge : array_like
        The value by another way: SciPy, finite differences, the core of the lab.
    """

    printed: ArrayLike | None
    correct: ArrayLike | None
    judge: ArrayLike


class Quiet(NamedTuple):
    """Inputs at which the printed form is right as well.

    Attributes
    ----------
    draw : callable
        As of `Trial`.
    says : str
        What they have in common, to be continued with a full stop: ``"with intervals of equal length"``.
    """

    draw: Callable[[np.random.Generator], Inputs]
    says: str


@dataclass(frozen=True)
class Trial:
    """The trial of one erratum.

    Attributes
    ----------
    key : str
        Id of the erratum.
    drawn : str
        What is drawn, in words.
    draw : callable
        ``draw(rng) -> inputs``, well-conditioned and typical.
    forms : callable
        ``forms(*inputs) -> Forms``.
    measure : str
        What is compared, in words.
    judged_by : str
        The independent way, in words.
    tolerance : float
        Largest residual of the correct form, in ``unit``.
    unit : str
        SI; empty for none.
    norm : "max", "length" or "angle"
        The residual: largest difference of a component, length of the difference, or difference modulo a turn.
    somewhere : str
        Where the printed form is wrong, if not at all points: ``"where q3 is negative"``.
    quiet : Quiet or None
        Inputs at which the error is not seen.
    """

    key: str
    drawn: str
    draw: Callable[[np.random.Generator], Inputs]
    forms: Callable[..., Forms]
    measure: str
    judged_by: str
    tolerance: float = 1e-9
    unit: str = ""
    norm: Literal["max", "length", "angle"] = "max"
    somewhere: str = ""
    quiet: Quiet | None = None

    def residuals(self, *inputs: Any) -> tuple[float, float]:
        """Return the residuals of the printed and of the correct form at some inputs; infinite if there is no value."""
        forms = self.forms(*inputs)
        return self._residual(forms.printed, forms.judge), self._residual(forms.correct, forms.judge)

    def _residual(self, value: ArrayLike | None, judge: ArrayLike) -> float:
        if value is None or np.shape(value) != np.shape(judge):
            return math.inf
        away = np.asarray(value, dtype=np.float64) - np.asarray(judge, dtype=np.float64)
        if self.norm == "angle":
            # Exactly half a turn stays half a turn, whatever its sign.
            away = np.abs(away) % (2.0 * np.pi)
            away = np.minimum(away, 2.0 * np.pi - away)
        found = float(np.linalg.norm(away) if self.norm == "length" else np.abs(away).max())
        return math.inf if math.isnan(found) else found


@dataclass(frozen=True, eq=False)
class Run:
    """The residuals of a run.

    Attributes
    ----------
    printed, correct : ndarray, shape (n,)
        Infinite where a form does not exist.
    tolerance : float
    """

    printed: Floats
    correct: Floats
    tolerance: float

    @property
    def worst_printed(self) -> float:
        """The largest residual of the printed form."""
        return float(self.printed.max())

    @property
    def worst_correct(self) -> float:
        """The largest residual of the correct form."""
        return float(self.correct.max())

    @property
    def seen(self) -> int:
        """The number of points at which the printed form is wrong by far more than rounding."""
        return int((self.printed > SEEN * self.tolerance).sum())


def run(trial: Trial, seed: int, *, quiet: bool = False, points: int = POINTS) -> Run:
    """Run both forms of a trial at seeded points.

    Parameters
    ----------
    trial : Trial
    seed : int
        The same seed gives the same points.
    quiet : bool
        At inputs where the error is not seen; the trial must have some.
    points : int

    Raises
    ------
    ValueError
        The trial has no such inputs.
    """
    found = np.array(list(in_pieces(trial, seed, quiet=quiet, points=points)))
    return Run(found[:, 0], found[:, 1], trial.tolerance)


def in_pieces(trial: Trial, seed: int, *, quiet: bool = False, points: int = POINTS) -> Iterator[tuple[float, float]]:
    """Yield the residuals of the printed and the correct form point by point; see `run`."""
    if quiet and trial.quiet is None:
        raise ValueError(f"{trial.key}: there are no inputs at which the printed form is right")
    draw = trial.quiet.draw if quiet and trial.quiet else trial.draw
    rng = np.random.default_rng(seed)
    for _ in range(points):
        # Not around the yield: others work in between.
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            residuals = trial.residuals(*draw(rng))
        yield residuals
