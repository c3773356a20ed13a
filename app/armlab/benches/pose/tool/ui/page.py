"""Transforms as matrices: a selection in one is a vector in the scene; position in three kinds of coordinates."""

from __future__ import annotations

import numpy as np

from armlab.benches.pose.tool.state import MATRIX, Pair, PoseView, link_parameters, pair_of, step_of
from armlab.benches.pose.tool.ui.chooser import Chooser
from armlab.benches.pose.tool.ui.notation import AXES, INVERSE, chain, link_product, link_symbols, title
from armlab.benches.pose.tool.ui.words import in_words
from armlab.kin.coordinates import cylindrical, spherical
from armlab.session.parts.joints import Joints
from armlab.session.parts.selection import Selection
from armlab.session.state import Post, State
from armlab.ui.format import mathml
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.matrices import MatrixView
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

COLUMNS = (*AXES, tag("b", "p"))
ROWS = (*AXES, None)
"""Names of the columns, the axes and the origin of the moved frame, and of the rows, the axes of the reference."""

ON_AXIS = 1e-9
"""Distance from the z axis, or from the origin, below which an angle of the coordinates is not defined, metres."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the choice of a transform, its matrix, and the read-out below."""
    units = units_of(state)
    chooser = Chooser(gui, post)
    matrix = MatrixView(gui, post, MATRIX)
    words, product, position = gui.html(), gui.html(), gui.html()

    def show(state: State) -> None:
        view, pair = state[PoseView], state.derived(pair_of)
        chooser.show(state)
        matrix.show(state, title(view), pair.transform, 3, 3, COLUMNS, ROWS)
        words.show(tag("p.dim.said", in_words(view, state[Selection].of(MATRIX), pair, units)))
        product.show(_product(state, units))
        position.show(_position(pair, units))

    return show


def _product(state: State, units: Units) -> Markup | None:
    """Return the product that gives the transform, for a single step with its numbers."""
    view, joints = state[PoseView], state[Joints]
    i = step_of(view)
    parts = [chain(view)] if i is None else [link_symbols(joints.arm, i, units)]
    if i is not None:
        parts.append(joined("= ", link_product(joints.arm, link_parameters(joints.arm, joints.q, i), units)))
    if view.inward:
        parts.append(mathml(INVERSE))
    lines = [tag("div", part) for part in parts if part]
    return tag("div.eq.small", lines) if lines else None


def _position(pair: Pair, units: Units) -> Inside:
    p = pair.transform[:3, 3]
    r, azimuth, height = (float(value) for value in cylindrical(p))
    radius, _, polar = (float(value) for value in spherical(p))
    at_origin = float(np.linalg.norm(p)) < ON_AXIS
    theta = "–" if r < ON_AXIS else units.orientation(azimuth)
    rows = (
        ("Cartesian", [(axis, units.length(float(value))) for axis, value in zip("xyz", p, strict=True)]),
        ("cylindrical", [("r", units.length(r)), ("θ", theta), ("z", units.length(height))]),
        ("spherical", [("r", units.length(radius)), ("θ", theta), ("φ", "–" if at_origin else units.angle(polar))]),
    )
    lines = [
        tag("tr", tag("th", name), [tag("td", tag("i", letter), f" {text}") for letter, text in cells])
        for name, cells in rows
    ]
    note = "θ is the angle about z, from x; the spherical φ is the angle from z."
    if at_origin:
        note = "At the origin θ and φ are not defined."
    elif r < ON_AXIS:
        note = "On the z axis θ is not defined."
    return tag("h3", "Position p"), tag("table.coordinates", lines), tag("p.dim", note)


PANEL = Panel((Joints, PoseView, Selection), build, see_through=True)
