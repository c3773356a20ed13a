"""The circle of joint speeds of length 1 and its image, the ellipse, with the same point marked on both."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.ellipsoid.state import Manipulability, VelocityBlock
from armlab.benches.velocity.ellipsoid.state_circle import Mapped, MarkSpeeds, UnitCircle, mapped
from armlab.session.state import Post, State
from armlab.ui import svg
from armlab.ui.format import mathml, number
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

Array = NDArray[np.float64]

SIDE, MARGIN = 150.0, 20.0
"""Side of a picture and width of its margin, in units of the picture (about one pixel)."""

MAP = r"v=J\dot{q}"


class Pictures:
    """Two pictures and the slider of the point."""

    def __init__(self, gui: Gui, state: State, post: Post) -> None:
        gui.heading("From joint speeds to velocities ", tag("small", mathml(MAP), "⟦, 5.140-5.142⟧"))
        self._pictures = gui.html()
        self._units = units_of(state)
        factor = self._units.factor(True)
        turn = round(2.0 * math.pi / factor, self._units.decimals(True))
        self._slider = gui.slider(
            f"Direction, {self._units.angle_unit}",
            0.0,
            turn,
            round(10.0 ** -self._units.decimals(True), 6),
            self._shown(state),
            lambda value: post(MarkSpeeds(value * factor)),
            "Of the joint speeds of length 1, from the first joint's alone to the second's.",
        )

    def _shown(self, state: State) -> float:
        return self._units.value(state[UnitCircle].angle % (2.0 * math.pi), True)

    def show(self, state: State) -> None:
        """Draw both pictures."""
        found = state.derived(mapped)
        if found is None:
            return
        self._slider.show(self._shown(state))
        self._pictures.show(pictures(found, state[Manipulability].block))


def pictures(found: Mapped, block: VelocityBlock) -> Markup:
    """Return the circle and the ellipse side by side, with the numbers of the marked point."""
    angle = np.linspace(0.0, 2.0 * math.pi, len(found.ellipse))
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    usual = block.typical
    reach = max(float(np.abs(found.ellipse).max()), 0.5 * usual)
    unit = "rad/s" if block.arm.revolute.all() else "m/s" if not block.arm.revolute.any() else "of the limits"
    left = _picture(circle, found.preimages, found.speeds, 1.0, ("q̇₁", "q̇₂"), "Circle of joint speeds")
    rows = block.arm.task.position if block.key == "translation" else "xy"
    letter = "v" if block.key == "translation" else "ω"
    names = tuple(joined(letter, tag("tspan", axis, dy=2, font_size=8)) for axis in rows)
    right = _picture(found.ellipse, found.axes, found.velocity, reach, names, "Ellipse of velocities")
    a, b = (number(float(value), 3) for value in found.speeds)
    x, y = (number(float(value), 3) for value in found.velocity)
    size = number(float(np.linalg.norm(found.velocity)), 3)
    return tag(
        "div.el-map",
        tag("figure", left, tag("figcaption", f"q̇ = ({a}, {b})", tag("br"), unit)),
        tag("figure", right, tag("figcaption", f"v = ({x}, {y})", tag("br"), f"{block.unit}, length {size}")),
    )


def _picture(curve: Array, columns: Array, mark: Array, reach: float, names: Sequence[Inside], said: str) -> Markup:
    """Return one picture: axes, the curve, two coloured directions, and the marked point as an arrow."""
    half = 0.5 * SIDE
    scale = (half - MARGIN) / reach

    def at(point: Array) -> tuple[float, float]:
        return half + scale * float(point[0]), half - scale * float(point[1])

    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(at, curve))
    x, y = at(mark)
    middle = at(np.zeros(2))
    return svg.drawing(
        "",
        SIDE,
        SIDE,
        said,
        svg.shape("line", x1=0, y1=half, x2=SIDE, y2=half),
        svg.shape("line", x1=half, y1=0, x2=half, y2=SIDE),
        svg.text("", SIDE - 2, half - 3, names[0], "end"),
        svg.text("", half + 3, 9, names[1]),
        tag("polygon.curve", points=path),
        [svg.line(kind, *middle, *at(columns[:, i])) for i, kind in enumerate(("one", "two"))],
        svg.line("mark", *middle, x, y),
        svg.circle("mark", x, y, 4),
    )
