"""Real roots of an equation in the last of three joints, at most of degree four in its value or half-angle tangent."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from armlab.kin.ik.trig import NEARLY, sine_cosine, wrap

FLAT = 1e-12
"""Size of a coefficient, relative to the samples it is computed from, below which it counts as zero."""

NEAR_REAL = 3e-3
"""Distance from the real line (or unit circle) up to which a root is examined: rounding separates merging roots."""

SMALL = 1e-6
"""Value of the equation, relative to its terms, below which a real number near a root is examined: forward kinematics
decides."""


@dataclass(frozen=True)
class Roots:
    """The real roots, or the statement that every value is a root."""

    values: tuple[float, ...] = ()
    every: bool = False


def roots(f: Callable[[float], float], revolute: bool, size: float, length: float) -> Roots:
    """Return the real roots of a trigonometric polynomial of degree two, or of a polynomial of degree four.

    Parameters
    ----------
    f : callable
    revolute : bool
        Whether f is a trigonometric polynomial of the value of a turn, or a polynomial of the value of a slide.
    size : float
        The size of the terms f is the sum of.
    length : float
        For slides, metres: the size of values of interest.
    """
    return _of_turn(f, size) if revolute else _of_slide(f, size, length)


def _of_turn(f: Callable[[float], float], size: float) -> Roots:
    samples = np.array([f(2.0 * math.pi * k / 5.0) for k in range(5)])
    first, second = (
        complex(2.0 / 5.0 * np.sum(samples * np.exp(-2j * np.pi * m * np.arange(5) / 5.0))) for m in (1, 2)
    )
    mean = float(samples.mean())
    if abs(second) <= FLAT * size:
        found = sine_cosine(-first.imag, first.real, -mean, size)
        return Roots(found.values, found.every)
    # With z = exp(i q) the equation is Re(second z² + first z) + mean = 0; times z² it is a polynomial.
    coefficients = [second / 2, first / 2, mean, first.conjugate() / 2, second.conjugate() / 2]
    near = [z for z in np.roots(coefficients) if abs(abs(z) - 1.0) < NEAR_REAL]
    starts = [float(np.angle(z)) for z in near]
    return Roots(_polished(starts, f, size, 1e-4, wrapping=True))


def _of_slide(f: Callable[[float], float], size: float, length: float) -> Roots:
    nodes = np.array([-1.0, -0.5, 0.0, 0.5, 1.0])
    samples = np.array([f(length * x) for x in nodes])
    coefficients = np.linalg.solve(np.vander(nodes, 5), samples)
    large = np.abs(coefficients) > 1e2 * FLAT * size
    if not large.any():
        return Roots(every=True)
    kept = coefficients[int(np.argmax(large)) :]
    if len(kept) == 3:
        return Roots(_of_square(kept.tolist(), length, size))
    near = [x for x in np.roots(kept) if abs(x.imag) < NEAR_REAL * (1.0 + abs(x))]
    return Roots(_polished([length * float(x.real) for x in near], f, size, 1e-4 * length, wrapping=False))


def _of_square(coefficients: Sequence[float], length: float, size: float) -> tuple[float, ...]:
    """Return the roots of a square equation, the middle where they have just vanished by rounding of terms of a size.

    Two however near: in an arm that is nearly special the other joints may tell them apart.
    """
    a, b, c = coefficients
    square = b * b - 4.0 * a * c
    scale = b * b + 4.0 * abs(a) * size
    if square < -NEARLY * scale:
        return ()
    if square <= 0.0:
        return (-b / (2.0 * a) * length,)
    far = -(b + math.copysign(math.sqrt(square), b)) / 2.0
    return (far / a * length, c / far * length)


def _polished(
    starts: Sequence[float], f: Callable[[float], float], size: float, h: float, wrapping: bool
) -> tuple[float, ...]:
    """Return the starts improved by secant steps, without those that are no roots."""
    found = []
    for x in starts:
        for _ in range(3):
            slope = (f(x + h) - f(x - h)) / (2.0 * h)
            step = -f(x) / slope if slope != 0.0 else 0.0
            if abs(step) < 10.0 * h and abs(f(x + step)) < abs(f(x)):
                x += step
        if abs(f(x)) <= SMALL * size:
            found.append(wrap(x) if wrapping else x)
    return tuple(found)
