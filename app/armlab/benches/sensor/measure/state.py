"""The dart board: where throws land, how many there are, and how the aim has been corrected."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from armlab.kin.sensors.throws import MOST_THROWS, Estimate, estimate, throws
from armlab.session.fields import FieldPart, flag, number, text, whole
from armlab.session.state import PartType

Floats = NDArray[np.float64]

BOARD = 0.12
"""Radius of the board in metres; farther than that the bias cannot be."""

MOST_SEED = 1_000_000

DECIMALS = 12
"""Decimals of the bias in metres."""


@dataclass(frozen=True)
class Throws(FieldPart):
    """Throws at a board, which do not depend on the arm.

    Attributes
    ----------
    right, up : float
        Bias, metres.
    spread : float
        Standard deviation along any direction, metres.
    count, seed : int
    aim_right, aim_up : float
        Correction of the aim, metres.
    hit : float
        Radius within which a throw is a hit, metres.
    told : bool
        Whether true bias and spread are shown beside the estimated ones.
    example : str
        Key of the example it still is; empty when something has been changed.
    """

    key: ClassVar[str] = "throws"
    looks: ClassVar[tuple[str, ...]] = ("told",)

    right: float = number("b_x", "bias to the right", 0.05, -BOARD, BOARD, "m")
    up: float = number("b_y", "bias upwards", 0.03, -BOARD, BOARD, "m")
    spread: float = number("σ", "spread, the standard deviation along a direction", 0.012, 0.0, 0.1, "m")
    count: int = whole("number of throws", 20, 2, MOST_THROWS)
    seed: int = whole("seed of the throws", 1, 0, MOST_SEED)
    aim_right: float = number("", "correction of the aim to the right", 0.0, -1.0, 1.0, "m")
    aim_up: float = number("", "correction of the aim upwards", 0.0, -1.0, 1.0, "m")
    hit: float = number("r", "radius of a hit", 0.016, 0.0, BOARD, "m", above=True)
    told: bool = flag("true values are shown", True)
    example: str = text("example", "biased")

    @property
    def bias(self) -> Floats:
        """The bias that is left with the aim as it is, (2,), metres; none where only rounding is left."""
        return np.round([self.right + self.aim_right, self.up + self.aim_up], DECIMALS)

    @cached_property
    def points(self) -> Floats:
        """Where the throws land, (n, 2), metres from the middle."""
        return throws(self.count, self.bias, self.spread, self.seed)

    @cached_property
    def found(self) -> Estimate:
        """Bias and spread as the throws tell them."""
        return estimate(self.points)

    @property
    def rms(self) -> float:
        """Root mean square of the distances from the middle, metres."""
        return math.sqrt(float((self.points**2).sum(axis=1).mean()))

    @property
    def about(self) -> float:
        """Root mean square of the distances from their centre, metres."""
        return math.sqrt(float(((self.points - self.found.mean) ** 2).sum(axis=1).mean()))

    @property
    def bias_share(self) -> float:
        """Part of the mean square distance that the bias makes; the rest is spread. 0 where all is hit exactly."""
        whole = self.rms**2
        return self.found.distance**2 / whole if whole > 0.0 else 0.0

    @property
    def hits(self) -> int:
        """Number of throws within the radius of a hit."""
        return int(np.count_nonzero((self.points**2).sum(axis=1) <= self.hit**2))


PART = PartType(Throws, order=143)
