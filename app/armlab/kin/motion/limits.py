"""Limits of the derivatives of coordinates: velocity, acceleration and jerk, in one form for all motions."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import as_floats, wrong

Floats = NDArray[np.float64]

NAMES = ("velocity", "acceleration", "jerk")
"""Names of the limited derivatives of order 1, 2, 3."""

LEAST, MOST = 1e-60, 1e60
"""Smallest and largest finite limit: products of times computed from others would leave the range of numbers."""


@dataclass(frozen=True, eq=False, init=False)
class Limits:
    """Limits of the absolute values of rates; infinite where there is none.

    Those of joints are in rad/s and m/s, and so on; those of a timing law s(t) in 1/s, 1/s², 1/s³.

    Parameters
    ----------
    velocity, acceleration, jerk : array_like, shape () or (m,)
        Positive; one number stands for all coordinates. Infinite when left out.

    Attributes
    ----------
    velocity, acceleration, jerk : ndarray, shape () or (m,)

    Raises
    ------
    InputError
        Not positive, or so small or so large that nothing can be computed with it; the text names the joint.

    Examples
    --------
    >>> Limits(velocity=2.0, acceleration=[4.0, 8.0])
    Limits(velocity=2.0, acceleration=[4.0, 8.0])
    """

    velocity: Floats
    acceleration: Floats
    jerk: Floats

    def __init__(
        self, velocity: ArrayLike = math.inf, acceleration: ArrayLike = math.inf, jerk: ArrayLike = math.inf
    ) -> None:
        for name, values in zip(NAMES, (velocity, acceleration, jerk), strict=True):
            object.__setattr__(self, name, _checked(values, name))

    @classmethod
    def of(
        cls,
        arm: Arm,
        velocity: ArrayLike | None = None,
        acceleration: ArrayLike | None = None,
        jerk: ArrayLike | None = None,
    ) -> Limits:
        """Return the limits of an arm, with those given in their place."""
        return cls(
            arm.speed_limits if velocity is None else velocity,
            arm.acceleration_limits if acceleration is None else acceleration,
            math.inf if jerk is None else jerk,
        ).for_joints(arm.n)

    def for_joints(self, m: int) -> Limits:
        """Return the same limits with one number for each of m joints; `InputError` if they are for another number."""
        each = []
        for name, values in zip(NAMES, self.each, strict=True):
            if values.shape not in ((), (m,)):
                raise wrong(f"limit of {name}", f"one number, or {m}: one for each joint", values)
            each.append(np.broadcast_to(values, (m,)))
        return Limits(*each)

    def of_joint(self, j: int) -> Limits:
        """Return the limits of one joint, counted from 0."""
        return Limits(*(values if values.shape == () else values[j] for values in self.each))

    @property
    def each(self) -> tuple[Floats, Floats, Floats]:
        """The limits of velocity, acceleration and jerk, each one number or (m,)."""
        return self.velocity, self.acceleration, self.jerk

    @property
    def bounded(self) -> tuple[bool, bool, bool]:
        """Whether there is a finite limit of velocity, acceleration and jerk."""
        v, a, j = (bool(np.isfinite(values).any()) for values in self.each)
        return v, a, j

    def __repr__(self) -> str:
        given = zip(NAMES, self.each, self.bounded, strict=True)
        return f"Limits({', '.join(f'{name}={values.tolist()}' for name, values, finite in given if finite)})"


def limits_of(limits: Limits | Arm, m: int) -> Limits:
    """Return limits with a number for each of m joints; an arm stands for its own.

    Raises
    ------
    InputError
        Neither, of another number of joints, or an arm without any limit of speed or acceleration.
    """
    if isinstance(limits, Arm):
        own = Limits.of(limits)
        if not any(own.bounded):
            name = limits.name or "this arm"
            raise InputError(f"limits: {name} has none of its own; give Limits(velocity=..., acceleration=...)")
        return own.for_joints(m)
    if not isinstance(limits, Limits):
        raise wrong("limits", "Limits(velocity=..., acceleration=..., jerk=...) or an arm", limits)
    return limits.for_joints(m)


def _checked(values: ArrayLike, name: str) -> Floats:
    where = f"limit of {name}"
    array = as_floats(values, where, "a positive number, or one for each joint")
    if array.ndim > 1:
        raise wrong(where, "a positive number, or one for each joint", values)
    for j, value in enumerate(np.atleast_1d(array).tolist()):
        whose = where if array.ndim == 0 else f"{where} of joint {j + 1}"
        if not value > 0.0:
            raise wrong(whose, "a positive number", value)
        if math.isfinite(value) and not LEAST <= value <= MOST:
            raise wrong(whose, f"a number from {LEAST:g} to {MOST:g}", value)
    array.setflags(write=False)
    return array
