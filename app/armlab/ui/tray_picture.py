"""A plot as the tray draws it: its curves with as many points as the screen can show, limits, and marks."""

from __future__ import annotations

import base64
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from armlab.ui.colours import VERDICT, Rgb
from armlab.ui.curve import Curve
from armlab.ui.html import Inside, joined

Array = NDArray[np.float64]
Range = tuple[float, float]


@dataclass(frozen=True, eq=False)
class Drawn:
    """A curve and its points.

    Attributes
    ----------
    curve : Curve
    x, y : ndarray, shape (k,)
        What is not finite leaves a gap.
    """

    curve: Curve
    x: Array
    y: Array


@dataclass(frozen=True)
class Level:
    """A limit: a line across the plot, with its name.

    Attributes
    ----------
    name : str
    value : float
    colour : (int, int, int)
    """

    name: str
    value: float
    colour: Rgb = VERDICT["no"]


@dataclass(frozen=True, eq=False)
class Picture:
    """A plot, large.

    Attributes
    ----------
    title : str or markup
        The quantity and its unit.
    x : str
        Name of the abscissa with its unit.
    drawn : sequence of Drawn
        What comes later lies above.
    levels : sequence of Level
    marks : sequence of (str, float)
        Name and value of x of thin upright lines, such as one at a cutoff frequency.
    across, up : (float, float) or None
        Ranges that are seen at first; None lets the page choose them.
    log : bool
        Whether the abscissa is logarithmic.
    square : bool
        Whether both axes have the same scale, and curves may go to and fro.
    y : str
        Name of the ordinate where the curves do not name it.
    """

    title: Inside
    x: str
    drawn: Sequence[Drawn]
    levels: Sequence[Level] = ()
    marks: Sequence[tuple[str, float]] = ()
    across: Range | None = None
    up: Range | None = None
    log: bool = False
    square: bool = False
    y: str = ""

    def with_names(self, names: Mapping[str, str]) -> Self:
        """Return the picture with other names of some curves, by the names they have."""
        drawn = [
            replace(each, curve=replace(each.curve, name=names.get(each.curve.name, each.curve.name)))
            for each in self.drawn
        ]
        return replace(self, drawn=drawn)

    def described(self, most: int) -> tuple[dict[str, Any], str]:
        """Return the picture for the page: all but the points, and the points as base64 of 32-bit floats.

        Parameters
        ----------
        most : int
            Largest number of points of a curve, about.
        """
        columns = list[Array]()
        curves = list[dict[str, Any]]()
        for each in self.drawn:
            x, y = thinned(each.x, each.y, most)
            columns += [x, y]
            curves.append({**described_curve(each.curve), "count": len(x)})
        numbers = np.concatenate(columns) if columns else np.zeros(0)
        found = {
            "title": str(joined(self.title)),
            "x": self.x,
            "curves": curves,
            "levels": [{"name": at.name, "value": at.value, "colour": list(at.colour)} for at in self.levels],
            "marks": [{"name": name, "value": float(at)} for name, at in self.marks],
            "across": self.across,
            "up": self.up,
            "log": self.log,
            "square": self.square,
            "y": self.y,
        }
        return found, base64.b64encode(numbers.astype("<f4").tobytes()).decode()


def described_curve(curve: Curve) -> dict[str, Any]:
    """Return the looks of a curve for the page."""
    looks: dict[str, Any] = {"name": curve.name, "colour": list(curve.colour), "width": curve.width}
    if curve.dash:
        looks["dash"] = list(curve.dash)
    if curve.dots:
        looks["dots"] = True
    if curve.opacity < 1.0:
        looks["opacity"] = curve.opacity
    return looks


def thinned(x: Array, y: Array, most: int) -> tuple[Array, Array]:
    """Return about ``most`` points of a curve that look the same: of each piece its ends, its extremes and its gaps.

    >>> x, y = thinned(np.arange(1000.0), np.where(np.arange(1000) == 501, 9.0, 0.0), 40)
    >>> len(x) <= 60, float(y.max())
    (True, 9.0)
    """
    pieces = max(most // 4, 1)
    if len(x) <= max(most, 4):
        return x, y
    size = -(-len(x) // pieces)
    padded = np.full(size * pieces, np.nan)
    padded[: len(y)] = y
    rows = padded.reshape(pieces, size)
    gap = ~np.isfinite(rows)
    first = np.arange(pieces) * size
    picked = [
        first,
        first + size - 1,
        first + np.where(gap, np.inf, rows).argmin(axis=1),
        first + np.where(gap, -np.inf, rows).argmax(axis=1),
        (first + gap.argmax(axis=1))[gap.any(axis=1)],
        np.array([len(x) - 1]),
    ]
    kept = np.unique(np.concatenate(picked))
    kept = kept[kept < len(x)]
    return x[kept], y[kept]
