"""The quintic law 6 tau^5 - 15 tau^4 + 10 tau^3: rest to rest, acceleration zero at both ends."""

from __future__ import annotations

from typing import Any

from armlab.kin.motion.law import Law
from armlab.kin.motion.law_types import LawType
from armlab.kin.timing._rest import rest_law


def make(duration: float, distance: float, options: dict[str, Any]) -> Law:
    """Return the law. Notes 6.8 and 6.74, which prints 5 for 15.

    Peaks: 15/8 d/T and 10/sqrt(3) d/T^2.
    """
    return rest_law((6, -15, 10, 0, 0, 0), duration, distance)


LAW = LawType("quintic", "Quintic", 3, make)
