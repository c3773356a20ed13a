"""The exponential course (1 - e^(-lambda s)) / (1 - e^(-lambda)): fast at first, slow at the end."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.field import Field
from armlab.kin.motion.path_types import PathType
from armlab.kin.paths._template import Template

Floats = NDArray[np.float64]

MOST_RATE = 50.0
"""Largest rate: beyond it the whole change happens in the first tenth."""


def make(knots: Floats, options: dict[str, Any]) -> Template:
    """Return the path; with a negative rate it is slow at first. One of the classes in the notes, section 6.2."""
    rate: float = options["rate"]
    if rate == 0.0:
        raise InputError("rate: expected a number that is not 0 (that is the straight line), got 0")
    whole = math.expm1(-rate)

    def course(s: Floats, order: int) -> Floats:
        if order == 0:
            return np.asarray(np.expm1(-rate * s) / whole)
        return np.asarray((-rate) ** order * np.exp(-rate * s) / whole)

    return Template(knots, course)


PATH = PathType(
    "exponential",
    "Exponential",
    14,
    make,
    least=2,
    most=2,
    spaces=("joint",),
    fields=(Field("rate", "λ", "rate; negative: slow first", "number", 3.0, low=-MOST_RATE, high=MOST_RATE),),
    formula=r"X(s)=X_A+\frac{1-e^{-\lambda s}}{1-e^{-\lambda}}(X_B-X_A)",
    says="Fast first, slow at the end; with negative λ the other way round.",
)
