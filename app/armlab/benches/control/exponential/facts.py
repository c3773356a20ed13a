"""Facts of the matrix exponential that lessons can check: its entries, and the error of a sum."""

from __future__ import annotations

import numpy as np

from armlab.benches.control.exponential.state import Exponential
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _eigenvalues(state: State) -> np.ndarray | None:
    """Return the real eigenvalues of A, the larger one first, or None if they are not real."""
    basis = state[Exponential].found.basis
    return np.sort(basis.values.real)[::-1] if basis.real else None


def _error(state: State) -> float:
    part = state[Exponential]
    return float(part.found.errors[part.terms - 1])


FACTS = Facts(
    __name__,
    (Exponential,),
    {
        "matrix": Fact("the entries of exp(A t), row by row", lambda s: s[Exponential].found.whole, kind="numbers"),
        "state": Fact("x(t)", lambda s: s[Exponential].found.whole @ np.array(s[Exponential].x0), kind="numbers"),
        "error": Fact("the largest error of the sum of the series", _error),
        "terms": Fact("the number of terms that are summed", lambda s: s[Exponential].terms, kind="count"),
        "t": Fact("the time t", lambda s: s[Exponential].t, "s"),
        "eigenvalues": Fact("the real eigenvalues of A", _eigenvalues, "1/s", "numbers"),
        "printed_error": Fact(
            "the largest difference of T⁻¹ exp(Λ t) T from exp(A t)", lambda s: s[Exponential].found.printed
        ),
    },
)
