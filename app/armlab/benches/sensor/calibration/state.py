"""The sensor that is calibrated: its errors in percent of full scale, the points, and the degree of the polynomial."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from armlab.kin.sensors.characteristic import MOST_DEGREE, SHAPES, Calibration, Cycle, Sensor, dead_band
from armlab.session.fields import FieldPart, choice, number, text, whole
from armlab.session.state import PartType

Floats = NDArray[np.float64]

PERCENT = 0.01

MOST = 20.0
"""Largest error that can be given, in percent of full scale."""

SECOND = 1_000_003
"""Number that is added to the seed for the noise of the cycle that checks the calibration."""


@dataclass(frozen=True)
class Curve(FieldPart):
    """A sensor and its calibration, which do not depend on the arm.

    Attributes
    ----------
    offset, gain, bend, hysteresis, resolution, noise : float
        Errors in percent of full scale; see `Sensor`.
    shape : str
        Some of `SHAPES`.
    points, degree, seed : int
        Inputs on each way of the cycle, degree of the polynomial, and seed of the noise.
    drift, age : float
        Percent of full scale by which the offset drifts in a month, and months since the calibration.
    example : str
        Key of the example it still is; empty when something has been changed.
    """

    key: ClassVar[str] = "calibration"

    offset: float = number("", "offset", 3.0, -MOST, MOST, "%")
    gain: float = number("", "gain error", -4.0, -MOST, MOST, "%")
    bend: float = number("", "nonlinearity", 2.0, -MOST, MOST, "%")
    shape: str = choice("shape of the nonlinearity", "arch", SHAPES)
    hysteresis: float = number("", "hysteresis", 0.4, 0.0, MOST, "%")
    resolution: float = number("", "resolution", 0.2, 0.0, MOST, "%")
    noise: float = number("", "noise", 0.05, 0.0, MOST, "%")
    points: int = whole("points on each way", 21, 3, 200)
    degree: int = whole("degree of the polynomial", 1, 1, MOST_DEGREE)
    seed: int = whole("seed of the noise", 1, 0, 1_000_000)
    drift: float = number("", "drift of the offset in a month", 0.0, -MOST, MOST, "%")
    age: float = number("", "months since the calibration", 0.0, 0.0, 120.0)
    example: str = text("example", "usual")

    @cached_property
    def sensor(self) -> Sensor:
        """The sensor, with its errors as parts of full scale."""
        names = ("offset", "gain", "bend", "hysteresis", "resolution", "noise")
        values = {name: PERCENT * getattr(self, name) for name in names}
        return Sensor(shape=self.shape, **values)

    @cached_property
    def cycle(self) -> Cycle:
        """The cycle on which it is calibrated."""
        return Cycle(self.sensor, self.points, self.seed)

    @cached_property
    def calibration(self) -> Calibration:
        """The polynomial that is fitted to it."""
        return Calibration(self.cycle, self.degree)

    @cached_property
    def again(self) -> Cycle:
        """A cycle with inputs between those, by which the calibration is checked."""
        return self.cycle.between(self.seed + SECOND)

    @cached_property
    def checked(self) -> Floats:
        """Errors that are left at these inputs, after the drift, as parts of full scale."""
        return self.calibration.checked(self.again, PERCENT * self.drift * self.age)

    @cached_property
    def dead(self) -> float:
        """The resolution error, a part of full scale."""
        return dead_band(self.sensor)

    def check(self) -> None:
        """Refuse a degree that the points do not determine."""
        self.calibration  # noqa: B018  raises when it cannot be


PART = PartType(Curve, order=144)
