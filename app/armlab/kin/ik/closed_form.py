"""Closed forms: the reason why one applies to an arm, and all joint values it gives for a pose."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, lru_cache

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik import closed as _folder
from armlab.kin.structure import Structure, structure_of
from armlab.plugins import discover

Vector = NDArray[np.float64]

SAMPLES = 8
"""Number of representatives of an angle that may be chosen freely: every 45 degrees."""

FREE_ANGLES = tuple((k - SAMPLES // 2 + 1) * 2.0 * np.pi / SAMPLES for k in range(SAMPLES))


@dataclass(frozen=True)
class Found:
    """The result of a closed form.

    Attributes
    ----------
    q : list of ndarray, shape (n,)
        Candidates; each is verified on the true arm by `armlab.kin.ik.solve_all`. A family is given by some
        representatives.
    families : tuple of str
        For each family of solutions a sentence why there are infinitely many; empty when all are isolated.
    none : str
        Why there is no solution, where there is none and the reason is known.
    sampled : bool
        Whether values of a free joint were tried of which none may have led on: an empty list then proves nothing.
    """

    q: list[Vector]
    families: tuple[str, ...] = ()
    none: str = ""
    sampled: bool = False


@dataclass(frozen=True)
class ClosedForm:
    """One closed form, the constant ``CLOSED`` of a module in `armlab.kin.ik.closed`.

    Parameters
    ----------
    key, title : str
    order : int
        The first that fits an arm is used.
    fits : callable
        ``fits(arm)``: the sentence why the arm has this closed form, or None.
    solve : callable
        ``solve(arm, T)`` with T (4, 4) in the axes of frame 0, its rotation exactly orthonormal.
    """

    key: str
    title: str
    order: int
    fits: Callable[[Arm], str | None]
    solve: Callable[[Arm, Vector], Found]


@cache
def closed_forms() -> dict[str, ClosedForm]:
    """Return all closed forms by key, special ones before general ones."""
    return discover(_folder, "CLOSED", ClosedForm)


@lru_cache(maxsize=64)
def closed_form_of(arm: Arm) -> tuple[ClosedForm, str] | None:
    """Return the closed form of an arm and the sentence why it applies; None when none is known here."""
    for form in closed_forms().values():
        reason = form.fits(arm)
        if reason is not None:
            return form, reason
    return None


@lru_cache(maxsize=64)
def known_structure(arm: Arm) -> Structure:
    """Return the structure of an arm (arms are compared by identity)."""
    return structure_of(arm)
