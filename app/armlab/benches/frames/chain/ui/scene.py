"""The frames in the scene with their names and parents, the point, and the change of coordinates as arrows."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.frames.chain.commands import DragFrame
from armlab.benches.frames.chain.point import DragFramePoint, SelectFrame
from armlab.benches.frames.chain.stage import places_of, unit_of
from armlab.benches.frames.chain.state import MOST_FRAMES, POINT, WORLD, Chain
from armlab.benches.frames.chain.tree import point_of, points_of, poses_of
from armlab.benches.frames.chain.ui.colours import FROM_FRAME, ORIGINS
from armlab.benches.frames.chain.ui.globe import Globe
from armlab.kin.transforms import transform
from armlab.session.parts.display import Display
from armlab.session.state import State
from armlab.ui import adapter
from armlab.ui.colours import AXES, FINE_INK, INK, Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.marks import FRAME_LENGTH
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._handle import Handle
from armlab.ui.scene._marks import Marks, Named, Segment, Sketch
from armlab.ui.scene._nodes import add_triad, move, put, seen
from armlab.ui.switches import DARK

Floats = NDArray[np.float64]

THICK, FINE = 0.4, 0.28
"""Thickness of arrows and of fine lines, in usual thicknesses for axes of the usual length."""

HANDLE = 1.6
"""Length of the arrows of the handle, in lengths of the axes."""

BALL = 0.09
"""Radius of the point, in lengths of the axes."""

PLACES = (0.4, 0.62, 0.5)
"""Places of the names of the three arrows, in their lengths: those of arrows side by side do not cover each other."""

LEAST = 1e-6
"""Length of an arrow, metres, below which it is not drawn."""

COLOURS: tuple[Rgb, Rgb, Rgb] = (AXES["x"], AXES["y"], AXES["z"])


class _Triad:
    """A frame to click, with its name; its size follows that of the picture."""

    def __init__(self, canvas: LayerCanvas, name: str, on_click: Callable[[], None]) -> None:
        self._node = add_triad(canvas.scene, canvas.path(name), canvas.size)
        self._name = Named(canvas, f"{name}_name")
        adapter.on_event(self._node, "on_click", lambda _: on_click())

    def show(self, name: str, pose: Floats | None, unit: float) -> None:
        """Show the frame with a name at a pose (4, 4), with axes of a length; None hides it."""
        seen(self._node, pose is not None)
        if pose is None:
            self._name.show("", np.zeros(3))
            return
        put(self._node, pose)
        if self._node.scale != unit:
            self._node.scale = unit
        self._name.show(name, pose[:3, 3] - 0.2 * unit * pose[:3, :3].sum(axis=1))


class _Picture:
    """All that is drawn of a chain."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas = canvas
        self._triads = [_Triad(canvas, f"chain/frame{k}", self._chooser(k)) for k in range(MOST_FRAMES + 1)]
        self._arrows, self._lines = Sketch(canvas, "chain/arrows"), Sketch(canvas, "chain/lines")
        self._names = [Named(canvas, f"chain/arrow{k}") for k in range(3)]
        self._ball: viser.IcosphereHandle = canvas.scene.add_icosphere(
            canvas.path("chain/point"), 1.0, cast_shadow=False, receive_shadow=False
        )
        adapter.on_event(self._ball, "on_click", lambda _: canvas.post(SelectFrame(POINT)))
        self._point = Named(canvas, "chain/point_name")
        self._globe = Globe(canvas, "chain/globe")
        self._handle: Handle | None = None
        self._handle_unit = 0.0
        self._handles = 0
        self._shown: tuple[str, ...] = ()

    def _chooser(self, k: int) -> Callable[[], None]:
        def choose() -> None:
            if 0 < k < len(self._shown):
                self._canvas.post(SelectFrame(self._shown[k]))

        return choose

    def show(self, state: State) -> None:
        """Show the chain of a state."""
        part, found, p = state[Chain], state.derived(poses_of), state.derived(point_of)
        unit, dark = unit_of(state.derived(places_of)), DARK.on(state)
        self._shown = part.names
        for k, triad in enumerate(self._triads):
            name = part.names[k] if k < len(part.names) else ""
            triad.show(_labels(found, name), found[name] if name else None, unit)
        self._show_point(p, unit, dark)
        self._show_lines(state, unit, dark)
        self._show_arrows(state, unit, dark)
        self._globe.show(found[part.given], p, part.globe)
        self._show_handle(state, unit)

    def _show_point(self, p: Floats, unit: float, dark: bool) -> None:
        scale = BALL * unit
        if self._ball.scale != scale:
            self._ball.scale = scale
        if self._ball.color != INK[dark]:
            self._ball.color = INK[dark]
        move(self._ball, p)
        self._point.show("p", p + np.array([0.0, 0.0, 0.3 * unit]))

    def _show_lines(self, state: State, unit: float, dark: bool) -> None:
        """Show a fine line from each parent to its child, and the components of the point, if they are wanted."""
        part, found = state[Chain], state.derived(poses_of)
        lines: list[Segment] = [
            (found[each.parent][:3, 3], found[each.name][:3, 3], FINE_INK[dark]) for each in part.frames
        ]
        if part.steps:
            coordinates = state.derived(points_of)
            for name in dict.fromkeys((part.reference, part.frame)):
                lines += steps(coordinates[name], found[name])
        self._lines.weigh(self._weight(FINE, unit))
        self._lines.draw(Marks(strokes=_long(lines)))

    def _show_arrows(self, state: State, unit: float, dark: bool) -> None:
        part, found, p = state[Chain], state.derived(poses_of), state.derived(point_of)
        arrows = arrows_of(part, found, p, INK[dark])
        self._arrows.weigh(self._weight(THICK, unit))
        self._arrows.draw(Marks(_long([(start, end, colour) for start, end, colour, _ in arrows])))
        for k, label in enumerate(self._names):
            if k < len(arrows):
                start, end, _, text = arrows[k]
                drawn = float(np.linalg.norm(end - start)) > 2.5 * unit
                label.show(text if drawn else "", start + PLACES[k] * (end - start))
            else:
                label.show("", p)

    def _weight(self, thickness: float, unit: float) -> float:
        return thickness * unit / (FRAME_LENGTH * self._canvas.size)

    def _show_handle(self, state: State, unit: float) -> None:
        part = state[Chain]
        held = self._handle is not None and self._handle.held
        if not held and (self._handle is None or self._handle_unit != unit):
            self._make_handle(unit)
        assert self._handle is not None
        self._handle.at(part.selected, (lambda: self._put_handle(state)) if part.selected else None)

    def _put_handle(self, state: State) -> None:
        assert self._handle is not None
        part, found = state[Chain], state.derived(poses_of)
        if part.selected == POINT:
            self._handle.show_arrows(transform(position=state.derived(point_of)), found[part.given][:3, :3])
        elif part.handle == "turn":
            pose = found[part.selected]
            self._handle.show_rings(pose, pose[:3, :3])
        else:
            self._handle.show_arrows(found[part.selected], found[part.named(part.selected).parent][:3, :3])

    def _make_handle(self, unit: float) -> None:
        """Make a handle of another size in place of the one there is."""
        if self._handle is not None:
            self._handle.remove()
        self._handles += 1
        path = self._canvas.path(f"chain/handle{self._handles}")
        self._handle = Handle(self._canvas, path, self._dragged, scale=HANDLE * unit / self._canvas.size)
        self._handle_unit = unit

    def _dragged(self, pose: NDArray[np.floating], drag: object, ends: bool) -> None:
        assert self._handle is not None
        if self._handle.what == POINT:
            self._canvas.post(DragFramePoint(pose[:3, 3], drag))
        else:
            self._canvas.post(DragFrame(str(self._handle.what), pose, drag))


Arrow = tuple[Floats, Floats, Rgb, str]


def arrows_of(part: Chain, found: dict[str, Floats], p: Floats, ink: Rgb) -> list[Arrow]:
    """Return the arrows of 3.109 in the world with their names, that from the reference to the point in ink.

    If the frame is the reference, or the point is at its origin, one arrow says it all.
    """
    i, j = part.reference, part.frame
    one, other = found[i][:3, 3], found[j][:3, 3]
    whole: Arrow = (one, p, ink, f"{i} → p")
    if i == j:
        return [whole]
    if np.linalg.norm(p - other) < LEAST:
        return [(one, other, ORIGINS, f"{i} → {j}, p")]
    return [whole, (one, other, ORIGINS, f"{i} → {j}"), (other, p, FROM_FRAME, f"{j} → p")]


def steps(coordinates: Floats, frame: Floats) -> list[Segment]:
    """Return the way from the origin of a frame (4, 4) to a point (3,) in it, along one axis after the other."""
    at = frame[:3, 3]
    found: list[Segment] = []
    for k in range(3):
        to = at + coordinates[k] * frame[:3, k]
        found.append((at, to, COLOURS[k]))
        at = to
    return found


def _long(segments: list[Segment]) -> list[Segment]:
    return [each for each in segments if np.linalg.norm(each[1] - each[0]) > LEAST]


def _labels(found: dict[str, Floats], name: str) -> str:
    """Return the names of all frames with one origin, at the first of them; the others have no label of their own."""
    if not name:
        return ""
    at = found[name][:3, 3]
    same = [each for each, T in found.items() if np.abs(T[:3, 3] - at).max() < LEAST]
    return ", ".join("world" if each == WORLD else each for each in same) if same[0] == name else ""


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the frames."""
    return _Picture(canvas).show


LAYER = Layer("frame_chain", order=73, watches=(Chain, Display), build=build, panel="frame_chain")
