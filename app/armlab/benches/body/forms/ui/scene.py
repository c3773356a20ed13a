"""The body with its frame before the base frame, its gimbal rings, and the handle that turns it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.forms.gimbal import rings_of
from armlab.benches.body.forms.rotation import Forms, forms_of
from armlab.benches.body.forms.stage import pose_at, stage_of, towards_eye
from armlab.benches.body.forms.state import Body
from armlab.benches.body.forms.ui.base import BaseFrame
from armlab.benches.body.forms.ui.handle import body_handle
from armlab.benches.body.forms.ui.rings import Rings
from armlab.benches.body.forms.ui.words import LETTERS, turn_names
from armlab.kin.euler import angle_symbols
from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.state import State
from armlab.ui.colours import INK
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._block import Block
from armlab.ui.scene._marks import Marks, Segment, Sketch
from armlab.ui.switches import DARK
from armlab.ui.units import Units, units_of

Floats = NDArray[np.float64]

LOST = 0.6
"""Length of the arrow along the lost axis, in the same."""


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the body, the frames, the rings and the handle."""
    _, radius = stage_of(state)
    base = BaseFrame(canvas, "body/base", radius)
    block = Block(canvas, "body/block", radius, ("x′", "y′", "z′"))
    rings = Rings(canvas, radius)
    lost = Sketch(canvas, "body/lost")

    handle = body_handle(canvas, "body/handle", radius)

    def show(state: State) -> None:
        part, found, units = state[Body], state.derived(forms_of), units_of(state)
        centre, _ = stage_of(state)
        base.show(centre)
        block.show(pose_at(found.R, centre))
        angles = found.triples.shown
        shown = rings_of(part.axes, part.fixed, angles) if part.rings else ()
        rings.show(shown, ring_names(part, angles, units), centre, towards_eye(state))
        lost.draw(lost_marks(found, centre, radius, DARK.on(state)))
        handle(state)

    return show


def ring_names(part: Body, angles: Floats, units: Units) -> list[str]:
    """Return the names of the turns, in the order of the sequence, with their angles."""
    symbols = [LETTERS[symbol] for symbol in angle_symbols(part.axes, part.fixed)]
    named = zip(symbols, turn_names(part.axes, part.fixed), angles, strict=True)
    return [
        f"{k + 1}: {symbol} = {units.angle(float(angle))} about {axis}" for k, (symbol, axis, angle) in enumerate(named)
    ]


def lost_marks(found: Forms, centre: Floats, radius: float, dark: bool) -> Marks:
    """Return arrows both ways along the axis about which the rings cannot turn the body, at a singularity."""
    if not found.triples.singular:
        return Marks()
    tip = LOST * radius * found.triples.lost
    arrows: list[Segment] = [(centre, centre + tip, INK[dark]), (centre, centre - tip, INK[dark])]
    return Marks(arrows, label="no turn about this axis", at=centre + tip)


LAYER = Layer("body", order=68, watches=(Body, Notation, Display, RobotPart), build=build, panel="body")
