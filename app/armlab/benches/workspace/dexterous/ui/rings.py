"""The regions of a planar arm as coloured rings in its plane, and the circle on which joint 3 must be."""

from __future__ import annotations

import math

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.workspace.dexterous.places import possible_joints, tool_standing
from armlab.benches.workspace.dexterous.ui.words import COLOURS
from armlab.kin.rotations import quaternion_from_rotation
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.planar import lengths_of
from armlab.kin.workspace.planar_regions import Region, regions
from armlab.kin.workspace.sheet_maps import sheet_of
from armlab.session.state import State
from armlab.ui.colours import GREEN, GREY, VERMILLION
from armlab.ui.drawing import LayerCanvas
from armlab.ui.scene._nodes import seen, write
from armlab.ui.scene._strokes import add_line, add_name, polyline
from armlab.ui.units import units_of

PIXELS, ALPHA = 640, 92
"""Pixels along a side of the picture of the rings, and its opacity, of 255."""

BELOW = 0.012
"""Distance of the rings below the plane of the links, in sizes of the arm."""

TURN = np.linspace(0.0, 2.0 * np.pi, 97)

NAMES_AT, NAMES_STEP = math.radians(-62.0), math.radians(9.0)
"""Angle at which the radii are written, and step to the next one, so that they do not cover each other, radians."""

CIRCLE, POSSIBLE, IMPOSSIBLE = 0.0042, 0.008, 0.003
"""Thickness of the singular circles, and of the arcs about the tool, in sizes of the arm."""


class Rings:
    """All rings and arcs; they are made once, and only the arcs about the tool change."""

    def __init__(self, canvas: LayerCanvas) -> None:
        arm = canvas.drawn.figure.anatomy.arm
        lengths, joint = lengths_of(arm), first_joint(arm)
        assert lengths is not None
        self._arm, self._lengths, self._size = arm, lengths, canvas.size
        self._canvas, self._path = canvas, canvas.path("dexterous/rings")
        scene = canvas.scene
        height = sheet_of(arm, 0.0).s
        wxyz = quaternion_from_rotation(joint.axes)
        scene.add_frame(
            self._path, show_axes=False, wxyz=wxyz, position=joint.origin + joint.axes[:, 2] * (height - self._below)
        )
        found = regions(lengths)
        self._areas = scene.add_image(
            f"{self._path}/areas",
            picture(found, PIXELS),
            2.0 * found[-1].high,
            2.0 * found[-1].high,
            format="png",
            cast_shadow=False,
            receive_shadow=False,
        )
        self._names: list[tuple[viser.LabelHandle, float]] = []
        circles = [one for one in found if one.low == one.high and one.high > 0.0]
        for k, region in enumerate(circles):
            self._circle(k, region)
        self._arcs: list[viser.LineSegmentsHandle] = []
        self._drawn: object = None

    @property
    def _below(self) -> float:
        return BELOW * self._size

    def _circle(self, k: int, region: Region) -> None:
        r, lift = region.low, 1.1 * self._below
        circle = np.stack([r * np.cos(TURN), r * np.sin(TURN), np.full(len(TURN), lift)], axis=-1)
        scene = self._canvas.scene
        add_line(scene, f"{self._path}/circle{k}", polyline(circle), VERMILLION, self._size, CIRCLE)
        angle = NAMES_AT + k * NAMES_STEP
        at = (r * math.cos(angle), r * math.sin(angle), 2.0 * lift)
        self._names.append((add_name(scene, f"{self._path}/radius{k}", "", at, "center-center"), r))

    def show(self, state: State, fill: bool) -> None:
        """Show units and arcs of a state, and the rings themselves if they are valid."""
        seen(self._areas, fill)
        units = units_of(state)
        for name, r in self._names:
            write(name, units.length(r))
        if len(self._lengths) == 3:
            self._show_arcs(state)

    def _show_arcs(self, state: State) -> None:
        standing = state.derived(tool_standing)
        if standing is None or standing.place == self._drawn:
            return
        place = self._drawn = standing.place
        middle = np.array([place.r * math.cos(place.theta), place.r * math.sin(place.theta), 1.4 * self._below])
        radius = self._lengths[2]
        arcs = [
            middle + radius * _turns(first, last) for first, last in possible_joints(self._arm, self._lengths, place)
        ]
        whole = polyline(middle + radius * _turns(0.0, 2.0 * math.pi) - [0.0, 0.0, 0.2 * self._below])
        green = np.concatenate([polyline(arc) for arc in arcs]) if arcs else whole[:1]
        if self._arcs:
            self._arcs[0].points, self._arcs[1].points = whole, green
            return
        scene, size = self._canvas.scene, self._size
        self._arcs = [
            add_line(scene, f"{self._path}/around", whole, GREY, size, IMPOSSIBLE),
            add_line(scene, f"{self._path}/possible", green, GREEN, size, POSSIBLE),
        ]


def picture(found: tuple[Region, ...], pixels: int) -> NDArray[np.uint8]:
    """Return the rings from above, (pixels, pixels, RGBA), transparent outside them."""
    outer = found[-1].high
    x = (np.arange(pixels) + 0.5) / pixels * 2.0 - 1.0
    r = outer * np.hypot(x[:, None], x[None, :])
    image = np.zeros((pixels, pixels, 4), dtype=np.uint8)
    for region in found:
        if region.low < region.high:
            image[(r >= region.low) & (r <= region.high)] = (*COLOURS[region.kind], ALPHA)
    return image


def _turns(first: float, last: float) -> NDArray[np.float64]:
    """Return points (k, 3) of an arc of radius 1 about the origin."""
    angle = np.linspace(first, last, max(2, int(96 * (last - first) / (2.0 * math.pi)) + 1))
    return np.stack([np.cos(angle), np.sin(angle), np.zeros(len(angle))], axis=-1)
