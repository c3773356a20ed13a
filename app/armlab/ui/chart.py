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
from armlab.ui.ticks import ticks

Range = tuple[float, float]

LARGE, SMALL = 1e5, 1e-4
"""Least value, and largest range, that are written with a power of ten."""

EDGE = 16.0
"""Distance from the right edge below which a number ends at its line instead of standing in its middle."""


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
    """

    key: str
    x: Range
    y: Range
    width: float
    height: float
    left: float
    bottom: float

    def px(self, x: float) -> float:
        """Return the pixel of an abscissa."""
        return self.left + (self.width - self.left) * (x - self.x[0]) / (self.x[1] - self.x[0])

    def py(self, y: float) -> float:
        """Return the pixel of an ordinate."""
        return (self.height - self.bottom) * (self.y[1] - y) / (self.y[1] - self.y[0])

    def grid(self, top: float = 0.0) -> list[Markup]:
        """Return lines at round values, with the values beside them; ``top`` pixels stay free for a name."""
        right, floor = self.width, self.height - self.bottom
        lines = []
        for value in ticks(*self.x):
            x = self.px(value)
            anchor = "end" if x > right - EDGE else "middle"
            lines.append(svg.path("grid", f"M{x:.1f} 0V{floor:g}"))
            lines.append(svg.text("tick", x, self.height - 4.0, value_text(value, self.x), anchor))
        for value in ticks(*self.y):
            y = self.py(value)
            lines.append(svg.path("grid", f"M{self.left:g} {y:.1f}H{right:g}"))
            if y >= top:
                lines.append(svg.text("tick", self.left - 4.0, y + 4.0, value_text(value, self.y), "end"))
        return lines

    def zero(self) -> Markup:
        """Return the line on which y is zero."""
        return svg.path("axis", f"M{self.left:g} {self.py(0.0):.1f}H{self.width:g}")

    def cut(self, d: str, **looks: Attribute) -> Markup:
        """Return a path that ends at the edge of the rectangle."""
        return tag("path", clip_path=f"url(#{self.key}-clip)", d=d, **looks)

    def line(self, points: Iterable[tuple[float, float]], **looks: Attribute) -> Markup:
        """Return straight pieces between points, cut at the edge of the rectangle."""
        return self.cut("M" + "L".join(f"{self.px(x):.1f} {self.py(y):.1f}" for x, y in points), **looks)

    def picture(self, label: str, *inside: Inside) -> Markup:
        """Return the whole picture; its class is the key, and the label is read aloud."""
        wide, tall = self.width - self.left, self.height - self.bottom
        clip = tag("clipPath", svg.shape("rect", x=self.left, y=0, width=wide, height=tall), id=f"{self.key}-clip")
        return svg.drawing(f"chart.{self.key}", self.width, self.height, label, clip, *inside)


def value_text(value: float, span: Range) -> str:
    """Return a value on an axis with the decimals that its range needs.

    >>> value_text(0.5, (0.0, 1.0)), value_text(-2e6, (-3e6, 0.0)), value_text(0.0, (0.0, 1e-6))
    ('0.5', '−2e6', '0')
    """
    wide = span[1] - span[0]
    if abs(value) >= LARGE or wide < SMALL:
        return f"{value:.0e}".replace("e+0", "e").replace("e-0", "e-").replace("-", "−") if value else "0"
    return trimmed(value, max(0, 1 - math.floor(math.log10(wide / 2.0))))
