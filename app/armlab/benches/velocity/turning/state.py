"""The page of turning: three angles and their rates, or two time laws of omega with equal integrals."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from armlab.errors import InputError
from armlab.kin.euler import SEQUENCES
from armlab.session.fields import FieldPart, choice, flag, vector
from armlab.session.state import PartType

Triple = tuple[float, float, float]

CLIP_KEY = "turning"

MATRIX = "rates"
"""Key by which the scene knows a selection in T."""

VIEWS = ("angles", "laws")

MOST = 100.0
"""Largest angle or rate, rad or rad/s."""


@dataclass(frozen=True)
class Turning(FieldPart):
    """Choices of the page, which do not depend on the arm.

    Attributes
    ----------
    axes : str
        One of `armlab.kin.euler.SEQUENCES`.
    fixed : bool
        Whether the axes stay where they were before the first turn.
    angles, rates : (float, float, float)
        Radians and rad/s, in the order of the sequence.
    shown : "angles" or "laws"
    """

    key: ClassVar[str] = "turning"
    kept_by_undo: ClassVar[bool] = True
    clip: ClassVar[str] = CLIP_KEY

    axes: str = choice("sequence of axes", "xyz", SEQUENCES)
    fixed: bool = flag("fixed axes", True)
    angles: Triple = vector("φ", "angles", (math.radians(20.0), math.radians(50.0), math.radians(-30.0)))
    rates: Triple = vector("φ̇", "rates of the angles", (math.radians(30.0), math.radians(-15.0), math.radians(20.0)))
    shown: str = choice("view", "angles", VIEWS)

    def check(self) -> None:
        """Refuse angles and rates that are too large; `InputError` names the one."""
        for name, values, per in (("angle", self.angles, ""), ("rate", self.rates, "/s")):
            for k, value in enumerate(values):
                if abs(value) > MOST:
                    most, got = (f"{math.degrees(angle):.6g}°{per}" for angle in (MOST, value))
                    raise InputError(f"{name} {k + 1}: expected at most {most} either way, got {got}")


PART = PartType(Turning, order=28)
