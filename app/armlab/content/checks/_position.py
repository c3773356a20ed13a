"""Common parts of the checks of a position: sentences on a wrong one, and refusals when a file is read."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.content.check import Words
from armlab.content.reader import Table
from armlab.content.robots import Robot

Vector = NDArray[np.float64]

_MIRRORED = (
    ((-1, 1), "x has the wrong sign"),
    ((1, -1), "y has the wrong sign: positive angles turn counter-clockwise"),
    ((-1, -1), "x and y both have the wrong sign: the arm points the opposite way"),
)


def point(p: Vector, words: Words) -> str:
    """Return the coordinates of a point, with the unit written once."""
    written = [words.length(float(value)) for value in p]
    unit = written[0].rpartition(" ")[2]
    return f"({', '.join(text.removesuffix(f' {unit}') for text in written)}) {unit}"


def position_mistake(p: Vector, asked: Vector, within: float, words: Words) -> str:
    """Return the mistake that explains a position, or the coordinate with the largest deviation."""
    for signs, says in _MIRRORED:
        if np.linalg.norm(p - asked * [*signs, 1]) <= within:
            return says
    if np.linalg.norm(p - asked[[1, 0, 2]]) <= within:
        return "x and y are exchanged"
    if np.linalg.norm(p * [1, 1, -1] - asked) <= within:
        return "z has the wrong sign"
    k = int(np.argmax(np.abs(p - asked)))
    return f"{'xyz'[k]} is {words.length(float(p[k]))} and should be {words.length(float(asked[k]))}"


def refuse_out_of_reach(table: Table, key: str, position: Vector, robot: Robot, within: float) -> None:
    """Raise `ContentError` for a point of the world that the arm cannot reach in any configuration."""
    far = float(np.linalg.norm(position - robot.arm.base[:3, 3])) - robot.arm.reach
    if far > within:
        raise table.fail(key, f"it is {far:.3f} m out of the reach of {robot.name}")
