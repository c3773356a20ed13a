"""The cubic law -2 tau^3 + 3 tau^2: rest to rest, with a jump of the acceleration at both ends."""

from __future__ import annotations

from typing import Any

from armlab.kin.motion.law import Law
from armlab.kin.motion.law_types import LawType
from armlab.kin.timing._rest import rest_law


def make(duration: float, distance: float, options: dict[str, Any]) -> Law:
    """Return the law. Notes 6.55-6.56 and 6.183-6.186, where "continuity up to acceleration" needs the quintic.

    Peaks: 1.5 d/T and 6 d/T^2.
    """
    return rest_law((-2, 3, 0, 0), duration, distance)


LAW = LawType("cubic", "Cubic", 2, make)
