"""Three gimbal rings: each turns in the one around it by one of the three angles, and the body is fixed in the last."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.kin.rotations import rotation_about

Floats = NDArray[np.float64]

RADII = (1.0, 0.86, 0.72)
"""Radii from the outermost to the innermost ring, in that of the outermost one."""


@dataclass(frozen=True, eq=False)
class Ring:
    """One ring.

    Attributes
    ----------
    turn : int
        Place of its angle in the sequence, 0 to 2. About fixed axes the last turn has the outermost ring (notes,
        theorem 2).
    letter : str
        x, y or z: the axis of its turn.
    primes : int
        Number of turns that have carried its axis along; 0 for a fixed axis.
    axis : ndarray, shape (3,)
        The axis at present, in the base frame.
    frame : ndarray, shape (3, 3)
        Its plane: x along its own axis, which is held by the ring around it, and z across.
    radius : float
        Relative to the outermost ring.
    outside : float
        Radius of what holds it.
    """

    turn: int
    letter: str
    primes: int
    axis: Floats
    frame: Floats
    radius: float
    outside: float


def rings_of(axes: str, fixed: bool, angles: Floats) -> tuple[Ring, ...]:
    """Return the three rings from the outermost to the innermost one, at angles (3,) in radians."""
    order = (2, 1, 0) if fixed else (0, 1, 2)
    letters = [axes[k] for k in order]
    units = [np.eye(3)["xyz".index(letter)] for letter in letters]
    # A ring holds the axis of the next one; the innermost holds the body, across.
    holds = [units[1], units[2], units[1]]
    carried, found = np.eye(3), []
    for place, k in enumerate(order):
        own, across = units[place], np.cross(units[place], holds[place])
        axis = carried @ own
        carried = carried @ rotation_about(letters[place], angles[k])
        frame = carried @ np.column_stack([own, np.cross(across, own), across])
        outside = RADII[place - 1] if place else 1.14
        found.append(Ring(k, letters[place], 0 if fixed else place, axis, frame, RADII[place], outside))
    return tuple(found)
