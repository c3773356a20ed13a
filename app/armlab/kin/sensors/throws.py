"""Accuracy and repeatability of repeated attempts in a plane, and how well they are known from n of them.

Attempts to hit the origin are normally distributed about a point, the bias, with the same standard deviation, the
spread, in all directions. A small bias is called accuracy, a small spread repeatability. All lengths have one unit.

References
----------
Notes, sections 1.7 and 2.3.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats, finite_floats, whole_number, wrong

Floats = NDArray[np.float64]

MOST_THROWS = 10_000

CONFIDENCE = 0.95
"""Probability with which an interval found in this way holds the true value."""


def throws(count: int, bias: ArrayLike, spread: float, seed: int) -> Floats:
    """Return where attempts land.

    Parameters
    ----------
    count : int
        1 to `MOST_THROWS`.
    bias : array_like, shape (2,)
    spread : float
        Standard deviation along any direction, not negative.
    seed : int
        The same seed gives the same attempts; with a larger count the first of them stay.

    Returns
    -------
    ndarray, shape (count, 2)

    Raises
    ------
    InputError
        The arguments are not as above.
    """
    if whole_number(count, "throws", 1) > MOST_THROWS:
        raise wrong("throws", f"at most {MOST_THROWS}", count)
    centre = finite_floats(bias, "bias", (2,), "two finite numbers")
    if not (math.isfinite(spread) and spread >= 0.0):
        raise wrong("spread", "no negative number", spread)
    random = np.random.default_rng(whole_number(seed, "seed", 0))
    return np.asarray(centre + spread * random.standard_normal((count, 2)))


@dataclass(frozen=True, eq=False)
class Estimate:
    """Bias and spread as attempts tell them; see `estimate`.

    Attributes
    ----------
    count : int
    mean : ndarray, shape (2,)
        Their centre, the estimated bias.
    radius : float
        Radius of the circle about the centre that holds the bias with the confidence.
    spread : float
        Estimated standard deviation along a direction.
    low, high : float
        Interval that holds the spread with the confidence.
    """

    count: int
    mean: Floats
    radius: float
    spread: float
    low: float
    high: float

    @property
    def distance(self) -> float:
        """How far the centre is from the aim: the estimated error of accuracy."""
        return float(np.linalg.norm(self.mean))

    @property
    def settled(self) -> bool:
        """Whether the bias is not explained by chance: the aim is outside the circle."""
        return self.distance > self.radius


def estimate(points: ArrayLike, confidence: float = CONFIDENCE) -> Estimate:
    """Return bias and spread estimated from attempts, with their confidence.

    ``s^2 = sum |x - mean|^2 / (2 (n - 1))``; the mean is normal with the variance ``sigma^2 / n``, so that
    ``n |mean - bias|^2 / (2 s^2)`` has an F distribution with 2 and m = 2 (n - 1) degrees of freedom, whose quantile is
    known in closed form, and ``m s^2 / sigma^2`` a chi-squared one with m.

    Parameters
    ----------
    points : array_like, shape (n, 2)
        At least two.
    confidence : float
        Between 0 and 1.

    Raises
    ------
    InputError
        The arguments are not as above.
    """
    from scipy.special import chdtri  # type: ignore[import-untyped]

    at = as_floats(points, "throws", "rows of two numbers")
    if at.ndim != 2 or at.shape[1] != 2 or not np.isfinite(at).all():
        raise InputError(f"throws: expected rows of two finite numbers, got shape {at.shape}")
    count = len(at)
    if count < 2:
        raise InputError(f"throws: expected at least 2, since one alone has no spread, got {count}")
    if not 0.0 < confidence < 1.0:
        raise wrong("confidence", "a number between 0 and 1", confidence)
    # From the first on, so that equal attempts have exactly their own mean, and no spread.
    mean, m, rest = at[0] + (at - at[0]).mean(axis=0), 2 * (count - 1), 1.0 - confidence
    spread = math.sqrt(float(((at - mean) ** 2).sum()) / m)
    quantile = 0.5 * m * (rest ** (-2.0 / m) - 1.0)
    # chdtri(m, p) is what a chi-squared number exceeds with the probability p.
    low, high = (spread * math.sqrt(m / float(chdtri(m, p))) for p in (0.5 * rest, 1.0 - 0.5 * rest))
    return Estimate(count, mean, spread * math.sqrt(2.0 * quantile / count), spread, low, high)
