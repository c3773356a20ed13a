"""The cycloidal course s - sin(2 pi s) / (2 pi): the acceleration is one sine wave, zero at both ends."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.kin.motion.path_types import PathType
from armlab.kin.paths._template import Template

Floats = NDArray[np.float64]


def course(s: Floats, order: int) -> Floats:
    """Return the derivative of a given order of s - sin(2 pi s) / (2 pi)."""
    wave = 2.0 * math.pi
    turned = np.sin(wave * s + order * math.pi / 2.0) * wave ** (order - 1)
    straight = (s, 1.0, 0.0, 0.0)[order]
    return np.asarray(straight - turned)


def make(knots: Floats, options: dict[str, Any]) -> Template:
    """Return the path. Named in the notes before section 6.1; formula: Biagiotti and Melchiorri 2008, section 2.2.2."""
    return Template(knots, course)


PATH = PathType(
    "cycloidal",
    "Cycloidal",
    13,
    make,
    least=2,
    most=2,
    spaces=("joint",),
    formula=r"X(s)=X_A+(s-\frac{\sin 2\pi s}{2\pi})(X_B-X_A)",
    says="Its first two derivatives are zero at both ends.",
)
