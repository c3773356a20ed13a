"""The joint variables in the scene: arcs from x to x for revolute joints, strokes along z for prismatic ones."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from armlab.kin.dh import Row
from armlab.session.parts.notation import Notation
from armlab.session.state import State
from armlab.ui.drawing import LayerCanvas
from armlab.ui.format import MINUS
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._nodes import write
from armlab.ui.scene._turns import Slide, Turn
from armlab.ui.switches import Switch
from armlab.ui.units import Units, units_of

TURN_OVER = 0.1
"""Cosine of the angle of the axis with the line of sight above which an arc changes to the other face."""


class _Angles:
    """The variables of all joints."""

    def __init__(self, canvas: LayerCanvas) -> None:
        arm = canvas.drawn.figure.anatomy.arm
        self._rows = arm.rows
        self._marks = [Turn(canvas, i) if row.revolute else Slide(canvas, i) for i, row in enumerate(arm.rows)]
        self._drawn, self._sides = [math.nan] * arm.n, [0.0] * arm.n
        self._arm, self._client = arm, canvas.client
        self.units = Units(Notation())

    def follow(self, q: NDArray[np.float64]) -> None:
        """Draw the changes of a shown configuration."""
        self.face(q)
        for i, (mark, value) in enumerate(zip(self._marks, q.tolist(), strict=True)):
            if value != self._drawn[i]:
                self._drawn[i] = value
                mark.follow(value)
                write(mark.name, name_of(self.units, i, self._rows[i], value))

    def face(self, q: NDArray[np.float64]) -> None:
        """Move every arc to the face of its housing that the camera sees."""
        frames = np.asarray(self._arm.frames(q))
        axes = frames[:-1] if self._arm.convention == "standard" else frames[1:]
        sight = np.asarray(self._client.camera.position) - axes[:, :3, 3]
        facing = np.sum(sight * axes[:, :3, 2], axis=1) / np.linalg.norm(sight, axis=1)
        for i, (mark, cosine) in enumerate(zip(self._marks, facing.tolist(), strict=True)):
            if self._sides[i] == 0.0 or cosine * self._sides[i] < -TURN_OVER:
                self._sides[i] = 1.0 if cosine >= 0.0 else -1.0
                mark.face(self._sides[i])

    def rename(self, units: Units) -> None:
        """Write all names in these units."""
        self.units = units
        for i, (mark, value) in enumerate(zip(self._marks, self._drawn, strict=True)):
            write(mark.name, name_of(units, i, self._rows[i], value))


def name_of(units: Units, i: int, row: Row, q: float) -> str:
    """Return the name of joint variable i (0-based) with its value: where the table has an offset, with the sum.

    >>> name_of(Units(Notation()), 0, Row("R"), 0.5)
    'q₁ 28.6°'
    >>> name_of(Units(Notation()), 1, Row("R", theta=math.pi / 2), 0.5)
    'θ₂ = q₂ + 90° = 118.6°'
    """
    revolute = row.revolute
    offset = row.theta if revolute else row.d
    with_unit = units.angle if revolute else units.length
    variable = units.variable(i, revolute)
    if offset == 0.0:
        return f"{variable} {with_unit(q)}"
    sign = MINUS if offset < 0.0 else "+"
    entry = units.symbol("theta" if revolute else "d", i + 1)
    begin = "" if variable == entry else f"{entry} = "
    return f"{begin}{variable} {sign} {units.constant(abs(offset), revolute)} = {with_unit(q + offset)}"


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the variables, which follow the pose."""
    angles = _Angles(canvas)

    def show(state: State) -> None:
        angles.follow(canvas.shown_pose)  # it may have moved while they were hidden
        angles.rename(units_of(state))

    canvas.on_pose(angles.follow)
    canvas.on_eye(lambda: angles.face(canvas.shown_pose))
    return show


SWITCH = Switch(
    "angles",
    "Joint angles",
    "The angle θ of each revolute joint, from the x axis of the frame before to its "
    "own, and the length d of each prismatic joint.",
    "G",
)
LAYER = Layer("angles", order=81, watches=(Notation,), build=build, switch=SWITCH, hides=("names",))
