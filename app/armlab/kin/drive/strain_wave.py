"""Harmonic drives: ratio with its sign for each fixed part, and the shape of the flexspline.

A wave generator presses the teeth of a flexible ring, the flexspline, into those of a rigid one, the circular spline,
at two (or more) opposite places. The flexspline has fewer teeth, and lags behind by the difference in each turn.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import whole_between
from armlab.registry import known_name

Floats = NDArray[np.float64]

FIXED = {"circular": "circular spline", "flexible": "flexspline", "generator": "wave generator"}
"""Parts of which one is fixed."""

FEWEST, MOST = 40, 400
"""Numbers of teeth that a flexspline may have: one with fewer would have to bend so far that its teeth do not fit."""

LOBES = {2: 2, 3: 3, 4: 2}
"""Lobes of the wave generator for each difference of teeth: as many teeth must be between two lobes of one spline and
of the other, up to a whole number, so that the difference is a multiple of the number of lobes."""

HEIGHT = 0.8
"""Height of a tooth above and below its pitch circle, modules: less than the flexspline moves inwards, so that teeth
between the lobes are free."""

WIDTH, SLOPE = 0.72, math.tan(math.radians(30.0))
"""Half the width of a tooth on its pitch circle, modules, a little less than that of a gap, and by how much it becomes
narrower with its height."""


@dataclass(frozen=True)
class StrainWave:
    """A harmonic drive; make one with `strain_wave`.

    Attributes
    ----------
    flexspline : int
        N_FS, the number of teeth of the flexspline.
    difference : int
        N_CS - N_FS.
    fixed : "circular", "flexible" or "generator"
        The part that stands still.
    """

    flexspline: int
    difference: int = 2
    fixed: str = "circular"

    @property
    def circular(self) -> int:
        """N_CS, the number of teeth of the circular spline."""
        return self.flexspline + self.difference

    @property
    def lobes(self) -> int:
        """Number of lobes of the wave generator, and of places where the teeth mesh."""
        return LOBES[self.difference]

    @property
    def input(self) -> str:
        """The part that the motor turns: the wave generator, or the flexspline where that is fixed."""
        return "flexible" if self.fixed == "generator" else "generator"

    @property
    def output(self) -> str:
        """The part that turns the load."""
        return "flexible" if self.fixed == "circular" else "circular"

    @property
    def ratio(self) -> float:
        """The ratio n of input to output speed, with its sign.

        ``N_FS (w_FS - w_WG) = N_CS (w_CS - w_WG)``: seen from the wave generator the splines roll on each other. So n
        is ``-N_FS/(N_CS - N_FS)`` with the circular spline fixed, ``N_CS/(N_CS - N_FS)`` with the flexspline fixed,
        and ``N_CS/N_FS`` with the wave generator fixed. Notes 2.29 gives the size of the first without its sign.
        """
        if self.fixed == "generator":
            return self.circular / self.flexspline
        return (-self.flexspline if self.fixed == "circular" else self.circular) / self.difference

    def angles(self, theta: float) -> tuple[float, float, float]:
        """Return the angles of wave generator, flexspline and circular spline, radians, for an angle of the input."""
        out = theta / self.ratio
        if self.fixed == "circular":
            return theta, out, 0.0
        return (theta, 0.0, out) if self.fixed == "flexible" else (0.0, theta, out)

    @property
    def depth(self) -> float:
        """How far a lobe presses the flexspline outwards, modules: the difference of the pitch radii."""
        return 0.5 * self.difference

    def shape(self, beta: ArrayLike) -> tuple[Floats, Floats, Floats]:
        """Return how the flexspline is bent at angles from a lobe.

        Its middle line keeps its length: a point moves outwards by ``w = w0 cos(L beta)`` and along the circle by
        ``v = -(w0/L) sin(L beta)``, so that ``w + dv/dbeta = 0``, and the line turns by ``(v - dw/dbeta)/r``.

        Parameters
        ----------
        beta : array_like, shape (...)
            Radians, of the unbent flexspline.

        Returns
        -------
        radius, angle, tilt : ndarray, shape (...)
            Distance from the axis in modules, angle from the lobe and inclination to the radius there in radians. The
            first order of w0/r.
        """
        at = np.asarray(beta, dtype=np.float64)
        r, L, w0 = 0.5 * self.flexspline, self.lobes, self.depth
        wave, slide = np.cos(L * at), np.sin(L * at) / L
        along = -w0 * slide / r
        return r + w0 * wave, at + along, along + w0 * L**2 * slide / r


def strain_wave(flexspline: object, difference: object = 2, fixed: str = "circular") -> StrainWave:
    """Return a checked harmonic drive.

    Raises
    ------
    InputError
        A number of teeth that is broken or outside `FEWEST` to `MOST`, a difference that fits no wave generator, or
        teeth that do not lie the same way at all lobes.

    Examples
    --------
    >>> strain_wave(200).ratio, strain_wave(200, fixed="flexible").ratio, strain_wave(200, fixed="generator").ratio
    (-100.0, 101.0, 1.01)
    """
    known_name("fixed part", fixed, FIXED)
    teeth = whole_between(flexspline, "teeth of the flexspline", FEWEST, MOST)
    apart = whole_between(difference, "difference of the teeth", -MOST, MOST)
    if apart not in LOBES:
        raise InputError(
            f"teeth of the circular spline: expected 2, 3 or 4 more than the {teeth} of the flexspline, which fit two, "
            f"three or two lobes, got {teeth + apart}"
        )
    return StrainWave(teeth, apart, fixed)


def counted_teeth(drive: StrainWave, turns: int = 1) -> Fraction:
    """Return by how many of its own teeth the flexspline has turned against the circular spline, found by counting.

    No formula for the ratio is used. A lobe goes round inside the circular spline and comes to one gap of it after the
    other; into each it presses the next tooth of the flexspline, which turns as a whole until that tooth and that gap
    lie in one direction.

    Parameters
    ----------
    drive : StrainWave
    turns : int
        Whole turns of the wave generator against the circular spline.

    Returns
    -------
    Fraction
        Exact, in teeth; negative against the sense of the wave generator.
    """
    turned = Fraction(0)
    for passed in range(1, turns * drive.circular + 1):
        gap = Fraction(passed, drive.circular)
        tooth = Fraction(passed, drive.flexspline) + turned
        turned += gap - tooth
    return turned * drive.flexspline
