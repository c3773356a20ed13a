"""Two bodies side by side, each in its base frame, with a name and the axis of its present turn."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.forms.stage import pose_at, sides_of
from armlab.benches.body.forms.ui.base import BaseFrame
from armlab.session.state import State
from armlab.ui.colours import Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.scene._block import Block
from armlab.ui.scene._marks import Marks, Named, Segment, Sketch, across, arc

Floats = NDArray[np.float64]

AXIS, PLACE, ARC = 1.15, 0.85, 0.25
"""Half length of the axis of a turn, and place and radius of the arc around it, in radii of the place of a body."""

NAME, BELOW = 0.95, 1.3
"""Distances of the name of the axis, on its tail, and of that of the body, below it, from the middle, in the same."""


@dataclass(frozen=True, eq=False)
class Shown:
    """One of the bodies at one time.

    Attributes
    ----------
    R : ndarray, shape (3, 3)
    name : str
    axis : ndarray, shape (3,)
        Of the present turn, of unit length.
    angle : float
        How far it is made, radians.
    colour : Rgb
    about : str
        Name of the axis with the angle.
    """

    R: Floats
    name: str
    axis: Floats
    angle: float
    colour: Rgb
    about: str


class Pair:
    """Two bodies in the scene."""

    def __init__(self, canvas: LayerCanvas, name: str, state: State) -> None:
        _, radius = sides_of(state)
        self._bases = [BaseFrame(canvas, f"{name}/base{k}", radius) for k in range(2)]
        self._blocks = [Block(canvas, f"{name}/block{k}", radius, ("x′", "y′", "z′")) for k in range(2)]
        self._names = [Named(canvas, f"{name}/name{k}") for k in range(2)]
        self._about = [Named(canvas, f"{name}/about{k}") for k in range(2)]
        self._marks = [Sketch(canvas, f"{name}/marks{k}", 0.7) for k in range(2)]
        self._on = True

    def visible(self, on: bool) -> None:
        """Show or hide both bodies, with what belongs to them."""
        self._on = on
        for base, block in zip(self._bases, self._blocks, strict=True):
            base.visible(on)
            block.visible(on)

    def show(self, state: State, bodies: tuple[Shown, Shown]) -> None:
        """Show both bodies, unless they are hidden."""
        centres, radius = sides_of(state)
        for k, (body, centre) in enumerate(zip(bodies, centres, strict=True)):
            self._bases[k].show(centre)
            self._blocks[k].show(pose_at(body.R, centre))
            self._names[k].show(body.name if self._on else "", centre - np.array([0.0, 0.0, BELOW * radius]))
            self._about[k].show(body.about if self._on else "", centre - NAME * radius * body.axis)
            self._marks[k].draw(turn_marks(body, centre, radius) if self._on else Marks())


def turn_marks(body: Shown, centre: Floats, radius: float) -> Marks:
    """Return the axis of the present turn as an arrow through the body, and the arc of the turn around it."""
    tip = AXIS * radius * body.axis
    arrows: list[Segment] = [(centre - tip, centre + tip, body.colour)]
    middle, start = centre + PLACE * radius * body.axis, ARC * radius * across(body.axis)
    return Marks(arrows, arc(middle, start, body.axis, body.angle, body.colour))
