"""The wheels of a train on a board, which turn on the timeline."""

from __future__ import annotations

from typing import Any

import numpy as np

from armlab.benches.drive.gears.film import angles_at, film_time
from armlab.benches.drive.gears.stage import Stage, stage_of
from armlab.benches.drive.gears.state import Gears
from armlab.benches.drive.gears.ui.wheel import wheel_glb
from armlab.benches.drive.quantities import rpm
from armlab.kin.drive.tooth import ADDENDUM
from armlab.session.parts.display import Display
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui import adapter
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.glb import MATERIALS, scene_glb
from armlab.ui.figure.solids import block, drum
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._nodes import put, write
from armlab.ui.scene._strokes import add_name

WIDE = 1.7
"""Half the width of the train, in half heights of the stage, at most."""

WIDTH = 0.16
"""Width of a wheel along its axis, and thickness of the board, in half heights of the stage."""

LEVEL = 1.35
"""Distance of the wheels of the second stage before those of the first, in widths."""

BELOW = 0.12
"""Distance of the name of a wheel below it, in half heights of the stage."""


class _Train:
    """The nodes of one train: made anew for other wheels, and only turned by the film."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas, self._made = canvas, 0
        self._root: Any = None
        self._wheels: list[Any] = []
        self._names: list[Any] = []
        self._drawn: object = None

    def show(self, state: State) -> None:
        """Show the wheels of a state."""
        part, stage = state[Gears], stage_of(state)
        train = part.train
        places, modules, _ = drawn_places(part, stage.radius)
        drawn = (part.teeth, part.layout, tuple(modules.tolist()), stage.radius)
        if drawn != self._drawn:
            self._drawn = drawn
            self._make(part, stage, places, modules)
        for k, angle in enumerate(angles_at(part, film_time(state)).tolist()):
            put(self._wheels[k], stage.pose(float(places[k]), 0.0, level_of(part, k) * WIDTH * stage.radius, angle))
            turned = part.speed * float(train.turns[k])
            write(self._names[k], f"{end_of(part, k)}{part.teeth[k]} teeth, {rpm(turned)}")

    def _make(self, part: Gears, stage: Stage, places: Any, modules: Any) -> None:
        if self._root is not None:
            self._root.remove()
        # The page keeps the pose of a node that is made again under its name.
        self._made += 1
        scene, path, width = self._canvas.scene, self._canvas.path(f"gears/{self._made}"), WIDTH * stage.radius
        self._root = scene.add_frame(path, show_axes=False)
        self._wheels, self._names = [], []
        self._board(path, part, stage, places, modules)
        for k, teeth in enumerate(part.teeth):
            node = scene.add_frame(f"{path}/wheel{k}", show_axes=False)
            module = float(modules[k])
            solid = scene.add_glb(f"{path}/wheel{k}/solid", wheel_glb(teeth, k), cast_shadow=True, receive_shadow=True)
            adapter.set_scale(solid, (module, module, width))
            self._wheels.append(node)
            below = 0.5 * (teeth + 2.0 * ADDENDUM) * module + BELOW * stage.radius * (1.0 + 1.1 * (k % 2))
            at = stage.at(float(places[k]), -below, level_of(part, k) * width)
            self._names.append(add_name(scene, f"{path}/name{k}", "", at, "top-center"))

    def _board(self, path: str, part: Gears, stage: Stage, places: Any, modules: Any) -> None:
        """Draw the board behind the wheels, and the shafts that stand in it."""
        scene, width = self._canvas.scene, WIDTH * stage.radius
        tips = 0.5 * np.array(part.teeth) * modules
        long = float(places[-1] - places[0]) + 1.0 * float(min(tips[0], tips[-1])) + 0.5 * stage.radius
        middle = 0.5 * float(places[0] + places[-1])
        board = scene_glb([(block((long, 0.34 * stage.radius, 0.25 * width), 0.05 * width), MATERIALS["dark"])])
        node = scene.add_frame(f"{path}/board", show_axes=False)
        put(node, stage.pose(middle, 0.0, -0.95 * width))
        scene.add_glb(f"{path}/board/solid", board, cast_shadow=True, receive_shadow=True)
        for k in range(len(part.teeth)):
            front = level_of(part, k) * width + 0.75 * width
            long = front + 0.95 * width
            rod = scene_glb([(drum(0.05 * stage.radius, 0.5 * long, 0.1 * width), MATERIALS["steel"])])
            stand = scene.add_frame(f"{path}/shaft{k}", show_axes=False)
            put(stand, stage.pose(float(places[k]), 0.0, front - 0.5 * long))
            scene.add_glb(f"{path}/shaft{k}/solid", rod, cast_shadow=False, receive_shadow=True)


def level_of(part: Gears, k: int) -> float:
    """Return how far a wheel, 0-based, stands before the first, in widths of a wheel."""
    return LEVEL if part.layout == "compound" and k >= 2 else 0.0


def end_of(part: Gears, k: int) -> str:
    """Return the name of the end of the train at which a wheel sits, to be continued; empty between them."""
    return {0: "motor: ", len(part.teeth) - 1: "load: "}.get(k, "")


def drawn_places(part: Gears, radius: float) -> tuple[Any, Any, float]:
    """Return places (k,) and modules (k,) in the picture, metres, and how many times as large all is drawn."""
    train = part.train
    places, modules = train.places(part.distances), train.modules(part.distances)
    tips = (0.5 * np.array(part.teeth) + ADDENDUM) * modules
    left, right = float((places - tips).min()), float((places + tips).max())
    scale = min(2.0 * WIDE * radius / (right - left), radius / float(tips.max()))
    return scale * (places - 0.5 * (left + right)), scale * modules, scale


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the train."""
    return _Train(canvas).show


LAYER = Layer(
    "gears",
    order=78,
    watches=(Gears, Timeline, Display, RobotPart),
    build=build,
    panel="gears",
)
