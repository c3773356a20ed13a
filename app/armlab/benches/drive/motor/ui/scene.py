"""The motor in the scene: its disc turns, and arcs around it show the torques of the motor and of its load."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.benches.drive.motor.facts import moment_of
from armlab.benches.drive.motor.state import TURN, Motor, present_time
from armlab.benches.drive.motor.ui.model import DISC, DISC_AT, disc_glb, housing_glb, places
from armlab.benches.drive.quantities import prefixed, rpm
from armlab.benches.drive.stage import placed_at, stage_of, turned
from armlab.benches.drive.torque.ui.placed import in_world
from armlab.kin.drive.coils import AXIS, UP
from armlab.kin.drive.motor_run import Moment
from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.colours import PURPLE, VERMILLION, Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._marks import Marks, Segment, Sketch, arc
from armlab.ui.scene._nodes import move, put, seen, turn, write
from armlab.ui.units import units_of

Floats = NDArray[np.float64]

RADII = {"motor": 1.14, "load": 1.28}
"""Radii of the arcs of the torques, in radii of the disc."""

LARGEST = math.radians(150.0)
"""Arc of the largest torque of the run, radians."""

LEAST = math.radians(4.0)
"""Smallest arc that is drawn, radians."""

HEAD = math.radians(9.0)
"""Part of an arc that its arrow takes, radians."""

FASTEST = 1.0
"""Largest number of turns of the disc in a second; a faster motor is drawn slower, by a power of ten."""

MOST = 2
"""Largest number of motors."""


class _Motors:
    """The motors on the stage."""

    def __init__(self, canvas: LayerCanvas, unit: float) -> None:
        scene = canvas.scene
        plain: dict[str, Any] = {"scale": unit, "cast_shadow": False, "receive_shadow": False}
        self._unit, self._nodes, self._discs, self._names = unit, list[Any](), list[Any](), list[Any]()
        for k in range(MOST):
            path = canvas.path(f"motor{k}")
            self._nodes.append(scene.add_frame(path, show_axes=False))
            scene.add_glb(f"{path}/housing", housing_glb(), **plain)
            self._discs.append(scene.add_frame(f"{path}/disc", show_axes=False))
            scene.add_glb(f"{path}/disc/solid", disc_glb(k > 0), **plain)
            self._names.append(scene.add_label(f"{path}/name", "", font_screen_scale=0.9, anchor="top-center"))

    def show(self, pose: Floats, middles: list[Floats], angles: list[float], names: list[str]) -> None:
        for k, node in enumerate(self._nodes):
            seen(node, k < len(middles))
            if k >= len(middles):
                continue
            here = pose.copy()
            here[:3, 3] = placed_at(pose, self._unit, middles[k])
            put(node, here)
            turn(self._discs[k], turned(angles[k]))
            write(self._names[k], names[k])
            move(self._names[k], self._unit * np.array([0.0, DISC_AT, -1.45 * DISC]))


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the motor, or both of them."""
    _, unit = stage_of(state)
    motors = _Motors(canvas, unit)
    sketches = {name: Sketch(canvas, f"motor_{name}", 0.8) for name in RADII}

    def show(state: State) -> None:
        part, now, units = state[Motor], moment_of(state), units_of(state)
        pose, unit = stage_of(state)
        middles, slower = places(state), slowed(part)
        moments = [now, part.second.at(present_time(state))][: len(middles)]
        names = [units.angle(each.theta) for each in moments] if len(middles) == 2 else [_name(now, slower)]
        # How far both are apart is drawn as it is, also where their common turning is drawn slower.
        angles = [now.theta / slower + each.theta - now.theta for each in moments]
        motors.show(pose, middles, angles, names)
        for name, marks in torque_marks(part, now, middles[0]).items():
            shown = marks if len(middles) == 1 else Marks()
            sketches[name].draw(in_world(shown, pose, unit))

    return show


def slowed(part: Motor) -> float:
    """Return how many times slower the disc is drawn than the motor turns: 1, or a power of ten."""
    fastest = float(np.abs(part.run.omega).max()) / TURN
    return 10.0 ** max(0, math.ceil(math.log10(fastest / FASTEST))) if fastest > FASTEST else 1.0


def _name(now: Moment, slower: float) -> str:
    drawn = f"; the disc turns {slower:.0f} times slower" if slower > 1.0 else ""
    return f"{rpm(now.omega)}, {prefixed(now.i, 'A')}{drawn}"


def torque_marks(part: Motor, now: Moment, middle: Floats) -> dict[str, Marks]:
    """Return the arcs of the torque of the motor, with its turn, and of the load, against it, with their names."""
    torques = {"motor": (part.k * now.i, PURPLE, "motor"), "load": (-now.load, VERMILLION, "load")}
    largest = max(float(np.abs(part.k * part.run.i).max()), float(np.abs(part.run.load).max()))
    found = {}
    for name, (torque, colour, word) in torques.items():
        angle = LARGEST * torque / largest if largest else 0.0
        words = f"{word}: {prefixed(abs(torque) if name == 'load' and torque < 0.0 else torque, 'N m')}"
        found[name] = _arc(middle, RADII[name] * DISC, angle, colour, words)
    return found


def _arc(middle: Floats, radius: float, angle: float, colour: Rgb, words: str) -> Marks:
    centre = middle + DISC_AT * AXIS
    if abs(angle) < LEAST:
        return Marks()
    head = math.copysign(min(HEAD, abs(angle)), angle)
    before, tip = (centre + radius * (turned(at) @ UP) for at in (angle - head, angle))
    arrows: list[Segment] = [(before, tip, colour)]
    return Marks(arrows, arc(centre, radius * UP, AXIS, angle - 0.5 * head, colour), words, tip)


LAYER = Layer(
    "motor",
    order=75,
    watches=(Motor, Timeline, Notation, Display, RobotPart),
    build=build,
    panel="motor",
)
