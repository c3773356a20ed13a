"""A fact that a bench publishes has a value: near, at least or at most a number, a text, or true or false."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace

import numpy as np

from armlab.content.bench_words import fact_name
from armlab.content.check import PLAIN, CheckType, Words
from armlab.content.fact_words import said
from armlab.content.lesson_fields import Fields
from armlab.content.observation import Observation
from armlab.content.quantities import ROUNDING, is_near
from armlab.content.reader import Table, shown
from armlab.content.robots import Robot
from armlab.content.seen_fact import SeenFact, Value

MOST_COMPONENTS = 100

_WORD = re.compile(r"(?:a (?=[a-z]{3}))?[a-z]{2,}(?![\w(])")


@dataclass(frozen=True)
class FactIs:
    """The condition on a fact; numbers are in its own unit.

    Attributes
    ----------
    fact : str
        Its word, such as ``velocity.statics.torques``.
    component : int
        Number, from 1, of one of several values; 0 for all of them, or for a fact with one value.
    value : Value or None
        The required value; None when the fact has to lie between two numbers.
    tolerance : float or None
        Largest difference of a number from the value; None for counts, texts and truth values only.
    at_least, at_most : float or None
    degrees : bool
        Whether the file gives its numbers in degrees; which is right for angles only.
    """

    fact: str
    component: int = 0
    value: Value | None = None
    tolerance: float | None = None
    at_least: float | None = None
    at_most: float | None = None
    degrees: bool = False

    @property
    def facts(self) -> tuple[str, ...]:
        """The word of the fact."""
        return (self.fact,)

    def is_met(self, observation: Observation) -> bool:
        """Return whether the fact is known and meets the condition."""
        value = self._now(observation)
        if value is None:
            return False
        if isinstance(value, (str, bool)) or isinstance(self.value, (str, bool)):
            return type(value) is type(self.value) and value == self.value
        if isinstance(value, tuple) or isinstance(self.value, tuple):
            return self._near_all(value)
        if self.value is not None and not is_near(value, self.value, self.tolerance or 0.0):
            return False
        # A number that is typed as the bound is the bound: 700 mm are at most 0.7 m.
        low = self.at_least is None or value >= self.at_least - ROUNDING * abs(self.at_least)
        return low and (self.at_most is None or value <= self.at_most + ROUNDING * abs(self.at_most))

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return a sentence on the value of the fact and the required one."""
        seen, value = observation.facts.get(self.fact), self._now(observation)
        title = self.titled(seen.title if seen else self.fact)
        if seen is None or value is None:
            return f"{_begun(title)}: {_why_unknown(seen)}."
        told = f"{_begun(title)}: "
        now = self._said(seen.named(value), seen.unit, words)
        if self.is_met(observation):
            return _ended(f"{told}{now}")
        required = replace(self, value=seen.named(self.value)).asked(seen.unit, words)
        return _ended(f"{told}{self._missed(value, seen.unit, words)}{now}") + _ended(f" Required: {required}")

    def titled(self, title: str) -> str:
        """Return the subject of the check, by the title of the fact."""
        return f"{title}, component {self.component}" if self.component else title

    def asked(self, unit: str, words: Words = PLAIN) -> str:
        """Return the required value in words."""
        if self.value is not None:
            within = f" ± {self._said(self.tolerance, unit, words)}" if self.tolerance else ""
            return f"{self._said(self.value, unit, words)}{within}"
        ends = (("at least", self.at_least), ("at most", self.at_most))
        return " and ".join(f"{name} {self._said(end, unit, words)}" for name, end in ends if end is not None)

    def _missed(self, value: Value, unit: str, words: Words) -> str:
        """Return what stands before a number whose words are those of the end that it misses; else nothing."""
        if isinstance(value, (str, bool, tuple)) or isinstance(self.value, (str, bool, tuple)):
            return ""
        within = self.tolerance or 0.0
        low, high = (self.at_least, self.at_most) if self.value is None else (self.value - within, self.value + within)
        now = self._said(value, unit, words)
        if low is not None and value < low and self._said(low, unit, words) == now:
            return "a little less than "
        if high is not None and value > high and self._said(high, unit, words) == now:
            return "a little more than "
        return ""

    def _said(self, value: Value | None, unit: str, words: Words) -> str:
        """Return a value in words: an angular speed in the unit in which the file gives it."""
        if not self.degrees or unit != "rad/s" or value is None or isinstance(value, str):
            return said(value, unit, words)
        numbers = np.degrees(value)
        return said(tuple(numbers.tolist()) if isinstance(value, tuple) else float(numbers), "deg/s", words)

    def _now(self, observation: Observation) -> Value | None:
        seen = observation.facts.get(self.fact)
        value = None if seen is None else seen.value
        if not self.component or value is None:
            return value
        return value[self.component - 1] if isinstance(value, tuple) and self.component <= len(value) else None

    def _near_all(self, value: Value) -> bool:
        if not isinstance(value, tuple) or not isinstance(self.value, tuple) or len(value) != len(self.value):
            return False
        within = self.tolerance or 0.0
        return all(is_near(one, other, within) for one, other in zip(value, self.value, strict=True))


def _begun(title: str) -> str:
    """Return a title as it begins a sentence: a formula stays as it is, since R is not r.

    >>> _begun("the rank of J"), _begun("a root"), _begun("x(t)"), _begun("r of the planar 3R"), _begun("a of link 2")
    ('The rank of J', 'A root', 'x(t)', 'r of the planar 3R', 'a of link 2')
    """
    return f"{title[:1].upper()}{title[1:]}" if _WORD.match(title) else title


def _ended(sentence: str) -> str:
    """Return a sentence with its full stop; a value that is a question has its own sign."""
    return sentence if sentence.endswith("?") else f"{sentence}."


def _why_unknown(seen: SeenFact | None) -> str:
    """Return why a fact, or the component of it that is asked for, has no value."""
    if seen is None or (seen.value is None and seen.slow):
        return "not known yet"
    if isinstance(seen.value, tuple) and seen.value:
        count = len(seen.value)
        return f"there are only {count} components" if count > 1 else "there is only one component"
    return "not there yet, or this arm does not have it"


def read(table: Table, robot: Robot) -> FactIs:
    """Read ``fact``; ``value`` with ``tolerance``, or ``at_least`` and ``at_most``; ``component``.

    Numbers of a fact that is an angle may be in degrees: ``value_deg``, ``tolerance_deg`` and so on, all of them then.
    """
    fields = Fields.of(table)
    fact = fact_name(fields, "fact")
    component = fields.whole("component", 1, MOST_COMPONENTS) if fields.has("component") else 0
    keys = [key for name in _NAMES for key in (name, f"{name}_deg") if fields.has(key)]
    degrees = any(key.endswith("_deg") for key in keys)
    if degrees and not all(key.endswith("_deg") for key in keys):
        raise fields.fail(keys[0], "expected all numbers in degrees, or none")
    unit, factor = ("_deg", math.radians(1.0)) if degrees else ("", 1.0)
    value = _value(fields, f"value{unit}", factor)
    tolerance, least, most = (_end(fields, f"{name}{unit}", factor) for name in _NAMES[1:])
    if (value is None) == (least is None and most is None):
        raise fields.fail(f"value{unit}", "expected either value, or at_least and at_most or one of them")
    if tolerance is not None and (value is None or isinstance(value, (str, bool)) or tolerance < 0.0):
        raise fields.fail(f"tolerance{unit}", "expected a number not below zero, with a value that is a number")
    if least is not None and most is not None and least > most:
        raise fields.fail(f"at_most{unit}", f"expected at least {least / factor:g}, got {most / factor:g}")
    for key in ("fact", "component", *(f"{name}{end}" for name in _NAMES for end in ("", "_deg"))):
        table.has(key)  # what was taken here is known to the table given, too
    return FactIs(fact, component, value, tolerance, least, most, degrees)


_NAMES = ("value", "tolerance", "at_least", "at_most")


def _end(fields: Fields, key: str, factor: float) -> float | None:
    return fields.number(key) * factor if fields.has(key) else None


def _value(fields: Fields, key: str, factor: float) -> Value | None:
    """Take a number, a list of numbers, a text, or true or false."""
    if not fields.has(key):
        return None
    value = fields.value(key)
    if isinstance(value, list) and 1 <= len(value) <= MOST_COMPONENTS:
        return tuple((fields.numbers(key, len(value)) * factor).tolist())
    if isinstance(value, (str, bool)) and factor == 1.0:
        return value
    if isinstance(value, (list, dict, str, bool)):
        raise fields.fail(key, f"expected a number or a list of numbers, got {shown(value)}")
    return fields.number(key) * factor


CHECK = CheckType("fact", 80, read)
