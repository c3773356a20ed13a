"""Curves of one coordinate over time through typed knots: knots, curves and limits."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar, Self

from armlab.benches.motion.curves.fastest import Asked, Fastest
from armlab.benches.motion.curves.knots import Knot, checked
from armlab.benches.motion.curves.made import Drawn, Made, kinds, made
from armlab.content.robots import Robot
from armlab.errors import InputError, UnknownName
from armlab.kin.motion.law_types import free_law_types
from armlab.session.chosen import Chosen
from armlab.session.state import Json, Part, PartType

MOST_CURVES = 3

UNITS = ("rad", "°", "m", "mm")
"""What the numbers of the coordinate can be in; they are not converted, for no arm is behind them."""

DEGREES = (3, 5, 7, 9)
"""Of the normalised polynomials to look at."""

SMALLEST_LIMIT, LARGEST_LIMIT = 1e-9, 1e12


@dataclass(frozen=True)
class Curves(Part):
    """Knots, the curves through them and limits, all in one unit of the coordinate, and seconds.

    Attributes
    ----------
    knots : tuple of (float, float)
        Time and coordinate, times rising.
    curves : tuple of Drawn
        One to three, of different colours.
    v_max, a_max : float or None
        Limits of the rate and of its rate; None for no limit.
    unit : str
        One of `UNITS`.
    selected : int
        The curve whose equations are shown.
    degree : int
        Of the normalised polynomial that is shown.
    example : str
        Key of the example that is in place as it was put there; empty when it is none.
    asked : Asked or None
        The fastest intervals that are being looked for. Not saved, as is what was found.
    fastest : Fastest or None
    """

    key: ClassVar[str] = "curves"

    knots: tuple[Knot, ...] = ((0.0, 0.0), (1.0, 1.0), (2.0, 0.5), (3.0, 2.0))
    curves: tuple[Drawn, ...] = (Drawn(0, Chosen("spline")),)
    v_max: float | None = None
    a_max: float | None = None
    unit: str = UNITS[0]
    selected: int = 0
    degree: int = 5
    example: str = ""
    asked: Asked | None = None
    fastest: Fastest | None = None

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return a spline with three kinds of ends; the arm does not matter."""
        both = Chosen("spline", (("ends", "both"), ("virtual", (0.5, 2.5))))
        natural = Chosen("spline", (("ends", "natural"),))
        return cls(curves=(Drawn(0, Chosen("spline")), Drawn(1, natural), Drawn(2, both)), example="ends")

    def for_robot(self, robot: Robot) -> Self:
        """Keep everything: it has nothing to do with the arm."""
        return self

    def to_json(self) -> Json:
        """Write everything but the fastest intervals."""
        return {
            "knots": [list(knot) for knot in self.knots],
            "curves": [[each.colour, each.path.to_json(), each.law.to_json()] for each in self.curves],
            "limits": [self.v_max, self.a_max],
            "unit": self.unit,
            "selected": self.selected,
            "degree": self.degree,
            "example": self.example,
        }

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read it back; raises when it is not usable."""
        curves = tuple(_drawn(*each) for each in data["curves"])
        selected, degree = data.get("selected", 0), data.get("degree", 5)
        distinct = len({each.colour for each in curves}) == len(curves)
        if not 1 <= len(curves) <= MOST_CURVES or not distinct or selected not in range(len(curves)):
            raise InputError(f"curves: not usable: {str(data)[:80]}")
        v_max, a_max = (checked_limit(each, "limit") for each in data["limits"])
        return cls(
            checked(data["knots"]),
            curves,
            v_max,
            a_max,
            checked_unit(data["unit"]),
            int(selected),
            checked_degree(degree),
            str(data.get("example", "")),
        )

    @cached_property
    def outcomes(self) -> tuple[Made | InputError, ...]:
        """Each curve, or why there is none through these knots."""
        return tuple(_outcome(self.knots, each) for each in self.curves)

    @property
    def made(self) -> Iterator[Made]:
        """The curves there are."""
        return (each for each in self.outcomes if isinstance(each, Made))

    @property
    def ends(self) -> str:
        """The ends of the first spline, which the fastest intervals are for; at rest when there is none."""
        splines = (each.path.options for each in self.curves if each.path.key == "spline")
        return str(next(splines, {}).get("ends", "clamped"))


PART = PartType(Curves, order=99)


def _outcome(knots: tuple[Knot, ...], drawn: Drawn) -> Made | InputError:
    try:
        return made(knots, drawn)
    except InputError as refusal:
        return refusal


def _drawn(colour: Any, path: Json, law: Json) -> Drawn:
    if colour not in range(MOST_CURVES):
        raise InputError(f"colour: expected 0 to {MOST_CURVES - 1}, got {colour!r}")
    return Drawn(int(colour), Chosen.from_json(path, kinds()), Chosen.from_json(law, free_law_types()))


def checked_limit(value: float | None, where: str) -> float | None:
    """Return a limit, or None for none; `InputError` when it is not positive."""
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not SMALLEST_LIMIT <= value <= LARGEST_LIMIT:
        got = f"{value:g}" if isinstance(value, (int, float)) and math.isfinite(value) else str(value)[:40]
        raise InputError(f"{where}: expected a positive number, or nothing for no limit; got {got}")
    return float(value)


def checked_unit(unit: str) -> str:
    """Return a unit; `UnknownName` for another word."""
    if unit not in UNITS:
        raise UnknownName("unit", unit, UNITS)
    return unit


def checked_degree(degree: int) -> int:
    """Return the degree of a normalised polynomial; `InputError` for one that is not offered."""
    if degree not in DEGREES:
        raise InputError(f"degree: expected one of {', '.join(map(str, DEGREES))}, got {degree!r}")
    return int(degree)
