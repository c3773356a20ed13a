"""All solutions of an inverse kinematics problem, and what is known about their number."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import product
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.rest import AT

Completeness = Literal["none", "complete", "at least", "infinite"]

MOST_EQUIVALENTS = 4096
"""Largest number of whole-turn copies that are listed."""

HALF_TURN = 1e-13
"""Distance from minus half a turn, in whole turns, within which an angle becomes plus half a turn."""


@dataclass(frozen=True, eq=False)
class IkSolutions:
    """The solutions found by `armlab.kin.ik.solve_all.solve_all`, and how complete they are.

    A sequence of configurations: ``len(found)``, ``for q in found`` and ``found[k]`` go by the rows of ``q``, and what
    selects rows of an array selects them here, such as ``found[found.within_limits]``.

    Attributes
    ----------
    arm : Arm
    q : ndarray, shape (k, n)
        Rad and m. Each angle is inside its limits by whole turns where it can be and then nearest to zero, else nearest
        to the limits; sorted by joint 1, then joint 2, and so on. Infinitely many are given by some representatives.
    names : tuple of str
        The branch of each, such as ``"shoulder left, elbow up, wrist flip"``; numbers where an arm has no such words.
    within_limits : ndarray of bool, shape (k,)
    beyond : ndarray, shape (k, n)
        Distance of each joint below (negative) or above (positive) its limits in rad or m; 0 inside.
    completeness : str
        ``"none"``: there is no solution; ``"complete"``: these are all; ``"at least"``: these were found by a search,
        there may be more (or, with k = 0, some); ``"infinite"``: a family, of which these are representatives.
    sentence : str
        The same in words, with the reason.
    method : str
        Key of the closed form, ``"general_6r"``, ``"self_motion"``, ``"many_starts"`` or ``"held"``.
    why : str
        Why that one was used.
    families : tuple of ndarray, shape (s, n)
        Points along curves of solutions, in order, where they were traced.
    """

    arm: Arm = field(repr=False)
    q: NDArray[np.float64]
    names: tuple[str, ...]
    within_limits: NDArray[np.bool_]
    beyond: NDArray[np.float64]
    completeness: Completeness
    sentence: str
    method: str
    why: str
    families: tuple[NDArray[np.float64], ...] = ()

    def __len__(self) -> int:
        return len(self.q)

    def __iter__(self) -> Iterator[NDArray[np.float64]]:
        return iter(self.q)

    def __getitem__(self, rows: int | slice | NDArray[np.bool_] | NDArray[np.intp]) -> NDArray[np.float64]:
        return np.asarray(self.q[rows])

    @property
    def how_far_out(self) -> tuple[str, ...]:
        """Sentences on the joints beyond their limits and by how much, one for each solution, empty when inside."""
        return tuple(_out(self.arm, row) for row in self.beyond)

    def equivalents(self, k: int) -> NDArray[np.float64]:
        """Return solution k and its copies by whole turns that are inside the limits, shape (j, n).

        Sorted like ``q``; empty where a joint is outside its limits at every turn.
        """
        choices = []
        for i, row in enumerate(self.arm.rows):
            value, (low, high) = float(self.q[k, i]), self.arm.limits[i]
            if not row.revolute:
                choices.append([value] if low - AT <= value <= high + AT else [])
                continue
            first, last = math.ceil((low - AT - value) / math.tau), math.floor((high + AT - value) / math.tau)
            choices.append([value + turns * math.tau for turns in range(first, last + 1)])
        count = math.prod(map(len, choices))
        if count == 0:
            return np.empty((0, self.arm.n))
        return np.array([row for row, _ in zip(product(*choices), range(MOST_EQUIVALENTS), strict=False)])


def beyond_limits(arm: Arm, q: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return by how much joint values (k, n) are outside the limits, rad or m, negative below; 0 within `AT`."""
    low, high = arm.limits.T
    out = np.where(q < low - AT, q - low, np.where(q > high + AT, q - high, 0.0))
    return np.asarray(out, dtype=np.float64)


def wrapped_rows(arm: Arm, q: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return joint values (k, n) with each angle, whole turns added, inside its limits and then as near to zero as can
    be; where no whole turn leads inside, as near to them as can be.

    Half a turn is on the positive side, however it was rounded, where the limits leave the choice.
    """
    low, high = arm.limits.T
    turns = np.floor(0.5 + HALF_TURN - q / math.tau)
    first, last = np.ceil((low - AT - q) / math.tau), np.floor((high + AT - q) / math.tau)
    # Outside at every turn, first = last + 1: above the limits or below them.
    above = q + math.tau * first - high <= low - q - math.tau * last + AT
    wanted = np.where(first <= last, np.clip(turns, first, last), np.where(above, first, last))
    return np.where(arm.revolute, q + math.tau * wanted, q)


def sorted_rows(q: NDArray[np.float64]) -> NDArray[np.intp]:
    """Return the order (k,) of rows (k, n) by joint 1, then 2 and so on; values within rounding count as equal."""
    keys = np.round(q, 6) + 0.0
    return np.asarray(np.lexsort(keys.T[::-1]), dtype=np.intp)


def _out(arm: Arm, row: NDArray[np.float64]) -> str:
    return ", ".join(
        f"joint {i + 1} by {_amount(abs(float(value)), arm.rows[i].revolute)} {'above' if value > 0 else 'below'}"
        for i, value in enumerate(row)
        if value != 0.0
    )


def _amount(value: float, revolute: bool) -> str:
    if revolute:
        degrees = math.degrees(value)
        return f"{degrees:.1f}°" if degrees >= 0.05 else "less than 0.1°"
    return f"{value * 1000.0:.0f} mm" if value >= 0.0005 else "less than 1 mm"
