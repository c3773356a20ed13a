"""The constants of the table in the scene: lengths and offsets as dimension lines, angles as arcs."""

from __future__ import annotations

import viser

from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.state import State
from armlab.ui.colours import INK
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._dimensions import Dimension, dimensions_of
from armlab.ui.scene._nodes import write
from armlab.ui.scene._strokes import HEAD, add_head, add_line, add_name
from armlab.ui.switches import DARK, Switch
from armlab.ui.units import units_of


def build(canvas: LayerCanvas, state: State) -> Show:
    """Attach a dimension line or an arc for each constant to its body, with which it moves."""
    found = dimensions_of(canvas.drawn.figure.anatomy)
    names = [add_name(canvas.scene, f"{_path(canvas, one)}_name", "", one.name_at, "center-center") for one in found]
    heads: list[viser.MeshHandle] = []
    for one in found:
        for k, (tip, direction) in enumerate(one.heads):
            path = f"{_path(canvas, one)}_head{k}"
            heads.append(add_head(canvas.scene, path, tip, direction, INK[False], HEAD * canvas.size))
    dark: bool | None = None

    def show(state: State) -> None:
        nonlocal dark
        units = units_of(state)
        for name, one in zip(names, found, strict=True):
            write(name, one.text(units))
        if dark == DARK.on(state):
            return
        dark = DARK.on(state)
        for one in found:
            # Lines are made anew because their colour follows the theme.
            add_line(canvas.scene, _path(canvas, one), one.lines, INK[dark], canvas.size)
        for head in heads:
            head.color = INK[dark]

    return show


def _path(canvas: LayerCanvas, one: Dimension) -> str:
    return f"{canvas.node(one.body)}/{one.field}{one.index}"


SWITCH = Switch(
    "lengths", "Lengths and twists", "The constants of the table that are not zero, with their values.", "I"
)
LAYER = Layer("lengths", order=82, watches=(Notation, Display), build=build, switch=SWITCH)
