"""Measures of a planned motion: its largest values, the limit that slows it, and the limits it exceeds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, Self

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Limited = Literal["position", "velocity", "acceleration", "jerk", "tool speed"]

TOOL = 0
"""Number of the tool, where joints are counted from 1."""

MOST_SPANS = 200
"""Largest number of times at which one limit is exceeded that are kept; more cannot be told apart in a plot."""


@dataclass(frozen=True)
class Overrun:
    """A limit that is exceeded, once or several times.

    Attributes
    ----------
    joint : int
        1-based, or `TOOL`.
    quantity : str
    spans : tuple of (float, float)
        From when to when, seconds; of very many only the first.
    count : int
        How many times in all.
    """

    joint: int
    quantity: Limited
    spans: tuple[tuple[float, float], ...]
    count: int

    @classmethod
    def of(cls, joint: int, quantity: Limited, spans: Sequence[tuple[float, float]]) -> Self:
        """Return a limit exceeded in the given intervals, of which the first `MOST_SPANS` are kept."""
        return cls(joint, quantity, tuple(spans[:MOST_SPANS]), len(spans))


@dataclass(frozen=True)
class Binding:
    """The limit that slows a motion for the longest part of it.

    Attributes
    ----------
    joint : int
        1-based, or `TOOL`.
    quantity : str
    """

    joint: int
    quantity: Limited


@dataclass(frozen=True, eq=False)
class Figures:
    """The largest values of a motion.

    Attributes
    ----------
    velocity, acceleration : ndarray, shape (n,)
        Exact peaks of the absolute values, rad/s or m/s and rad/s² or m/s².
    velocity_at, acceleration_at : ndarray, shape (n,)
        When, seconds.
    velocity_share, acceleration_share : ndarray, shape (n,)
        Parts of the limits.
    way : float
        Metres the tool point goes.
    tool_speed : float
        m/s, the largest.
    binding : Binding or None
        None where no limit is met, as in a motion that is given more time.
    """

    velocity: Floats
    acceleration: Floats
    velocity_at: Floats
    acceleration_at: Floats
    velocity_share: Floats
    acceleration_share: Floats
    way: float
    tool_speed: float
    binding: Binding | None

    @property
    def fastest_joint(self) -> int:
        """The joint, from 1, that comes nearest to its limit of velocity."""
        return int(np.argmax(self.velocity_share)) + 1
