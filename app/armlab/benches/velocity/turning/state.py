"""The page of turning: three angles and their rates, or two time laws of omega with equal integrals."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar, Self

from armlab.content.robots import Robot
from armlab.errors import InputError, UnknownName
from armlab.kin.euler import SEQUENCES
from armlab.session.state import Json, Part, PartType

Triple = tuple[float, float, float]

CLIP_KEY = "turning"

MATRIX = "rates"
"""Under which a selection in T is known to the scene."""

VIEWS = ("angles", "laws")

MOST = 100.0
"""rad or rad/s; more is a slip of the pen."""


@dataclass(frozen=True)
class Turning(Part):
    """What the page shows.

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

    axes: str = "xyz"
    fixed: bool = True
    angles: Triple = (math.radians(20.0), math.radians(50.0), math.radians(-30.0))
    rates: Triple = (math.radians(30.0), math.radians(-15.0), math.radians(20.0))
    shown: str = "angles"

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return roll, pitch and yaw about fixed axes, as the notes have them."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Keep everything: it has nothing to do with the arm."""
        return self

    def to_json(self) -> Json:
        """Write everything."""
        return {
            "axes": self.axes,
            "fixed": self.fixed,
            "angles": list(self.angles),
            "rates": list(self.rates),
            "shown": self.shown,
        }

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read it back; raises when it is not usable."""
        (a, b, c), (d, e, f) = (tuple(float(value) for value in data[name]) for name in ("angles", "rates"))
        part = cls(data["axes"], bool(data["fixed"]), (a, b, c), (d, e, f), data["shown"])
        check(part)
        return part


PART = PartType(Turning, order=28)


def check(part: Turning) -> None:
    """Refuse what cannot be shown; `InputError` names the field."""
    if part.axes not in SEQUENCES:
        raise UnknownName("axes", part.axes, SEQUENCES)
    if part.shown not in VIEWS:
        raise UnknownName("view", part.shown, VIEWS)
    for name, values, unit in (("angle", part.angles, "rad"), ("rate", part.rates, "rad/s")):
        for k, value in enumerate(values):
            if not (math.isfinite(value) and abs(value) <= MOST):
                raise InputError(f"{name} {k + 1}: expected at most {MOST:g} {unit}, got {value:.6g} {unit}")


def changed(part: Turning, **fields: object) -> Turning:
    """Return the part with other values, checked."""
    after = replace(part, **fields)  # type: ignore[arg-type]
    if after == part:
        return part
    check(after)
    return after
