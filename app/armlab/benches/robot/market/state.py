"""The calculator of compound growth: three of begin, end, years and rate give the fourth."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.robot.market.numbers import STOCK
from armlab.errors import InputError
from armlab.kin.growth import grown, growth_rate, years_to_grow
from armlab.registry import known_name
from armlab.session.fields import FieldPart, choice, flag, number, put, setting, text
from armlab.session.state import Command, PartType, State

NUMBERS = {"begin": "beginning", "end": "end", "years": "years", "rate": "rate"}
"""Numbers of the calculator, key to words."""

LEAST, MOST = 1e-6, 1e15
"""Least and largest value at the beginning or the end."""

LONGEST, FASTEST = 1000.0, 100.0
"""Largest number of years, and largest rate: 10 000 % a year."""

SLOWEST = -0.999
"""Lowest rate."""


@dataclass(frozen=True)
class Market(FieldPart):
    """Choices of the page.

    Attributes
    ----------
    unknown : str
        Which of `NUMBERS` is computed from the others; its own field is what was typed before.
    begin, end : float
        Robots, or whatever grows.
    years : float
    rate : float
        A fraction a year.
    start : float
        The year in which the value is ``begin``.
    log : bool
        Whether the chart has a logarithmic axis.
    example : str
    """

    key: ClassVar[str] = "market"
    looks: ClassVar[tuple[str, ...]] = ("log",)

    unknown: str = choice("what is computed", "rate", NUMBERS)
    begin: float = number("V_begin", "value at the beginning", STOCK[0].robots, LEAST, MOST)
    end: float = number("V_end", "value at the end", STOCK[-1].robots, LEAST, MOST)
    years: float = number("", "years", float(STOCK[-1].year - STOCK[0].year), -LONGEST, LONGEST)
    rate: float = number("CAGR", "rate a year", 0.1, SLOWEST, FASTEST)
    start: float = number("", "year of the beginning", float(STOCK[0].year), 1900.0, 2100.0)
    log: bool = flag("logarithmic axis", True)
    example: str = text("example", "whole")

    def check(self) -> None:
        """Refuse numbers from which the unknown cannot be computed, or that make it too large."""
        found = self.found[self.unknown]
        low, high = {"years": (-LONGEST, LONGEST), "rate": (SLOWEST, FASTEST)}.get(self.unknown, (LEAST, MOST))
        if not low <= found <= high:
            said = [f"{100.0 * each:.4g} %" if self.unknown == "rate" else f"{each:.4g}" for each in (found, low, high)]
            raise InputError(
                f"{NUMBERS[self.unknown]}: it would be {said[0]}, and the lab computes from {said[1]} to {said[2]}"
            )

    @property
    def found(self) -> dict[str, float]:
        """All four numbers, the unknown one computed; `InputError` if it cannot be."""
        known = {"begin": self.begin, "end": self.end, "years": self.years, "rate": self.rate}
        if self.unknown == "rate":
            return {**known, "rate": growth_rate(self.begin, self.end, self.years)}
        if self.unknown == "end":
            return {**known, "end": grown(self.begin, self.rate, self.years)}
        if self.unknown == "begin":
            return {**known, "begin": grown(self.end, self.rate, -self.years)}
        return {**known, "years": years_to_grow(self.begin, self.end, self.rate)}


PART = PartType(Market, order=42)


@dataclass(frozen=True)
class ComputeNumber(Command):
    """Compute another of the four numbers; the one that was computed so far is kept as if it were typed."""

    name: str
    label: ClassVar[str] = "what is computed"

    def apply(self, state: State) -> State:
        """Return the state with the choice made."""
        known_name("number", self.name, NUMBERS)
        return setting(state, Market, {**state[Market].found, "unknown": self.name})


@dataclass(frozen=True)
class TakeSpan(Command):
    """Take two counts of the IFR as beginning and end, and compute the rate between them.

    Parameters
    ----------
    first, last : int
        Places in the list of counts, from 0.
    """

    first: int
    last: int
    label: ClassVar[str] = "years of the growth"

    def apply(self, state: State) -> State:
        """Return the state with the rate between the counts."""
        if not 0 <= self.first < self.last < len(STOCK):
            raise InputError(
                f"counts: expected two of 0 to {len(STOCK) - 1}, the earlier first, got {self.first}, {self.last}"
            )
        return put(state, between(state[Market], self.first, self.last))


def between(part: Market, first: int, last: int) -> Market:
    """Return the part with the rate between two counts computed."""
    one, other = STOCK[first], STOCK[last]
    values = {"begin": one.robots, "end": other.robots, "years": float(other.year - one.year), "start": float(one.year)}
    return part.with_values({**values, "unknown": "rate", "example": ""})
