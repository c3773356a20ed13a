"""Marks of the joints in the plots of a motion: by colour, and where colours repeat also by the line."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from armlab.ui.colours import JOINTS, css, joint_colour
from armlab.ui.format import dot
from armlab.ui.html import Markup, tag
from armlab.ui.plot import Curve

AGAIN = (9, 3, 2, 3)
"""Dashes of the joints whose colour another joint has, too."""

CLEAR = "rgba(0,0,0,0)"


def again(i: int) -> bool:
    """Return whether the colour of joint i (0-based) is that of an earlier joint."""
    return i >= len(JOINTS)


def joint_dash(i: int) -> tuple[int, ...]:
    """Return the dashes of the curve of joint i (0-based), as for `Curve`."""
    return AGAIN if again(i) else ()


def joint_mark(i: int) -> Markup:
    """Return the small mark of joint i (0-based): a dot, or a piece of its dashed line."""
    if not again(i):
        return dot(css(joint_colour(i)))
    return tag("i.mp-again", style=f"color:{css(joint_colour(i))}")


@dataclass(frozen=True)
class Rings(Curve):
    """Points drawn as rings, if dots of the same colour belong to another joint."""

    @property
    def series(self) -> dict[str, Any]:
        """Options with which the page draws the curve."""
        ring = {"show": True, "size": self.width, "fill": CLEAR, "stroke": css(self.colour), "width": 1.2}
        return {**super().series, "points": ring}


def joint_dots(i: int, name: str, size: float) -> Curve:
    """Return the curve of the samples of joint i (0-based), without a line between them."""
    kind = Rings if again(i) else Curve
    return kind(name, joint_colour(i), size, dots=True)
