"""Joint axes as dashed lines, and the arrows that the student has chosen, which move with the bodies of the arm."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.robot.trainer.commands import ChooseDirection
from armlab.benches.robot.trainer.exercise import DIRECTIONS, Exercise, vector
from armlab.benches.robot.trainer.state import Trainer
from armlab.kin.transforms import inverse
from armlab.ui import adapter
from armlab.ui.colours import AXES, AXIS_INK, GREY
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.anatomy import Pose
from armlab.ui.figure.mesh import Solid
from armlab.ui.figure.solids import along, lathe
from armlab.ui.scene._nodes import add_solid, move, put, seen, write

DASH, SPACE = 0.03, 0.018
LINE, BEYOND = 0.0035, 0.13
"""Length of a dash and of a space, thickness of the dashed lines, and their length beyond the points on them, in sizes
of the arm."""

ARROW, SHRINK = 0.14, 0.8
"""Length of an arrow in sizes of the arm, and the ratio by which each further one in the same place is shorter."""

BALL = 0.013
NEAR = 1e-6
"""Radius of an origin, and distance up to which two origins or lines are one, in sizes of the arm."""

Vector = NDArray[np.float64]


class PlacedFrames:
    """The drawing of one exercise.

    Parameters
    ----------
    canvas : LayerCanvas
    exercise : Exercise
    """

    def __init__(self, canvas: LayerCanvas, exercise: Exercise) -> None:
        self._canvas, self._exercise, self._size = canvas, exercise, canvas.size
        self._roots = [self._root(i) for i in range(exercise.n + 1)]
        self._lines = [self._draw_axis(joints) for joints in _lines(exercise, self._size)]
        self._dark = False
        self._origins = exercise.origins
        self._balls = [self._ball(i) for i in range(exercise.n + 1)]
        self._arrows = [{axis: self._arrow(i, axis) for axis in "zx"} for i in range(exercise.n + 1)]
        self._labels = [self._label(i) for i in range(exercise.n + 1)]
        self._arrange()
        self._shown: Trainer | None = None

    def show(self, trainer: Trainer, dark: bool) -> None:
        """Show the student's choices, in one of the two themes."""
        if dark != self._dark:
            self._dark = dark
            for line in self._lines:
                line.colors = np.array(AXIS_INK[dark], dtype=np.uint8)
        for root in self._roots:
            seen(root, trainer.started)
        if not trainer.started or trainer is self._shown:
            return
        self._shown = trainer
        placed = trainer.assignment
        origins = self._exercise.origins if placed is None else placed.frames[:, :3, 3]
        if not np.array_equal(origins, self._origins):
            self._origins = origins
            self._arrange()
        for i, (z, x) in enumerate(trainer.answers.axes):
            for axis, direction in (("z", z), ("x", x)):
                self._point(i, axis, direction, origins[i])

    def _arrange(self) -> None:
        """Place balls and names at the origins; where some coincide, each further frame has shorter arrows."""
        for i, same in enumerate(_coincident(self._origins, self._size)):
            move(self._balls[i], self._origins[i])
            for arrow in self._arrows[i].values():
                arrow.scale = ARROW * self._size * SHRINK ** same.index(i)
            label = self._labels[i]
            move(label, self._origins[i])
            seen(label, same[0] == i)
            write(label, "{" + ", ".join(map(str, same)) + "}")

    def _root(self, i: int) -> viser.FrameHandle:
        """Return a node on the body of frame i whose axes are those of the world while the arm stands in the pose."""
        anatomy = self._canvas.drawn.figure.anatomy
        body, frame = anatomy.frame_on_body(i)
        node: Pose = np.asarray(anatomy.arm.frames(self._exercise.pose)[i] @ inverse(frame))
        root = self._canvas.scene.add_frame(f"{self._canvas.node(body)}/trainer{i}", show_axes=False)
        put(root, np.asarray(inverse(node), dtype=np.float64))
        return root

    def _draw_axis(self, joints: list[int]) -> viser.LineSegmentsHandle:
        """Draw the common line of the axes of joints (0-based), on the body that the first of them turns on."""
        first, exercise = joints[0], self._exercise
        z = exercise.own_frames[first, :3, 2]
        through = [place for j in joints for place in _on_axis(exercise, j)]
        heights = [float((place - through[0]) @ z) for place in through]
        low, high = min(heights) - BEYOND * self._size, max(heights) + BEYOND * self._size
        begins = np.arange(low, high, (DASH + SPACE) * self._size)
        ends = np.minimum(begins + DASH * self._size, high)
        points = through[0] + np.stack([begins, ends], axis=1)[:, :, None] * z
        name = self._roots[first].name
        line = self._canvas.scene.add_line_segments(
            f"{name}/axis{first}", points.astype(np.float32), AXIS_INK[False], thickness=LINE * self._size
        )
        numbers = ", ".join(str(j + 1) for j in joints)
        self._canvas.scene.add_label(
            f"{name}/axis_label{first}",
            f"{'axis' if len(joints) == 1 else 'axes'} {numbers}",
            position=through[0] + high * z,
            font_screen_scale=0.8,
            anchor="bottom-center",
        )
        return line

    def _ball(self, i: int) -> viser.IcosphereHandle:
        return self._canvas.scene.add_icosphere(
            f"{self._roots[i].name}/origin{i}",
            BALL * self._size,
            GREY,
            cast_shadow=False,
            receive_shadow=False,
        )

    def _label(self, i: int) -> viser.LabelHandle:
        return self._canvas.scene.add_label(
            f"{self._roots[i].name}/origin_label{i}", f"{{{i}}}", font_screen_scale=0.85, anchor="top-left"
        )

    def _arrow(self, i: int, axis: str) -> viser.MeshHandle:
        path = f"{self._roots[i].name}/{axis}{i}"
        handle = add_solid(self._canvas.scene, path, _unit_arrow(), AXES[axis], visible=False)
        adapter.on_event(handle, "on_click", self._turn_on(i, axis))
        return handle

    def _turn_on(self, i: int, axis: str) -> Callable[[object], None]:
        """Return the callback for a click on an arrow, which chooses the next direction."""

        def turn(_: object) -> None:
            trainer = self._shown
            if trainer is None or trainer.answers.placed:
                return
            present = trainer.answers.axes[i]["zx".index(axis)]
            after = (DIRECTIONS.index(present) + 1) % len(DIRECTIONS) if present else 0
            self._canvas.post(ChooseDirection(i, axis, DIRECTIONS[after]))

        return turn

    def _point(self, i: int, axis: str, direction: str, origin: Vector) -> None:
        arrow = self._arrows[i][axis]
        if direction:
            put(arrow, along(vector(direction), origin))
        seen(arrow, bool(direction))


@cache
def _unit_arrow() -> Solid:
    """Return an arrow of unit length along z."""
    width = 0.04
    return lathe([(0.0, 0.0), (width, 0.0), (width, 0.76), (2.6 * width, 0.76), (0.0, 1.0)], sides=20)


def _on_axis(exercise: Exercise, j: int) -> list[Vector]:
    """Return points that the line of the axis of joint j+1 must pass through: the origin, and points of the arm."""
    z, own = exercise.own_frames[j, :3, 2], exercise.own_frames
    places = [exercise.origins[j], own[j, :3, 3]]
    # The body after the joint begins where its link leaves the axis.
    leaves = own[j, :3, 3] + ((own[j + 1, :3, 3] - own[j, :3, 3]) @ z) * z
    return [*places, leaves]


def _lines(exercise: Exercise, size: float) -> list[list[int]]:
    """Return the joints, 0-based, in groups whose axes are one line in the pose of the exercise."""
    lines: list[list[int]] = []
    for j in range(exercise.n):
        z, place = exercise.own_frames[j, :3, 2], exercise.own_frames[j, :3, 3]
        for line in lines:
            first = exercise.own_frames[line[0]]
            apart = np.cross(place - first[:3, 3], first[:3, 2])
            if np.linalg.norm(np.cross(z, first[:3, 2])) <= NEAR and np.linalg.norm(apart) <= NEAR * size:
                line.append(j)
                break
        else:
            lines.append([j])
    return lines


def _coincident(origins: Vector, size: float) -> list[list[int]]:
    """Return for each frame the frames, itself among them, whose origins are in the same place."""
    return [
        [j for j, other in enumerate(origins) if np.linalg.norm(other - origin) <= NEAR * size] for origin in origins
    ]
