"""The body turned by a product, with the axes of its turns where each of them is made."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.forms.stage import pose_at, stage_of
from armlab.benches.body.forms.ui.base import BaseFrame
from armlab.benches.body.forms.ui.rings import COLOURS
from armlab.benches.body.forms.ui.words import PRIMES
from armlab.benches.body.products.facts import matrix_of
from armlab.benches.body.products.state import Products
from armlab.kin.rotations import rotation_from_sequence
from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.state import State
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._block import Block
from armlab.ui.scene._marks import Marks, Named, Segment, Sketch
from armlab.ui.units import units_of

Floats = NDArray[np.float64]

AXIS = 1.15
"""Half length of the axis of a turn, in radii of the outermost gimbal ring; each further one is a little shorter."""

SHORTER = 0.12

GREEK = ("α", "β", "γ")
"""Names of the three angles."""


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the body, the base frame, and the axes of the turns."""
    _, radius = stage_of(state)
    base = BaseFrame(canvas, "products/base", radius)
    block = Block(canvas, "products/block", radius, ("x′", "y′", "z′"))
    axes = Sketch(canvas, "products/axes", 0.6)
    names = [Named(canvas, f"products/name{k}") for k in range(3)]

    def show(state: State) -> None:
        centre, _ = stage_of(state)
        part, units = state[Products], units_of(state)
        base.show(centre)
        block.show(pose_at(matrix_of(state), centre))
        tips = [(AXIS - SHORTER * k) * radius * axis for k, axis in enumerate(axes_of(part))]
        strokes: list[Segment] = [(centre - tip, centre + tip, COLOURS[k]) for k, tip in enumerate(tips)]
        axes.draw(Marks(strokes=strokes))
        for k, name in enumerate(names):
            if k >= len(tips):
                name.show("", centre)
                continue
            text = f"{GREEK[k]} = {units.angle(part.angles[k])} about {part.axes[k]}{PRIMES[k]}"
            name.show(text, centre - 1.06 * tips[k])

    return show


def axes_of(part: Products) -> list[Floats]:
    """Return the axis of each turn, (3,), as those before have carried it along."""
    found = []
    for k, axis in enumerate(part.axes):
        carried = rotation_from_sequence(part.axes[:k], part.angles[:k]) if k else np.eye(3)
        found.append(np.asarray(carried @ np.eye(3)["xyz".index(axis)], dtype=np.float64))
    return found


LAYER = Layer(
    "products",
    order=70,
    watches=(Products, Notation, Display, RobotPart),
    build=build,
    panel="products",
)
