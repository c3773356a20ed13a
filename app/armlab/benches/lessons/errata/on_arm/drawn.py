"""A drawing of an erratum on the present arm: the wrong result beside the right one, or why there is nothing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm

Floats = NDArray[np.float64]

Unit = Literal["m", "rad", "m/s", "rad/s"]

LONG = 0.22
"""Length of the longest arrow, in reaches of the arm."""

SEEN = 1e-6
"""Difference, in SI units, below which both results count as the same."""


@dataclass(frozen=True, eq=False)
class Segment:
    """An arrow or a line.

    Attributes
    ----------
    start, end : ndarray, shape (3,)
        In the world, metres.
    wrong : bool
        Whether it belongs to the printed form.
    arrow : bool
    label : str
        At its end; empty for none.
    """

    start: Floats
    end: Floats
    wrong: bool
    arrow: bool = True
    label: str = ""


@dataclass(frozen=True, eq=False)
class Drawn:
    """Both results at a configuration of an arm.

    Attributes
    ----------
    says : str
        What is drawn, in a sentence or two.
    away : float
        The difference of both, in ``unit``.
    unit : str
    segments : tuple of Segment
    ghosts : tuple of (ndarray, bool)
        Joint values of other configurations of the arm, each with whether it is wrong.
    unseen : str
        Why both are the same here, if they are.
    """

    says: str
    away: float
    unit: Unit
    segments: tuple[Segment, ...] = ()
    ghosts: tuple[tuple[Floats, bool], ...] = ()
    unseen: str = ""

    @property
    def seen(self) -> bool:
        """Whether both results differ."""
        return self.away > SEEN


@dataclass(frozen=True)
class Unfit:
    """Why an erratum cannot be drawn on an arm.

    Attributes
    ----------
    why : str
    robot : str
        Key of an arm on which it can; empty if only another configuration is needed.
    """

    why: str
    robot: str = ""


OnArm = Callable[[Arm, Floats], Drawn | Unfit]
"""Function from an arm and its joint values to what is drawn."""


def arrows(point: Floats, vectors: tuple[Floats, Floats], arm: Arm, names: tuple[str, str]) -> tuple[Segment, ...]:
    """Return the wrong and the right vector as arrows from a point, of which the longer one has the usual length."""
    longest = max(float(np.linalg.norm(vector)) for vector in vectors)
    scale = LONG * arm.reach / longest if longest > SEEN else 0.0
    return tuple(
        Segment(point, point + scale * vector, wrong, label=name)
        for vector, wrong, name in zip(vectors, (True, False), names, strict=True)
        if float(np.linalg.norm(vector)) > SEEN
    )


def line(point: Floats, direction: Floats, arm: Arm, wrong: bool, label: str) -> Segment:
    """Return an axis through a point."""
    half = 0.9 * LONG * arm.reach * direction
    return Segment(point - half, point + half, wrong, arrow=False, label=label)
