"""The gimbal rings in the scene, each in the colour of its turn, with its axis and its name."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.forms.gimbal import RADII, Ring
from armlab.benches.body.forms.stage import pose_at
from armlab.ui.colours import ORANGE, PURPLE, SKY, Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.glb import scene_glb
from armlab.ui.figure.mesh import Solid, placed
from armlab.ui.figure.solids import along, drum, torus
from armlab.ui.scene._marks import Marks, Named, Segment, Sketch
from armlab.ui.scene._nodes import put, seen

Floats = NDArray[np.float64]

COLOURS: tuple[Rgb, Rgb, Rgb] = (ORANGE, PURPLE, SKY)
"""Colours of the first, second and third turn: none is that of an axis."""

TUBE, PIN = 0.016, 0.012
"""Thickness of a ring and of its pins, in radii of the outermost one."""

BEARING = 0.034

BEYOND = 1.16
"""Ends of the drawn axes, in radii of the outermost ring."""

BESIDE = 0.8
"""Distance of the end of an axis from the middle of the picture of the rings, below which its name stands beside them,
in the same."""


class Rings:
    """Three rings, moved as the body turns."""

    def __init__(self, canvas: LayerCanvas, radius: float) -> None:
        scene, self._radius = canvas.scene, radius
        self._nodes = []
        for place in range(3):
            colours = [
                scene.add_glb(
                    canvas.path(f"body/ring{place}/{turn}"),
                    ring_glb(place, colour),
                    scale=radius,
                    cast_shadow=False,
                    receive_shadow=False,
                )
                for turn, colour in enumerate(COLOURS)
            ]
            self._nodes.append(colours)
        self._axes = Sketch(canvas, "body/axes", 0.6)
        self._names = [Named(canvas, f"body/ring_name{turn}") for turn in range(3)]

    def show(self, rings: tuple[Ring, ...], names: list[str], centre: Floats, eye: Floats) -> None:
        """Show rings, from the outermost one, with the names of the turns in order; no rings hide all.

        ``eye`` is the unit vector towards the eye at home, for which no name lies over the body.
        """
        shown = {(place, ring.turn): ring for place, ring in enumerate(rings)}
        for place, colours in enumerate(self._nodes):
            for turn, node in enumerate(colours):
                ring = shown.get((place, turn))
                seen(node, ring is not None)
                if ring is not None:
                    put(node, pose_at(ring.frame, centre))
        ends = [(BEYOND - 0.04 * place) * self._radius * ring.axis for place, ring in enumerate(rings)]
        strokes: list[Segment] = [
            (centre - end, centre + end, COLOURS[ring.turn]) for ring, end in zip(rings, ends, strict=True)
        ]
        self._axes.draw(Marks(strokes=strokes))
        for ring, end in zip(rings, ends, strict=True):
            self._names[ring.turn].show(names[ring.turn], centre + beside_the_body(1.06 * end, eye, self._radius))
        if not rings:
            for name in self._names:
                name.show("", centre)


def beside_the_body(end: Floats, eye: Floats, radius: float) -> Floats:
    """Return the end of an axis, or a point beside the rings where the axis points to the eye or away from it."""
    if float(np.linalg.norm(end - (end @ eye) * eye)) > BESIDE * radius:
        return end
    right = np.array([-eye[1], eye[0], 0.0]) / math.hypot(eye[0], eye[1])
    return math.copysign(BEYOND * radius, float(end @ right)) * right


@lru_cache(maxsize=9)
def ring_glb(place: int, colour: Rgb) -> bytes:
    """Return a ring across z with pins along x, by its place from the outermost, where the outermost has radius 1."""
    radius = RADII[place]
    outside = RADII[place - 1] if place else BEYOND
    solids = [torus(radius, TUBE), *_pins(radius, outside)]
    if place == len(RADII) - 1:
        # What holds the body, across the axis of the ring.
        solids.append(placed(drum(PIN, radius, 0.2 * PIN), along((0.0, 1.0, 0.0))))
    return scene_glb([(solid, (colour, 0.42, 0.0)) for solid in solids])


def _pins(inside: float, outside: float) -> list[Solid]:
    found = []
    for sign in (1.0, -1.0):
        x = np.array([sign, 0.0, 0.0])
        found.append(placed(drum(PIN, 0.5 * (outside - inside), 0.2 * PIN), along(x, 0.5 * (inside + outside) * x)))
        found.append(placed(drum(BEARING, BEARING, 0.2 * BEARING), along(x, inside * x)))
    return found
