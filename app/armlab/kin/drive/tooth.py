"""Teeth of a spur gear as a straight-sided rack cuts them: involute flanks, and below them what its corners leave.

All lengths are in modules: a wheel of z teeth has the pitch radius z/2. A rack whose flanks are inclined by the
pressure angle rolls on that circle and cuts the gaps. Its flanks leave involutes of the base circle, and its corners
leave trochoids, which undercut a wheel of few teeth. Wheels made by one rack turn together without interference.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.checks import whole_between

Floats = NDArray[np.float64]

PRESSURE_ANGLE = math.radians(20.0)
"""Inclination of the flanks of the rack, radians."""

ADDENDUM, DEDENDUM = 1.0, 1.25
"""Height of a tooth above the pitch circle and depth of a gap below it, modules (ISO 53)."""

FEWEST, MOST = 6, 200
"""Numbers of teeth that a wheel may have: with fewer than 6 no flank would be left below the pitch circle."""

FLANK = 7
"""Number of points of a flank."""

CORNER = math.pi / 4.0 - DEDENDUM * math.tan(PRESSURE_ANGLE)
"""Distance of a corner of the rack's tooth from the middle of that tooth, modules."""


def tooth_count(teeth: object, where: str) -> int:
    """Return a checked number of teeth.

    Raises
    ------
    InputError
        No whole number, or outside `FEWEST` to `MOST`.
    """
    return whole_between(teeth, where, FEWEST, MOST)


def undercut(teeth: int) -> bool:
    """Return whether the rack undercuts a wheel: whether it has fewer than 2/sin² 20° = 17.1 teeth."""
    return teeth < 2.0 * ADDENDUM / math.sin(PRESSURE_ANGLE) ** 2


def half_gap(teeth: int, radius: ArrayLike) -> Floats:
    """Return half the angle of a gap at a distance from the axis.

    The involute through the pitch point leaves ``pi/(2 z) + inv(phi) - inv(alpha)``, with ``cos(phi) = r_b/rho`` and
    ``inv(x) = tan(x) - x``. The corner of the rack passes at ``xi_c/r + atan(s/r_f) - s/r`` with
    ``s² = rho² - r_f²``, r and r_f the pitch and root radius. The wider of both is the gap.

    Parameters
    ----------
    teeth : int
    radius : array_like, shape (...)
        From root to tip, modules.

    Returns
    -------
    ndarray, shape (...)
        Radians.

    References
    ----------
    Litvin and Fuentes, *Gear Geometry and Applied Theory*, 2004, chapters 5 and 6.
    """
    rho = np.asarray(radius, dtype=np.float64)
    r, root = teeth / 2.0, teeth / 2.0 - DEDENDUM
    base = r * math.cos(PRESSURE_ANGLE)
    s = np.sqrt(np.maximum(rho**2 - root**2, 0.0))
    corner = CORNER / r + np.arctan2(s, root) - s / r
    phi = np.arccos(np.minimum(base / np.maximum(rho, base), 1.0))
    involute = np.pi / (2.0 * teeth) + np.tan(phi) - phi - (math.tan(PRESSURE_ANGLE) - PRESSURE_ANGLE)
    return np.where(rho < base, corner, np.maximum(corner, involute))


def half_tooth(teeth: int, radius: ArrayLike, thinned: float = 0.0) -> Floats:
    """Return half the angle of a tooth at a distance from the axis, radians, shape (...); negative outside the tooth.

    ``thinned`` is by how much the tooth is thinner on the pitch circle, modules.
    """
    return np.asarray(np.pi / teeth - half_gap(teeth, radius) - thinned / teeth)


def outline(teeth: int, thinned: float = 0.0, flank: int = FLANK) -> Floats:
    """Return the outline of a wheel, counterclockwise, with the middle of a tooth on the x axis.

    Parameters
    ----------
    teeth : int
    thinned : float
        See `half_tooth`.
    flank : int
        Number of points of a flank.

    Returns
    -------
    ndarray, shape (2 teeth flank, 2)
        Modules; the points of a tooth are those of the rising flank, then those of the falling one.

    Examples
    --------
    >>> outline(20).shape
    (280, 2)
    """
    low, high = teeth / 2.0 - DEDENDUM, teeth / 2.0 + ADDENDUM
    # Closer together at the root, where the flank bends.
    rho = low + (high - low) * np.linspace(0.0, 1.0, flank) ** 1.5
    half = half_tooth(teeth, rho, thinned)
    radii, angles = np.concatenate([rho, rho[::-1]]), np.concatenate([-half, half[::-1]])
    middles = 2.0 * np.pi * np.arange(teeth) / teeth
    turned = (middles[:, None] + angles).ravel()
    return np.asarray(np.tile(radii, teeth)[:, None] * np.column_stack([np.cos(turned), np.sin(turned)]))
