"""Polynomials with any number of conditions at both ends, and their doubly normalised form."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats, whole_number, wrong
from armlab.kin.field import Field
from armlab.kin.motion.path import PolynomialPath
from armlab.kin.motion.path_types import PathType
from armlab.kin.paths._boundary import MOST_DEGREE, boundary_polynomial, in_seconds
from armlab.kin.paths._exact import ExactPolynomial, boundary_fractions
from armlab.kin.paths.cubic import DURATION

Floats = NDArray[np.float64]


def rest_coefficients(degree: int) -> tuple[int, ...]:
    """Return the doubly normalised polynomial between two rests, exactly, highest power first.

    With degree 2k + 1 its derivatives 1 to k vanish at 0 and 1, as it goes from 0 to 1. Its derivative is a multiple of
    tau^k (1 - tau)^k.

    Parameters
    ----------
    degree : int
        Odd.

    Raises
    ------
    InputError
        Not a positive odd number.

    References
    ----------
    Notes 6.55, 6.74 (15 tau^4, not 5) and the rule after it.

    Examples
    --------
    >>> rest_coefficients(5)
    (6, -15, 10, 0, 0, 0)
    """
    if whole_number(degree, "degree", 1) % 2 == 0:
        raise wrong("degree", "an odd number: as many conditions at one end as at the other", degree)
    k = degree // 2
    low = [0] * (k + 1)
    for i in range(k + 1):
        low.append((-1) ** i * math.comb(k + i, i) * math.comb(degree, k - i))
    return tuple(reversed(low))


@dataclass(frozen=True)
class Rules:
    """The check of the notes' rules for the coefficients under symmetric conditions.

    Attributes
    ----------
    integers, alternating, sum_one, low_zero : bool
        All whole numbers; signs alternate among those that are not zero; they sum up to 1; those of degree up to
        (degree - 1) / 2 are zero.
    """

    integers: bool
    alternating: bool
    sum_one: bool
    low_zero: bool

    @property
    def kept(self) -> bool:
        """Whether all four rules hold."""
        return self.integers and self.alternating and self.sum_one and self.low_zero


def check_rules(coefficients: ArrayLike, tolerance: float = 1e-9) -> Rules:
    """Check the rules after 6.74 on coefficients, highest power first.

    Examples
    --------
    >>> check_rules([6, -15, 10, 0, 0, 0]).kept
    True
    >>> check_rules([6, -5, 10, 0, 0, 0])  # as 6.74 is printed
    Rules(integers=True, alternating=True, sum_one=False, low_zero=True)
    """
    values = as_floats(coefficients, "coefficients", "a list of numbers")
    if values.ndim != 1 or len(values) == 0 or not np.isfinite(values).all():
        raise wrong("coefficients", "a list of numbers", coefficients)
    degree = len(values) - 1
    signs = np.sign(values[np.abs(values) > tolerance])
    return Rules(
        integers=bool(np.all(np.abs(values - np.round(values)) <= tolerance)),
        alternating=bool(np.all(signs[1:] == -signs[:-1])),
        sum_one=bool(abs(values.sum() - 1.0) <= tolerance),
        low_zero=bool(np.all(np.abs(values[::-1][: (degree - 1) // 2 + 1]) <= tolerance)),
    )


def doubly_normalised(
    q_start: float, q_end: float, start: Sequence[float] = (), end: Sequence[float] = (), duration: float = 1.0
) -> Floats:
    """Return a, b, c, ..., highest power first, with q(tau) = q_i + Delta q (a tau^d + b tau^(d-1) + ...).

    Parameters
    ----------
    q_start, q_end : float
        Start and end of one joint.
    start, end : sequence of float
        Velocity, acceleration, ... at the ends, in units per second, per second squared, ...
    duration : float
        T, with tau = t / T.

    Raises
    ------
    InputError
        Delta q is zero: this form does not exist then, the polynomial itself does.

    References
    ----------
    Notes 6.164-6.182; for one joint at a time, as Delta q differs.

    Examples
    --------
    >>> doubly_normalised(1.0, 4.0, [0.7], [-0.4], 2.0).round(4).tolist()
    [-1.8, 2.3333, 0.4667, 0.0]
    """
    change = q_end - q_start
    if change == 0.0:
        raise InputError("q_end: the same as q_start; the doubly normalised form divides by their difference")
    values = [[np.array([value]) for value in row] for row in ([0.0, *start], [change, *end])]
    ends = (in_seconds(row, duration) for row in values)
    return np.asarray(boundary_polynomial(*ends)[::-1, 0] / change)


ANY_DEGREE = (("degree", (None,)),)
"""Condition for options at the ends: they are used only while no degree is given."""


def make(knots: Floats, options: dict[str, Any]) -> PolynomialPath:
    """Return the polynomial of least degree with the given derivatives at both ends.

    References
    ----------
    Notes 6.65-6.74 and section 6.3.5.
    """
    m, duration, degree = knots.shape[1], options["duration"], options["degree"]
    if degree is not None:
        if options["start"] is not None or options["end"] is not None:
            raise InputError(
                "degree: either the degree of a motion between rests, or derivatives at the ends; not both"
            )
        if degree % 2 == 0 or degree > MOST_DEGREE:
            raise wrong("degree", f"an odd number up to {MOST_DEGREE}", degree)
        rising = rest_coefficients(degree)[::-1]
        ends = [[Fraction(value) for value in pair] for pair in knots.T.tolist()]
        rows = [[q_i, *(a * (q_f - q_i) for a in rising[1:])] for q_i, q_f in ends]
    else:
        given = [_rows(options[key], key, m) for key in ("start", "end")]
        if 1 + len(given[0]) + len(given[1]) > MOST_DEGREE:
            raise InputError(
                f"start and end: at most {MOST_DEGREE - 1} conditions, got {len(given[0]) + len(given[1])}"
            )
        T = Fraction(duration)
        start, end = ([knot, *each] for knot, each in zip(knots, given, strict=True))
        rows = [
            boundary_fractions(*([Fraction(values[j]) * T**k for k, values in enumerate(row)] for row in (start, end)))
            for j in range(m)
        ]
    return ExactPolynomial(rows, duration)


def _rows(value: Floats | None, where: str, m: int) -> list[Floats]:
    if value is None:
        return []
    if value.shape[1] != m:
        raise wrong(where, f"rows of {m} numbers, one for each coordinate", value.tolist())
    return list(value)


PATH = PathType(
    "polynomial",
    "Polynomial with any end conditions",
    8,
    make,
    least=2,
    most=2,
    fields=(
        Field("degree", "", "odd degree of a motion between rests; or left out", "whole", low=1.0),
        Field("start", "", "velocity, acceleration, … at the start, one row each", "rows", unit="q/s", only=ANY_DEGREE),
        Field("end", "", "velocity, acceleration, … at the end, one row each", "rows", unit="q/s", only=ANY_DEGREE),
        DURATION,
    ),
    formula=r"X(s)=\sum_{k=0}^{N}a_ks^k",
    says="As many coefficients as conditions at both ends.",
)
