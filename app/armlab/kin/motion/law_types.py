"""The kinds of timing laws, found by folder, and the limits within which a law is as fast as possible."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from armlab.errors import InputError
from armlab.kin import timing as _folder
from armlab.kin.arm import Arm
from armlab.kin.checks import wrong
from armlab.kin.field import Field, checked_options, positive
from armlab.kin.motion.along import fastest_along, moving_ends
from armlab.kin.motion.breaks import SMOOTH_ENOUGH
from armlab.kin.motion.law import Law
from armlab.kin.motion.limits import Limits, limits_of
from armlab.kin.motion.path import Path
from armlab.plugins import discover
from armlab.registry import Registry

SHORTEST, LONGEST = 1e-30, 1e30
"""Shortest and longest duration, seconds: powers of a time between them can be represented."""

Make = Callable[[float, float, dict[str, Any]], Law]
Fastest = Callable[[Limits, float, dict[str, Any]], Law]
OnPath = Callable[[Path, Limits, dict[str, Any]], Law]


@dataclass(frozen=True)
class LawType:
    """One kind of timing law, the constant ``LAW`` of a module in `armlab.kin.timing`.

    Attributes
    ----------
    key, title : str
        Short name for programs, name of the field for people.
    order : int
        Place in lists.
    make : callable, optional
        ``make(duration, distance, options) -> Law``. Left out by a law that depends on the path.
    fastest : callable, optional
        ``fastest(limits, distance, options) -> Law``: as fast as allowed. Left out: ``make`` stretched to the limits.
    fields : tuple of Field
        Options.
    needs : tuple of str
        Limits without which there is no fastest law: of ``"velocity"``, ``"acceleration"``, ``"jerk"``.
    on_path : callable, optional
        ``on_path(path, limits, options) -> Law``, of a law that depends on the path: as fast as the limits of velocity
        and acceleration of the joints allow.
    """

    key: str
    title: str
    order: int
    make: Make | None = None
    fastest: Fastest | None = None
    fields: tuple[Field, ...] = ()
    needs: tuple[str, ...] = ()
    on_path: OnPath | None = None

    def law(self, duration: float = 1.0, distance: float = 1.0, **options: Any) -> Law:
        """Return the law of a duration.

        Parameters
        ----------
        duration : float
            T, seconds, positive.
        distance : float
            Final value of s: 1, or a length.
        **options
            By the keys of ``fields``.

        Raises
        ------
        InputError
            Not positive, a wrong option, or a law that depends on the path.
        """
        values = checked_options(self.key, self.fields, options)
        return self._maker(computable(duration, "duration"), computable(distance, "distance"), values)

    def within(self, limits: Limits, distance: float = 1.0, **options: Any) -> Law:
        """Return the fastest law of this kind within limits of the derivatives of s.

        Parameters
        ----------
        limits : Limits
            Limits of the absolute values of the first, second and third derivative of s.
        distance : float
            Final value of s.
        **options
            By the keys of ``fields``.

        Raises
        ------
        InputError
            No limit that holds it back, one that this law needs and that is missing, one that it cannot keep in any
            time, a wrong option, or a law that depends on the path.
        """
        law = self.shaped(limits, distance, **options)
        smooth = law.continuity_with(moving_ends(options))
        _, acceleration, jerk = limits.bounded
        if acceleration and smooth < 1:
            raise InputError(f"limit of acceleration: {jumping(self.title, 'speed')}")
        if jerk and smooth < SMOOTH_ENOUGH:
            raise InputError(f"limit of jerk: {jumping(self.title, 'acceleration')}")
        return law

    def shaped(self, limits: Limits, distance: float = 1.0, **options: Any) -> Law:
        """Return the same as `within`, but ignore a limit that this law cannot keep at any duration."""
        values = checked_options(self.key, self.fields, options)
        limits, length = limits.for_joints(1).of_joint(0), computable(distance, "distance")
        if not any(limits.bounded):
            raise InputError("limits: at least one of velocity, acceleration and jerk must be finite")
        for need in self.needs:
            if math.isinf(getattr(limits, need)):
                raise InputError(f"limit of {need}: {self.title} needs one")
        # An overflow here is refused below with a sentence.
        with np.errstate(all="ignore"):
            law = self._fastest(limits, length, values)
        computable(law.duration, "limits: the time within them")
        return law

    def along(
        self, path: Path, limits: Limits | Arm, *, shape: Limits | None = None, jumps: bool = False, **options: Any
    ) -> Law:
        """Return the fastest law of this kind along a path within the limits of the joints.

        The bounds of section 6.1.1 of the notes give the law its shape; they are safe and not sharp, so that it is then
        stretched until one limit is met. A law that depends on the path needs none of this.

        Parameters
        ----------
        path : Path
            A path in joint space.
        limits : Limits or Arm
            Limits of the joints; an arm stands for its own limits.
        shape : Limits, optional
            Limits from which a law takes its shape, such as a jerk by which it is rounded, but that need not be met;
            those of ``limits`` when left out.
        jumps : bool
            Where a derivative jumps no limit of the next one can be kept, which is refused. True: it is let through,
            and limits count between the jumps only.
        **options
            By the keys of ``fields``.

        Raises
        ------
        InputError
            A limit that is missing or cannot be kept, or a wrong option.
        """
        held = limits_of(limits, path.m)
        if self.on_path is None:
            shaping = held if shape is None else shape.for_joints(path.m)
            return fastest_along(self.title, self.shaped, path, held, shaping, jumps, options)
        if held.bounded[2] and not jumps:
            raise InputError(f"limit of jerk: {jumping(self.title, 'acceleration')}")
        values = checked_options(self.key, self.fields, options)
        return self.on_path(path, Limits(held.velocity, held.acceleration), values)

    @property
    def _maker(self) -> Make:
        if self.make is None:
            raise InputError(f"law: {self.title} depends on the path and the limits of the joints: use along")
        return self.make

    def _fastest(self, limits: Limits, length: float, values: dict[str, Any]) -> Law:
        if self.fastest is not None:
            return self.fastest(limits, length, values)
        law = self._maker(1.0, length, values)
        k = slowest(limits, law)
        if k == 0.0:
            raise InputError(f"limits: none of those given can hold back {self.title}")
        return law.stretched(k)


def slowest(limits: Limits, law: Law) -> float:
    """Return the factor k by which a law must be stretched so that one limit is met and none exceeded.

    The limit of jerk does not count for a law whose acceleration jumps: it cannot be kept there.

    References
    ----------
    Notes 6.163, with the cube root for the jerk.
    """
    smooth = law.continuity_from_rest >= SMOOTH_ENOUGH
    by_jerk = math.cbrt(law.peak_jerk / float(limits.jerk)) if smooth else 0.0
    by_acceleration = math.sqrt(law.peak_acceleration / float(limits.acceleration))
    return max(law.peak_speed / float(limits.velocity), by_acceleration, by_jerk)


def jumping(title: str, what: str) -> str:
    """Return a sentence why a law with a jumping derivative cannot keep a limit."""
    return f"the {what} of {title} jumps, so no time keeps it; take a smoother law, or no such limit"


def computable(value: object, where: str) -> float:
    """Return a positive number within the range of computation; `InputError` otherwise."""
    number = positive(value, where)
    if not SHORTEST <= number <= LONGEST:
        raise wrong(where, f"a number from {SHORTEST:g} to {LONGEST:g}", value)
    return number


@cache
def law_types() -> Registry[LawType]:
    """Return all kinds of timing laws by key, in the order of lists."""
    return discover(_folder, "LAW", LawType)


@cache
def free_law_types() -> dict[str, LawType]:
    """Return the kinds of laws that need no path, so that they can be shown and timed by themselves."""
    return {key: kind for key, kind in law_types().items() if kind.make is not None}


def law_type(key: str) -> LawType:
    """Return a kind of timing law by key; `UnknownName` when there is none."""
    return law_types()[key]
