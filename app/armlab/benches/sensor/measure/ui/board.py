"""The dart board with its throws, their centre, and the circle that holds the bias."""

from __future__ import annotations

import numpy as np

from armlab.benches.sensor.measure.state import BOARD, Throws
from armlab.ui import svg
from armlab.ui.html import Inside, Markup
from armlab.ui.units import Units

SIZE = 268.0
"""Width and height of the picture, pixels."""

SEEN = 1.1
"""Part of the board's radius that is seen to either side of the middle."""

RINGS = (BOARD, 0.08, 0.04)
"""Radii of the rings besides that of a hit, metres."""

MOST_DRAWN = 2000
"""Largest number of throws that are drawn."""

CROSS = 7.0


def place(x: float, y: float) -> tuple[float, float]:
    """Return the pixel of a place on the board in metres."""
    scale = 0.5 * SIZE / (SEEN * BOARD)
    return 0.5 * SIZE + scale * x, 0.5 * SIZE - scale * y


def _pixels(length: float) -> float:
    return length * 0.5 * SIZE / (SEEN * BOARD)


def board(part: Throws, units: Units) -> Markup:
    """Return the picture."""
    found = part.found
    middle = place(0.0, 0.0)
    rings = [svg.circle("th-ring", *middle, round(_pixels(radius), 1)) for radius in RINGS]
    x, y = place(*found.mean.tolist())
    label = (
        f"Board with {part.count} throws; their centre is {units.length(found.distance)} from the middle, their spread "
        f"{units.length(found.spread)}"
    )
    shapes: list[Inside] = [
        rings,
        svg.circle("th-hit", *middle, round(_pixels(part.hit), 1)),
        svg.line("th-axis", middle[0], 0.0, middle[0], SIZE),
        svg.line("th-axis", 0.0, middle[1], SIZE, middle[1]),
        svg.path("th-throws", _dots(part)),
        svg.circle("th-sure", x, y, round(_pixels(found.radius), 1)),
        svg.path("th-centre", f"M{x - CROSS:.1f} {y:.1f}h{2 * CROSS:g}M{x:.1f} {y - CROSS:.1f}v{2 * CROSS:g}"),
    ]
    if part.told:
        u, v = place(*part.bias.tolist())
        shapes.append(svg.path("th-true", f"M{u - 5:.1f} {v - 5:.1f}l10 10m0 -10l-10 10"))
    return svg.drawing("th-board", SIZE, SIZE, label, shapes)


def _dots(part: Throws) -> str:
    """Return the throws on the board as lines without length, which are drawn as dots."""
    at = part.points[:MOST_DRAWN]
    seen = at[np.abs(at).max(axis=1) < SEEN * BOARD]
    return "".join("M{:.1f} {:.1f}h0".format(*place(x, y)) for x, y in seen.tolist()) or "M0 0"
