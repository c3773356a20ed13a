"""The joint speeds of all methods side by side: for each method one bar for each joint, from a common zero line."""

from __future__ import annotations

from armlab.benches.velocity.microscope.look import Look
from armlab.benches.velocity.microscope.ui.words import NAMES, joint_speed
from armlab.kin.control.side_by_side import Compared
from armlab.ui import svg
from armlab.ui.colours import css, joint_colour
from armlab.ui.html import Markup, tag
from armlab.ui.units import Units

WIDTH, HEIGHT = 320, 124
TOP, BOTTOM = 14, 16
"""Size of the picture, and the room at its top for the mark of a cut bar and at its bottom for the methods' names."""

LARGEST = 2.5
"""Length at which a bar is cut, in multiples of the longest of the other methods."""

FILLED = 0.82
"""Share of its width that a group of bars fills."""

LEAST = 1e-9
"""Scaled joint speed below which all of them count as zero."""

UNBOUNDED = ("inverse", "pinv")
"""Methods whose speeds have no bound beside a singularity, and which therefore do not set the scale."""


def bars(look: Look, units: Units) -> Markup:
    """Return the bars as SVG; a bar that is cut ends in a point, and a method without an answer says so."""
    answers, full = look.answers, scale_of(look.answers)
    middle, half = TOP + (HEIGHT - TOP - BOTTOM) / 2.0, (HEIGHT - TOP - BOTTOM) / 2.0
    shapes = [svg.path("axis", f"M0 {middle}H{WIDTH}")]
    group = WIDTH / len(answers)
    for i, answer in enumerate(answers):
        left = i * group
        centre = left + group / 2.0
        shapes.append(svg.text("", centre, HEIGHT - 4, NAMES[answer.key], "middle"))
        if answer.step.qdot is None:
            shapes += _none(centre, middle)
            continue
        speeds = answer.step.qdot.tolist()
        wide = FILLED * group / len(speeds)
        for j, speed in enumerate(speeds):
            x = left + (1.0 - FILLED) / 2.0 * group + j * wide
            title = f"{units.variable(j, bool(look.part.arm.revolute[j]))}: {joint_speed(look, j, speed, units)}"
            shapes.append(_bar(x, wide, middle, half, speed / full, j, title))
    return svg.drawing("ms-bars", WIDTH, HEIGHT, "Joint speeds of each method", shapes)


def scale_of(answers: tuple[Compared, ...]) -> float:
    """Return the scaled joint speed that fills half the height of the picture."""
    longest = {a.key: float(abs(a.step.qdot).max()) for a in answers if a.step.qdot is not None}
    calm = max((size for key, size in longest.items() if key not in UNBOUNDED), default=0.0)
    most = max(longest.values(), default=0.0)
    full = min(most, LARGEST * calm) if calm > LEAST else most
    return full if full > LEAST else 1.0


def _bar(x: float, wide: float, middle: float, half: float, part: float, j: int, title: str) -> Markup:
    cut = abs(part) > 1.0
    high = half * min(abs(part), 1.0)
    y = middle - high if part > 0.0 else middle
    colour, thick = css(joint_colour(j)), max(wide - 1.2, 1.0)
    bar, point = svg.shape("rect", x=x, y=y, width=thick, height=max(high, 0.6), fill=colour), None
    if cut:
        tip, base = (y - 6.0, y) if part > 0.0 else (y + high + 6.0, y + high)
        corners = f"M{x:.1f} {base:.1f}L{x + thick / 2.0:.1f} {tip:.1f}L{x + thick:.1f} {base:.1f}z"
        point = tag("path.cut", d=corners, fill=colour)
    return tag("g", tag("title", title), bar, point)


def _none(centre: float, middle: float) -> list[Markup]:
    return [
        svg.text("none", centre, middle - 10.0 + 13.0 * k, word, "middle")
        for k, word in enumerate(("does", "not", "exist"))
    ]
