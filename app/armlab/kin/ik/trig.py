"""The trigonometric equations at the end of closed forms, with all their special cases."""

from __future__ import annotations

import math
from dataclasses import dataclass

ZERO = 1e-11
"""Size, relative to the terms, below which a coefficient counts as zero."""

NEARLY = 1e-3
"""Excess of c over sqrt(a² + b²), relative to the size of the terms, up to which the angle between the two solutions
that have just vanished is still given. The target is then out of reach by so little that forward kinematics has to
decide."""

DOUBLE = 1e-14
"""Size of a² + b² − c², relative to its terms, below which two solutions count as one: they are then 1e-7 rad apart,
and rounding decides whether they are real."""


@dataclass(frozen=True)
class Angles:
    """The solutions of an equation in one angle.

    Attributes
    ----------
    values : tuple of float
        Angles in (-pi, pi], radians: none, one, or two, with the plus sign of the root first.
    every : bool
        Whether every angle is a solution; ``values`` is then empty.
    """

    values: tuple[float, ...] = ()
    every: bool = False


def wrap(angle: float) -> float:
    """Return the angle in (-pi, pi] that differs by whole turns.

    >>> wrap(-math.pi) == math.pi
    True
    """
    wrapped = math.remainder(angle, math.tau)
    return math.pi if wrapped <= -math.pi else wrapped


def sine_cosine(a: float, b: float, c: float, size: float | None = None, root: float | None = None) -> Angles:
    """Return the angles with a sin(theta) + b cos(theta) = c.

    ``theta = atan2(a, b) ± atan2(sqrt(a² + b² − c²), c)``, which needs no case for b + c = 0. The half-angle formula of
    the notes, u = (a ± sqrt(a² + b² − c²)) / (b + c), divides by zero there: see `half_tangents`.

    Parameters
    ----------
    a, b, c : float
        Coefficients, all in one unit.
    size : float, optional
        The size of the terms the coefficients were made from, in the same unit; the largest of them when left out.
        Values smaller than `ZERO` times this size are zero.
    root : float, optional
        sqrt(a² + b² − c²), where the caller knows it better than the difference of squares does.

    Returns
    -------
    Angles
        Every angle where a = b = c = 0; none where a² + b² < c² by more than `NEARLY`; one where they are nearly equal.

    References
    ----------
    Notes 4.24-4.38; the numerator of 4.29 has a term too many, and 4.35 misses b + c = 0.

    Examples
    --------
    >>> [round(theta, 6) for theta in sine_cosine(0.0, 1.0, 0.5).values]
    [1.047198, -1.047198]
    >>> sine_cosine(0.0, 1.0, 2.0).values
    ()
    """
    r = math.hypot(a, b)
    size = max(r, abs(c)) if size is None else size
    if r <= ZERO * size:
        return Angles(every=abs(c) <= ZERO * size)
    if abs(c) - r > NEARLY * size:
        return Angles()
    if root is None:
        square = (r - c) * (r + c)
        root = math.sqrt(square) if square > DOUBLE * r * r else 0.0
    middle, half = math.atan2(a, b), math.atan2(root, c)
    if root == 0.0:
        return Angles((wrap(middle + half),))
    return Angles((wrap(middle + half), wrap(middle - half)))


def half_tangents(a: float, b: float, c: float) -> tuple[float, ...]:
    """Return u = tan(theta / 2) of the solutions of a sin(theta) + b cos(theta) = c, infinity for theta = pi.

    The roots of (b + c) u² − 2 a u + (c − b) = 0. With b + c = 0 the equation is linear: one root goes to infinity,
    theta = pi, and the other is −b / a. Neither root is taken as a difference of nearly equal numbers.

    References
    ----------
    Notes 4.33-4.38, corrected.

    Examples
    --------
    >>> half_tangents(1.3, -0.4, 0.4)
    (inf, 0.3076923076923077)
    """
    square = a * a + b * b - c * c
    if square < 0.0:
        return ()
    far = a + math.copysign(math.sqrt(square), a)
    if far == 0.0:  # a = 0 and b = ±c: both roots at theta = 0 or at theta = pi
        return (0.0, 0.0) if b + c != 0.0 else (math.inf, math.inf)
    first = far / (b + c) if b + c != 0.0 else math.inf
    return first, (c - b) / far
