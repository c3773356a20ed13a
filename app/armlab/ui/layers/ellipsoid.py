"""The velocity ellipsoid at the tool: a clear body, its principal axes and ellipses, and their lengths."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from armlab.session.parts.display import Display
from armlab.session.parts.ellipsoid import Block, Manipulability, PlacedEllipsoid, VelocityBlock, placed
from armlab.session.state import State
from armlab.ui.colours import BLUE, INK, SKY, VERDICT
from armlab.ui.drawing import LayerCanvas
from armlab.ui.format import number, subscript, trimmed
from armlab.ui.layers._nodes import move, seen, turn, write
from armlab.ui.plugin import Layer, Show
from armlab.ui.switches import DARK, Switch

Array = NDArray[np.float64]

AXIS, RIM, DASH = 0.0045, 0.0022, 0.0045
"""Thickness of lines, in sizes of the arm."""

LOST = 0.16
"""Half length of the dashed line along which there is no speed, in sizes of the arm."""

THINNEST = 0.001
"""Half thickness of a flat body, in sizes of the arm: a scale of 0 has no normals."""

SIDES = 48
DASHES = 9
NOTHING: dict[Block, str] = {"translation": "0: no speed this way", "rotation": "0: no turning about this"}


class Picture:
    """The nodes of one ellipsoid; a change of the pose moves and scales them and rebuilds none."""

    def __init__(self, canvas: LayerCanvas, name: str) -> None:
        self._canvas, self._block = canvas, None
        self._on = True
        scene, size, path = canvas.scene, canvas.size, canvas.path(name)
        self._root = scene.add_frame(path, show_axes=False)
        self._body = scene.add_icosphere(
            f"{path}/body", color=SKY, subdivisions=4, opacity=0.22, cast_shadow=False, receive_shadow=False
        )
        self._rims = scene.add_line_segments(f"{path}/rims", _circles(), BLUE, thickness=RIM * size)
        self._axes = scene.add_line_segments(f"{path}/axes", _axes(), INK[False], thickness=AXIS * size)
        self._lost = [
            scene.add_line_segments(
                f"{path}/lost{i}",
                _dashes(i),
                VERDICT["no"],
                thickness=DASH * size,
                scale=LOST * size,
                visible=False,
            )
            for i in range(3)
        ]
        self._labels = [
            scene.add_label(f"{path}/sigma{i}", "", font_screen_scale=0.85, anchor="bottom-center") for i in range(3)
        ]
        self._scale = scene.add_label(f"{path}/scale", "", font_screen_scale=0.8, anchor="top-center")
        self._ink = False

    _block: VelocityBlock | None

    def show(self, state: State, on: bool = True) -> None:
        """Show or hide it, of the block that is looked at."""
        self._on = on
        seen(self._root, on)
        if not on:
            return
        dark = DARK.on(state)
        if dark != self._ink:
            self._ink = dark
            self._axes.colors = np.array(INK[dark], dtype=np.uint8)
        if self._block is not state[Manipulability].block:
            self._block = block = state[Manipulability].block
            write(self._scale, f"drawn: 1 {block.unit} = {trimmed(block.drawn, 6)} m")
            for i in range(3):
                seen(self._labels[i], i < block.m)
        self.place(self._canvas.shown_pose)

    def place(self, q: Array) -> None:
        """Follow a shown configuration."""
        if not self._on or self._block is None:
            return
        found = placed(self._block, q)
        half = self._block.drawn * found.sigma
        thin = THINNEST * self._canvas.size
        a, b, c = np.maximum(half, thin).tolist()
        turn(self._root, found.axes)
        move(self._root, found.centre)
        self._body.scale = self._rims.scale = self._axes.scale = (a, b, c)
        self._name(found, half)

    def _name(self, found: PlacedEllipsoid, half: Array) -> None:
        """Write the lengths at the tips."""
        block = self._block
        assert block is not None
        for i in range(3):
            lost = i in found.lost
            seen(self._lost[i], lost)
            if i >= block.m:
                continue
            name = subscript("σ", i + 1)
            write(self._labels[i], f"{name} {NOTHING[block.key] if lost else speed(block, float(found.sigma[i]))}")
            tip = LOST * self._canvas.size if lost else float(half[i])
            # At the upper end of the axis; the lower end of the first is free for the scale.
            side = np.zeros(3)
            side[i] = tip if found.axes[2, i] >= -1e-9 else -tip
            move(self._labels[i], side)
            if i == 0:
                move(self._scale, -side)


def speed(block: VelocityBlock, value: float) -> str:
    """Return a half axis with its unit, with three digits where the ellipsoid is of its usual size."""
    return f"{number(value, digits(block.typical))} {block.unit}"


def digits(usual: float) -> int:
    """Return the decimals with which a quantity of this usual size has three digits."""
    return min(max(2 - math.floor(math.log10(usual)), 0), 6)


def _circles() -> NDArray[np.float32]:
    """Return unit circles in the three planes, (k, 2, 3)."""
    angle = np.linspace(0.0, 2.0 * np.pi, SIDES + 1)
    circle = np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=1)
    rings = [np.roll(circle, shift, axis=1) for shift in range(3)]
    return np.concatenate([np.stack([ring[:-1], ring[1:]], axis=1) for ring in rings]).astype(np.float32)


def _axes() -> NDArray[np.float32]:
    """Return the axes from -1 to 1, (3, 2, 3)."""
    return np.stack([-np.eye(3), np.eye(3)], axis=1).astype(np.float32)


def _dashes(i: int) -> NDArray[np.float32]:
    """Return a dashed line along axis i from -1 to 1, (k, 2, 3)."""
    ends = np.linspace(-1.0, 1.0, 2 * DASHES)
    points = np.zeros((2 * DASHES, 3), dtype=np.float32)
    points[:, i] = ends
    return points.reshape(DASHES, 2, 3)


def drawn_when(wanted: Callable[[State], bool], name: str) -> Callable[[LayerCanvas, State], Show]:
    """Return the ``build`` of a layer that draws the ellipsoid while a state wants it."""

    def build(canvas: LayerCanvas, state: State) -> Show:
        picture = Picture(canvas, name)
        canvas.on_pose(picture.place)
        return lambda state: picture.show(state, wanted(state))

    return build


SWITCH = Switch(
    "ellipsoid",
    "Velocity ellipsoid",
    "Velocities of the tool while √(Σ q̇ᵢ²) of the joint speeds is at most 1; see the tab Ellipsoid.",
    "M",
)
LAYER = Layer(
    "ellipsoid",
    order=65,
    watches=(Manipulability, Display),
    build=drawn_when(lambda state: True, "ellipsoid"),
    switch=SWITCH,
)
