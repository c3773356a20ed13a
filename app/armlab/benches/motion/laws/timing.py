"""Timing laws for the bench of laws: made from the typed options, with the limits that they exceed."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from armlab.benches.motion.chosen import Chosen
from armlab.errors import InputError
from armlab.kin.field import Field
from armlab.kin.motion.breaks import SMOOTH_ENOUGH
from armlab.kin.motion.extremes import exceeding
from armlab.kin.motion.law import Law
from armlab.kin.motion.law_types import law_type
from armlab.kin.motion.limits import Limits
from armlab.kin.motion.series import series_of
from armlab.kin.timing.table import acceleration_law

SMALLEST, LARGEST = 1e-4, 1e6
"""Least and largest value of times, distances and limits, each in its unit, that can be drawn."""

HUGE = 1e24
"""Largest value of s and its derivatives; the septic over the longest distance in the shortest time stays below it."""

MOST_ROWS = 60
"""Largest number of rows of a typed table."""

QUANTITIES: tuple[Field, ...] = (
    Field("duration", "T", "duration", "number", 2.0, low=0.0, above=True, unit="s"),
    Field("distance", "L", "distance s goes", "number", 1.0, low=0.0, above=True),
    Field("speed", "V", "limit of speed; empty for none", "number", low=0.0, above=True, unit="1/s"),
    Field("acceleration", "A", "limit of acceleration; empty for none", "number", low=0.0, above=True, unit="1/s²"),
    Field("jerk", "J", "limit of jerk; empty for none", "number", low=0.0, above=True, unit="1/s³"),
)
"""Inputs for all laws together."""

LIMITS = ("speed", "acceleration", "jerk")
"""Names of the limits, in the order of the derivatives 1, 2, 3."""

AS_TYPED: Mapping[str, Callable[..., Law]] = MappingProxyType({"table": acceleration_law})
"""Functions that make the laws with their own time and distance from their options."""

END_SPEEDS = ("sdot_start", "sdot_end", "sdot_first")
"""Options of laws that may begin or end with a speed."""


@dataclass(frozen=True)
class Timing:
    """Duration, distance and limits of the laws.

    Attributes
    ----------
    fastest : bool
        Whether they are as fast as the limits allow, and not as long as the duration.
    duration, distance : float
        T in seconds, and L, a pure number.
    speed, acceleration, jerk : float or None
        V, A, J; None where there is no limit.
    """

    fastest: bool = False
    duration: float = 2.0
    distance: float = 1.0
    speed: float | None = 1.0
    acceleration: float | None = 2.0
    jerk: float | None = None

    def limit(self, order: int) -> float:
        """Return the limit of the derivative of order 1, 2 or 3; infinite if there is none."""
        value = getattr(self, LIMITS[order - 1])
        return math.inf if value is None else float(value)

    def with_quantity(self, name: str, value: Any) -> Timing:
        """Return the timing with one quantity set; `InputError` names one that is not positive or cannot be drawn."""
        field = next((each for each in QUANTITIES if each.key == name), None)
        if field is None:
            raise InputError(f"unknown quantity {name!r}. Available: {', '.join(each.key for each in QUANTITIES)}")
        if value is None and field.default is not None:
            raise InputError(f"{field.key} {field.symbol}: expected a positive number, got nothing")
        return replace(self, **{name: drawable(field, field.checked(value))})  # type: ignore[arg-type]


def drawable(field: Field, value: float | None) -> float | None:
    """Return a checked number; `InputError` if it is too small or too large to be drawn."""
    if value is not None and not SMALLEST <= value <= LARGEST:
        unit = "" if field.unit == "1" else f" {field.unit}"
        raise InputError(f"{field.key} {field.symbol}: expected 0.0001 to 1 000 000{unit}, got {value:g}{unit}")
    return value


@dataclass(frozen=True)
class Entry:
    """One law of the bench.

    Attributes
    ----------
    chosen : Chosen
        Of `armlab.kin.motion.law_types`.
    as_typed : bool
        Whether it is left as its options say, not stretched to the duration and the distance; see `AS_TYPED`.
    colour : int
        Place of its colour.
    """

    chosen: Chosen
    as_typed: bool = False
    colour: int = 0

    @property
    def title(self) -> str:
        """The name of the law."""
        return law_type(self.chosen.key).title

    @property
    def moving_ends(self) -> bool:
        """Whether the law begins or ends with a speed on purpose."""
        return any(self.chosen.options.get(name) for name in END_SPEEDS)


@lru_cache(maxsize=256)
def law_of(entry: Entry, timing: Timing) -> Law:
    """Return the law of an entry.

    Raises
    ------
    InputError
        The law cannot be made so; the text names the option or the limit.
    """
    kind, options = law_type(entry.chosen.key), entry.chosen.options
    if len(options.get("rows", ())) > MOST_ROWS:
        raise InputError(f"rows: expected at most {MOST_ROWS}, got {len(options['rows'])}")
    try:
        # What overflows here is said below in words.
        with np.errstate(all="ignore"):
            law = _made(entry, timing, options)
            sizes: tuple[float, ...] = (law.duration, *law.span, law.peak_speed, law.peak_acceleration, law.peak_jerk)
    except (OverflowError, ZeroDivisionError):
        sizes = (math.nan,)
    if not all(abs(size) <= HUGE for size in sizes) or not SMALLEST <= sizes[0] <= LARGEST:
        raise InputError(f"{kind.title}: with these numbers it would be too long, too short or too fast to be drawn")
    return law


def _made(entry: Entry, timing: Timing, options: dict[str, Any]) -> Law:
    kind = law_type(entry.chosen.key)
    if entry.as_typed:
        defaults = {field.key: field.default for field in kind.fields}
        return AS_TYPED[kind.key](**{**defaults, **options})
    if not timing.fastest:
        return kind.law(timing.duration, timing.distance, **options)
    # A limit that it cannot keep in any time is told beside it; see `excesses`.
    return kind.shaped(Limits(timing.limit(1), timing.limit(2), timing.limit(3)), timing.distance, **options)


def largest(law: Law, order: int) -> float:
    """Return the largest |derivative| of order 1 to 3 on [0, T]; infinite where the one below it jumps inside."""
    if law.continuity < order - 1:
        return math.inf
    return (law.peak_speed, law.peak_acceleration, law.peak_jerk)[order - 1]


class Excess(NamedTuple):
    """A limit that is exceeded.

    Attributes
    ----------
    order : int
        Of the derivative, 1 to 3.
    peak, limit : float
        ``peak`` is infinite where the derivative below it jumps.
    spans : tuple of (float, float)
        When, seconds; empty where only jumps exceed it.
    """

    order: int
    peak: float
    limit: float
    spans: tuple[tuple[float, float], ...]


@lru_cache(maxsize=256)
def excesses(entry: Entry, timing: Timing) -> tuple[Excess, ...]:
    """Return which limits the law of an entry exceeds, and when.

    A speed at an end is a jump only where the law is meant to begin and end at rest.
    """
    law = law_of(entry, timing)
    peaks = (law.peak_speed, law.peak_acceleration, law.peak_jerk)
    smooth = smoothness(entry, law)
    found = []
    for order, peak in enumerate(peaks, start=1):
        limit = timing.limit(order)
        if math.isinf(limit):
            continue
        spans = _spans(law, order, limit)
        jumps = smooth < min(order - 1, SMOOTH_ENOUGH)
        if spans or jumps:
            found.append(Excess(order, math.inf if jumps else peak, limit, spans))
    return tuple(found)


def smoothness(entry: Entry, law: Law) -> float:
    """Return the class of the law of an entry, with rest before and after it unless it is to move at its ends."""
    return law.continuity if entry.moving_ends else law.continuity_from_rest


def _spans(law: Law, order: int, limit: float) -> tuple[tuple[float, float], ...]:
    degree = None if law.degree is None else max(law.degree - order, 0)
    series = series_of(lambda t: law.at(t, order)[:, None], law.edges, degree)
    return tuple(exceeding(series, np.array([limit]))[0])


class Phases(NamedTuple):
    """A law of constant accelerations with three phases: speed up, constant speed, slow down.

    Attributes
    ----------
    up, coast, down : float
        Seconds; ``coast`` is 0 in a triangle of speed.
    peak : float
        The largest speed.
    """

    up: float
    coast: float
    down: float
    peak: float

    @property
    def triangle(self) -> bool:
        """Whether there is no phase of constant speed."""
        return self.coast == 0.0


STILL = 1e-9
"""Ratio to the largest acceleration below which one counts as zero."""


def phases(law: Law) -> Phases | None:
    """Return the phases of a trapezoid or triangle of speed, or None for another law, such as one that turns back.

    References
    ----------
    Notes 6.104-6.113.
    """
    if law.degree != 2 or not law.monotone:
        return None
    middles = 0.5 * (law.edges[1:] + law.edges[:-1])
    values = law.at(middles, 2)
    signs = np.where(np.abs(values) <= STILL * law.peak_acceleration, 0, np.sign(values)).astype(int)
    if len(signs) > 3 or np.any(np.diff(signs) >= 0) or not signs.any():
        return None
    times = dict(zip(signs.tolist(), np.diff(law.edges).tolist(), strict=True))
    return Phases(times.get(1, 0.0), times.get(0, 0.0), times.get(-1, 0.0), law.peak_speed)
