"""Products and sums of numbers in a change of coordinates: matrices multiplied first, or applied one by one."""

from __future__ import annotations

from typing import NamedTuple

from armlab.kin.checks import whole_number
from armlab.registry import known_name


class Count(NamedTuple):
    """Numbers of products and of sums of two numbers."""

    products: int
    sums: int

    def times(self, count: int) -> Count:
        """Return the counts of as many repetitions."""
        return Count(count * self.products, count * self.sums)

    def plus(self, other: Count) -> Count:
        """Return the counts of both together."""
        return Count(self.products + other.products, self.sums + other.sums)


class Cost(NamedTuple):
    """The cost of multiplying two matrices of a kind, and of applying one to a point."""

    multiply: Count
    apply: Count


COSTS: dict[str, Cost] = {
    "rotation": Cost(Count(27, 18), Count(9, 6)),
    "transform": Cost(Count(36, 27), Count(9, 9)),
    "whole": Cost(Count(64, 48), Count(16, 12)),
}
"""Costs by kind: rotations; transforms without their last row 0 0 0 1, that is ``R1 R2`` and ``R1 p2 + p1``; and 4 x 4
matrices multiplied as if nothing were known of them."""


def multiplied_first(steps: int, points: int = 1, kind: str = "rotation") -> Count:
    """Return the cost of multiplying all matrices once and applying the product to each point.

    Parameters
    ----------
    steps : int
        Number of matrices, at least 1.
    points : int
    kind : str
        A key of `COSTS`.

    Raises
    ------
    InputError
        Fewer than one step, or a number of points below zero; `UnknownName` for another kind.

    References
    ----------
    Notes, the text before 3.20.

    Examples
    --------
    >>> multiplied_first(3)
    Count(products=63, sums=42)
    """
    cost = COSTS[known_name("kind", kind, COSTS)]
    count = whole_number(steps, "steps", 1)
    return cost.multiply.times(count - 1).plus(cost.apply.times(whole_number(points, "points", 0)))


def one_by_one(steps: int, points: int = 1, kind: str = "rotation") -> Count:
    """Return the cost of applying the matrices to each point, one after the other from the right.

    The parameters and errors are those of `multiplied_first`.

    References
    ----------
    Notes 3.20-3.22.

    Examples
    --------
    >>> one_by_one(3)
    Count(products=27, sums=18)
    """
    cost = COSTS[known_name("kind", kind, COSTS)]
    return cost.apply.times(whole_number(steps, "steps", 1) * whole_number(points, "points", 0))


def worth_multiplying(kind: str = "rotation") -> int:
    """Return from how many points on multiplying first takes fewer products, whatever the number of steps above one.

    For n steps and N points ``m (n - 1) + a N < a n N`` holds for ``N > m / a``, with m products in a multiplication of
    two matrices and a in an application.

    >>> worth_multiplying("rotation"), worth_multiplying("transform")
    (4, 5)
    """
    cost = COSTS[known_name("kind", kind, COSTS)]
    return cost.multiply.products // cost.apply.products + 1
