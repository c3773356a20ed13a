"""The list of solutions, each as one or two lines that can be pressed."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.benches.target.solutions.found import Found, Row
from armlab.benches.target.solutions.state import GoToSolution, LookAtSolution
from armlab.benches.target.solutions.ui.ghosts import row_colour
from armlab.kin.arm import Arm
from armlab.ui.colours import css
from armlab.ui.form import Form
from armlab.ui.html import Markup, classes, tag
from armlab.ui.units import Units

Values = NDArray[np.float64]

FEW = 2
"""Number of joint values with room beside a name."""

ACROSS = 7
"""Number of values in one line."""


class Table:
    """The list of one arm.

    Parameters
    ----------
    arm : Arm
    units : Units
    form : Form
        What the list stands in.
    """

    def __init__(self, arm: Arm, units: Units, form: Form) -> None:
        self._arm, self._units, self._form = arm, units, form
        heads = ((units.variable(i, row.revolute), units.unit(row.revolute)) for i, row in enumerate(arm.rows))
        self._heads = [tag("span", f"{name} ", tag("small", unit)) for name, unit in heads]

    def markup(self, found: Found, rows: Sequence[Row], present: Row | None, chosen: int, q: Values | None) -> Markup:
        """Return the list.

        Parameters
        ----------
        found : Found
        rows : sequence of Row
            Those to be listed.
        present : Row or None
            Where the arm is.
        chosen : int
            Slot of the one whose ghost is drawn as a body.
        q : ndarray or None
            Joint values of the arm where it is at ``present``: they are shown, with the whole turns it has made.
        """
        named = not all(row.name.startswith("solution ") for row in rows)
        short = self._arm.n <= (ACROSS if not named else FEW)
        stop = next((row for row in rows if row is present), rows[0] if rows else None)
        lines = [
            self._row(place, row, named, q if row is present else None, row is present, row.slot == chosen, row is stop)
            for place, row in enumerate(found.rows, start=1)
            if row in rows
        ]
        kind = classes("div.sols", short=short, named=named, wide=self._is_wide(named))
        head = tag("div.sol-head", tag("span.values", self._heads))
        style = f"--n:{min(self._arm.n, ACROSS)}"
        return tag(kind, head, lines, style=style, role="grid", aria_label="Solutions", data_roves="1")

    def _row(
        self, place: int, row: Row, named: bool, q: Values | None, present: bool, chosen: bool, reached: bool
    ) -> Markup:
        """Return a row; only the one that is ``reached`` by the tab key is a stop, from it arrow keys go on."""
        values = [
            tag("span", self._units.text(float(value), joint.revolute))
            for value, joint in zip(row.q if q is None else q, self._arm.rows, strict=True)
        ]
        out = tag("span.out", f"✕ {self.out(row)}") if not row.within else None
        hint = f"Out of limits: {self.out(row)}" if out else "The arm is here" if present else "Go there"
        go = self._form.button(
            f"go{row.slot}",
            (
                tag("b.place", str(place), style=f"--c:{css(row_colour(row))}"),
                tag("span.name", row.name) if named else None,
                tag("span.values", tag("i", "●") if present else None, values),
                out,
            ),
            GoToSolution(row.slot),
            "sol",
            hint,
            label=f"Solution {place}: {row.name}",
            tabindex="0" if reached else "-1",
            data_rove="1",
        )
        see = None
        if not present and not self._is_wide(named):
            body = LookAtSolution(row.slot)
            see = self._form.button(f"see{row.slot}", "◉", body, "see", "Draw this one as a body", pressed=chosen)
        kind = classes("div.sol-row", now=present, off=not present and not row.within)
        cells = [tag("div", each, role="gridcell") for each in (go, see) if each is not None]
        return tag(kind, cells, data_place=place, role="row", aria_selected=str(present).lower())

    def _is_wide(self, named: bool) -> bool:
        """Return whether the values of a row need the whole width of the panel."""
        return not named and self._arm.n >= ACROSS

    def out(self, row: Row) -> str:
        """Return which joints are out of their limits, and by how much."""
        return ", ".join(
            f"joint {i + 1} by {self._amount(abs(float(row.beyond[i])), self._arm.rows[i].revolute)} "
            f"{'above' if row.beyond[i] > 0.0 else 'below'}"
            for i in np.flatnonzero(row.beyond)
        )

    def _amount(self, value: float, revolute: bool) -> str:
        least = 0.5 * 10.0 ** -self._units.decimals(revolute) * self._units.factor(revolute)
        shown = self._units.angle if revolute else self._units.length
        return shown(value) if value >= least else f"less than {shown(2.0 * least)}"
