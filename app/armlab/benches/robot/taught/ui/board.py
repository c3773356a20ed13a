"""The positions as on a dart board: rings about the goal or about their mean, and the circle of the repeatability."""

from __future__ import annotations

import numpy as np

from armlab.benches.robot.taught.state import PLANES, TaughtGoal
from armlab.benches.robot.taught.visits import Visits
from armlab.session.round_numbers import round_above
from armlab.ui import svg
from armlab.ui.html import Inside, Markup
from armlab.ui.small_numbers import with_unit
from armlab.ui.units import Units

WIDE, HIGH = 330.0, 220.0
"""Size of the picture, pixels."""

RINGS = 4
"""Number of rings; the largest touches the picture above and below."""

ROOM = 1.1
"""Room around what is to be seen."""

ARM, CROSS = 6.0, 9.0
"""Half lengths of the marks of the mean and of the goal, pixels."""


def board(part: TaughtGoal, visits: Visits, units: Units) -> Markup:
    """Return the picture."""
    axes = ["xyz".index(letter) for letter in part.plane]
    goal, middle = visits.goal[axes], visits.scatter.middle[axes]
    centre = goal if part.about == "goal" else middle
    points = visits.points[:, axes]
    ring = ring_of(part, visits)
    scale = 0.5 * HIGH / (RINGS * ring)

    def at(point: np.ndarray) -> tuple[float, float]:
        x, y = scale * (point - centre)
        return 0.5 * WIDE + float(x), 0.5 * HIGH - float(y)

    shapes: list[Inside] = []
    for k in range(1, RINGS + 1):
        shapes.append(svg.circle("ac-ring", 0.5 * WIDE, 0.5 * HIGH, round(k * ring * scale, 1)))
        shapes.append(svg.text("tick", 0.5 * WIDE + 3.0, 0.5 * HIGH - k * ring * scale + 10.0, _label(k, ring, units)))
    shapes.append(svg.circle("ac-rp", *at(middle), round(visits.scatter.repeatability * scale, 1)))
    shapes.append(svg.line("ac-ap", *at(goal), *at(middle)))
    shapes += [svg.circle("ac-point", *at(point), 2.5) for point in points]
    shapes += _cross("ac-goal", *at(goal), CROSS, False)
    shapes += _cross("ac-mean", *at(middle), ARM, True)
    shapes.append(svg.text("tick", WIDE - 2.0, HIGH - 4.0, f"{part.plane[0]} →, {part.plane[1]} ↑", "end"))
    said = (
        f"{len(points)} positions in {PLANES[part.plane]}; the mean misses the goal by "
        f"{with_unit(visits.scatter.accuracy, False, units)}"
    )
    return svg.drawing("chart.ac-board", WIDE, HIGH, said, *shapes)


def ring_of(part: TaughtGoal, visits: Visits) -> float:
    """Return the radius of the first ring, metres: a round number with which all rings hold what is to be seen."""
    away = visits.points - (visits.goal if part.about == "goal" else visits.scatter.middle)
    largest = max(float(np.linalg.norm(away, axis=1).max()), visits.scatter.repeatability)
    if part.about == "goal":
        largest = max(largest, visits.scatter.accuracy)
    return round_above(ROOM * largest / RINGS) or 1e-6


def _label(k: int, ring: float, units: Units) -> str | None:
    return with_unit(k * ring, False, units) if k in (1, RINGS) else None


def _cross(kind: str, x: float, y: float, half: float, upright: bool) -> list[Markup]:
    if upright:
        return [svg.line(kind, x - half, y, x + half, y), svg.line(kind, x, y - half, x, y + half)]
    part = 0.7 * half
    return [
        svg.line(kind, x - part, y - part, x + part, y + part),
        svg.line(kind, x - part, y + part, x + part, y - part),
    ]
