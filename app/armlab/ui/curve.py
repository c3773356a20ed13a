"""A curve of a plot: its name and its looks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from armlab.ui.colours import Rgb, css


@dataclass(frozen=True)
class Curve:
    """One curve.

    Attributes
    ----------
    name : str
        With its unit, such as ``"w, m²"``.
    colour : (int, int, int)
    width : float
        Of the line, or of its dots, pixels.
    dots : bool
        Whether its points are drawn as dots without a line: a line goes on over gaps inside of a curve.
    dash : tuple of int
        Pixels drawn and left out in turn; empty for a full line.
    opacity : float
        Below 1 for what stands behind other curves.
    """

    name: str
    colour: Rgb
    width: float = 1.6
    dots: bool = False
    dash: tuple[int, ...] = ()
    opacity: float = 1.0

    @property
    def series(self) -> dict[str, Any]:
        """Options with which the page draws the curve."""
        drawn: dict[str, Any] = {"label": self.name, "stroke": css(self.colour)}
        if self.opacity < 1.0:
            drawn["stroke"] = f"rgba{css(self.colour)[3:-1]},{self.opacity:g})"
        if self.dash:
            drawn["dash"] = list(self.dash)
        if self.dots:
            return {**drawn, "width": 0, "points": {"show": True, "size": self.width, "fill": css(self.colour)}}
        return {**drawn, "width": self.width}
