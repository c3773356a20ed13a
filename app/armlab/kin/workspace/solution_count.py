"""Numbers of solutions of the inverse kinematics at points, with one orientation of the tool for all."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from armlab.kin.arm import Arm
from armlab.kin.checks import as_floats, wrong
from armlab.kin.ik.solutions import IkSolutions
from armlab.kin.ik.solve_all import solve_all


class Count(NamedTuple):
    """The number of solutions of a pose.

    Attributes
    ----------
    number : float
        Number of solutions found; inf for a family.
    inside : float
        Number of these within the joint limits; inf when representatives of a family are.
    complete : bool
        Whether it is proven that there are no others; else it is "at least".
    """

    number: float
    inside: float
    complete: bool

    def __str__(self) -> str:
        """Return the number in words."""
        if math.isinf(self.number):
            return "infinitely many"
        return f"{self.number:.0f}" if self.complete else f"at least {self.number:.0f}"


def counts(arm: Arm, points: ArrayLike, R: ArrayLike) -> Iterator[Count]:
    """Yield how many solutions there are with the tool at each point, of the arm's task.

    Parameters
    ----------
    arm : Arm
    points : array_like, shape (k, 3)
        Points in the world, metres.
    R : array_like, shape (3, 3)
        Orientation of the tool in the world.

    Raises
    ------
    InputError
        Points or rotation of another shape.

    References
    ----------
    Notes, lists after 4.43.
    """
    where, turned = as_floats(points, "points", "points (k, 3) in metres"), as_floats(R, "R", "a rotation (3, 3)")
    if where.ndim != 2 or where.shape[1] != 3:
        raise wrong("points", "points (k, 3) in metres", points)
    if turned.shape != (3, 3):
        raise wrong("R", "a rotation (3, 3)", R)
    T = np.eye(4)
    T[:3, :3] = turned
    for point in where:
        T[:3, 3] = point
        yield count_of(solve_all(arm, T))


def count_of(found: IkSolutions) -> Count:
    """Return the number of solutions."""
    inside = int(found.within_limits.sum())
    if found.completeness == "infinite":
        return Count(math.inf, math.inf if inside else 0.0, True)
    return Count(float(len(found)), float(inside), found.completeness != "at least")
