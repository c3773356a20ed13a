"""The picture of the plane: the point, its angle by atan2, and the direction and the angle that atan gives."""

from __future__ import annotations

import math

from armlab.benches.body.atan2.angle import Angle
from armlab.benches.body.atan2.state import MOST
from armlab.ui import svg
from armlab.ui.form import Marks
from armlab.ui.html import Inside, Markup, tag

SIZE = 270.0
"""Width and height of the picture, pixels."""

UNIT = 0.5 * SIZE / MOST
"""Pixels of a unit of the plane."""

INNER, OUTER = 0.4, 0.8
"""Radii of the arcs of atan2 and of atan, in units of the plane."""

RAY = 1.9
"""Length of the direction of atan, in units of the plane."""

QUADRANTS = ("I", "II", "III", "IV")


def at(x: float, y: float) -> tuple[float, float]:
    """Return the pixel of a point of the plane."""
    return 0.5 * SIZE + UNIT * x, 0.5 * SIZE - UNIT * y


def place_of(across: float, down: float) -> tuple[float, float]:
    """Return the point of the plane at a place in parts of the picture from the upper left."""
    return (2.0 * across - 1.0) * MOST, (1.0 - 2.0 * down) * MOST


def arc(kind: str, radius: float, angle: float) -> Markup:
    """Return the arc of an angle from the x axis; positive ones go counter-clockwise."""
    (x0, y0), (x1, y1) = at(radius, 0.0), at(radius * math.cos(angle), radius * math.sin(angle))
    large, sweep = int(abs(angle) > math.pi), int(angle < 0.0)
    size = radius * UNIT
    return svg.path(kind, f"M{x0:.1f} {y0:.1f}A{size:.1f} {size:.1f} 0 {large} {sweep} {x1:.1f} {y1:.1f}")


def picture(found: Angle, label: str, marks: Marks) -> Markup:
    """Return the plane with the point; ``marks`` makes it a picture to drag in."""
    x, y = at(found.x, found.y)
    middle = 0.5 * SIZE
    shapes: list[Inside] = [
        svg.shape("rect.at-wrong", x=0.0, y=0.0, width=middle, height=SIZE),
        svg.line("at-axis", 4.0, middle, SIZE - 4.0, middle),
        svg.line("at-axis", middle, 4.0, middle, SIZE - 4.0),
        svg.text("", SIZE - 6.0, middle - 6.0, "x", "end"),
        svg.text("", middle + 7.0, 14.0, "y"),
        [_quadrant(k) for k in range(4)],
        svg.text("at-note", 6.0, middle + 15.0, "atan: half a turn off"),
    ]
    if found.atan is not None and not found.right:
        tip = at(RAY * math.cos(found.atan), RAY * math.sin(found.atan))
        shapes.append(svg.line("at-other", middle, middle, *tip))
    if found.atan is not None:
        shapes += [arc("at-atan", OUTER, found.atan), _named("at-atan-name", OUTER, found.atan, "atan")]
    if found.atan2 is not None:
        shapes += [arc("at-atan2", INNER, found.atan2), _named("at-atan2-name", INNER, found.atan2, "atan2")]
    shapes += [
        svg.line("at-ray", middle, middle, x, y),
        svg.circle("at-point", x, y, 7.0),
        svg.text("", *_beside(x, y), "(x, y)", "middle"),
    ]
    return svg.drawing("at-plane", SIZE, SIZE, label, shapes, **marks)


def _quadrant(k: int) -> Markup:
    turned = math.radians(45.0 + 90.0 * k)
    x, y = at(2.5 * math.cos(turned), 2.5 * math.sin(turned))
    return svg.text("at-quadrant", x, y + 5.0, QUADRANTS[k], "middle")


def _named(kind: str, radius: float, angle: float, name: str) -> Markup:
    """Return the name of an arc, beyond its middle."""
    x, y = at((radius + 0.22) * math.cos(0.5 * angle), (radius + 0.22) * math.sin(0.5 * angle))
    return svg.text(kind, x, y + 4.0, name, "middle")


def _beside(x: float, y: float) -> tuple[float, float]:
    """Return the place of the name of the point: above it, or below it at the upper edge, and inside the picture."""
    return min(max(x, 22.0), SIZE - 22.0), (y - 13.0 if y > 26.0 else y + 22.0)


def caption() -> Inside:
    """Return the legend of the picture."""
    names = (("at-atan2", "atan2(y, x)"), ("at-atan", "atan(y/x)"), ("at-other", "direction of atan(y/x)"))
    return tag("div.legend", [tag("span", _swatch(kind), name) for kind, name in names])


def _swatch(kind: str) -> Markup:
    return tag("svg.at-swatch", svg.line(kind, 0.0, 5.0, 18.0, 5.0), viewBox="0 0 18 10", aria_hidden="true")
