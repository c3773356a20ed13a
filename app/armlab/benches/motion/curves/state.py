"""Curves of one coordinate over time through typed knots: knots, curves and limits."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, Self

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.curves.fastest import Asked, Fastest
from armlab.benches.motion.curves.knots import Knot, checked
from armlab.benches.motion.curves.made import Drawn, Made, kinds, made
from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.motion.law_types import free_law_types
from armlab.session.fields import FieldPart, choice, own, text, whole
from armlab.session.state import Json, PartType

MOST_CURVES = 3

UNITS = ("rad", "°", "m", "mm")
"""Units that the coordinate can have; its numbers are not converted, because they do not belong to an arm."""

DEGREES = (3, 5, 7, 9)
"""Degrees of the normalised polynomials that can be chosen."""

Limits = tuple[float | None, float | None]

SMALLEST_LIMIT, LARGEST_LIMIT = 1e-9, 1e12


def _curves(data: Json) -> tuple[Drawn, ...]:
    return tuple(each if isinstance(each, Drawn) else _drawn(*each) for each in data)


def _drawn(colour: Any, path: Json, law: Json) -> Drawn:
    if colour not in range(MOST_CURVES):
        raise InputError(f"colour: expected 0 to {MOST_CURVES - 1}, got {colour!r}")
    return Drawn(int(colour), Chosen.from_json(path, kinds()), Chosen.from_json(law, free_law_types()))


def _written(curves: tuple[Drawn, ...]) -> Json:
    return [[each.colour, each.path.to_json(), each.law.to_json()] for each in curves]


def _limits(data: Json) -> Limits:
    v_max, a_max = data
    return _limit(v_max, "v_max"), _limit(a_max, "a_max")


def _limit(value: float | None, where: str) -> float | None:
    """Return a limit, or None for none; `InputError` if it is not positive."""
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not SMALLEST_LIMIT <= value <= LARGEST_LIMIT:
        got = f"{value:g}" if isinstance(value, (int, float)) and math.isfinite(value) else str(value)[:40]
        raise InputError(f"{where}: expected a positive number, or nothing for no limit; got {got}")
    return float(value)


@dataclass(frozen=True)
class Curves(FieldPart):
    """Knots, the curves through them and limits, all in one unit of the coordinate, and seconds.

    Attributes
    ----------
    knots : tuple of (float, float)
        Time and coordinate, times rising.
    curves : tuple of Drawn
        One to three, of different colours.
    limits : tuple of float or None
        Of the rate and of its rate; None for no limit.
    unit : str
        One of `UNITS`.
    selected : int
        The curve whose equations are shown.
    degree : int
        Of the normalised polynomial that is shown.
    example : str
        Key of the loaded example; empty if it has been changed or there is none.
    asked : Asked or None
        The fastest intervals that are being looked for. Not saved, as is what was found.
    fastest : Fastest or None
    """

    key: ClassVar[str] = "curves"

    leave_example: ClassVar[tuple[str, ...]] = ("unit",)
    looks: ClassVar[tuple[str, ...]] = ("selected", "degree")

    knots: tuple[Knot, ...] = own("knots", ((0.0, 0.0), (1.0, 1.0), (2.0, 0.5), (3.0, 2.0)), checked)
    curves: tuple[Drawn, ...] = own("curves", (Drawn(0, Chosen("spline")),), _curves, _written)
    limits: Limits = own("limits", (None, None), _limits)
    unit: str = choice("unit", UNITS[0], UNITS)
    selected: int = whole("curve whose equations are shown", 0, 0)
    degree: int = whole("degree", 5, DEGREES[0], DEGREES[-1])
    example: str = text("example")
    asked: Asked | None = None
    fastest: Fastest | None = None

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return a spline with three kinds of ends, independent of the arm."""
        both = Chosen("spline", (("ends", "both"), ("virtual", (0.5, 2.5))))
        natural = Chosen("spline", (("ends", "natural"),))
        return cls(curves=(Drawn(0, Chosen("spline")), Drawn(1, natural), Drawn(2, both)), example="ends")

    def for_robot(self, robot: Robot) -> Self:
        """Keep everything, which does not depend on the arm."""
        return self

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep everything."""
        return self

    def check(self) -> None:
        """Refuse curves with the same colour, and the choice of one that does not exist."""
        if not 1 <= len(self.curves) <= MOST_CURVES or len({each.colour for each in self.curves}) < len(self.curves):
            raise InputError(f"curves: expected 1 to {MOST_CURVES} of different colours, got {len(self.curves)}")
        if self.degree not in DEGREES:
            raise InputError(f"degree: expected one of {', '.join(map(str, DEGREES))}, got {self.degree}")
        if self.selected >= len(self.curves):
            raise InputError(f"curve: expected 1 to {len(self.curves)}, got {self.selected + 1}")

    def with_values(self, values: Mapping[str, Any]) -> Self:
        """Return the part with fields set, without fastest intervals for other knots, limits or ends."""
        part = super().with_values(values)
        same = (part.knots, part.limits, part.ends) == (self.knots, self.limits, self.ends)
        return part if same else replace(part, asked=None, fastest=None)

    @property
    def v_max(self) -> float | None:
        """Limit of the rate, or None."""
        return self.limits[0]

    @property
    def a_max(self) -> float | None:
        """Limit of the derivative of the rate, or None."""
        return self.limits[1]

    @cached_property
    def outcomes(self) -> tuple[Made | InputError, ...]:
        """Each curve, or the reason why there is none through these knots."""
        return tuple(_outcome(self.knots, each) for each in self.curves)

    @property
    def made(self) -> Iterator[Made]:
        """The curves that could be computed."""
        return (each for each in self.outcomes if isinstance(each, Made))

    @property
    def ends(self) -> str:
        """The ends of the first spline, for which the fastest intervals are found; at rest if there is none."""
        splines = (each.path.options for each in self.curves if each.path.key == "spline")
        return str(next(splines, {}).get("ends", "clamped"))


PART = PartType(Curves, order=99)


def _outcome(knots: tuple[Knot, ...], drawn: Drawn) -> Made | InputError:
    try:
        return made(knots, drawn)
    except InputError as refusal:
        return refusal
