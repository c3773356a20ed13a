"""The axes of a drawn picture: places of points, a grid with round values, and a cut at the edge.

Lines and numbers have the classes that the kit's style sheet colours for light and dark.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from armlab.ui import svg
from armlab.ui.format import trimmed
from armlab.ui.html import Attribute, Inside, Markup, tag
from armlab.ui.ticks import multiples, powers_of_ten, ticks

Range = tuple[float, float]

LARGE, SMALL = 1e5, 1e-4
"""Least value, and largest range, that are written with a power of ten."""

EDGE = 16.0
"""Distance from the right edge below which a number ends at its line instead of standing in its middle."""

NAME = 18.0
"""Height at the top in which the name of the ordinate takes the place of numbers."""

DECIMALS = 3
"""Largest number of decimals before a power of ten, for which there is room beside a picture."""

LETTER, DIGIT = 5.5, 5.6
"""Usual width of a letter of a name and of a digit of a number."""


@dataclass(frozen=True)
class Chart:
    """A rectangle of the plane in a picture.

    Parameters
    ----------
    key : str
        Of the page's elements: two charts on a page have others.
    x, y : (float, float)
        Ranges that are seen.
    width, height : float
        Of the picture, in pixels.
    left, bottom : float
        What the numbers take of it.
    names : (str, str)
        Of abscissa and ordinate with their units, in the corners before the numbers; a number that has no room beside
        them is left out.
    steps : (float, float)
        Distances of the round values; 0 lets the chart choose.
    log, log_y : bool
        Whether the abscissa, and the ordinate, is logarithmic.

    Raises
    ------
    ValueError
        A range is empty or not finite, or a logarithmic one does not lie above zero.
    """

    key: str
    x: Range
    y: Range
    width: float
    height: float
    left: float
    bottom: float
    names: tuple[str, str] = ("", "")
    steps: tuple[float, float] = (0.0, 0.0)
    log: bool = False
    log_y: bool = False

    def __post_init__(self) -> None:
        for axis, (low, high), log in (("x", self.x, self.log), ("y", self.y, self.log_y)):
            if not (low > (0.0 if log else -math.inf) and 0.0 < high - low < math.inf):
                what = "above zero" if log else "of finite numbers"
                raise ValueError(f"{axis} of chart {self.key}: expected a range {what}, got {low:g} to {high:g}")

    def px(self, x: float) -> float:
        """Return the pixel of an abscissa."""
        return self.left + (self.width - self.left) * _part(x, self.x, self.log)

    def py(self, y: float) -> float:
        """Return the pixel of an ordinate."""
        return (self.height - self.bottom) * (1.0 - _part(y, self.y, self.log_y))

    def grid(self) -> list[Markup]:
        """Return lines at round values, with the values and the names of the axes beside them."""
        (across, up), floor = self.names, self.height - 4.0
        lines = [svg.text("", 2, y, name) for y, name in ((11.0, up), (floor, across)) if name]
        for value in powers_of_ten(*self.x) if self.log else _round(self.steps[0], self.x):
            x, text = self.px(value), value_text(value, (0.0, value) if self.log else self.x)
            anchor = "end" if x > self.width - EDGE else "middle"
            lines.append(self.upright(value, "grid"))
            if not across or x - 0.5 * DIGIT * len(text) >= 2.0 + LETTER * len(across):
                lines.append(svg.text("tick", x, floor, text, anchor))
        for value in powers_of_ten(*self.y) if self.log_y else _round(self.steps[1], self.y):
            y = self.py(value)
            lines.append(svg.path("grid", f"M{self.left:g} {y:.1f}H{self.width:g}"))
            if not up or y >= NAME:
                lines.append(
                    svg.text(
                        "tick",
                        self.left - 4.0,
                        y + 4.0,
                        value_text(value, (0.0, value) if self.log_y else self.y),
                        "end",
                    )
                )
        return lines

    def upright(self, x: float, kind: str, **looks: Attribute) -> Markup:
        """Return a line from top to bottom, such as a cursor."""
        return tag(f"path.{kind}", d=f"M{self.px(x):.1f} 0V{self.height - self.bottom:g}", **looks)

    def zero(self) -> Markup:
        """Return the line on which y is zero."""
        return svg.path("axis", f"M{self.left:g} {self.py(0.0):.1f}H{self.width:g}")

    def cut(self, d: str, **looks: Attribute) -> Markup:
        """Return a path that ends at the edge of the rectangle."""
        return tag("path", clip_path=f"url(#{self.key}-clip)", d=d, **looks)

    def line(self, points: Iterable[tuple[float, float]], **looks: Attribute) -> Markup:
        """Return straight pieces between points, cut at the edge of the rectangle and broken where y is not finite."""
        pieces, pen = list[str](), "M"
        for x, y in points:
            if math.isfinite(y):
                pieces.append(f"{pen}{self.px(x):.1f} {self.py(y):.1f}")
            pen = "L" if math.isfinite(y) else "M"
        return self.cut("".join(pieces), fill="none", **looks)

    def picture(self, label: str, *inside: Inside) -> Markup:
        """Return the whole picture; its class is the key, and the label is read aloud."""
        wide, tall = self.width - self.left, self.height - self.bottom
        clip = tag("clipPath", svg.shape("rect", x=self.left, y=0, width=wide, height=tall), id=f"{self.key}-clip")
        return svg.drawing(f"chart.{self.key}", self.width, self.height, label, clip, *inside)


def _part(value: float, span: Range, log: bool) -> float:
    """Return where a value lies in a range, 0 to 1 between its ends."""
    low, high = span
    return math.log(value / low) / math.log(high / low) if log else (value - low) / (high - low)


def _round(step: float, span: Range) -> list[float]:
    return multiples(step, *span) if step else ticks(*span)


def value_text(value: float, span: Range) -> str:
    """Return a value on an axis with the decimals that its range needs.

    >>> value_text(0.5, (0.0, 1.0)), value_text(-2e6, (-3e6, 0.0)), value_text(0.0, (0.0, 1e-6))
    ('0.5', '−2e6', '0')
    >>> value_text(-1.5e5, (-2e5, 0.0))
    '−1.5e5'
    """
    wide = span[1] - span[0]
    if abs(value) >= LARGE or wide < SMALL:
        return _with_power(value, wide) if value else "0"
    return trimmed(value, max(0, 2 - math.floor(math.log10(wide / 2.0))))


def _with_power(value: float, wide: float) -> str:
    """Return a value with a power of ten, and the decimals that tell the round values of a range apart."""
    finest = math.floor(math.log10(wide / 5.0)) - 1  # of `ticks`, whose steps have two digits
    decimals = min(max(0, math.floor(math.log10(abs(value))) - finest), DECIMALS)
    mantissa, power = f"{value:.{decimals}e}".split("e")
    return f"{trimmed(float(mantissa), decimals)}e{int(power)}".replace("-", "−")
