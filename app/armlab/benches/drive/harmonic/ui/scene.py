"""A harmonic drive whose teeth mesh at the lobes of its wave generator, turning on the timeline."""

from __future__ import annotations

from typing import Any

import numpy as np

from armlab.benches.drive.gears.stage import Stage, stage_of
from armlab.benches.drive.harmonic.film import film_time, turned_at
from armlab.benches.drive.harmonic.state import Harmonic
from armlab.benches.drive.harmonic.ui.parts import (
    RIM,
    STEEL,
    circular_glb,
    flag_glb,
    generator_glb,
    tooth_of_flexspline,
    tooth_poses,
)
from armlab.kin.drive.strain_wave import StrainWave
from armlab.session.parts.display import Display
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui import adapter
from armlab.ui.colours import PURPLE, line_colour
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._nodes import move, put, seen
from armlab.ui.scene._strokes import add_name

WIDTH = 0.34
"""Width of the rings along the axis, in half heights of the stage."""

FRONT = 0.75
"""Distance of the names before the middle of the drive, in widths."""


class _Drive:
    """The nodes of one drive: made anew for other numbers of teeth, and only turned by the film."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas, self._made = canvas, 0
        self._root: Any = None
        self._circular: Any = None
        self._generator: Any = None
        self._flag: Any = None
        self._teeth: Any = None
        self._names: list[Any] = []
        self._drawn: object = None
        self._at: object = None

    def show(self, state: State) -> None:
        """Show the drive of a state."""
        part, stage, theta = state[Harmonic], stage_of(state), turned_at(film_time(state))
        drive = part.drive
        # Which part is fixed changes how it turns, not its solids.
        drawn = (drive.flexspline, drive.difference, stage.radius)
        if drawn != self._drawn:
            self._drawn, self._at = drawn, None
            self._make(drive, stage)
        for name in self._names:
            seen(name, part.names)
        if self._at != (drive, theta):
            self._at = (drive, theta)
            self._turn(drive, stage, theta)

    def _make(self, drive: StrainWave, stage: Stage) -> None:
        if self._root is not None:
            self._root.remove()
        # The page keeps the pose of a node that is made again under its name.
        self._made += 1
        scene, path = self._canvas.scene, self._canvas.path(f"harmonic/{self._made}")
        self._root = scene.add_frame(path, show_axes=False)
        put(self._root, stage.pose(0.0))
        module, width = module_of(drive, stage.radius), WIDTH * stage.radius
        self._circular = scene.add_frame(f"{path}/circular", show_axes=False)
        self._generator = scene.add_frame(f"{path}/generator", show_axes=False)
        self._flag = scene.add_frame(f"{path}/flag", show_axes=False)
        nodes = (self._circular, self._generator, self._flag)
        solids = (circular_glb(drive.circular), generator_glb(drive), flag_glb(drive.flexspline))
        for node, glb in zip(nodes, solids, strict=True):
            solid = scene.add_glb(f"{node.name}/solid", glb, cast_shadow=True, receive_shadow=True)
            adapter.set_scale(solid, (module, module, width))
        self._add_teeth(path, drive, module, width)
        self._add_names(path, stage.radius, width)

    def _add_teeth(self, path: str, drive: StrainWave, module: float, width: float) -> None:
        tooth = tooth_of_flexspline()
        colours = np.tile(np.array(line_colour(STEEL), dtype=np.uint8), (drive.flexspline, 1))
        colours[0] = line_colour(PURPLE)
        self._teeth = self._canvas.scene.add_batched_meshes_simple(
            f"{path}/teeth",
            (tooth.vertices * (module, module, width)).astype(np.float32),
            tooth.faces.astype(np.uint32),
            batched_wxyzs=np.tile(np.array([1.0, 0.0, 0.0, 0.0], dtype=np.float32), (drive.flexspline, 1)),
            batched_positions=np.zeros((drive.flexspline, 3), dtype=np.float32),
            batched_colors=colours,
            flat_shading=True,
            lod="off",
            cast_shadow=False,
            receive_shadow=False,
        )

    def _add_names(self, path: str, radius: float, width: float) -> None:
        scene, near = self._canvas.scene, FRONT * width
        places = (
            ("circular spline", (0.0, 1.02 * radius, 0.0), "bottom-center"),
            ("flexspline", (0.0, -1.02 * radius, 0.0), "top-center"),
            ("wave generator", (0.0, -0.05 * radius, near), "top-center"),
        )
        self._names = [
            add_name(scene, f"{path}/name{k}", text, at, anchor) for k, (text, at, anchor) in enumerate(places)
        ]

    def _turn(self, drive: StrainWave, stage: Stage, theta: float) -> None:
        generator, _, circular = drive.angles(theta)
        for node, angle in ((self._generator, generator), (self._circular, circular)):
            adapter.set_wxyz(node, (float(np.cos(0.5 * angle)), 0.0, 0.0, float(np.sin(0.5 * angle))))
        places, directions = tooth_poses(drive, theta)
        module = module_of(drive, stage.radius)
        flat = np.zeros((drive.flexspline, 3), dtype=np.float32)
        flat[:, :2] = module * places
        turned = np.zeros((drive.flexspline, 4), dtype=np.float32)
        turned[:, 0], turned[:, 3] = np.cos(0.5 * directions), np.sin(0.5 * directions)
        move(self._flag, flat[0])
        adapter.set_wxyz(self._flag, (float(turned[0, 0]), 0.0, 0.0, float(turned[0, 3])))
        self._teeth.batched_positions = flat
        self._teeth.batched_wxyzs = turned


def module_of(drive: StrainWave, radius: float) -> float:
    """Return the module in the picture, metres, with which the rim has the radius of the stage."""
    return radius / (0.5 * drive.circular * (1.0 + RIM))


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the drive."""
    return _Drive(canvas).show


LAYER = Layer(
    "harmonic",
    order=79,
    watches=(Harmonic, Timeline, Display, RobotPart),
    build=build,
    panel="harmonic",
)
