"""The point in the scene with the lengths and angles of its coordinates, and the circles on which only one changes."""

from __future__ import annotations

import math

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.frames.chain.stage import unit_of
from armlab.benches.frames.coordinates.state import Coordinates, DragPoint, Where, where_of
from armlab.benches.frames.coordinates.ui.colours import COLOURS
from armlab.kin.transforms import transform
from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.state import State
from armlab.ui.colours import AXES as COLOURS_OF
from armlab.ui.colours import FINE_INK, INK, Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.marks import FRAME_LENGTH
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._handle import Handle
from armlab.ui.scene._marks import Marks, Named, Segment, Sketch, arc
from armlab.ui.scene._nodes import move
from armlab.ui.switches import DARK
from armlab.ui.units import units_of

Floats = NDArray[np.float64]

X, Z = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])

AXES = 2.2
"""Length of the axes, in lengths of those of a frame in a picture of this size."""

ARC, BALL = 1.1, 0.12
"""Radius of the arcs of angles, and of the point, in the same."""

BELOW = 0.75
"""Distance of the name of r below its line, clear of those of h and theta, in radii of the arcs."""

THICK, AXIS, FINE = 0.7, 0.6, 0.35
"""Thickness of lengths and arcs, axes, and circles, in usual thicknesses for axes of the usual length."""

LEAST = 1e-6
"""Length, metres, and angle, radians, below which nothing is drawn."""

COLOURS_OF_AXES: tuple[Rgb, ...] = tuple(COLOURS_OF.values())

NAMES = ("r", "theta", "third")


class _Picture:
    """The point, its coordinates and its handle."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas = canvas
        self._axes = Sketch(canvas, "coordinates/axes")
        self._letters = [Named(canvas, f"coordinates/axis{k}") for k in range(3)]
        self._thick, self._fine = Sketch(canvas, "coordinates/thick"), Sketch(canvas, "coordinates/fine")
        self._names = [Named(canvas, f"coordinates/{name}") for name in NAMES]
        self._ball: viser.IcosphereHandle = canvas.scene.add_icosphere(
            canvas.path("coordinates/point"), 1.0, cast_shadow=False, receive_shadow=False
        )
        self._handle: Handle | None = None
        self._unit = self._handle_unit = 0.0
        self._handles = 0

    def show(self, state: State) -> None:
        """Show the point of a state."""
        found, units, dark = state.derived(where_of), units_of(state), DARK.on(state)
        unit = unit_of(np.array([-0.3 * np.abs(found.p), found.p, np.zeros(3)]))
        self._resize(unit, dark)
        move(self._ball, found.p)
        lines, fine, places = drawn(state[Coordinates].shown, found, ARC * unit, FINE_INK[dark])
        self._thick.draw(Marks(strokes=lines))
        self._fine.draw(Marks(strokes=fine))
        third = units.length(found.h) if state[Coordinates].shown == "cylindrical" else units.orientation(found.phi)
        letter = "h" if state[Coordinates].shown == "cylindrical" else "φ"
        radius = found.r if state[Coordinates].shown == "cylindrical" else found.R
        texts = (f"r = {units.length(radius)}", f"θ = {units.orientation(found.theta)}", f"{letter} = {third}")
        for name, text, place in zip(self._names, texts, places, strict=True):
            name.show("" if place is None else text, np.zeros(3) if place is None else place)
        self._show_handle(found, unit)

    def _resize(self, unit: float, dark: bool) -> None:
        if self._ball.color != INK[dark]:
            self._ball.color = INK[dark]
        if unit == self._unit:
            return
        self._ball.scale = BALL * unit
        for k, letter in enumerate("xyz"):
            self._letters[k].show(letter, (AXES + 0.2) * unit * np.eye(3)[k])
        for sketch, weight in ((self._axes, AXIS), (self._thick, THICK), (self._fine, FINE)):
            sketch.weigh(weight * unit / (FRAME_LENGTH * self._canvas.size))
        ends = zip(AXES * unit * np.eye(3), COLOURS_OF_AXES, strict=True)
        self._axes.draw(Marks([(np.zeros(3), end, colour) for end, colour in ends]))

    def _show_handle(self, found: Where, unit: float) -> None:
        if self._handle is None or (unit != self._handle_unit and not self._handle.held):
            if self._handle is not None:
                self._handle.remove()
            self._handles += 1
            self._handle_unit = unit
            path = self._canvas.path(f"coordinates/handle{self._handles}")
            self._handle = Handle(self._canvas, path, self._dragged, scale=1.6 * unit / self._canvas.size)
        self._unit = unit
        self._handle.show_arrows(transform(position=found.p), np.eye(3))

    def _dragged(self, pose: NDArray[np.floating], drag: object, ends: bool) -> None:
        self._canvas.post(DragPoint(pose[:3, 3], drag))


Places = tuple[Floats | None, Floats | None, Floats | None]


def drawn(shown: str, found: Where, radius: float, ink: Rgb) -> tuple[list[Segment], list[Segment], Places]:
    """Return thick and fine strokes in the world, and the places of the three names, None for those left out.

    ``radius`` is that of the arcs, metres.
    """
    direction = np.array([math.cos(found.theta), math.sin(found.theta), 0.0])
    foot = found.r * direction
    lines, fine = _azimuth(found, direction, radius, ink)
    halfway = np.array([math.cos(0.5 * found.theta), math.sin(0.5 * found.theta), 0.0])
    at_theta = None if found.on_axis else 1.35 * radius * halfway
    if shown == "cylindrical":
        lines += [(np.zeros(3), foot, COLOURS["r"]), (foot, found.p, COLOURS["h"])]
        fine += arc(np.array([0.0, 0.0, found.h]), foot, Z, 2.0 * math.pi, ink)
        at_r = None if found.on_axis else 0.55 * foot - BELOW * radius * Z
        return _long(lines), _long(fine), (at_r, at_theta, 0.5 * (foot + found.p) if abs(found.h) > radius else None)
    lines.append((np.zeros(3), found.p, COLOURS["r"]))
    fine.append((foot, found.p, ink))
    fine.append((np.zeros(3), foot, ink))
    across = np.cross(Z, direction)
    at_phi = None
    if not found.at_origin:
        lines += arc(np.zeros(3), radius * Z, across, found.phi, COLOURS["phi"])
        fine += arc(np.zeros(3), found.R * Z, across, max(found.phi, 0.5 * math.pi), ink)
        fine += arc(np.array([0.0, 0.0, found.h]), foot, Z, 2.0 * math.pi, ink)
        at_phi = 1.35 * radius * (math.cos(0.5 * found.phi) * Z + math.sin(0.5 * found.phi) * direction)
    return _long(lines), _long(fine), (None if found.at_origin else 0.65 * found.p, at_theta, at_phi)


def _azimuth(found: Where, direction: Floats, radius: float, ink: Rgb) -> tuple[list[Segment], list[Segment]]:
    """Return the arc of the azimuth and the ray to its end; nothing on the z axis."""
    if found.on_axis:
        return [], []
    return arc(np.zeros(3), radius * X, Z, found.theta, COLOURS["theta"]), [(np.zeros(3), radius * direction, ink)]


def _long(segments: list[Segment]) -> list[Segment]:
    return [each for each in segments if np.linalg.norm(each[1] - each[0]) > LEAST]


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the point."""
    return _Picture(canvas).show


LAYER = Layer("coordinates", order=76, watches=(Coordinates, Display, Notation), build=build, panel="coordinates")
