"""The step that is unfolded, in the scene: its triangle, circle or angles, and the arm that the derivation ends in."""

from __future__ import annotations

import numpy as np
import viser
from numpy.typing import NDArray

from armlab.benches.target.by_hand.state import ByHand, is_there, sheet
from armlab.benches.target.by_hand.ui.card import shown_step
from armlab.benches.target.by_hand.ui.drawn import ROLES, Picture, picture_of
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.target import Target
from armlab.session.state import State
from armlab.ui.colours import BLUE, GREY, PURPLE, SKY, VERMILLION, Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._line_nodes import Dots, Lines
from armlab.ui.scene._nodes import move, seen, write
from armlab.ui.scene._sticks import corners_of
from armlab.ui.scene._strokes import add_name, polyline
from armlab.ui.units import units_of

COLOURS: dict[str, Rgb] = {"given": BLUE, "wanted": PURPLE, "found": VERMILLION, "helper": GREY}
"""Lengths of the arm, what the target gives, what the step finds, and lines that only help."""

THICK = {"given": 0.011, "wanted": 0.008, "found": 0.009, "helper": 0.0022}
"""Thickness of lines, in sizes of the arm: those along links are thicker than the skeleton."""
DOT, OPACITY = 0.009, 0.25


class _Faces:
    """Translucent triangles, one node."""

    def __init__(self, canvas: LayerCanvas, name: str, colour: Rgb) -> None:
        self._canvas, self._path, self._colour = canvas, canvas.path(name), colour
        self._node: viser.MeshHandle | None = None
        self._shown: NDArray[np.float64] | None = None

    def show(self, faces: list[NDArray[np.float64]]) -> None:
        """Show triangles (3, 3) in the world in place of the present ones."""
        at = np.array(faces).reshape(-1, 3)
        if self._shown is not None and np.array_equal(at, self._shown):
            return
        self._shown = at
        if self._node is not None:
            self._node.remove()
            self._node = None
        if not len(at):
            return
        one = np.arange(len(at), dtype=np.uint32).reshape(-1, 3)
        self._node = self._canvas.scene.add_mesh_simple(
            self._path,
            at.astype(np.float32),
            one,
            color=self._colour,
            opacity=OPACITY,
            side="double",
            flat_shading=True,
            cast_shadow=False,
            receive_shadow=False,
        )


RAISED = 0.03
"""Height of a name above its point, in sizes of the arm: the name of a joint may stand at the point itself."""


class _Drawing:
    """All nodes of the layer."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas = canvas
        self._lines = {role: Lines(canvas, f"by_hand/{role}", COLOURS[role], THICK[role]) for role in ROLES}
        self._dots = {role: Dots(canvas, f"by_hand/{role}_dots", COLOURS[role]) for role in ROLES}
        self._faces = _Faces(canvas, "by_hand/faces", SKY)
        self._arm = Lines(canvas, "by_hand/arm", GREY, 0.004)
        self._names: list[viser.LabelHandle] = []

    def show(self, state: State) -> None:
        """Show the step that is unfolded, and the arm in the joint values where it is elsewhere."""
        found, arm = state.derived(sheet), state[Joints].arm
        if found is None or arm is not self._canvas.drawn.figure.anatomy.arm:
            self._draw(Picture())
            self._arm.show(None)
            return
        step = found.derivation.steps[shown_step(state, found) - 1]
        self._draw(picture_of(step, arm.base, units_of(state)))
        q = found.derivation.q
        elsewhere = q is not None and not is_there(state, found)
        self._arm.show(polyline(corners_of(arm, q[None])[0]) if elsewhere and q is not None else None)

    def _draw(self, picture: Picture) -> None:
        for role in ROLES:
            self._lines[role].show(picture.lines.get(role))
            self._dots[role].show(picture.points.get(role), DOT)
        self._faces.show(picture.faces)
        for k, (text, place) in enumerate(picture.names):
            at = place + np.array([0.0, 0.0, RAISED * self._canvas.size])
            if k < len(self._names):
                write(self._names[k], text)
                move(self._names[k], at)
            else:
                path = self._canvas.path(f"by_hand/name{k}")
                self._names.append(add_name(self._canvas.scene, path, text, at, "bottom-left"))
        for k, label in enumerate(self._names):
            seen(label, k < len(picture.names))


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the step while its page is open."""
    return _Drawing(canvas).show


LAYER = Layer("by_hand", 74, (Joints, Target, ByHand, Notation), build, panel="by_hand")
