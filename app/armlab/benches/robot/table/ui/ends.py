"""Base, tool and tool point as fields: position, and yaw, pitch and roll."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
from numpy.typing import NDArray

from armlab.benches.robot.table.state import Point, SetPoint, world_point
from armlab.kin.arm import Arm
from armlab.kin.rotations import euler_zyx, rotation_from_sequence
from armlab.session.edits import SetEnd
from armlab.session.parts.robot import RobotPart
from armlab.session.sizes import widest
from armlab.session.state import State
from armlab.ui.form import Form, Wish
from armlab.ui.format import MINUS, mathml, pairs
from armlab.ui.html import Markup
from armlab.ui.markup import fold, row
from armlab.ui.tables import cell_text
from armlab.ui.units import Units

ANGLES = ("yaw", "pitch", "roll")
ENDS = {"base": "frame 0 in the world", "tool": "frame n to the tool {E}"}
PRODUCT = "R = Rz(yaw) Ry(pitch) Rx(roll)"


def ends_markup(form: Form, state: State, units: Units) -> Markup:
    """Return all fields, folded."""
    arm = state[RobotPart].robot.arm

    def line(which: str, label: str, axes: tuple[str, ...], title: str) -> Markup:
        texts = _texts(state, which, units)
        cells = [
            form.field(f"{which}-{axis}", texts[axis], f"{which}, {axis}", partial(_typed, state, which, axis, units))
            for axis in axes
        ]
        return row(label, cells, wide=True, cells=True, hint=title)

    parts = []
    for end, title in ENDS.items():
        told = title.replace("n to the", f"{arm.n} to the")
        parts.append(line(end, f"{end} x y z, {units.length_unit}", tuple("xyz"), told))
        parts.append(line(end, f"yaw pitch roll, {units.angle_unit}", ANGLES, f"{told}: {PRODUCT}"))
    told = "fixed to the tool, in the axes of its frame {E}"
    parts.append(line("point", f"point x y z, {units.length_unit}", tuple("xyz"), told))
    return fold("Base, tool and tool point", parts)


def _typed(state: State, which: str, axis: str, units: Units, text: str) -> Wish:
    """Return the command of a field, or None if the typed text is the present value."""
    if text == _texts(state, which, units)[axis]:
        return None
    turns = axis in ANGLES
    where = f"{'tool point' if which == 'point' else which}, {axis}"
    value = units.read(text, turns, where, within=None if turns else widest(turns))
    if which == "point":
        x, y, z = (value if name == axis else was for name, was in zip("xyz", state[Point].xyz, strict=True))
        return SetPoint((x, y, z))
    pose = np.array(_pose(state[RobotPart].robot.arm, which))
    if turns:
        angles = euler_zyx(pose[:3, :3])[0].tolist()
        angles[ANGLES.index(axis)] = value
        pose[:3, :3] = rotation_from_sequence("zyx", angles)
    else:
        pose["xyz".index(axis), 3] = value
    return SetEnd(which, pose)


def point_line(state: State, units: Units) -> Markup:
    """Return the place of the tool point in the world."""
    formula = mathml(r"{}^{w}p={}^{w}T_E\,{}^{E}p")
    place = "\u2002".join(units.text(float(value), False) for value in world_point(state))
    return pairs([((formula, f", {units.length_unit}"), place)])


def _texts(state: State, which: str, units: Units) -> dict[str, str]:
    """Return the texts of the fields of the base, the tool or the point."""
    if which == "point":
        pose = np.eye(4)
        pose[:3, 3] = state[Point].xyz
    else:
        pose = _pose(state[RobotPart].robot.arm, which)
    position, angles = pose[:3, 3], euler_zyx(pose[:3, :3])[0]
    texts = {axis: cell_text(float(value), "d", units) for axis, value in zip("xyz", position, strict=True)}
    return texts | {name: _turned(float(value), units) for name, value in zip(ANGLES, angles, strict=True)}


def _turned(angle: float, units: Units) -> str:
    """Return an angle of an orientation, with half a turn as 180°."""
    text = cell_text(angle, "theta", units)
    return text.removeprefix(MINUS) if text == cell_text(-math.pi, "theta", units) else text


def _pose(arm: Arm, which: str) -> NDArray[np.float64]:
    return arm.base if which == "base" else arm.tool
