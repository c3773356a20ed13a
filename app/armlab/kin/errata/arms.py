"""The small arms of the notes, in closed form, for the trials."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

STEP = 1e-6
"""Step of central differences, radians or metres."""


def point_2r(l1: float, l2: float, q: ArrayLike) -> Floats:
    """Return the tool of a planar 2R (notes 4.44), metres, shape (2,)."""
    q1, q2 = np.asarray(q, dtype=np.float64)
    return np.array([l1 * np.cos(q1) + l2 * np.cos(q1 + q2), l1 * np.sin(q1) + l2 * np.sin(q1 + q2)])


def jacobian_2r(l1: float, l2: float, q: ArrayLike) -> Floats:
    """Return the Jacobian of a planar 2R (notes 5.84), shape (2, 2)."""
    q1, q2 = np.asarray(q, dtype=np.float64)
    s1, c1, s12, c12 = np.sin(q1), np.cos(q1), np.sin(q1 + q2), np.cos(q1 + q2)
    return np.array([[-l1 * s1 - l2 * s12, -l2 * s12], [l1 * c1 + l2 * c12, l2 * c12]])


def point_polar(d1: float, q: ArrayLike) -> Floats:
    """Return the tool of the polar arm (notes 4.66), metres, shape (3,)."""
    q1, q2, q3 = np.asarray(q, dtype=np.float64)
    out = q3 * np.cos(q2)
    return np.array([out * np.cos(q1), out * np.sin(q1), d1 + q3 * np.sin(q2)])


def point_elbow(d1: float, l2: float, l3: float, q: ArrayLike) -> Floats:
    """Return the tool of the elbow arm (notes 4.83), metres, shape (3,)."""
    q1, q2, q3 = np.asarray(q, dtype=np.float64)
    out = l2 * np.cos(q2) + l3 * np.cos(q2 + q3)
    return np.array([out * np.cos(q1), out * np.sin(q1), d1 + l2 * np.sin(q2) + l3 * np.sin(q2 + q3)])


def differences(f: Callable[[Floats], Floats], q: ArrayLike, step: float = STEP) -> Floats:
    """Return the Jacobian of a function by central differences, shape (m, n)."""
    q = np.asarray(q, dtype=np.float64)
    steps = step * np.eye(len(q))
    return np.column_stack([(f(q + h) - f(q - h)) / (2.0 * step) for h in steps])
