"""Both sides of an identity over one of its variables, the others fixed where the sides differ most."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.help.identities.state import comparison_of, formulas_of, kinds_of
from armlab.content.identity import LARGEST, values_of
from armlab.session.state import State

Complexes = NDArray[np.complex128]

POINTS = 401

RANGES = {"real": (-6.0, 6.0), "positive": (0.0, 6.0), "angle": (-np.pi, np.pi)}
"""Ranges of the kinds of variables over which the sides can be drawn."""

STEEP = 20.0
"""Largest value that is drawn, so that poles leave room for the rest."""


@dataclass(frozen=True, eq=False)
class Sweep:
    """Both sides over one variable.

    Attributes
    ----------
    name : str
        The variable.
    x : ndarray, shape (N,)
    left, right : ndarray, shape (N,)
        Complex; not a number where a side has no value, or is too large to be drawn.
    at : float
        Value of the variable where the sides differ most.
    complex : bool
        Whether one of them has an imaginary part.
    """

    name: str
    x: NDArray[np.float64]
    left: Complexes
    right: Complexes
    at: float
    complex: bool


def sweep_of(state: State) -> Sweep | None:
    """Return both sides over the first variable that runs along a line; None if there is none."""
    found, kinds = comparison_of(state), kinds_of(state)
    name = next((name for name, kind in kinds.items() if kind in RANGES), None)
    if name is None or len(found.left) == 0:
        return None
    k = found.names.index(name)
    x = np.linspace(*RANGES[kinds[name]], POINTS)
    place = found.points[found.worst]
    given = {each: np.full(POINTS, value) for each, value in zip(found.names, place, strict=True)}
    given[name] = x + 0j
    left, right = (_drawn(*values_of(side, given)) for side in formulas_of(state))
    most = max((float(np.nanmax(np.abs(side.imag), initial=0.0)) for side in (left, right)), default=0.0)
    return Sweep(name, x, left, right, float(place[k].real), most > 1e-9)


def _drawn(values: Complexes, well: NDArray[np.bool_]) -> Complexes:
    low = well & (np.abs(values) <= min(STEEP, LARGEST))
    return np.where(low, values, np.nan + 1j * np.nan)
