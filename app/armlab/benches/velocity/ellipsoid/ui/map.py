"""The circle of joint speeds of length 1 and its image, the ellipse, with the same point marked on both."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.ellipsoid.state import Manipulability, VelocityBlock
from armlab.benches.velocity.ellipsoid.state_circle import Mapped, MarkSpeeds, UnitCircle, mapped
from armlab.session.state import Post, State
from armlab.ui.format import mathml, number
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

Array = NDArray[np.float64]

SIDE, MARGIN = 150.0, 20.0
"""Of a picture and of its margin, in its own units, which are about pixels."""

MAP = r"v=J\dot{q}"


class Pictures:
    """Two pictures and the slider of the point."""

    def __init__(self, gui: Gui, state: State, post: Post) -> None:
        gui.heading(f"From joint speeds to velocities <small>{mathml(MAP)}, 5.140-5.142</small>")
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
        """Draw both."""
        found = state.derived(mapped)
        if found is None:
            return
        self._slider.show(self._shown(state))
        self._pictures.show(pictures(found, state[Manipulability].block))


def pictures(found: Mapped, block: VelocityBlock) -> str:
    """Return the circle and the ellipse side by side, with what is marked in numbers."""
    angle = np.linspace(0.0, 2.0 * math.pi, len(found.ellipse))
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    usual = block.typical
    reach = max(float(np.abs(found.ellipse).max()), 0.5 * usual)
    unit = "rad/s" if block.arm.revolute.all() else "m/s" if not block.arm.revolute.any() else "of the limits"
    left = _picture(circle, found.preimages, found.speeds, 1.0, ("q̇₁", "q̇₂"), "Circle of joint speeds")
    rows = block.arm.task.position if block.key == "translation" else "xy"
    letter = "v" if block.key == "translation" else "ω"
    names = tuple(f'{letter}<tspan dy="2" font-size="8">{axis}</tspan>' for axis in rows)
    right = _picture(found.ellipse, found.axes, found.velocity, reach, names, "Ellipse of velocities")
    a, b = (number(float(value), 3) for value in found.speeds)
    x, y = (number(float(value), 3) for value in found.velocity)
    size = number(float(np.linalg.norm(found.velocity)), 3)
    return (
        f'<div class="el-map"><figure>{left}<figcaption>q̇ = ({a}, {b})<br>{unit}</figcaption></figure>'
        f"<figure>{right}<figcaption>v = ({x}, {y})<br>{block.unit}, length {size}</figcaption></figure></div>"
    )


def _picture(curve: Array, columns: Array, mark: Array, reach: float, names: tuple[str, ...], said: str) -> str:
    """Return one picture: axes, the curve, two coloured directions, and the marked point as an arrow."""
    half = 0.5 * SIDE
    scale = (half - MARGIN) / reach

    def at(point: Array) -> tuple[float, float]:
        return half + scale * float(point[0]), half - scale * float(point[1])

    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(at, curve))
    strokes = "".join(_line(at(np.zeros(2)), at(columns[:, i]), kind) for i, kind in enumerate(("one", "two")))
    x, y = at(mark)
    return (
        f'<svg viewBox="0 0 {SIDE:g} {SIDE:g}" role="img" aria-label="{said}">'
        f'<line x1="0" y1="{half}" x2="{SIDE}" y2="{half}"/><line x1="{half}" y1="0" x2="{half}" y2="{SIDE}"/>'
        f'<text x="{SIDE - 2}" y="{half - 3}" text-anchor="end">{names[0]}</text>'
        f'<text x="{half + 3}" y="9">{names[1]}</text>'
        f'<polygon class="curve" points="{path}"/>{strokes}'
        f'{_line((half, half), (x, y), "mark")}<circle class="mark" cx="{x:.1f}" cy="{y:.1f}" r="4"/></svg>'
    )


def _line(start: tuple[float, float], end: tuple[float, float], kind: str) -> str:
    return f'<line class="{kind}" x1="{start[0]:.1f}" y1="{start[1]:.1f}" x2="{end[0]:.1f}" y2="{end[1]:.1f}"/>'
