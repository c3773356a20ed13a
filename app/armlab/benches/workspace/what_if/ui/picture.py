"""The sections of two workspaces, one over the other, as a drawing."""

from __future__ import annotations

import math

import numpy as np

from armlab.benches.workspace.what_if.found import Compared
from armlab.kin.workspace.section import Section
from armlab.ui.chart import Chart
from armlab.ui.html import Markup, tag
from armlab.ui.units import Units

WIDTH, HIGHEST = 320.0, 246.0
LEFT, BOTTOM = 40.0, 18.0
"""Width and largest height of the drawing, and what the numbers take of it, in its own units (about one pixel)."""

MARGIN = 0.03
"""Room around the sections, relative to their extent."""

SPARE = 1e-9

GAP = (math.nan, math.nan)
"""Point between two lines."""


def picture(found: Compared, units: Units) -> Markup | None:
    """Return the sections as SVG, or None while they are unknown, or for a planar arm, where they are lines."""
    if found.sections is None or found.sections[0].grid.flat or found.sections[1].grid.flat:
        return None
    sections = found.sections[:1] if found.same else found.sections
    turning = sections[0].joint.revolute
    corners = np.concatenate([line for section in sections for line in section.contours] or [np.zeros((1, 2))])
    corners = np.concatenate([corners, np.zeros((1, 2))]) if turning else corners
    low, high, factor = corners.min(axis=0), corners.max(axis=0), units.factor(False)
    wide, tall = np.maximum(high - low, SPARE).tolist()
    room = MARGIN * max(wide, tall)
    (x0, y0), (x1, y1) = ((low - room) / factor).tolist(), ((high + room) / factor).tolist()
    # Both directions have one scale: high sections leave room on the right.
    x1 = max(x1, x0 + (y1 - y0) * (WIDTH - LEFT) / (HIGHEST - BOTTOM))
    height = BOTTOM + (WIDTH - LEFT) * (y1 - y0) / (x1 - x0)
    rho, z = (f"{name}{units.length_unit}" for name in (("ρ, ", "z, ") if turning else ("", "")))
    chart = Chart("wi-section", (x0, x1), (y0, y1), WIDTH, height, LEFT, BOTTOM, (rho, z))
    axes = (chart.zero(), chart.upright(0.0, "axis")) if turning else None
    shapes = [_outline(chart, kind, section, factor) for kind, section in zip(("was", "then"), sections, strict=False)]
    said = f"Side view: {units.length(wide)} wide, {units.length(tall)} high"
    return chart.picture(said, tag("title", said), chart.grid(), axes, shapes)


def _outline(chart: Chart, kind: str, section: Section, factor: float) -> Markup:
    """Return the closed lines around a section, one after the other."""
    lines = [np.concatenate([line, line[:1], [GAP]]) / factor for line in section.contours]
    return chart.line((point for line in lines for point in line.tolist()), class_=kind)
