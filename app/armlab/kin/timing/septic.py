"""The septic law -20 tau^7 + 70 tau^6 - 84 tau^5 + 35 tau^4: the jerk, too, is zero at both ends."""

from __future__ import annotations

from typing import Any

from armlab.kin.motion.law import Law
from armlab.kin.motion.law_types import LawType
from armlab.kin.timing._rest import rest_law


def make(duration: float, distance: float, options: dict[str, Any]) -> Law:
    """Return the law, the next by the rule after 6.74 of the notes. Peak speed 35/16 d/T."""
    return rest_law((-20, 70, -84, 35, 0, 0, 0, 0), duration, distance)


LAW = LawType("septic", "Septic", 4, make)
