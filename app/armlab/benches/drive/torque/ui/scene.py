"""The coils in the scene: magnets, rotor with commutator, currents, forces, lever arms and torque."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.drive.quantities import prefixed
from armlab.benches.drive.stage import stage_of, turned
from armlab.benches.drive.torque.sampled import Sampled, sampled_of
from armlab.benches.drive.torque.state import Torque
from armlab.benches.drive.torque.ui.model import (
    ARM,
    GAP,
    MAGNET,
    NORTH,
    RING,
    RING_AT,
    SIDE,
    SOUTH,
    brushes_glb,
    coil_glb,
    magnet,
    shaft_glb,
)
from armlab.benches.drive.torque.ui.placed import in_world
from armlab.kin.drive.coils import AXIS, MOST_COILS, UP
from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.colours import GREEN, GREY, INK
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._marks import Marks, Segment, Sketch, arc
from armlab.ui.scene._nodes import add_solid, move, put, seen, turn, write
from armlab.ui.switches import DARK
from armlab.ui.units import Units, units_of

Floats = NDArray[np.float64]

FORCE, TORQUE, WIRE = 0.8, 1.15, 0.55
"""Lengths of the arrows of a force, of the largest torque of one coil, and of a current, in units of the model."""

LEAST = 0.03
"""Shortest arrow that is drawn, in units of the model."""

FIELD_LINES = [(y, z) for z in (-1.0, 1.0) for y in (-0.7, 0.0, 0.7)]
"""Places y and z of the arrows of the field."""

ANGLE = 0.4
"""Radius of the arc of the angle."""

THROUGH = 0.45
"""Opacity of the magnets."""

WEIGHTS = {"field": 0.35, "wire": 0.6, "force1": 0.8, "force2": 0.8, "torque": 1.0, "angle": 0.8}
"""Thickness of what is drawn, in usual ones."""

TORQUE_COLOUR = (122, 66, 160)


class _Model:
    """The model on its pose; what turns is under one node."""

    def __init__(self, canvas: LayerCanvas, unit: float) -> None:
        scene, path = canvas.scene, canvas.path("coils")
        self._canvas, self._unit = canvas, unit
        self._root = scene.add_frame(path, show_axes=False)
        self._rotor = scene.add_frame(f"{path}/rotor", show_axes=False)
        plain: dict[str, Any] = {"scale": unit, "cast_shadow": False, "receive_shadow": False}
        self._coils = []
        for k in range(MOST_COILS):
            node = scene.add_frame(f"{path}/rotor/coil{k}", show_axes=False)
            turn(node, turned(k * math.pi / MOST_COILS))
            scene.add_glb(f"{path}/rotor/coil{k}/wire", coil_glb(k == 0), **plain)
            self._coils.append(node)
        self._plain = plain
        self._made: tuple[int, bool] | None = None
        self._parts: list[viser.GlbHandle] = []
        for name, x, colour in (("N", -1.0, NORTH), ("S", 1.0, SOUTH)):
            # Seen through, since one of them stands before the rotor.
            add_solid(scene, f"{path}/magnet{name}", magnet(x), colour, scale=unit, opacity=THROUGH)
            at = unit * np.array([x * (GAP + MAGNET[0]), -0.5 * MAGNET[1], 0.5 * MAGNET[2] + 0.12])
            scene.add_label(f"{path}/{name}", name, position=at, font_screen_scale=1.0, anchor="center-center")
        self._signs = [
            scene.add_label(f"{path}/sign{k}", "", font_screen_scale=0.9, anchor="center-center") for k in range(2)
        ]

    def show(self, part: Torque, theta: float, pose: Floats) -> None:
        put(self._root, pose)
        turn(self._rotor, turned(theta))
        if self._made != (part.coils, part.switched):
            self._made = part.coils, part.switched
            self._make(part.coils, part.switched)
        for k, node in enumerate(self._coils):
            seen(node, k < part.coils)
            if k < part.coils:
                turn(node, turned(k * math.pi / part.coils))
        for label, sign in zip(self._signs, (1.0, -1.0), strict=True):
            write(label, "+" if sign * part.current >= 0.0 else "−")
            move(label, self._unit * np.array([sign * (RING + 0.34), RING_AT, 0.0]))

    def _make(self, coils: int, switched: bool) -> None:
        for part in self._parts:
            part.remove()
        scene, path = self._canvas.scene, self._canvas.path("coils")
        self._parts = [
            scene.add_glb(f"{path}/rotor/shaft", shaft_glb(coils, switched), **self._plain),
            scene.add_glb(f"{path}/brushes", brushes_glb(switched), **self._plain),
        ]


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the model and its arrows."""
    _, unit = stage_of(state)
    model = _Model(canvas, unit)
    sketches = {name: Sketch(canvas, f"coils_{name}", weight) for name, weight in WEIGHTS.items()}

    def show(state: State) -> None:
        part, found, units = state[Torque], state.derived(sampled_of), units_of(state)
        pose, unit = stage_of(state)
        model.show(part, found.angle, pose)
        for name, marks in marks_of(part, found, units, DARK.on(state)).items():
            sketches[name].draw(in_world(marks, pose, unit))

    return show


def marks_of(part: Torque, found: Sampled, units: Units, dark: bool) -> dict[str, Marks]:
    """Return the arrows in the model, by what they show, with their names."""
    ray = found.arms[0] / part.radius
    sides = [ARM * ray, -ARM * ray]
    force = abs(part.coil.force)
    marks = {
        "field": Marks([(_field(-1.0, at), _field(1.0, at), GREY) for at in FIELD_LINES]),
        "wire": Marks(
            [
                _arrow(0.25 * SIDE * AXIS + side + 0.07 * ray, WIRE * wire, INK[dark])
                for side, wire in zip(sides, found.wires, strict=True)
            ]
            if part.current
            else [],
            [(np.zeros(3), side, INK[dark]) for side in sides],
        ),
    }
    for k, side in enumerate(sides):
        along = found.forces[k] / force if force else np.zeros(3)
        tip = side + FORCE * along
        name = f"F{'₁₂'[k]} = {prefixed(force, 'N')}" if force and k == 0 else "F₂" if force else ""
        marks[f"force{k + 1}"] = Marks([(side, tip, GREEN)] if force else [], label=name, at=tip)
    marks["torque"] = _torque(part, found)
    marks["angle"] = Marks(
        strokes=arc(-0.55 * SIDE * AXIS, ANGLE * UP, AXIS, math.remainder(found.angle, 2.0 * math.pi), GREY),
        label=f"θ = {units.angle(found.angle)}",
        at=-0.55 * SIDE * AXIS + 1.5 * ANGLE * (turned(0.5 * math.remainder(found.angle, 2.0 * math.pi)) @ UP),
    )
    return marks


def _torque(part: Torque, found: Sampled) -> Marks:
    """Return the torque along the axis, as long as it is large compared with that of one coil, up to a limit."""
    peak = abs(part.coil.peak)
    length = TORQUE * math.tanh(found.now / peak) / math.tanh(1.0) if peak else 0.0
    start = 1.25 * SIDE * AXIS
    arrows: list[Segment] = [(start, start + length * AXIS, TORQUE_COLOUR)] if abs(length) > LEAST else []
    return Marks(arrows, label=f"τ = {prefixed(found.now, 'N m')}", at=start + max(length, 0.0) * AXIS + 0.1 * UP)


def _field(sign: float, at: tuple[float, float]) -> Floats:
    return np.array([sign * 0.92 * GAP, *at])


def _arrow(start: Floats, vector: Floats, colour: tuple[int, int, int]) -> Segment:
    return start - 0.5 * vector, start + 0.5 * vector, colour


LAYER = Layer(
    "coils",
    order=74,
    watches=(Torque, Timeline, Notation, Display, RobotPart),
    build=build,
    panel="torque",
)
