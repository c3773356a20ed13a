"""Arms drawn as thin sticks along the lengths of the table; many of them are one node of the scene."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import viser
from numpy.typing import ArrayLike, NDArray

from armlab.kin.arm import Arm
from armlab.ui import adapter
from armlab.ui.colours import Rgb, line_colour
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.solids import lathe
from armlab.ui.scene._nodes import seen
from armlab.ui.scene._strokes import Segments, add_line, polyline

Floats = NDArray[np.float64]

THICK = 0.0045
"""Radius of the sticks, in sizes of the arm."""

LEAST = 1e-6
"""Length of a stick, in sizes of the arm, below which it is not drawn."""

OPPOSITE = 1e-9
"""Distance of the cosine from that of minus z below which a stick is turned about x instead."""

STEP = 8
"""Number of arms by which the capacity of the node grows."""


class Sticks:
    """Any number of arms in one node.

    Parameters
    ----------
    canvas : LayerCanvas
    path : str
        Name of the node.
    on_click : callable
        Called with the place, among those shown, of the arm that was clicked.
    """

    def __init__(self, canvas: LayerCanvas, path: str, on_click: Callable[[int], None]) -> None:
        self._canvas, self._path, self._on_click = canvas, path, on_click
        self._drawn = drawn_sticks(canvas.drawn.figure.anatomy.arm, LEAST * canvas.size)
        self._node: viser.BatchedMeshHandle | None = None
        self._room = 0
        self._colours: tuple[Rgb, ...] = ()

    def show(self, corners: Floats, colours: Sequence[Rgb]) -> None:
        """Show arms with these corners, (k, 2n+2, 3), each in its colour; see `corners_of`."""
        if not len(corners):
            if self._node is not None:
                seen(self._node, False)
            return
        wxyz, position, scale = self._laid(corners)
        if self._node is None or len(corners) > self._room:
            self._make(len(corners))
        assert self._node is not None
        count = len(position)
        everything = self._room * int(self._drawn.sum())
        self._node.batched_positions = _padded(position, everything, 0.0)
        self._node.batched_wxyzs = _padded(wxyz, everything, (1.0, 0.0, 0.0, 0.0))
        # What is not needed is too small to be seen.
        self._node.batched_scales = _padded(scale, everything, LEAST * self._canvas.size)
        if tuple(colours) != self._colours:
            self._colours = tuple(colours)
            rgb = np.repeat([line_colour(colour) for colour in colours], count // len(corners), axis=0).astype(np.uint8)
            self._node.batched_colors = np.concatenate([rgb, np.zeros((everything - count, 3), dtype=np.uint8)])
        seen(self._node, True)

    def _make(self, count: int) -> None:
        """Make the node with a capacity for ``count`` arms."""
        self._room = -(-count // STEP) * STEP
        everything = self._room * int(self._drawn.sum())
        rod = lathe([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)], sides=10)
        self._colours = ()
        self._node = self._canvas.scene.add_batched_meshes_simple(
            self._path,
            rod.vertices.astype(np.float32),
            rod.faces.astype(np.uint32),
            batched_wxyzs=np.tile(np.array([1.0, 0.0, 0.0, 0.0]), (everything, 1)),
            batched_positions=np.zeros((everything, 3)),
            batched_scales=np.full((everything, 3), LEAST * self._canvas.size),
            batched_colors=np.zeros((everything, 3), dtype=np.uint8),
            lod="off",
            cast_shadow=False,
            receive_shadow=False,
        )
        adapter.on_event(self._node, "on_click", self._clicked)

    def _clicked(self, event: viser.SceneNodePointerEvent[viser.BatchedMeshHandle]) -> None:
        if event.instance_index is not None:
            self._on_click(event.instance_index // int(self._drawn.sum()))

    def _laid(self, corners: Floats) -> tuple[Floats, Floats, Floats]:
        """Return orientation, position and scale of every stick, arm by arm."""
        begin, way = corners[:, :-1][:, self._drawn], np.diff(corners, axis=1)[:, self._drawn]
        begin, way = begin.reshape(-1, 3), way.reshape(-1, 3)
        length = np.linalg.norm(way, axis=1)
        width = np.full_like(length, THICK * self._canvas.size)
        return turns_to(way / np.maximum(length, 1e-12)[:, None]), begin, np.column_stack([width, width, length])


def drawn_sticks(arm: Arm, least: float) -> NDArray[np.bool_]:
    """Return which of the segments of `corners_of` have a length in any configuration, shape (2n+1,)."""
    drawn = []
    for row in arm.rows:
        along_z, along_x = abs(row.d) > least or not row.revolute, abs(row.a) > least
        drawn += [along_z, along_x] if arm.convention == "standard" else [along_x, along_z]
    drawn.append(float(np.linalg.norm(arm.tool[:3, 3])) > least)
    # Something has to be there to be clicked.
    return np.array(drawn) if any(drawn) else np.ones(len(drawn), dtype=bool)


def corners_of(arm: Arm, q: Floats) -> Floats:
    """Return the line of the table along d and a from frame 0 to the tool, (k, 2n+2, 3), at q of shape (k, n)."""
    frames = np.asarray(arm.frames(q), dtype=np.float64)
    origins, x = frames[:, :, :3, 3], frames[:, :, :3, 0]
    a = np.array([row.a for row in arm.rows])[None, :, None]
    standard = arm.convention == "standard"
    between = origins[:, 1:] - a * x[:, 1:] if standard else origins[:, :-1] + a * x[:, :-1]
    corners = np.empty((len(q), 2 * arm.n + 2, 3))
    corners[:, 0:-1:2], corners[:, 1:-1:2] = origins, between
    corners[:, -1] = origins[:, -1] + frames[:, -1, :3, :3] @ arm.tool[:3, 3]
    return corners


def turns_to(directions: Floats) -> Floats:
    """Return the shortest rotations, as wxyz (k, 4), that take z to unit vectors (k, 3)."""
    x, y, z = directions.T
    w = np.sqrt(np.maximum(0.5 * (1.0 + z), 0.0))
    reversed_ = z < -1.0 + OPPOSITE
    safe = np.where(reversed_, 1.0, w)
    turns = np.column_stack([w, -0.5 * y / safe, 0.5 * x / safe, np.zeros_like(w)])
    turns[reversed_] = (0.0, 1.0, 0.0, 0.0)
    return turns


def _padded(values: Floats, count: int, filling: float | tuple[float, ...]) -> NDArray[np.float32]:
    whole = np.empty((count, values.shape[1]), dtype=np.float32)
    whole[: len(values)], whole[len(values) :] = values, filling
    return whole


STICK = 0.007
"""Thickness of an arm as a thin line, in sizes of the arm."""


def stick_lines(arm: Arm, q: ArrayLike) -> Segments:
    """Return an arm along the lengths of its table, (k, 2, 3)."""
    return polyline(corners_of(arm, np.asarray(q, dtype=float)[None])[0])


class Stick:
    """An arm as a thin line, made when it is first shown."""

    def __init__(self, canvas: LayerCanvas, name: str, colour: Rgb, thickness: float = STICK) -> None:
        self._canvas, self._path, self._colour, self._thickness = canvas, canvas.path(name), colour, thickness
        self._arm = canvas.drawn.figure.anatomy.arm
        self._line: viser.LineSegmentsHandle | None = None
        self._q: bytes = b""

    def show(self, q: Floats | None) -> None:
        """Show the arm in a configuration (n,); None hides it."""
        if q is None:
            if self._line is not None:
                seen(self._line, False)
            return
        if self._line is None:
            lines = stick_lines(self._arm, q)
            self._line = add_line(
                self._canvas.scene, self._path, lines, self._colour, self._canvas.size, self._thickness
            )
        elif q.tobytes() != self._q:
            self._line.points = stick_lines(self._arm, q)
        self._q = q.tobytes()
        seen(self._line, True)
