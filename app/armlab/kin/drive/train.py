"""Trains of spur gears: ratio, sense of rotation, and angles at which the teeth mesh."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.drive.tooth import tooth_count
from armlab.registry import known_name

Floats = NDArray[np.float64]

LAYOUTS = {"row": "in a row", "compound": "two stages"}
"""Arrangements: each wheel meshes with the next, or the second and the third sit on one shaft."""

FEWEST, MOST = 2, 4
"""Number of wheels of a train."""

STAGES = 4
"""Number of wheels of a train of two stages."""


@dataclass(frozen=True)
class Train:
    """A gear train whose axes lie in one line; make one with `train`.

    Attributes
    ----------
    teeth : tuple of int
        Of each wheel, from the motor to the load.
    layout : "row" or "compound"
    """

    teeth: tuple[int, ...]
    layout: str = "row"

    @property
    def meshes(self) -> tuple[tuple[int, int], ...]:
        """Pairs of wheels that mesh, 0-based."""
        if self.layout == "compound":
            return (0, 1), (2, 3)
        return tuple((i, i + 1) for i in range(len(self.teeth) - 1))

    @property
    def turns(self) -> Floats:
        """Turns of each wheel for one turn of the first, with their sense, shape (k,): a mesh gives -z_i/z_j."""
        turns = np.ones(len(self.teeth))
        meshing = set(self.meshes)
        for j in range(1, len(self.teeth)):
            step = -self.teeth[j - 1] / self.teeth[j] if (j - 1, j) in meshing else 1.0
            turns[j] = step * turns[j - 1]
        return turns

    @property
    def ratio(self) -> float:
        """The ratio n: turns of the motor for one of the load, negative if they turn against each other (2.34)."""
        return float(1.0 / self.turns[-1])

    @property
    def idlers(self) -> tuple[int, ...]:
        """Wheels, 0-based, between the first and the last of a row: they change the sense, not the ratio."""
        return () if self.layout == "compound" else tuple(range(1, len(self.teeth) - 1))

    def modules(self, distances: Sequence[float]) -> Floats:
        """Return the module of each wheel from centre distances, ``m = 2 a/(z_i + z_j)``, metres, shape (k,).

        Parameters
        ----------
        distances : sequence of float
            Centre distance of the first mesh and of the second stage, metres; a row needs only the first, since all
            its wheels have one module.
        """
        first = 2.0 * distances[0] / (self.teeth[0] + self.teeth[1])
        if self.layout == "row":
            return np.full(len(self.teeth), first)
        second = 2.0 * distances[1] / (self.teeth[2] + self.teeth[3])
        return np.array([first, first, second, second])

    def places(self, distances: Sequence[float]) -> Floats:
        """Return the place of each axis along the line of centres, metres, shape (k,); the first is at 0."""
        modules, places = self.modules(distances), np.zeros(len(self.teeth))
        for i, j in self.meshes:
            places[j] = places[i] + 0.5 * modules[i] * (self.teeth[i] + self.teeth[j])
            if self.layout == "compound" and j == 1:
                places[2] = places[1]
        return places

    def angles(self, theta: float) -> Floats:
        """Return the angle of each wheel when the first is turned by theta, radians, shape (k,).

        At 0 the middle of a tooth of the first wheel lies on the line of centres; a tooth of one wheel meets a gap of
        the other. Where a tooth stands is that of `armlab.kin.drive.tooth.outline`, turned by this angle.
        """
        angles, meshing = np.full(len(self.teeth), float(theta)), set(self.meshes)
        for j in range(1, len(self.teeth)):
            if (j - 1, j) in meshing:
                z = self.teeth[j]
                angles[j] = math.pi + math.pi / z - angles[j - 1] * self.teeth[j - 1] / z
            else:
                angles[j] = angles[j - 1]
        return angles


def train(teeth: Sequence[object], layout: str = "row") -> Train:
    """Return a checked train.

    Raises
    ------
    InputError
        Not 2 to 4 wheels, not 4 for two stages, or a number of teeth that no wheel has; the text names the wheel.

    Examples
    --------
    >>> train([20, 40, 60]).ratio, train([20, 60]).ratio, train([20, 60, 15, 45], "compound").ratio
    (3.0, -3.0, 9.0)
    """
    known_name("layout of the train", layout, LAYOUTS)
    if not FEWEST <= len(teeth) <= MOST:
        raise InputError(f"teeth: a train has {FEWEST} to {MOST} wheels, got {len(teeth)}")
    if layout == "compound" and len(teeth) != STAGES:
        raise InputError(f"teeth: two stages have {STAGES} wheels, got {len(teeth)}")
    return Train(tuple(tooth_count(each, f"teeth of wheel {i + 1}") for i, each in enumerate(teeth)), layout)
