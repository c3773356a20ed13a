"""A picture of the x and the y axis from above, with the point, and the directions that atan2 and atan find."""

from __future__ import annotations

import math

from armlab.ui import svg
from armlab.ui.html import Markup

SIZE, RADIUS, ARC = 150.0, 52.0, 22.0
"""Width and height of the picture, and radii of the rays and of the arc, pixels."""

CORNERS = {"I": (SIZE - 12.0, 16.0), "II": (12.0, 16.0), "III": (12.0, SIZE - 8.0), "IV": (SIZE - 12.0, SIZE - 8.0)}
"""Places of the numbers of the quadrants."""

STEPS = 24
"""Number of strokes of the arc."""


def quadrants(x: float, y: float, theta: float, by_atan: float | None, label: str) -> Markup:
    """Return the picture.

    Parameters
    ----------
    x, y : float
        Of the point; only the direction counts.
    theta : float
        By atan2, radians.
    by_atan : float or None
        By atan, radians, if it is defined.
    label : str
        Read aloud instead of the picture.
    """
    middle = SIZE / 2.0

    def at(angle: float, radius: float) -> tuple[float, float]:
        return middle + radius * math.cos(angle), middle - radius * math.sin(angle)

    arc = [at(theta * k / STEPS, ARC) for k in range(STEPS + 1)]
    way = "M" + "L".join(f"{px:.1f} {py:.1f}" for px, py in arc)
    far, name = at(math.atan2(y, x), RADIUS), at(theta, RADIUS + 12.0)
    shapes = [
        svg.line("fr-axis", 8.0, middle, SIZE - 8.0, middle),
        svg.line("fr-axis", middle, 8.0, middle, SIZE - 8.0),
        svg.text("", SIZE - 4.0, middle - 5.0, "x", "end"),
        svg.text("", middle + 6.0, 14.0, "y"),
        *[svg.text("fr-quadrant", *place, each, "middle") for each, place in CORNERS.items()],
    ]
    if by_atan is not None and abs(by_atan - theta) > 1e-9:
        shapes.append(svg.line("fr-wrong", middle, middle, *at(by_atan, RADIUS)))
        shapes.append(svg.text("", *at(by_atan, RADIUS + 2.0), "atan", "middle"))
    shapes += [
        svg.path("fr-arc", way),
        svg.line("fr-ray", middle, middle, *far),
        svg.circle("fr-point", *far, 4.0),
        svg.text("", *name, "P", "middle"),
    ]
    return svg.drawing("fr-quadrants", SIZE, SIZE, label, shapes)
