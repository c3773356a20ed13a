"""Fields of a pose: a position in the units on screen, and an orientation as three angles or as a matrix."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.kin.nearest import nearest_rotation
from armlab.session.sizes import MOST_TURNED
from armlab.session.state import Command
from armlab.ui.form import Form
from armlab.ui.format import matrix, readable
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import row
from armlab.ui.nearest import nearest_box
from armlab.ui.units import Units, typed_numbers

Floats = NDArray[np.float64]

AXES, ANGLES = ("x", "y", "z"), ("roll", "pitch", "yaw")

UNIT = 1e-9
"""Distance from the nearest rotation below which a typed matrix is one."""


def length_row(
    form: Form,
    cell: str,
    label: Inside,
    values: Sequence[float],
    units: Units,
    action: Callable[[int, float], Command],
    most: float,
    names: Sequence[str] = AXES,
) -> Markup:
    """Return a line of lengths to type, each at most ``most`` either way.

    The action gets the place of the one that was typed, and metres.
    """
    return _row(form, cell, label, values, units, action, most, names, False)


def angle_row(
    form: Form,
    cell: str,
    label: Inside,
    values: Sequence[float],
    units: Units,
    action: Callable[[int, float], Command],
    names: Sequence[str] = ANGLES,
) -> Markup:
    """Return a line of angles to type; the action gets the place of the one that was typed, and radians."""
    return _row(form, cell, label, values, units, action, MOST_TURNED, names, True)


def _row(
    form: Form,
    cell: str,
    label: Inside,
    values: Sequence[float],
    units: Units,
    action: Callable[[int, float], Command],
    most: float,
    names: Sequence[str],
    turns: bool,
) -> Markup:
    unit = units.unit(turns)

    def field(k: int, name: str) -> Markup:
        def taken(text: str) -> Command:
            return action(k, units.read(text, turns, name, within=(-most, most)))

        return form.field(f"{cell} {k}", units.entry(float(values[k]), turns), f"{name} in {unit}", taken)

    return row((label, f", {unit}"), [field(k, name) for k, name in enumerate(names)], wide=True, cells=True)


def matrix_fields(
    form: Form,
    cell: str,
    shown: Floats,
    one: Callable[[int, int, float], Command],
    all_: Callable[[tuple[float, ...]], Command],
) -> Markup:
    """Return nine fields of a matrix, each of which takes one number, or all nine if they are pasted."""

    def field(i: int, j: int) -> Markup:
        where = f"row {i + 1}, column {j + 1}"

        def taken(text: str) -> Command:
            found = typed_numbers(text, where, 9, "the matrix")
            return all_(tuple(found)) if len(found) > 1 else one(i, j, found[0])

        below = f"{cell} {i + 1}{j}" if i < 2 else f"{cell} 0{j + 1}" if j < 2 else ""
        return form.field(f"{cell} {i}{j}", readable(float(shown[i, j]), 4), f"R, {where}", taken, below)

    rows = [tag("tr", [tag("td", field(i, j)) for j in range(3)]) for i in range(3)]
    return tag("table.mat.typed.fr-matrix", rows)


def projected(
    form: Form, cell: str, typed: Floats | None, take: Callable[[tuple[float, ...]], Command]
) -> Markup | None:
    """Return how far a typed matrix is from the rotation that was taken, with a button to write that one instead."""
    if typed is None:
        return None
    nearest = nearest_rotation(typed)
    if nearest.distance < UNIT:
        return None
    chip = form.chip(cell, "Take it", take(tuple(nearest.rotation.ravel().tolist())), "Write the nearest rotation")
    return nearest_box(
        typed,
        nearest,
        tag("p", "‖M − R‖, the root of the sum of the squares of all entries. The frame takes R: ", chip),
        matrix(nearest.rotation, 4),
    )
