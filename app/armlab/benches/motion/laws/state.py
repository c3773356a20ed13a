"""The bench of timing laws: up to three side by side, one of them stretched in time, and a calculator of bounds."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field, replace
from functools import cached_property
from typing import ClassVar, Self

import numpy as np

from armlab.benches.motion.laws.bounds import Bounded
from armlab.benches.motion.laws.timing import AS_TYPED, QUANTITIES, Entry, Timing, law_of
from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.motion import Law, free_law_types
from armlab.session.chosen import Chosen
from armlab.session.state import Json, Part, PartType

CLIP_KEY = "laws"

MOST_LAWS = 3

LEAST_FACTOR, MOST_FACTOR = 0.001, 1000.0
"""Of a time scaling."""


@dataclass(frozen=True)
class Laws(Part):
    """What the bench shows.

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
    example : str
        Key of the example that is in place as it was put there; empty when it is none.
    """

    key: ClassVar[str] = "laws"

    entries: tuple[Entry, ...] = (Entry(Chosen("cubic")), Entry(Chosen("quintic"), colour=1))
    timing: Timing = field(default_factory=Timing)
    scaled: int = 0
    k: float = 1.0
    bounded: Bounded = field(default_factory=Bounded)
    bounds_shown: bool = False
    example: str = ""

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the cubic beside the quintic."""
        return cls()

    def for_robot(self, robot: Robot) -> Self:
        """Keep everything: it has nothing to do with the arm."""
        return self

    @cached_property
    def laws(self) -> tuple[Law, ...]:
        """The laws, in the order of the entries."""
        return tuple(law_of(entry, self.timing) for entry in self.entries)

    @cached_property
    def stretched(self) -> Law | None:
        """The chosen law, k times as slow (notes 6.156-6.160); None while k is 1."""
        return None if self.k == 1.0 else self.laws[self.scaled].stretched(self.k)

    @property
    def every(self) -> tuple[Law, ...]:
        """All laws, the stretched one last."""
        return self.laws if self.stretched is None else (*self.laws, self.stretched)

    @property
    def end(self) -> float:
        """When the slowest of all ends, seconds."""
        return max(law.duration for law in self.every)

    def to_json(self) -> Json:
        """Write what was chosen and typed."""
        return {
            "laws": [
                {"law": each.chosen.to_json(), "as_typed": each.as_typed, "colour": each.colour}
                for each in self.entries
            ],
            "timing": asdict(self.timing),
            "scaled": self.scaled,
            "k": self.k,
            "bounds": self.bounded.to_json(),
            "bounds_shown": self.bounds_shown,
            "example": self.example,
        }

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read it back; raises when nothing can be computed with it."""
        timing = Timing(fastest=bool(data["timing"]["fastest"]))
        for each in QUANTITIES:
            timing = timing.with_quantity(each.key, data["timing"][each.key])
        entries = tuple(
            Entry(
                _kept(Chosen.from_json(each["law"], free_law_types()), timing),
                bool(each["as_typed"]),
                int(each["colour"]),
            )
            for each in data["laws"]
        )
        bounded = Bounded.from_json(data["bounds"])
        part = cls(
            entries,
            timing,
            int(data["scaled"]),
            float(data["k"]),
            bounded,
            bool(data["bounds_shown"]),
            str(data.get("example", "")),
        )
        check(part)
        return part


PART = PartType(Laws, order=104)


def _kept(chosen: Chosen, timing: Timing) -> Chosen:
    """Return a law as it was saved, without a deceleration above the limit, which could be typed before."""
    down = chosen.options.get("sddot_down")
    if down is None or not timing.fastest or down <= timing.limit(2):
        return chosen
    return chosen.with_option(free_law_types()[chosen.key], "sddot_down", None)


def check(part: Laws) -> None:
    """Refuse what cannot be made; `InputError` names the law, the option or the limit."""
    colours = {entry.colour for entry in part.entries}
    if not 1 <= len(part.entries) == len(colours) <= MOST_LAWS or not colours <= set(range(MOST_LAWS)):
        raise InputError(f"laws: expected 1 to {MOST_LAWS} of different colours, got {len(part.entries)}")
    if not 0 <= part.scaled < len(part.entries):
        raise InputError(f"law to stretch: expected 1 to {len(part.entries)}, got {part.scaled + 1}")
    if not LEAST_FACTOR <= part.k <= MOST_FACTOR:
        raise InputError(f"k: expected {LEAST_FACTOR:g} to {MOST_FACTOR:g}, got {part.k:g}")
    for entry in part.entries:
        if entry.as_typed and entry.chosen.key not in AS_TYPED:
            raise InputError(f"as typed: {entry.title} does not say its own time and distance")
    # Made here, kept by the part, and refused where they cannot be.
    if not np.isfinite(part.end):
        raise InputError("laws: too long to be drawn")


def changed(part: Laws, **fields: object) -> Laws:
    """Return the part with other values, checked; what was an example is none any more."""
    if all(getattr(part, name) == value for name, value in fields.items()):
        return part
    after = replace(part, **{"example": "", **fields})  # type: ignore[arg-type]
    check(after)
    return after
