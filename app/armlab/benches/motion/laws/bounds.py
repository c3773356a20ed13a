"""The calculator of bounds: a path through typed knots and the limits of its joints (section 6.1.1 of the notes)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.laws.timing import LARGEST, SMALLEST
from armlab.errors import InputError
from armlab.kin.field import Field
from armlab.kin.motion import LawBounds, Limits, PathType, law_bounds, path_types
from armlab.session.state import Json

MOST_JOINTS, MOST_KNOTS = 3, 40

Rows = tuple[tuple[float, ...], ...]

FIELDS: tuple[Field, ...] = (
    Field("knots", "q", "knots: a row each, a joint a column", "rows", ((1.0, 0.0), (3.0, 1.0)), -LARGEST, LARGEST),
    Field("v_max", "v_max", "limits of speed, a joint each", "list", (3.0, 2.0), 0.0, LARGEST, True, unit="q/s"),
    Field(
        "a_max",
        "a_max",
        "limits of acceleration, a joint each; empty for none",
        "list",
        None,
        0.0,
        LARGEST,
        True,
        unit="q/s²",
    ),
    Field("speed", "V", "speed to work with; empty for the largest", "number", None, 0.0, LARGEST, True, unit="1/s"),
)
"""Inputs of the calculator, besides the options of the path."""

EXAMPLE_PATH = Chosen("polynomial", (("start", ((0.0, -2.0),)),))
"""Path of 6.34, q = (2 s² + 1, 3 s² - 2 s)."""


def joint_paths() -> dict[str, PathType]:
    """Return the kinds of paths that can be used between configurations, by key."""
    return {key: kind for key, kind in path_types().items() if "joint" in kind.spaces}


@dataclass(frozen=True)
class Bounded:
    """A path with the limits of its joints, at first the example of 6.34-6.44.

    Attributes
    ----------
    path : Chosen
        Of `joint_paths`.
    knots : tuple of tuple of float
        Up to 40 knots of up to 3 joints, rad or m.
    v_max, a_max : tuple of float
        One for each joint; ``a_max`` is empty where there are none.
    speed : float or None
        A V below the largest; None for the largest.
    """

    path: Chosen = EXAMPLE_PATH
    knots: Rows = ((1.0, 0.0), (3.0, 1.0))
    v_max: tuple[float, ...] = (3.0, 2.0)
    a_max: tuple[float, ...] = ()
    speed: float | None = None

    @property
    def joints(self) -> int:
        """The number of joints."""
        return len(self.knots[0])

    def with_value(self, name: str, value: Any) -> Bounded:
        """Return the calculator with one of `FIELDS` set.

        With another number of joints the limits go on as the last one given, and the path keeps none of its options.

        Raises
        ------
        InputError
            Not numbers, not positive, or out of range; the text names the field.
        """
        field = next((each for each in FIELDS if each.key == name), None)
        if field is None:
            raise InputError(f"unknown field {name!r}. Available: {', '.join(each.key for each in FIELDS)}")
        if value is None and field.default is not None:
            raise InputError(f"{field.key}: expected {field.title}, got nothing")
        checked: Any = None if value is None else field.checked(value)
        if name == "speed":
            return replace(self, speed=checked)
        if name != "knots":
            numbers: tuple[float, ...] = () if checked is None else tuple(checked.tolist())
            return replace(self, v_max=numbers) if name == "v_max" else replace(self, a_max=numbers)
        return self._through(tuple(tuple(row) for row in checked.tolist()))

    def _through(self, knots: Rows) -> Bounded:
        if len(knots) > MOST_KNOTS or not 1 <= len(knots[0]) <= MOST_JOINTS:
            raise InputError(
                f"knots: expected at most {MOST_KNOTS} rows of 1 to {MOST_JOINTS} joints, got {len(knots)} of "
                f"{len(knots[0])}"
            )
        m = len(knots[0])
        if m == self.joints:
            return replace(self, knots=knots)
        v, a = ((*given, *given[-1:] * (m - len(given)))[:m] for given in (self.v_max, self.a_max))
        return replace(self, knots=knots, v_max=v, a_max=a, path=Chosen(self.path.key))

    @property
    def found(self) -> LawBounds:
        """The bounds; `InputError` names the fault of path or limits."""
        return _found(self)

    def to_json(self) -> Json:
        """Write path and limits."""
        return {
            "path": self.path.to_json(),
            "knots": self.knots,
            "v_max": self.v_max,
            "a_max": self.a_max,
            "speed": self.speed,
        }

    @classmethod
    def from_json(cls, data: Json) -> Bounded:
        """Read path and limits back; raises if they are not usable."""
        part = cls(path=Chosen.from_json(data["path"], joint_paths()))
        given = {"a_max": data["a_max"] or None, "v_max": data["v_max"], "speed": data["speed"]}
        # The knots first: they would drop the options of the path otherwise.
        part = replace(part, knots=tuple(tuple(map(float, row)) for row in data["knots"]))
        for name, value in (("knots", data["knots"]), *given.items()):
            part = part.with_value(name, value)
        return part


@lru_cache(maxsize=64)
def _found(bounded: Bounded) -> LawBounds:
    kind = joint_paths()[bounded.path.key]
    with np.errstate(all="ignore"):
        path = kind.path(bounded.knots, **bounded.path.options)
        bounds = law_bounds(path, Limits(bounded.v_max, bounded.a_max or math.inf), bounded.speed)
    if not SMALLEST**2 <= bounds.V <= LARGEST**2 or not np.isfinite(bounds.M_a).all():
        raise InputError("knots: these are too far apart, or too near, for a bound that could be used")
    return bounds
