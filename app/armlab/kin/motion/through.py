"""Orientation through several waypoints: smooth where the path of the tool is, about one axis from corner to corner."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from numpy.polynomial.polynomial import polyval
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats
from armlab.kin.motion.knots import checked_times
from armlab.kin.motion.orientation import Orientation, about_one_axis
from armlab.kin.motion.piecewise import Piecewise
from armlab.kin.rotations import as_rotation, skew

Floats = NDArray[np.float64]

SAME_PLACE = 1e-9
"""Difference in s below which a waypoint lies at a corner."""

STEEPEST = 3.0
"""Angular speed at a waypoint, relative to the slower turn beside it, up to which turns in one sense about one axis do
not swing beyond their ends (Fritsch and Carlson, *Monotone Piecewise Cubic Interpolation*, 1980). Where the sense
changes they may, as a spline of positions does."""

NEAR, TERMS = 1.0, 10
"""Square of the angle up to which the coefficients of `_coefficients` are sums of powers, and the number of powers;
what is left out is below 1e-17."""


class Through(Orientation):
    """A rotation spline: from each waypoint to the next R_k exp(S(p(s))), with p(s) a cubic.

    The angular velocity is continuous but for the corners. At a waypoint in between it is the mean of those of the
    turns about one axis before and behind it, weighted with the length of the other, and at most `STEEPEST` times that
    of the slower; the ends have those of their turn. So a tool with the same orientation at two waypoints keeps it in
    between, and from corner to corner it turns about one axis.

    Parameters
    ----------
    rotations : array_like, shape (N, 3, 3)
    places : array_like, shape (N,), optional
        s of each, increasing from 0 to 1; evenly spaced when left out.
    corners : array_like, shape (c,), optional
        Places at which the path of the tool has a corner: there the angular velocity may jump, too.

    Raises
    ------
    InputError
        Fewer than two, not rotations (the text names the waypoint), or wrong places.

    References
    ----------
    The Hermite cubics of rotation vectors are those of Kang and Park, *Cubic spline algorithms for orientation
    interpolation*, 1999; rates from the neighbours, not from a system of equations, exist for turns of any angle.
    """

    def __init__(self, rotations: ArrayLike, places: ArrayLike | None = None, corners: ArrayLike | None = None) -> None:
        matrices = as_floats(rotations, "rotations", "3 x 3 matrices")
        if matrices.ndim != 3 or len(matrices) < 2:
            raise InputError(f"rotations: expected at least two 3 x 3 matrices, got shape {matrices.shape}")
        count = len(matrices)
        s = np.linspace(0.0, 1.0, count) if places is None else checked_times(places, count, "places")
        if s[0] != 0.0 or s[-1] != 1.0:
            raise InputError(f"places: expected the first 0 and the last 1, got {s[0]:g} and {s[-1]:g}")
        each = [as_rotation(R, f"waypoint {k}") for k, R in enumerate(matrices, 1)]
        turns = [about_one_axis(a, b) for a, b in pairwise(each)]
        self.pieces = s[1:-1]
        at = np.zeros(0) if corners is None else as_floats(corners, "corners", "numbers from 0 to 1").ravel()
        sharp = np.asarray((np.abs(self.pieces[:, None] - at) < SAME_PLACE).any(axis=1))
        self.corners = self.pieces[sharp]
        self.remarks = tuple(
            f"Between waypoints {k} and {k + 1}: {remark}" for k, turn in enumerate(turns, 1) for remark in turn.remarks
        )
        self._starts = np.array([turn.start for turn in turns])
        self._vectors = _cubics(s, np.array([turn.axis * turn.angle for turn in turns]), sharp)

    def rotation(self, s: ArrayLike) -> Floats:
        """Return R(s)."""
        values = np.asarray(s, dtype=float)
        (p,) = self._vectors.at(values, (0,))
        first, second, _, _, _ = _coefficients(p)
        S = skew(p)
        turned = np.eye(3) + first[..., None] * S + second[..., None] * (S @ S)
        return np.asarray(self._starts[self._piece(values)] @ turned)

    def angular(self, s: ArrayLike) -> tuple[Floats, Floats]:
        """Return omega and its derivative, (..., 3) each, at a waypoint those behind it."""
        values = np.asarray(s, dtype=float)
        p, dp, ddp = self._vectors.at(values, (0, 1, 2))
        _, second, third, second_rate, third_rate = _coefficients(p)
        once, twice = np.cross(p, dp), np.cross(p, np.cross(p, dp))
        omega = dp + second * once + third * twice
        grown = 2.0 * np.sum(p * dp, axis=-1, keepdims=True)
        bent = second * np.cross(p, ddp) + third * (np.cross(dp, once) + np.cross(p, np.cross(p, ddp)))
        change = ddp + bent + grown * (second_rate * once + third_rate * twice)
        start = self._starts[self._piece(values)]
        return (start @ omega[..., None])[..., 0], (start @ change[..., None])[..., 0]

    def _piece(self, s: Floats) -> NDArray[np.intp]:
        return np.asarray(np.searchsorted(self.pieces, s, side="right"))


def _cubics(s: Floats, turned: Floats, sharp: NDArray[np.bool_]) -> Piecewise:
    """Return the rotation vectors p(s) from each waypoint to the next.

    Parameters
    ----------
    s : ndarray, shape (N,)
        Places of the waypoints.
    turned : ndarray, shape (N-1, 3)
        Rotation vectors from each to the next, in its axes, which are also those of the next.
    sharp : ndarray of bool, shape (N-2,)
        Which of those in between are corners.
    """
    h = np.diff(s)[:, None]
    rates = turned / h
    before, behind = rates[:-1], rates[1:]
    mean = (h[1:] * before + h[:-1] * behind) / (h[:-1] + h[1:])
    slower = np.minimum(*(np.linalg.norm(each, axis=-1, keepdims=True) for each in (before, behind)))
    size = np.linalg.norm(mean, axis=-1, keepdims=True)
    mean = mean * np.minimum(1.0, STEEPEST * slower / np.where(size > 0.0, size, 1.0))
    starts = np.concatenate([rates[:1], np.where(sharp[:, None], behind, mean)])
    ends = np.concatenate([np.where(sharp[:, None], before, mean), rates[-1:]])
    _, second, third, _, _ = _coefficients(turned)
    S = skew(turned)
    # The angular velocity in the axes of the tool is this matrix times the derivative of p.
    ends = np.linalg.solve(np.eye(3) - second[..., None] * S + third[..., None] * (S @ S), ends[..., None])[..., 0]
    cubic = [
        np.zeros_like(rates),
        starts,
        (3.0 * rates - 2.0 * starts - ends) / h,
        (starts + ends - 2.0 * rates) / h**2,
    ]
    return Piecewise(s, np.stack(cubic, axis=1))


def _coefficients(p: Floats) -> list[Floats]:
    """Return A, B, C, dB/dx and dC/dx of rotation vectors (..., 3), with x = p·p, (..., 1) each.

    exp(S(p)) = I + A S + B S^2, and I + B S + C S^2 is its left Jacobian: A = sin(φ)/φ, B = (1 - cos(φ))/φ^2,
    C = (φ - sin(φ))/φ^3 with φ = |p|.
    """
    x = np.sum(p * p, axis=-1, keepdims=True)
    near = x < NEAR
    far = np.where(near, NEAR, x)
    phi = np.sqrt(far)
    A = np.sin(phi) / phi
    B, C = (1.0 - np.cos(phi)) / far, (1.0 - A) / far
    closed = A, B, C, (0.5 * A - B) / far, (0.5 * (A - np.cos(phi)) / far - C) / far
    small = np.where(near, x, 0.0)
    return [np.where(near, polyval(small, powers), value) for powers, value in zip(POWERS, closed, strict=True)]


def _powers(first: int) -> Floats:
    return np.array([(-1.0) ** k / math.factorial(2 * k + first) for k in range(TERMS)])


POWERS = [_powers(1), _powers(2), _powers(3), *(_powers(k)[1:] * np.arange(1.0, TERMS) for k in (2, 3))]
