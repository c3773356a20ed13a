"""The selection in J, in words."""

from __future__ import annotations

import numpy as np

from armlab.benches.velocity.speeds.motion import Moving
from armlab.benches.velocity.speeds.state import MATRIX, Velocity
from armlab.benches.velocity.speeds.ui.marks import speed_per_unit
from armlab.benches.velocity.speeds.ui.numbers import ROWS, matrix_words
from armlab.kin.arm import Arm
from armlab.session.parts.joints import Joints
from armlab.session.parts.selection import Selection
from armlab.session.state import State
from armlab.ui.format import number, subscript
from armlab.ui.html import Inside, Markup, joined
from armlab.ui.units import Units, units_of

IN = {"world": "the world", "base": "frame 0", "tool": "the tool"}


def in_words(state: State, moving: Moving) -> Markup:
    """Return a sentence or two on the selection."""
    arm, units = state[Joints].arm, units_of(state)
    selected = state[Selection].of(MATRIX, columns=arm.n)
    row, column = selected.row, selected.column
    said: Inside = None
    if not selected.matrix:
        said = matrix_words(state, moving)
    elif row is None and column is not None:
        said = _column(arm, moving, column, units)
    elif row is not None and column is None:
        said = _row(state, moving, row)
    elif row is not None and column is not None:
        said = _entry(state, moving, row, column)
    return joined(said)


def axis_name(arm: Arm, j: int) -> str:
    """Return the symbol of the axis of joint j (0-based): z of the previous frame, or of its own frame if modified."""
    return subscript("z", j if arm.convention == "standard" else j + 1)


def _speed(arm: Arm, j: int) -> str:
    return f"{subscript('q', j + 1)[0]}\u0307{subscript('', j + 1)} = 1 {'rad/s' if arm.revolute[j] else 'm/s'}"


def _column(arm: Arm, moving: Moving, j: int, units: Units) -> str:
    z, linear = axis_name(arm, j), float(np.linalg.norm(moving.J[:3, j]))
    if not arm.revolute[j]:
        return (
            f"Column {j + 1} is ({z}; 0): with {_speed(arm, j)} alone the tool moves along {z} at 1 m/s and does not "
            "turn⟦ (5.57–5.58)⟧."
        )
    lever = f"({z} × p; {z}), p from the joint to the tool"
    if linear < 1e-9 * arm.length_scale:
        return f"Column {j + 1} is {lever}⟦ (5.64–5.65)⟧. The tool is on the axis: its linear half is 0."
    return (
        f"Column {j + 1} is {lever}⟦ (5.64–5.65)⟧: with {_speed(arm, j)} alone the tool runs across the lever at "
        f"{units.text(linear, False)} {units.length_unit}/s, its distance from the axis times 1 rad/s."
    )


def _row(state: State, moving: Moving, i: int) -> Markup:
    total = float(moving.matrix[i] @ moving.speeds)
    units = units_of(state)
    value = f"{units.text(total, i >= 3)} {units.unit(i >= 3)}/s"
    where = IN[state[Velocity].axes]
    kind = "the tool's speed along" if i < 3 else "its turning about"
    return joined(
        f"Row {i + 1}: how much each joint gives to ",
        ROWS[i],
        f", {kind} {'xyz'[i % 3]} of {where}; the arrows stand at the joints. With the chosen speeds ",
        ROWS[i],
        f" = {value}.",
    )


def _entry(state: State, moving: Moving, i: int, j: int) -> str:
    arm, units = state[Joints].arm, units_of(state)
    value = float(moving.matrix[i, j])
    told = speed_per_unit(value, j, i, arm, units) if i < 3 or arm.revolute[j] else number(value, 3)
    part = "column" if i < 3 else "axis"
    return (
        f"Entry ({i + 1}, {j + 1}): the component of the {part} of joint {j + 1} along {'xyz'[i % 3]} of "
        f"{IN[state[Velocity].axes]}, {told}."
    )
