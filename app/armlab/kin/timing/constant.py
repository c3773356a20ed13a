"""Constant speed: the speed jumps at both ends."""

from __future__ import annotations

from typing import Any

import numpy as np

from armlab.kin.motion.law import Law, PolynomialLaw
from armlab.kin.motion.law_types import LawType
from armlab.kin.motion.limits import Limits
from armlab.kin.motion.piecewise import Piecewise

REMARK = "The speed jumps at both ends: no motor can do that unless the path itself begins and ends at rest."


def make(duration: float, distance: float, options: dict[str, Any]) -> Law:
    """Return s = distance t / T. Notes 1.28, 6.2."""
    coefficients = np.array([0.0, distance / duration])
    return PolynomialLaw(Piecewise(np.array([0.0, duration]), coefficients[None, :, None]), (REMARK,))


def fastest(limits: Limits, distance: float, options: dict[str, Any]) -> Law:
    """Return the law at the largest speed; the accelerations between the jumps are zero."""
    return make(distance / float(limits.velocity), distance, options)


LAW = LawType("constant", "Constant speed", 1, make, fastest, needs=("velocity",))
