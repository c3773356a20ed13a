"""Matrices whose entries, rows and columns can be selected, and copied as NumPy, MATLAB or LaTeX."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.kin.graph.printing import latex_number
from armlab.session.parts.selection import Select, Selection
from armlab.session.state import Post, State
from armlab.ui.form import Form
from armlab.ui.format import number
from armlab.ui.html import Inside, Markup, classes, joined, tag
from armlab.ui.markup import copy_button
from armlab.ui.widgets import Gui

Matrix = NDArray[np.floating]

Place = tuple[int | None, int | None]
"""Row and column of a place; None for all."""

WIDE = 5
"""Largest number of columns with usual spacing; more are set closer."""


class MatrixView:
    """One matrix in a panel.

    Parameters
    ----------
    gui : Gui
    post : callable
    key : str
        Under which its selection is known to the scene; empty for a matrix that is only read.
    """

    def __init__(self, gui: Gui, post: Post, key: str = "") -> None:
        self._key = key
        self._form = gui.form(post)

    def show(
        self,
        state: State,
        title: Inside,
        values: Matrix,
        decimals: int = 3,
        rule: int | None = None,
        columns: Sequence[Inside] = (),
        rows: Sequence[Inside] = (),
    ) -> None:
        """Show the matrix.

        Parameters
        ----------
        state : State
            Whose selection is marked.
        title : str, Markup or several
        values : ndarray, shape (m, n)
        decimals : int
        rule : int, optional
            A dashed line stands before this column.
        columns, rows : sequence of str or Markup
            Their names; a column or row without a name cannot be selected as a whole.
        """
        chosen = state[Selection].of(self._key) if self._key else Selection()
        table = _Table(values, decimals, rule, chosen, self._form, self._key)
        head = tag("h3", title, tag("span.copies", copy_buttons(values)))
        self._form.show(head, table.markup(columns, rows))

    def visible(self, on: bool) -> None:
        """Show or hide the matrix."""
        self._form.visible(on)


@dataclass(frozen=True)
class _Table:
    """The markup of one matrix; with a key its entries are buttons."""

    values: Matrix
    decimals: int
    rule: int | None
    chosen: Selection
    form: Form
    key: str

    def markup(self, columns: Sequence[Inside], rows: Sequence[Inside]) -> Markup:
        m, n = self.values.shape
        lines = []
        if columns:
            heads = [self._head(columns[j], f"column {j + 1}", (None, j)) for j in range(n)]
            lines.append(tag("tr.heads", tag("th") if rows else None, heads))
        for i in range(m):
            lead = self._head(rows[i], f"row {i + 1}", (i, None)) if rows else None
            lines.append(tag(classes("tr", top=i == 0), lead, [self._entry(i, j) for j in range(n)]))
        return tag("div.scroll", tag(classes("table.mat.select", wide=n > WIDE), lines))

    def _head(self, name: Inside, label: str, which: Place) -> Markup:
        if not name or not self.key:
            return tag("th", name)
        pressed = bool(self.chosen.matrix) and (self.chosen.row, self.chosen.column) == which
        return tag("th", self._button(which, name, label, pressed))

    def _entry(self, i: int, j: int) -> Markup:
        value = float(self.values[i, j])
        zero = abs(value) < 0.5 * 10.0**-self.decimals
        text = "0" if zero else number(value, self.decimals)
        lit = self.chosen.holds(i, j)
        inside = self._button((i, j), text, f"row {i + 1}, column {j + 1}: {text}", lit) if self.key else text
        return tag(classes("td", zero=zero, ruled=j == self.rule, lit=lit), inside)

    def _button(self, which: Place, inside: Inside, label: str, pressed: bool) -> Markup:
        cell = ",".join("" if index is None else str(index) for index in which)
        return self.form.button(cell, inside, Select(self.key, *which), label=label, pressed=pressed)


def copy_buttons(values: Matrix) -> Markup:
    """Return small buttons that copy a matrix in the languages of homework."""
    forms = (("NumPy", as_numpy(values)), ("MATLAB", as_matlab(values)), ("LaTeX", as_latex(values)))
    return joined(copy_button(name, text) for name, text in forms)


def as_numpy(values: Matrix) -> str:
    """Return the matrix as Python code.

    >>> as_numpy(np.array([[1.0, -0.0], [0.25, 2.0]]))
    'np.array([[1.0, 0.0], [0.25, 2.0]])'
    """
    rows = ", ".join(f"[{', '.join(repr(_plain(value)) for value in row)}]" for row in values)
    return f"np.array([{rows}])"


def as_matlab(values: Matrix) -> str:
    """Return the matrix as MATLAB code.

    >>> as_matlab(np.array([[1.0, 0.5], [0.0, 2.0]]))
    '[1 0.5; 0 2]'
    """
    return f"[{'; '.join(' '.join(f'{_plain(value):.15g}' for value in row) for row in values)}]"


def as_latex(values: Matrix) -> str:
    r"""Return the matrix as LaTeX with six digits.

    >>> print(as_latex(np.array([[1.0, 0.5]])))
    \begin{bmatrix} 1 & 0.5 \end{bmatrix}
    """
    rows = r" \\ ".join(" & ".join(latex_number(_plain(value), 6) for value in row) for row in values)
    return rf"\begin{{bmatrix}} {rows} \end{{bmatrix}}"


def _plain(value: float) -> float:
    """Return the number, with rounding errors of a zero removed."""
    return 0.0 if abs(float(value)) < 1e-15 else float(value)
