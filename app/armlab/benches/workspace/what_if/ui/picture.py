"""The sections of two workspaces, one over the other, as a drawing."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np
from numpy.typing import NDArray

from armlab.benches.workspace.what_if.found import Compared
from armlab.kin.workspace.section import Section
from armlab.ui import svg
from armlab.ui.html import Markup, tag
from armlab.ui.units import Units

Floats = NDArray[np.float64]

WIDTH, HIGHEST = 320.0, 230.0
"""Width and largest height of the drawing, in its own units (about one pixel)."""

EDGE = 16.0
"""Margin on each side for the names of the axes, in units of the drawing."""

SPARE = 1e-9


def picture(found: Compared, units: Units) -> Markup | None:
    """Return the sections as SVG, or None while they are unknown, or for a planar arm, where they are lines."""
    if found.sections is None or found.sections[0].grid.flat or found.sections[1].grid.flat:
        return None
    sections = found.sections[:1] if found.same else found.sections
    turning = sections[0].joint.revolute
    corners = np.concatenate([line for section in sections for line in section.contours] or [np.zeros((1, 2))])
    corners = np.concatenate([corners, np.zeros((1, 2))]) if turning else corners
    low, high = corners.min(axis=0), corners.max(axis=0)
    wide, tall = np.maximum(high - low, SPARE)
    scale = min((WIDTH - 2 * EDGE) / wide, (HIGHEST - 2 * EDGE) / tall)
    left = (WIDTH - scale * wide) / 2
    height = scale * tall + 2 * EDGE

    def at(points: Floats) -> Floats:
        return np.column_stack([left + scale * (points[:, 0] - low[0]), EDGE + scale * (high[1] - points[:, 1])])

    shapes = [svg.path(kind, _path(at, section)) for kind, section in zip(("was", "then"), sections, strict=False)]
    x, y = at(np.zeros((1, 2)))[0].tolist()
    axis = (
        svg.line("axis", x, 2.0, x, height - 2.0),
        svg.line("axis", x, y, WIDTH, y),
        svg.text("", x - 10.0, 11.0, "z"),
        svg.text("end", WIDTH, y - 4.0, "ρ"),
        svg.circle("", x, y, 2.5),
    )
    said = f"Side view: {units.length(float(wide))} wide, {units.length(float(tall))} high"
    return svg.drawing("wi-section", WIDTH, height, said, tag("title", said), axis if turning else None, shapes)


def _path(at: Callable[[Floats], Floats], section: Section) -> str:
    return "".join(f"M{_points(at(line))}Z" for line in section.contours)


def _points(line: Iterable[Floats]) -> str:
    return "L".join(f"{x:.1f} {y:.1f}" for x, y in line)
