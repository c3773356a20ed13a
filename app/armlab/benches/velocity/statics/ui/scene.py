"""A wrench at the tool, the torques that balance it, and the forces that need none."""

from __future__ import annotations

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.velocity.statics.state import USUAL, Balance, DragForce, Statics, balance_at, free_forces_at
from armlab.benches.velocity.statics.ui.torques import LENGTH, Arrow, Push, Torque
from armlab.kin.rotations import quaternion_from_rotation
from armlab.session.parts.display import Display
from armlab.session.state import State
from armlab.ui import adapter
from armlab.ui.colours import GREEN, PURPLE, VERMILLION
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.solids import along
from armlab.ui.format import number, subscript
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._nodes import move, seen, turn, write
from armlab.ui.scene._strokes import add_line, add_name, dashes

Array = NDArray[np.float64]

FREE = 0.34
"""Half length of the dashed lines of forces that need no torque, in sizes of the arm."""

FEW = 3
"""Number of joints up to which a torque of zero is written, too; with more joints it would be in the way."""

SECOND = 0.82
"""Length of the second arrow of a moment, in lengths of the first, which gives it two heads."""

HANDLE = 0.09
"""Length of the handle's arrows, in sizes of the arm."""


class _Scene:
    """The nodes of the page, which a drag moves and scales."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas = canvas
        scene, size, arm = canvas.scene, canvas.size, canvas.drawn.figure.anatomy.arm
        self._arm = arm
        path, reach = canvas.path("statics"), FREE * size
        self._root = scene.add_frame(path, show_axes=False)
        self._force = Arrow(scene, f"{path}/force", VERMILLION, size, 0.008)
        self._force_name = add_name(scene, f"{path}/force_name", "", (0.0, 0.0, 0.0), "bottom-left")
        self._moment = Arrow(scene, f"{path}/moment", PURPLE, size, 0.008)
        self._second = Arrow(scene, f"{path}/moment2", PURPLE, size, 0.008)
        self._moment_name = add_name(scene, f"{path}/moment_name", "", (0.0, 0.0, 0.0), "top-left")
        self._free = [
            add_line(scene, f"{path}/free{i}", dashes([0.0, 0.0, -reach], [0.0, 0.0, reach], 9), GREEN, size, 0.0055)
            for i in range(3)
        ]
        self._joints = [Torque(canvas, i) if turns else Push(canvas, i) for i, turns in enumerate(arm.revolute)]
        self._tip = _Tip(canvas)
        self._shown: Statics | None = None

    def show(self, state: State) -> None:
        """Show the wrench of a state."""
        self._shown = state[Statics]
        self.place(self._canvas.shown_pose)

    def place(self, q: Array) -> None:
        """Move the marks to a shown configuration."""
        part = self._shown
        if part is None:
            return
        found = balance_at(part, self._arm, q)
        move(self._root, found.tool[:3, 3])
        self._draw_wrench(part, found)
        shares = part.shares(self._arm, found.torques).tolist()
        for i, (mark, value, share) in enumerate(zip(self._joints, found.torques.tolist(), shares, strict=True)):
            turns, least = bool(self._arm.revolute[i]), float(found.least[i])
            name = "" if abs(value) <= least and self._arm.n > FEW else torque_name(i, turns, value, least)
            mark.show(share, name)
        self._draw_free(q)

    def _draw_wrench(self, part: Statics, found: Balance) -> None:
        size = self._canvas.size
        force, moment = found.wrench[:3], found.wrench[3:]
        arrow = LENGTH * size / (part.full_force or USUAL) * force
        self._force.show(np.zeros(3), arrow)
        seen(self._force_name, bool(force.any()))
        write(self._force_name, f"F {number(float(np.linalg.norm(force)), 1)} N")
        move(self._force_name, 0.6 * arrow)
        self._tip.place(found.tool[:3, 3] + arrow, size / (part.full_force or USUAL), found.tool[:3, 3])
        ring = LENGTH * size / part.full_moment * moment if part.full_moment else np.zeros(3)
        # Two heads, as textbooks draw a moment.
        self._moment.show(np.zeros(3), ring)
        self._second.show(np.zeros(3), SECOND * ring)
        seen(self._moment_name, bool(moment.any()))
        write(self._moment_name, f"M {number(float(np.linalg.norm(moment)), 2)} N m")
        move(self._moment_name, 0.6 * ring)

    def _draw_free(self, q: Array) -> None:
        """Draw the directions of forces that need no torque."""
        free = free_forces_at(self._arm, q)
        for i, line in enumerate(self._free):
            seen(line, i < free.shape[1])
            if i < free.shape[1]:
                turn(line, along(free[:, i])[:3, :3])


class _Tip:
    """A handle at the tip of the force's arrow."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas, self._held, self._drag = canvas, False, object()
        self._metres, self._from = 1.0, np.zeros(3)
        arm = canvas.drawn.figure.anatomy.arm
        flat = arm.task.position == "xy"
        self._control = canvas.scene.add_transform_controls(
            canvas.path("force_tip"),
            scale=HANDLE * canvas.size,
            line_width=3.0,
            disable_rotations=True,
            wxyz=quaternion_from_rotation(arm.base[:3, :3] if flat else np.eye(3)),
            active_axes=(True, True, not flat),
            depth_test=False,
        )
        adapter.on_event(self._control, "on_update", self._moved)

    def place(self, tip: Array, metres: float, start: Array) -> None:
        """Move the handle to the tip, unless it is dragged; ``metres`` is the length for one newton times `LENGTH`."""
        self._metres, self._from = LENGTH * metres, start
        if not self._held:
            move(self._control, tip)

    def _moved(self, event: viser.TransformControlsEvent) -> None:
        if event.phase == "start":
            self._held, self._drag = True, object()
            return
        self._held = event.phase != "end"
        x, y, z = ((np.asarray(self._control.position) - self._from) / self._metres).tolist()
        self._canvas.post(DragForce((x, y, z), self._drag))


def torque_name(i: int, turns: bool, value: float, least: float) -> str:
    """Return the name of a torque with its value and unit.

    >>> torque_name(1, True, -2.5, 1e-6), torque_name(2, False, 1e-12, 1e-6)
    ('τ₂ −2.50 N m', 'τ₃ 0')
    """
    name = subscript("τ", i + 1)
    return f"{name} 0" if abs(value) <= least else f"{name} {number(value, 2)} {'N m' if turns else 'N'}"


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the wrench, the torques and the free directions."""
    scene = _Scene(canvas)
    canvas.on_pose(scene.place)
    return scene.show


LAYER = Layer("statics", order=67, watches=(Statics, Display), build=build, panel="statics")
