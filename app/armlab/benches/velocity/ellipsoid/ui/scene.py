"""The ellipsoids of velocity and of force at the tool, each in its own scale."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.ellipsoid.state import Block, Manipulability, PlacedEllipsoid, VelocityBlock, placed
from armlab.benches.velocity.ellipsoid.ui.body import LONGEST, Body, Colours, Half
from armlab.session.parts.display import Display
from armlab.session.state import State
from armlab.ui.colours import BLUE, ORANGE, SKY, VERMILLION
from armlab.ui.drawing import LayerCanvas
from armlab.ui.format import number, subscript, trimmed
from armlab.ui.plugin import Layer, Show
from armlab.ui.switches import DARK, Switch

Array = NDArray[np.float64]

NOTHING: dict[Block, str] = {"translation": "0: no speed this way", "rotation": "0: no turning about this"}
ENDLESS: dict[Block, str] = {"translation": "∞: any force, no torque", "rotation": "∞: any moment, no torque"}
BOTH: dict[Block, str] = {"translation": "0: no speed, any force", "rotation": "0: no turning, any moment"}
MOST = 1e4
"""Multiple of a usual half axis beyond which the number is not written."""


class Picture:
    """Both ellipsoids; the one of forces is made when it is first shown."""

    def __init__(self, canvas: LayerCanvas, name: str) -> None:
        self._canvas, self._name = canvas, name
        self._velocity = Body(canvas, name, Colours(SKY, BLUE, BLUE))
        self._force: Body | None = None
        self._part: Manipulability | None = None
        self._on = True

    def show(self, state: State, on: bool = True) -> None:
        """Show or hide the ellipsoids of the chosen block."""
        part = state[Manipulability]
        self._on = on
        if on and part.force and self._force is None:
            colours = Colours(ORANGE, VERMILLION, VERMILLION)
            self._force = Body(self._canvas, f"{self._name}_force", colours, -1, LONGEST)
            self._part = None
        for body, wanted in ((self._velocity, part.velocity), (self._force, part.force)):
            if body is not None:
                body.visible(on and wanted)
                body.ink(DARK.on(state))
        if not on:
            return
        if self._part is not part:
            self._part, block = part, part.block
            self._velocity.say(f"drawn: 1 {block.unit} = {trimmed(block.drawn, 6)} m")
            if self._force is not None:
                self._force.say(f"drawn: 1 {block.force_unit} = {trimmed(block.drawn_force, 6)} m")
        self.place(self._canvas.shown_pose)

    def place(self, q: Array) -> None:
        """Move the ellipsoids to a shown configuration."""
        part = self._part
        if not self._on or part is None:
            return
        found = placed(part.block, q)
        if part.velocity:
            halves = [speed_half(part.block, found, i, part.force) for i in range(3)]
            self._velocity.place(found.centre, found.axes, halves)
        if part.force and self._force is not None:
            halves = [force_half(part.block, found, i, part.velocity) for i in range(3)]
            self._force.place(found.centre, found.axes, halves)


def speed_half(block: VelocityBlock, found: PlacedEllipsoid, i: int, both: bool = False) -> Half:
    """Return half axis i of the velocity ellipsoid for drawing; if ``both`` are shown only the longer one is named."""
    if i >= block.m:
        return Half(0.0, "")
    lost = i in found.lost
    if both and not lost and force_longer(block, found, i):
        return Half(block.drawn * float(found.sigma[i]), "")
    said = (BOTH if both else NOTHING)[block.key] if lost else speed(block, float(found.sigma[i]))
    return Half(block.drawn * float(found.sigma[i]), f"{subscript('σ', i + 1)} {said}", lost)


def force_half(block: VelocityBlock, found: PlacedEllipsoid, i: int, both: bool = False) -> Half:
    """Return half axis i of the force ellipsoid for drawing; if ``both`` are shown only the longer one is named.

    Where it is endless, the velocity ellipsoid names it: it has no speed there.
    """
    if i >= block.m:
        return Half(0.0, "")
    value = float(found.half_forces[i])
    if both and (math.isinf(value) or not force_longer(block, found, i)):
        return Half(block.drawn_force * value, "")
    said = ENDLESS[block.key] if math.isinf(value) else force(block, value)
    return Half(block.drawn_force * value, f"1/{subscript('σ', i + 1)} {said}")


def force_longer(block: VelocityBlock, found: PlacedEllipsoid, i: int) -> bool:
    """Return whether half axis i is drawn longer for forces than for velocities."""
    return block.drawn_force * float(found.half_forces[i]) > block.drawn * float(found.sigma[i])


def speed(block: VelocityBlock, value: float) -> str:
    """Return a half axis with its unit, with three digits if the ellipsoid has its usual size."""
    return f"{number(value, digits(block.typical))} {block.unit}"


def force(block: VelocityBlock, value: float) -> str:
    """Return a half axis of the force ellipsoid with its unit."""
    if math.isinf(value):
        return "∞"
    if value > MOST * block.typical_force:
        return f"over {number(MOST * block.typical_force, 0)} {block.force_unit}"
    return f"{number(value, digits(block.typical_force))} {block.force_unit}"


def digits(usual: float) -> int:
    """Return the decimals with which a quantity of this usual size has three digits."""
    return min(max(2 - math.floor(math.log10(usual)), 0), 6)


def drawn_when(wanted: Callable[[State], bool], name: str) -> Callable[[LayerCanvas, State], Show]:
    """Return the ``build`` function of a layer that draws the ellipsoids while a state wants them."""

    def build(canvas: LayerCanvas, state: State) -> Show:
        picture = Picture(canvas, name)
        canvas.on_pose(picture.place)
        return lambda state: picture.show(state, wanted(state))

    return build


SWITCH = Switch(
    "ellipsoid",
    "Ellipsoid",
    "Velocities of the tool while √(Σ q̇ᵢ²) of the joint speeds is at most 1, or forces; see the page Ellipsoid.",
    "M",
)
LAYER = Layer(
    "ellipsoid",
    order=65,
    watches=(Manipulability, Display),
    build=drawn_when(lambda state: True, "ellipsoid"),
    switch=SWITCH,
)
