"""The block: a body with six faces that differ in colour and in their number of dots, and its frame."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from armlab.ui.colours import AXES, Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.glb import scene_glb
from armlab.ui.figure.mesh import Solid, joined, placed
from armlab.ui.figure.solids import along, block, drum, lathe
from armlab.ui.scene._nodes import put, seen

Floats = NDArray[np.float64]

SIZE = (0.62, 0.48, 0.34)
"""Edges of the block along x, y and z, in radii."""

BEVEL, PLATE, DOT = 0.02, 0.006, 0.034
"""Its bevel, the thickness of the plates on its faces, and the radius of a dot."""

ARROW, WIDTH, HEAD = 0.62, 0.014, 0.1
"""Length of the arrows of its frame, their radius and the length of their heads."""

DARK: Rgb = (62, 69, 80)
WHITE: Rgb = (228, 232, 238)

DOTS: dict[int, tuple[tuple[int, int], ...]] = {
    1: ((0, 0),),
    2: ((-1, -1), (1, 1)),
    3: ((-1, -1), (0, 0), (1, 1)),
    4: ((-1, -1), (-1, 1), (1, -1), (1, 1)),
    5: ((-1, -1), (-1, 1), (0, 0), (1, -1), (1, 1)),
    6: ((-1, -1), (-1, 0), (-1, 1), (1, -1), (1, 0), (1, 1)),
}
"""Places of the dots of a face, as on dice; opposite faces have 7 together, and x, y, z have 1, 2, 3."""


class Block:
    """A block with its frame and the names of its axes, which is moved to a pose.

    Parameters
    ----------
    canvas : LayerCanvas
    name : str
        Of its node.
    radius : float
        Of a ring around it, metres: a corner of it is at 0.43 of that, a tip of its arrows at 0.62.
    names : sequence of str
        Of its three axes; empty ones have no label.
    """

    def __init__(self, canvas: LayerCanvas, name: str, radius: float, names: tuple[str, ...] = ("", "", "")) -> None:
        scene, path = canvas.scene, canvas.path(name)
        self._node = scene.add_frame(path, show_axes=False)
        scene.add_glb(f"{path}/block", block_glb(), scale=radius, cast_shadow=True, receive_shadow=False)
        scene.add_glb(f"{path}/arrows", arrows_glb(), scale=radius, cast_shadow=False, receive_shadow=False)
        for k, text in enumerate(names):
            if text:
                at = (ARROW + 0.06) * radius * np.eye(3)[k]
                scene.add_label(f"{path}/name{k}", text, position=at, font_screen_scale=0.9, anchor="center-center")
        self._pose: Floats | None = None

    def show(self, pose: Floats) -> None:
        """Move it to a pose (4, 4)."""
        if self._pose is None or not np.array_equal(pose, self._pose):
            self._pose = pose
            put(self._node, pose)

    def visible(self, on: bool) -> None:
        """Show or hide it."""
        seen(self._node, on)


@cache
def block_glb() -> bytes:
    """Return the block for a radius of 1."""
    solids: list[tuple[Solid, tuple[Rgb, float, float]]] = [(block(SIZE, BEVEL), (DARK, 0.5, 0.0))]
    dots: list[Solid] = []
    dark_dots: list[Solid] = []
    for k, colour in enumerate(AXES.values()):
        for sign in (1.0, -1.0):
            number = k + 1 if sign > 0.0 else 6 - k
            solids.append((_plate(k, sign), (colour if sign > 0.0 else _pale(colour), 0.5, 0.0)))
            (dots if sign > 0.0 else dark_dots).append(_dots(k, sign, number))
    solids += [(joined(dots), (WHITE, 0.5, 0.0)), (joined(dark_dots), (DARK, 0.5, 0.0))]
    return scene_glb(solids)


@cache
def arrows_glb() -> bytes:
    """Return the three arrows of the body for a radius of 1."""
    profile = [(0.0, 0.0), (WIDTH, 0.0), (WIDTH, ARROW - HEAD), (2.6 * WIDTH, ARROW - HEAD), (0.0, ARROW)]
    arrow = lathe(profile, sides=20)
    units = zip(np.eye(3), AXES.values(), strict=True)
    return scene_glb([(placed(arrow, along(unit)), (colour, 0.5, 0.0)) for unit, colour in units])


def _plate(k: int, sign: float) -> Solid:
    size = np.array(SIZE) - 3.0 * BEVEL
    size[k] = 2.0 * PLATE
    at = 0.5 * sign * SIZE[k] * np.eye(3)[k]
    return block(size, 0.4 * PLATE, at)


def _dots(k: int, sign: float, number: int) -> Solid:
    i, j = [each for each in range(3) if each != k]
    normal = sign * np.eye(3)[k]
    found = []
    for a, b in DOTS[number]:
        at = (0.5 * SIZE[k] + PLATE) * normal
        at[i], at[j] = 0.27 * a * SIZE[i], 0.27 * b * SIZE[j]
        found.append(placed(drum(DOT, 0.4 * PLATE, 0.1 * PLATE), along(normal, at)))
    return joined(found)


def _pale(colour: Rgb) -> Rgb:
    r, g, b = (round(0.45 * value + 0.55 * white) for value, white in zip(colour, WHITE, strict=True))
    return r, g, b
