"""The film of the table in the scene: the moving frame, and its moves as arcs and arrows in their colours."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.robot.film.clip import CLIP, Place, place_of
from armlab.kin.dh import Convention
from armlab.kin.moves import MOVES, Move, moves_of, partial_product
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.colours import Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.marks import FRAME_LENGTH, frame_glb
from armlab.ui.figure.solids import along
from armlab.ui.format import subscript
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._arrows import Arc, Arrow, Pose, pale_frame
from armlab.ui.scene._nodes import put, seen, write
from armlab.ui.units import Units, units_of

COLOURS: dict[str, Rgb] = {"theta": (155, 112, 250), "d": (236, 78, 170), "a": (126, 160, 30), "alpha": (190, 130, 90)}
"""Colours of the moves: violet, pink, olive and brown, because the axes and the joints have the others."""

TOOL_COLOUR: Rgb = (128, 137, 150)

LENGTH = 1.35 * FRAME_LENGTH
"""Length of the arrows of the film's frames, in sizes of the arm."""

FROM, TO = 0.30, 0.22
"""Opacity of the frame where a row starts, and of the one where it ends."""

_FROM_Z = np.array([[0.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]])
"""Transform that exchanges x and z, so that turns about x are drawn as turns about z, with their zero along z."""


def symbol(units: Units, field: str, row: int, convention: Convention) -> str:
    """Return the letter of a move with its index: θ₂ in row 2, but α₁ and a₁ there in a modified table."""
    before = convention == "modified" and field in ("a", "alpha")
    return subscript(units.book.symbols[field], row if before else row + 1)


class Film:
    """All nodes of the film."""

    def __init__(self, canvas: LayerCanvas) -> None:
        scene, size, path = canvas.scene, canvas.size, canvas.path("film")
        self._canvas = canvas
        self._arm = canvas.drawn.figure.anatomy.arm
        self._root = scene.add_frame(path, show_axes=False, visible=False)
        self._from = pale_frame(scene, f"{path}/from", LENGTH * size, FROM)
        self._to = pale_frame(scene, f"{path}/to", LENGTH * size, TO)
        self._moving = scene.add_glb(
            f"{path}/moving", frame_glb(), scale=LENGTH * size, cast_shadow=False, receive_shadow=False
        )
        # On two sides of their origins, which may be one.
        self._names = (
            scene.add_label(f"{path}/from/name", "", font_screen_scale=0.85, anchor="top-right"),
            scene.add_label(f"{path}/to/name", "", font_screen_scale=0.85, anchor="top-left"),
        )
        self._marks: dict[str, Arc | Arrow] = {
            field: (Arc if field in ("theta", "alpha") else Arrow)(scene, f"{path}/{field}", colour, size)
            for field, colour in COLOURS.items()
        }
        self._tool = Arrow(scene, f"{path}/tool", TOOL_COLOUR, size)
        self._stations: list[Pose] = []
        self._drawn: tuple[int, bytes] | None = None

    def show(self, state: State, q: NDArray[np.float64]) -> None:
        """Show the film of a state at a configuration, which may differ from that of the state during a short move."""
        on = state[Timeline].clip == CLIP.key
        seen(self._root, on)
        if not on:
            return
        place = place_of(state)
        if self._drawn != (place.row, q.tobytes()):
            self._drawn = place.row, q.tobytes()
            self._begin(place.row, q)
        put(self._moving, partial_product(self._arm, q, place.row, place.progress))
        if place.row == self._arm.n:
            self._show_tool(place, units_of(state))
        else:
            self._show_moves(place, q, units_of(state))

    def _begin(self, row: int, q: NDArray[np.float64]) -> None:
        """Place all nodes for the start of a row."""
        n = self._arm.n
        ends = 1 if row == n else MOVES
        self._stations = [partial_product(self._arm, q, row, k) for k in range(ends + 1)]
        put(self._from, self._stations[0])
        put(self._to, self._stations[-1])
        for name, text in zip(self._names, (str(row), "E" if row == n else str(row + 1)), strict=True):
            write(name, f"{{{text}}}")

    def _show_moves(self, place: Place, q: NDArray[np.float64], units: Units) -> None:
        arm, row = self._arm, self._arm.rows[place.row]
        self._tool.show(0.0, 0.0, False, "")
        for k, move in enumerate(moves_of(row, float(q[place.row]), arm.convention)):
            mark, station = self._marks[move.symbol], self._stations[k]
            mark.place(station @ _FROM_Z if move.axis == "x" else station)
            part = 0.0 if k > place.move else (place.part if k == place.move else 1.0)
            present = k == place.move
            name = f"{symbol(units, move.symbol, place.row, arm.convention)} = {amount(units, move)}"
            shown = present or (k < place.move and abs(move.amount) > 1e-9)
            mark.show(part * move.amount, move.amount, present, name if shown else "")

    def _show_tool(self, place: Place, units: Units) -> None:
        for mark in self._marks.values():
            mark.show(0.0, 0.0, False, "")
        start, shift = self._stations[0], self._arm.tool[:3, 3]
        length = float(np.linalg.norm(shift))
        if length > 0.0:
            self._tool.place(start @ along(shift))
            self._tool.show(place.part * length, length, True, f"tool {units.length(length)}")


def amount(units: Units, move: Move) -> str:
    """Return the size of a move, with its unit."""
    return units.angle(move.amount) if move.kind == "turn" else units.length(move.amount)


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the film while it is on and its page is seen."""
    return canvas.follow(state, Film(canvas).show)


LAYER = Layer("film", order=80, watches=(Timeline, Joints, Notation), build=build, panel="film")
