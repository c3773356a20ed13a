"""The bench of timing laws: up to three side by side, one of them stretched in time, and a calculator of bounds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, Self

import numpy as np

from armlab.benches.motion.chosen import Chosen
from armlab.benches.motion.laws.bounds import Bounded
from armlab.benches.motion.laws.signs import Signs
from armlab.benches.motion.laws.timing import AS_TYPED, QUANTITIES, Entry, Timing, law_of
from armlab.errors import InputError
from armlab.kin.motion import Law, free_law_types
from armlab.session.fields import FieldPart, declarations, flag, number, own, text, whole
from armlab.session.state import Json, PartType

CLIP_KEY = "laws"

MOST_LAWS = 3

LEAST_FACTOR, MOST_FACTOR = 0.001, 1000.0
"""Least and largest factor of a time scaling."""


OPENED = Entry(Chosen("cubic")), Entry(Chosen("quintic"), colour=1)


def _entries(data: Json) -> tuple[Entry, ...]:
    return tuple(each if isinstance(each, Entry) else _entry(each) for each in data)


def _entry(data: Json) -> Entry:
    chosen = Chosen.from_json(data["law"], free_law_types())
    return Entry(chosen, bool(data["as_typed"]), int(data["colour"]))


def _written(entries: tuple[Entry, ...]) -> Json:
    return [{"law": each.chosen.to_json(), "as_typed": each.as_typed, "colour": each.colour} for each in entries]


def _timing(data: Json) -> Timing:
    if isinstance(data, Timing):
        return data
    timing = Timing(fastest=bool(data["fastest"]))
    for each in QUANTITIES:
        timing = timing.with_quantity(each.key, data[each.key])
    return timing


def _bounded(data: Json) -> Bounded:
    return data if isinstance(data, Bounded) else Bounded.from_json(data)


def _signs(data: Json) -> Signs:
    return data if isinstance(data, Signs) else Signs.from_json(data)


def _kept(entry: Entry, timing: Timing) -> Entry:
    """Return a saved law without a deceleration above the limit, which earlier versions accepted."""
    down = entry.chosen.options.get("sddot_down")
    if down is None or not timing.fastest or down <= timing.limit(2):
        return entry
    return replace(entry, chosen=entry.chosen.with_option(free_law_types()[entry.chosen.key], "sddot_down", None))


@dataclass(frozen=True)
class Laws(FieldPart):
    """Choices of the bench.

    Attributes
    ----------
    entries : tuple of Entry
        One to three laws, each with a colour of its own.
    timing : Timing
        Duration, distance and limits, the same for all.
    scaled : int
        Place of the law that is stretched in time.
    k : float
        The new time is k times the old; 1 leaves it alone.
    bounded : Bounded
        The path and the limits of the calculator.
    bounds_shown : bool
        Whether the calculator is looked at.
    signs : Signs
        Intervals of an acceleration of plus and minus one, which stand by themselves.
    example : str
        Key of the loaded example; empty if it has been changed or there is none.
    """

    key: ClassVar[str] = "laws"

    leave_example: ClassVar[tuple[str, ...]] = ("example", "signs")
    looks: ClassVar[tuple[str, ...]] = ("bounds_shown",)

    entries: tuple[Entry, ...] = own("laws", OPENED, _entries, _written, under="laws")
    timing: Timing = own("duration and limits", Timing(), _timing, asdict)
    scaled: int = whole("law to stretch", 0, 0)
    k: float = number("k", "time scaling", 1.0, LEAST_FACTOR, MOST_FACTOR)
    bounded: Bounded = own("bounds on a path", Bounded(), _bounded, Bounded.to_json, under="bounds")
    bounds_shown: bool = flag("whether the bounds are shown", False)
    signs: Signs = own("intervals of the signs", Signs(), _signs, Signs.to_json, later=True)
    example: str = text("example")

    def with_values(self, values: Mapping[str, Any]) -> Self:
        """Return the part with fields set; laws that are read together with their timing pass through `_kept`."""
        if "entries" in values and "timing" in values:
            fields = declarations(type(self))
            entries, timing = (self._checked(fields[name].spec, values[name]) for name in ("entries", "timing"))
            values = {**values, "entries": tuple(_kept(entry, timing) for entry in entries)}
        return super().with_values(values)

    def check(self) -> None:
        """Refuse laws that cannot be computed; `InputError` names the law, the option or the limit."""
        colours = {entry.colour for entry in self.entries}
        if not 1 <= len(self.entries) == len(colours) <= MOST_LAWS or not colours <= set(range(MOST_LAWS)):
            raise InputError(f"laws: expected 1 to {MOST_LAWS} of different colours, got {len(self.entries)}")
        if self.scaled >= len(self.entries):
            raise InputError(f"law to stretch: expected 1 to {len(self.entries)}, got {self.scaled + 1}")
        for entry in self.entries:
            if entry.as_typed and entry.chosen.key not in AS_TYPED:
                raise InputError(f"as typed: {entry.title} does not say its own time and distance")
        # Made here, kept by the part, and refused where they cannot be.
        if not np.isfinite(self.end):
            raise InputError("laws: too long to be drawn")
        self.bounded.found  # noqa: B018  raises when it cannot be

    @cached_property
    def laws(self) -> tuple[Law, ...]:
        """The laws, in the order of the entries."""
        return tuple(law_of(entry, self.timing) for entry in self.entries)

    @cached_property
    def stretched(self) -> Law | None:
        """The chosen law, slower by the factor k (notes 6.156-6.160), or None while k is 1."""
        return None if self.k == 1.0 else self.laws[self.scaled].stretched(self.k)

    @property
    def every(self) -> tuple[Law, ...]:
        """All laws, the stretched one last."""
        return self.laws if self.stretched is None else (*self.laws, self.stretched)

    @property
    def end(self) -> float:
        """The end of the slowest law, seconds."""
        return max(law.duration for law in self.every)


PART = PartType(Laws, order=104)
