"""Encoders: joint values as the controller measures them, rounded to whole counts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.checks import whole_number
from armlab.kin.field import positive
from armlab.registry import known_name

Floats = NDArray[np.float64]

SHAFTS = {"motor": "motor shaft", "link": "link"}

LEAD = 0.01
"""Lead of the spindle, metres: how far a sliding joint moves in one turn of it."""

MOST_COUNTS = 100_000_000


@dataclass(frozen=True)
class Encoder:
    """Encoders of the same kind on all joints; make one with `encoder`.

    Attributes
    ----------
    counts : int
        A turn.
    shaft : "motor" or "link"
        On the motor shaft, which turns ``ratio`` times as fast, a count is that much finer at the joint. On the link,
        behind the gears, it sees what the gears do, but coarsely.
    ratio : float
        Turns of the motor for one of the joint, or of the spindle of a sliding joint.
    """

    counts: int
    shaft: str = "motor"
    ratio: float = 100.0

    def resolution(self, revolute: NDArray[np.bool_]) -> Floats:
        """Return the size of one count of each joint, (n,), rad or m: a turn over counts and, at the motor, ratio."""
        turn = np.where(revolute, 2.0 * np.pi, LEAD)
        return np.asarray(turn / (self.counts * (self.ratio if self.shaft == "motor" else 1.0)))


def encoder(counts: int, shaft: str = "motor", ratio: float = 100.0) -> Encoder:
    """Return a checked encoder; `InputError` for a wrong number, `UnknownName` for an unknown shaft."""
    known_name("encoder on", shaft, SHAFTS)
    if whole_number(counts, "counts of the encoder", 4) > MOST_COUNTS:
        raise InputError(f"counts of the encoder: expected at most {MOST_COUNTS}, got {counts}")
    return Encoder(int(counts), shaft, positive(ratio, "gear ratio"))


def read_off(q: Floats, resolution: Floats) -> Floats:
    """Return joint values (..., n) as whole counts of a resolution (n,), rounded to the nearest."""
    return np.asarray(np.round(q / resolution) * resolution)
