"""Measures of how well an arm can move in a configuration, one number each, for colouring a workspace.

All are of the task Jacobian. Where it mixes metres and radians its singular values depend on the units, so they are
those of the scaled task (`armlab.kin.control.scaled_task`): lengths are divided by the arm's length scale.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.control.scaled_task import ScaledTask
from armlab.kin.length_power import POWERS, length_power
from armlab.registry import Registry

Array = NDArray[np.floating]

QUICK, SLOW = 65_536, 4_096
"""Configurations measured in one piece, some 15 ms: by formulas, and by singular values."""

SQUARED = 1e-7
"""Singular value, relative to sigma_max, below which it counts as 0: it is the root of an eigenvalue of J J^T."""


@dataclass(frozen=True)
class Measure:
    """A number that says how well an arm can move.

    Parameters
    ----------
    key : str
    title : str
        Name in lower case, as on screen.
    symbol : str
        The symbol in LaTeX.
    unit : callable
        ``unit(arm) -> str``, such as ``"m³"``; empty without one.
    logarithmic : bool
        Whether its interesting differences are near zero, so that colours had better follow the logarithm.
    values : callable
        ``values(arm, q) -> (k,)`` of configurations (k, n); single precision in, single precision out.
    piece : int
        Configurations that are measured in some 15 ms.
    """

    key: str
    title: str
    symbol: str
    unit: Callable[[Arm], str]
    logarithmic: bool
    values: Callable[[Arm, Array], Array]
    piece: int


def manipulability(arm: Arm, q: Array) -> Array:
    """Return w of configurations (k, n), shape (k,); notes 5.144. In single precision w² is accurate to about 1e-6."""
    return arm.manipulability(q)


def inverse_condition(arm: Arm, q: Array) -> Array:
    """Return sigma_min / sigma_max of the scaled task Jacobian, shape (k,), from 0 (singular) to 1 (isotropic)."""
    extremes = sigma_extremes(arm, q)
    largest = extremes[:, 1]
    ratio = np.divide(extremes[:, 0], largest, out=np.zeros(len(q)), where=~(largest <= 0.0))
    return np.asarray(ratio, dtype=q.dtype)


def sigma_min(arm: Arm, q: Array) -> Array:
    """Return the smallest of the min(m, n) singular values of the scaled task Jacobian, shape (k,)."""
    return np.asarray(sigma_extremes(arm, q)[:, 0], dtype=q.dtype)


def sigma_extremes(arm: Arm, q: Array) -> NDArray[np.float64]:
    """Return the smallest and the largest singular value of the scaled task Jacobian of configurations (k, n).

    Parameters
    ----------
    arm : Arm
    q : ndarray, shape (k, n)

    Returns
    -------
    ndarray, shape (k, 2)
        Below `SQUARED` times the largest they are 0; nan for a configuration that is not finite. Notes 5.126, 5.127.
    """
    task, precise = _task_of(arm), np.asarray(q, dtype=np.float64)
    J = task.jacobians(precise, np.asarray(arm.fk(precise), dtype=np.float64))
    finite = np.isfinite(precise).all(axis=1)
    J[~finite] = 0.0
    turned = np.swapaxes(J, 1, 2)
    squares = np.linalg.eigvalsh(J @ turned if task.m <= task.n else turned @ J)[:, [0, -1]]
    squares[squares < SQUARED**2 * squares[:, 1:]] = 0.0
    squares[~finite] = np.nan
    return np.asarray(np.sqrt(squares))


def unit_of_manipulability(arm: Arm) -> str:
    """Return the unit of w of the task: a power of metres, or ``"mixed units"`` when its terms have different ones."""
    power = length_power(arm)
    return "mixed units" if power is None else POWERS[power]


def unit_of_sigma(arm: Arm) -> str:
    """Return the unit of singular values of the scaled task Jacobian: metres, or none."""
    return _task_of(arm).sigma_unit


@lru_cache(maxsize=16)
def _task_of(arm: Arm) -> ScaledTask:
    return ScaledTask(arm)


def _no_unit(arm: Arm) -> str:
    return ""


MEASURES: Registry[Measure] = Registry(
    "measure",
    (
        Measure("manipulability", "manipulability", "w", unit_of_manipulability, False, manipulability, QUICK),
        Measure(
            "inverse_condition",
            "inverse condition",
            r"\sigma_{\min}/\sigma_{\max}",
            _no_unit,
            False,
            inverse_condition,
            SLOW,
        ),
        Measure("sigma_min", "smallest singular value", r"\sigma_{\min}", unit_of_sigma, True, sigma_min, SLOW),
    ),
)


def measure_named(key: str) -> Measure:
    """Return a measure by its key.

    Raises
    ------
    UnknownName
    """
    return MEASURES[key]
