"""The kinds of timing laws, found by folder, and the bounds within which one is as fast as allowed."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

from armlab.errors import InputError, UnknownName
from armlab.kin import timing as _folder
from armlab.kin.checks import as_floats, wrong
from armlab.kin.motion.field import Field, checked_options, positive
from armlab.kin.motion.law import Law
from armlab.plugins import discover

SMOOTH_ENOUGH = 2
"""The class from and to rest for which the jerk is finite everywhere."""

JERK_REMARK = "The acceleration jumps, so the jerk is infinite there: the limit of jerk is not kept."


@dataclass(frozen=True)
class Limits:
    """Bounds of a timing law.

    Attributes
    ----------
    speed, acceleration, jerk : float
        Of |s'|, |s''|, |s'''|; infinite where there is none.
    """

    speed: float = math.inf
    acceleration: float = math.inf
    jerk: float = math.inf

    @classmethod
    def checked(cls, speed: Any, acceleration: Any, jerk: Any) -> Limits:
        """Return limits; `InputError` for one that is not positive, or when all are infinite."""
        found = []
        for where, value in (("speed", speed), ("acceleration", acceleration), ("jerk", jerk)):
            number = as_floats(value, f"limit of {where}", "a positive number")
            if number.shape != () or not number > 0.0:
                raise wrong(f"limit of {where}", "a positive number", value)
            found.append(float(number))
        if all(map(math.isinf, found)):
            raise InputError("limits: at least one of speed, acceleration and jerk must be finite")
        return cls(*found)

    def slowest(self, law: Law) -> float:
        """Return the factor k by which a law must be stretched so that one limit is met and none exceeded.

        The limit of jerk does not count for a law whose acceleration jumps: it cannot be kept there.

        References
        ----------
        Notes 6.163, with the cube root for the jerk.
        """
        smooth = law.continuity_from_rest >= SMOOTH_ENOUGH
        by_jerk = math.cbrt(law.peak_jerk / self.jerk) if smooth else 0.0
        return max(law.peak_speed / self.speed, math.sqrt(law.peak_acceleration / self.acceleration), by_jerk)


Make = Callable[[float, float, dict[str, Any]], Law]
Fastest = Callable[[Limits, float, dict[str, Any]], Law]


@dataclass(frozen=True)
class LawType:
    """One kind of timing law, the constant ``LAW`` of a module in `armlab.kin.timing`.

    Attributes
    ----------
    key, title : str
        Short name for programs, name of the field for people.
    order : int
        Place in lists.
    make : callable
        ``make(duration, distance, options) -> Law``.
    fastest : callable, optional
        ``fastest(limits, distance, options) -> Law``: as fast as allowed. Left out: ``make`` stretched to the limits.
    fields : tuple of Field
        Options.
    needs : tuple of str
        Limits without which there is no fastest law: of ``"speed"``, ``"acceleration"``, ``"jerk"``.
    """

    key: str
    title: str
    order: int
    make: Make
    fastest: Fastest | None = None
    fields: tuple[Field, ...] = ()
    needs: tuple[str, ...] = ()

    def law(self, duration: float = 1.0, distance: float = 1.0, **options: Any) -> Law:
        """Return the law of a duration.

        Parameters
        ----------
        duration : float
            T, seconds, positive.
        distance : float
            What s grows to: 1, or a length.
        **options
            By the keys of ``fields``.

        Raises
        ------
        InputError
            Not positive, or a wrong option.
        """
        values = checked_options(self.key, self.fields, options)
        return self.make(positive(duration, "duration"), positive(distance, "distance"), values)

    def within(
        self,
        speed: float = math.inf,
        acceleration: float = math.inf,
        jerk: float = math.inf,
        distance: float = 1.0,
        **options: Any,
    ) -> Law:
        """Return the fastest law of this kind within bounds on |s'|, |s''| and |s'''|.

        Raises
        ------
        InputError
            A bound that is not positive, one that this law needs and that is missing, or a wrong option.
        """
        values = checked_options(self.key, self.fields, options)
        limits, length = Limits.checked(speed, acceleration, jerk), positive(distance, "distance")
        for need in self.needs:
            if math.isinf(getattr(limits, need)):
                raise InputError(f"limit of {need}: {self.title} needs one")
        law = self._fastest(limits, length, values)
        if math.isfinite(limits.jerk) and law.continuity_from_rest < SMOOTH_ENOUGH:
            law.remarks = (*law.remarks, JERK_REMARK)
        return law

    def _fastest(self, limits: Limits, length: float, values: dict[str, Any]) -> Law:
        if self.fastest is not None:
            return self.fastest(limits, length, values)
        law = self.make(1.0, length, values)
        k = limits.slowest(law)
        if k == 0.0:
            raise InputError(f"limits: none of those given can hold back {self.title}")
        return law.stretched(k)


@cache
def law_types() -> dict[str, LawType]:
    """Return all kinds of timing laws by key, in the order of lists."""
    return discover(_folder, "LAW", LawType)


def law_type(key: str) -> LawType:
    """Return a kind of timing law by key; `UnknownName` when there is none."""
    if not isinstance(key, str) or key not in law_types():
        raise UnknownName("law", key, law_types())
    return law_types()[key]
