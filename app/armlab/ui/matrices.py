"""Matrices whose entries, rows and columns can be selected, and copied as NumPy, MATLAB or LaTeX."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.session.parts.selection import Select, Selection
from armlab.session.state import Post, State
from armlab.ui.fields import Fields
from armlab.ui.format import number
from armlab.ui.markup import button, copy_button
from armlab.ui.widgets import Gui

Matrix = NDArray[np.floating]

WIDE = 5
"""Columns a panel has room for; more are set closer."""


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
        self._key, self._post = key, post
        self._shape = (0, 0)
        self._fields: Fields = gui.fields(lambda cell, _: self._chosen(cell))

    def show(
        self,
        state: State,
        title: str,
        values: Matrix,
        decimals: int = 3,
        rule: int | None = None,
        columns: Sequence[str] = (),
        rows: Sequence[str] = (),
    ) -> None:
        """Show the matrix.

        Parameters
        ----------
        state : State
            Whose selection is marked.
        title : str
            Markup of the heading.
        values : ndarray, shape (m, n)
        decimals : int
        rule : int, optional
            A dashed line stands before this column.
        columns, rows : sequence of str
            Markup of their names; a column or row without a name cannot be selected as a whole.
        """
        self._shape = values.shape
        chosen = state[Selection].of(self._key) if self._key else Selection()
        table = _Table(values, decimals, rule, chosen, self._fields.channel_id if self._key else "")
        head = f'<h3>{title}<span class="copies">{copy_buttons(values)}</span></h3>'
        self._fields.show(head + table.markup(columns, rows))

    def visible(self, on: bool) -> None:
        """Show or hide the matrix."""
        if self._fields.html.visible != on:
            self._fields.html.visible = on

    def _chosen(self, cell: str) -> None:
        """Post what a press on a cell selects."""
        indices = [int(text) if text else None for text in cell.split(",") if text.isdecimal() or not text]
        inside = len(indices) == 2 and all(
            index is None or index < size for index, size in zip(indices, self._shape, strict=True)
        )
        if not inside:
            raise InputError(f"matrix: expected a row and a column of {self._shape}, got {cell[:40]!r}")
        self._post(Select(self._key, indices[0], indices[1]))


@dataclass(frozen=True)
class _Table:
    """The markup of one matrix; with a channel its entries are buttons."""

    values: Matrix
    decimals: int
    rule: int | None
    chosen: Selection
    channel: str

    def markup(self, columns: Sequence[str], rows: Sequence[str]) -> str:
        m, n = self.values.shape
        lines = []
        if columns:
            heads = "".join(self._head(f",{j}", columns[j], f"column {j + 1}", (None, j)) for j in range(n))
            lines.append(f'<tr class="heads">{"<th></th>" if rows else ""}{heads}</tr>')
        for i in range(m):
            lead = self._head(f"{i},", rows[i], f"row {i + 1}", (i, None)) if rows else ""
            top = ' class="top"' if i == 0 else ""
            lines.append(f"<tr{top}>{lead}{''.join(self._entry(i, j) for j in range(n))}</tr>")
        wide = " wide" if n > WIDE else ""
        return f'<div class="scroll"><table class="mat select{wide}">{"".join(lines)}</table></div>'

    def _head(self, cell: str, name: str, label: str, which: tuple[int | None, int | None]) -> str:
        if not name or not self.channel:
            return f"<th>{name}</th>"
        pressed = bool(self.chosen.matrix) and (self.chosen.row, self.chosen.column) == which
        return f"<th>{self._button(cell, name, label, pressed)}</th>"

    def _entry(self, i: int, j: int) -> str:
        value = float(self.values[i, j])
        zero = abs(value) < 0.5 * 10.0**-self.decimals
        text = "0" if zero else number(value, self.decimals)
        lit = self.chosen.holds(i, j)
        classes = " ".join(name for name, on in (("zero", zero), ("ruled", j == self.rule), ("lit", lit)) if on)
        inside = self._button(f"{i},{j}", text, f"row {i + 1}, column {j + 1}: {text}", lit) if self.channel else text
        return f'<td class="{classes}">{inside}</td>' if classes else f"<td>{inside}</td>"

    def _button(self, cell: str, inside: str, label: str, pressed: bool) -> str:
        return button(self.channel, cell, inside, label=label, pressed=pressed)


def copy_buttons(values: Matrix) -> str:
    """Return small buttons that copy a matrix in the languages students hand in."""
    forms = (("NumPy", as_numpy(values)), ("MATLAB", as_matlab(values)), ("LaTeX", as_latex(values)))
    return "".join(copy_button(name, text) for name, text in forms)


def as_numpy(values: Matrix) -> str:
    """Return Python that makes the matrix.

    >>> as_numpy(np.array([[1.0, -0.0], [0.25, 2.0]]))
    'np.array([[1.0, 0.0], [0.25, 2.0]])'
    """
    rows = ", ".join(f"[{', '.join(repr(_plain(value)) for value in row)}]" for row in values)
    return f"np.array([{rows}])"


def as_matlab(values: Matrix) -> str:
    """Return MATLAB that makes the matrix.

    >>> as_matlab(np.array([[1.0, 0.5], [0.0, 2.0]]))
    '[1 0.5; 0 2]'
    """
    return f"[{'; '.join(' '.join(f'{_plain(value):.15g}' for value in row) for row in values)}]"


def as_latex(values: Matrix) -> str:
    r"""Return LaTeX of the matrix with six digits.

    >>> print(as_latex(np.array([[1.0, 0.5]])))
    \begin{bmatrix} 1 & 0.5 \end{bmatrix}
    """
    rows = r" \\ ".join(" & ".join(f"{_plain(value):.6g}" for value in row) for row in values)
    return rf"\begin{{bmatrix}} {rows} \end{{bmatrix}}"


def _plain(value: float) -> float:
    """Return the number without the crumbs of rounding that a zero carries."""
    return 0.0 if abs(float(value)) < 1e-15 else float(value)
