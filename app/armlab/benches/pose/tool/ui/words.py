"""The meaning of a selection in the matrix of a transform, in a sentence."""

from __future__ import annotations

from armlab.benches.pose.tool.state import Pair, PoseView
from armlab.benches.pose.tool.ui.notation import cosine
from armlab.session.parts.selection import Selection
from armlab.ui.format import number, subscript
from armlab.ui.html import Inside, tag
from armlab.ui.units import Units

NOTHING = "Select a letter, a row or an entry to see it in the scene."
LAST_ROW = "The last row is 0 0 0 1 in every transform: with it, rotation and translation become one matrix product."


def in_words(view: PoseView, selected: Selection, pair: Pair, units: Units) -> Inside:
    """Return the meaning of the selected entry, row or column."""
    row, column = selected.row, selected.column
    here, moved = f"{{{view.reference}}}", f"{{{view.frame}}}"
    if row is None and column is None:
        return NOTHING
    if row == 3:
        return LAST_ROW
    if row is None:
        assert column is not None
        if column == 3:
            return f"p: from the origin of {here} to that of {moved}, |p| = {units.length(pair.distance)}."
        return f"The {'xyz'[column]} axis of {moved}, in the axes of {here}: a unit vector."
    if column is None:
        return f"Row {'xyz'[row]}: the {'xyz'[row]} axis of {here} in the axes of {moved}; its last entry is that of p."
    if column == 3:
        value = float(pair.transform[row, 3])
        said = f" = {units.length(value)}: the component of p along the {'xyz'[row]} axis of {here}."
        return "p", tag("sub", "xyz"[row]), said
    name = subscript("r", 10 * (row + 1) + column + 1)
    angle = cosine(float(pair.transform[row, column]), pair.angle(row, column), units)
    return f"{name} = {angle}, the angle between {'xyz'[row]} of {here} and {'xyz'[column]} of {moved}."


def vector(values: list[float], decimals: int = 3) -> str:
    """Return components in brackets."""
    return f"({', '.join(number(value, decimals) for value in values)})"
