"""The singular directions in the scene, at the joints and at the tool, with the wanted and the reached velocity."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.microscope.look import Look, look_at
from armlab.benches.velocity.microscope.state import Microscope
from armlab.benches.velocity.statics.ui.torques import LENGTH_DIGITS, Arrow, Push, Torque
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui import adapter
from armlab.ui.colours import BLUE, GREEN, VERDICT, Rgb
from armlab.ui.drawing import LayerCanvas
from armlab.ui.figure.solids import along
from armlab.ui.format import number
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._nodes import move, put, seen, write
from armlab.ui.scene._strokes import add_line, add_name, dashes

Array = NDArray[np.float64]

LENGTH, FARTHEST = 0.3, 2.0
"""Length of the wanted velocity in sizes of the arm, and the longest reached velocity in lengths of the wanted one."""

LOST = 0.26
"""Half length of the line along the direction that is lost, in sizes of the arm."""

DASH, DASHES = 0.0045, 11
"""Thickness, in sizes of the arm, and number of the dashes."""

LEAST = 0.03
"""Share of a unit vector, or of the wish, below which nothing is drawn."""

NAMED = 0.2
"""Share of the length of the wish, or of the longest line, below which an arrow or a line at the tool has no name: it
would lie over the names of the joints there, and the page says what the colours mean."""

TOGETHER = 0.25
"""Distance of the tips of wish and reached velocity, in lengths of the wish, below which they share one name."""

STEPS = 40
"""Number of lengths that an arc at a joint can have."""

THICK, THIN = 0.0055, 0.0036
"""Thickness of the arrows of translation and of rotation, in sizes of the arm."""


class _Velocity:
    """A velocity of the tool: an arrow of translation, and a thin one of rotation."""

    def __init__(self, canvas: LayerCanvas, name: str, colour: Rgb, above: str) -> None:
        scene, path = canvas.scene, canvas.path(f"microscope_{name}")
        scene.add_frame(path, show_axes=False)
        self._size = canvas.size
        # Names of moving stand to the right of their tips, those of turning to the left: the tips may be close.
        self._arrows = [
            Arrow(scene, f"{path}/{kind}", colour, canvas.size, thick, f"{above}-{side}")
            for kind, thick, side in (("moving", THICK, "left"), ("turning", THIN, "right"))
        ]

    def show(self, at: Array, parts: Array, names: Sequence[str]) -> None:
        """Draw a twist (6,), in multiples of the length of the wish, at the tool; an empty name is not written."""
        for i, (arrow, name) in enumerate(zip(self._arrows, names, strict=True)):
            part = parts[3 * i : 3 * i + 3]
            size = float(np.linalg.norm(part))
            drawn = part * (min(size, FARTHEST) / size) if size > LEAST else np.zeros(3)
            arrow.show(at, LENGTH * self._size * drawn)
            arrow.call(name)


def names_of(wish: Array, reached: Array) -> tuple[tuple[str, str], tuple[str, str]]:
    """Return the names of wish and reached velocity, for translation and rotation; one name for both if they meet.

    A part shorter than `NAMED` has none.

    Parameters
    ----------
    wish, reached : ndarray, shape (6,)
        In parts of the length of the wish.
    """
    halves = [(wish[:3], reached[:3]), (wish[3:], reached[3:])]
    meet = [min(map(np.linalg.norm, each)) > LEAST and np.linalg.norm(each[0] - each[1]) < TOGETHER for each in halves]
    first, second = ("wanted, reached" if each else "wanted" for each in meet)
    third, fourth = ("" if each else "reached" for each in meet)
    names = ((first, f"ω {second}"), (third, f"ω {fourth}" if fourth else ""))
    (a, b), (c, d) = (
        [name if np.linalg.norm(part) >= NAMED else "" for name, part in zip(each, (twist[:3], twist[3:]), strict=True)]
        for each, twist in zip(names, (wish, reached), strict=True)
    )
    return (a, b), (c, d)


class _Lost:
    """The direction in which the tool is slowest: a dashed line for translation, or an axis for rotation."""

    def __init__(self, canvas: LayerCanvas) -> None:
        scene, size = canvas.scene, canvas.size
        self._size = size
        self._nodes, self._lines, self._names = [], [], []
        for kind, anchor in (("moving", "bottom-center"), ("turning", "top-center")):
            path = canvas.path(f"microscope_lost_{kind}")
            self._nodes.append(scene.add_frame(path, show_axes=False))
            segments = dashes((0.0, 0.0, -1.0), (0.0, 0.0, 1.0), DASHES)
            self._lines.append(add_line(scene, f"{path}/line", segments, VERDICT["no"], size, DASH))
            self._names.append(add_name(scene, f"{path}/name", "", (0.0, 0.0, 0.0), anchor))
        self._halves = [0.0, 0.0]

    def show(self, at: Array, look: Look) -> None:
        """Draw the lost direction of a configuration."""
        twist, wish = look.twist(look.lost), look.twist(look.wish)
        for i, node in enumerate(self._nodes):
            part = twist[3 * i : 3 * i + 3]
            size = float(np.linalg.norm(part))
            seen(node, size > LEAST)
            if size <= LEAST:
                continue
            # The line points away from the wish, which has names of its own, and has its name at its end.
            put(node, along(-part if part @ wish[3 * i : 3 * i + 3] > 0.0 else part, at))
            self._grow(i, round(LOST * self._size * size, LENGTH_DIGITS))
            what = "rotation" if i else "translation"
            seen(self._names[i], size >= NAMED)
            write(self._names[i], f"lost: no {what}" if look.singular else f"slowest {what}")

    def _grow(self, i: int, half: float) -> None:
        if half != self._halves[i]:
            self._halves[i] = half
            adapter.set_scale(self._lines[i], (1.0, 1.0, half))
            move(self._names[i], (0.0, 0.0, half))


class Picture:
    """All marks of the microscope, which are moved and never rebuilt while the arm moves."""

    def __init__(self, canvas: LayerCanvas, state: State) -> None:
        arm = state[Joints].arm
        self._canvas, self._part = canvas, state[Microscope]
        self._joints = [(Torque if row.revolute else Push)(canvas, i, "microscope") for i, row in enumerate(arm.rows)]
        self._wish = _Velocity(canvas, "wish", BLUE, "bottom")
        self._reached = _Velocity(canvas, "reached", GREEN, "top")
        self._lost = _Lost(canvas)

    def show(self, state: State) -> None:
        """Show the wish and the options of a state."""
        self._part = state[Microscope]
        self.place(self._canvas.shown_pose)

    def place(self, q: Array) -> None:
        """Move the marks to a shown configuration."""
        part = self._part
        look = look_at(part, q)
        at = np.asarray(part.arm.position(q), dtype=np.float64)
        speeds = look.V[:, -1]
        most = float(np.abs(speeds).max())
        for mark, value in zip(self._joints, speeds.tolist(), strict=True):
            counts = abs(value) > LEAST * most
            # In steps, so that an arc is not made anew for every picture of a drag.
            part_shown = round(STEPS * value / most) / STEPS if counts else 0.0
            mark.show(part_shown, number(value, 2) if counts else "")
        size = float(np.linalg.norm(look.wish))
        wish, answer = look.twist(look.wish) / size, look.answer(part.method).qdot
        reached = np.zeros(6) if answer is None else look.twist(look.J @ answer) / size
        names = names_of(wish, reached)
        self._wish.show(at, wish, names[0])
        self._reached.show(at, reached, names[1])
        self._lost.show(at, look)


def build(canvas: LayerCanvas, state: State) -> Show:
    """Build the marks."""
    picture = Picture(canvas, state)
    canvas.on_pose(picture.place)
    return picture.show


LAYER = Layer("microscope", order=66, watches=(Microscope,), build=build, panel="microscope")
