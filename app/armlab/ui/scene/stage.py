"""Light and ground."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.session.parts.display import Display
from armlab.session.parts.robot import RobotPart
from armlab.session.state import State
from armlab.ui.colours import Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.figure import Figure
from armlab.ui.plugin import Layer, Show
from armlab.ui.switches import DARK, SHADOWS

Position = tuple[float, float, float]

KEY: Position = (-1.35, -1.86, 3.0)
FILL: Position = (2.0, 1.5, 1.0)
RIM: Position = (-1.0, 2.5, 1.2)
"""Positions of the lamps, in sizes of the arm."""

HANGS = -0.5
"""Height of the tip of the base's z axis, 1 upright and 0 on a wall, below which an arm hangs from its base."""


@dataclass(frozen=True)
class Look:
    """Theme: colours of the lines of the grid, strength of the main lamp, darkness of shadows."""

    cell: Rgb
    section: Rgb
    key: float
    shadow: float


DAY = Look((203, 210, 219), (176, 186, 198), 1.75, 0.16)
NIGHT = Look((58, 67, 80), (78, 90, 106), 1.7, 0.55)


def cell_size(size: float) -> float:
    """Return 1, 2 or 5 times a power of ten, near a seventh of the arm.

    >>> cell_size(2.0)
    0.2
    """
    wanted = size / 7.0
    powers = range(math.floor(math.log10(wanted)) - 1, math.ceil(math.log10(wanted)) + 2)
    steps = [round(m * 10.0**k, 12) for k in powers for m in (1, 2, 5)]
    return min(steps, key=lambda step: abs(math.log(step / wanted)))


def build(canvas: LayerCanvas, state: State) -> Show:
    """Add three lights and an endless grid that fades into the background."""
    _light(canvas, "fill", FILL, False, intensity=0.7, color=(214, 228, 255))
    canvas.scene.add_light_hemisphere(
        canvas.path("stage/sky"), sky_color=(244, 248, 255), ground_color=(168, 172, 180), intensity=2.7
    )
    _light(canvas, "rim", RIM, False, intensity=0.5)
    height = ground_height(canvas.drawn.figure, state[RobotPart].robot.home)

    def show(state: State) -> None:
        look, shadows = NIGHT if DARK.on(state) else DAY, SHADOWS.on(state)
        _light(canvas, "key", KEY, shadows, intensity=look.key, color=(255, 250, 244))
        _ground(canvas, look, shadows, height)

    return show


def _light(canvas: LayerCanvas, name: str, towards: Position, shadows: bool, **options: Any) -> None:
    """Add a lamp in a direction, at a distance in sizes of the arm."""
    x, y, z = (canvas.size * part for part in towards)
    canvas.scene.add_light_directional(canvas.path(f"stage/{name}"), cast_shadow=shadows, position=(x, y, z), **options)


def ground_height(figure: Figure, home: NDArray[np.float64]) -> float:
    """Return the height of the ground in the world: below the base, or below an arm that hangs from its base."""
    root = figure.anatomy.root
    if root[2, 2] < HANGS:
        return float(figure.bounds(home)[0, 2])
    return min(float(np.min(mesh.vertices @ root[2, :3])) for _, mesh in figure.parts[0]) + float(root[2, 3])


def _ground(canvas: LayerCanvas, look: Look, shadows: bool, height: float) -> None:
    """Add the grid, on which shadows fall."""
    size = canvas.size
    canvas.scene.add_grid(
        canvas.path("stage/ground"),
        infinite_grid=True,
        cell_size=cell_size(size),
        section_size=5.0 * cell_size(size),
        cell_color=look.cell,
        section_color=look.section,
        cell_thickness=0.8,
        section_thickness=0.9,
        fade_distance=7.0 * size,
        fade_strength=1.6,
        fade_from="origin",
        shadow_opacity=look.shadow if shadows else 0.0,
        # A little below the plate, or the two would fight for the same pixels.
        position=(0.0, 0.0, height - 0.002 * size),
    )


LAYER = Layer("stage", order=0, watches=(Display,), build=build, silent=True)
