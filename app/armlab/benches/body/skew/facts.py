"""Facts of a matrix, its parts and its dyads that lessons can check."""

from __future__ import annotations

import numpy as np

from armlab.benches.body.skew.state import SHOWN, Skew
from armlab.kin.matrix_parts import dyads, quadratic_form, skew_part, skew_vector, symmetric_part
from armlab.kin.rotations import skew
from armlab.session.facts import Fact, Facts
from armlab.session.state import State

ORTHONORMAL = 1e-6
"""Largest difference of an entry of A^T A from I of columns that are taken for perpendicular and of unit length."""


def matrix_of(state: State) -> np.ndarray:
    """Return A, (3, 3)."""
    return np.array(state[Skew].A)


def cross_of(state: State) -> np.ndarray:
    """Return S(v) u, (3,)."""
    part = state[Skew]
    return np.asarray(skew(part.v) @ np.array(part.u))


def sum_of(state: State) -> np.ndarray:
    """Return the sum of the dyads of each column with itself, (3, 3)."""
    return np.asarray(np.trace(dyads(state[Skew].A), axis1=0, axis2=1))


def dyad_of(state: State) -> np.ndarray:
    """Return the dyad that is looked at, (3, 3)."""
    part = state[Skew]
    return np.asarray(dyads(part.A)[part.first - 1, part.second - 1])


def orthonormal(state: State) -> bool:
    """Return whether the columns are perpendicular and of unit length."""
    A = matrix_of(state)
    return bool(np.abs(A.T @ A - np.eye(3)).max() < ORTHONORMAL)


def swapped(state: State) -> float:
    """Return the largest difference of an entry of A^T A from the sum of the dyads, which is A A^T."""
    A = matrix_of(state)
    return float(np.abs(A.T @ A - sum_of(state)).max())


FACTS = Facts(
    __name__,
    (Skew,),
    {
        "shown": Fact("what is shown of the matrix", lambda s: s[Skew].shown, kind="text", names=SHOWN),
        "matrix": Fact("A, row by row", lambda s: matrix_of(s).ravel(), kind="numbers"),
        "symmetric": Fact("the symmetric part, row by row", lambda s: symmetric_part(s[Skew].A).ravel(), "", "numbers"),
        "skew": Fact("the skew part, row by row", lambda s: skew_part(s[Skew].A).ravel(), kind="numbers"),
        "vector": Fact("the vector of the skew part", lambda s: skew_vector(s[Skew].A), kind="numbers"),
        "form": Fact("the number xᵀA x", lambda s: quadratic_form(s[Skew].A, s[Skew].x)),
        "form_of_skew": Fact("xᵀA x of the skew part", lambda s: quadratic_form(skew_part(s[Skew].A), s[Skew].x)),
        "form_of_symmetric": Fact(
            "xᵀA x of the symmetric part", lambda s: quadratic_form(symmetric_part(s[Skew].A), s[Skew].x)
        ),
        "skew_size": Fact("the largest entry of the skew part", lambda s: np.abs(skew_part(s[Skew].A)).max()),
        "cross": Fact("S(v) u", cross_of, kind="numbers"),
        "dyad": Fact("the dyad that is looked at, row by row", lambda s: dyad_of(s).ravel(), kind="numbers"),
        "sum": Fact("the sum of the dyads of each column with itself", lambda s: sum_of(s).ravel(), kind="numbers"),
        "swapped": Fact("the largest difference of an entry of AᵀA from the sum of the dyads", swapped),
        "orthonormal": Fact("whether the columns are perpendicular and of length 1", orthonormal, kind="truth"),
        "dyad_mixed": Fact("whether its columns are two", lambda s: s[Skew].first != s[Skew].second, kind="truth"),
        "first": Fact("the first column of the dyad that is looked at", lambda s: s[Skew].first, kind="count"),
        "second": Fact("the second column of the dyad that is looked at", lambda s: s[Skew].second, kind="count"),
    },
)
