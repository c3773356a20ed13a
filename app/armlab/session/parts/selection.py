"""The selection in a matrix on screen: an entry, a row or a column, which the scene highlights."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.errors import InputError
from armlab.session.fields import FieldPart
from armlab.session.state import Command, PartType, State


@dataclass(frozen=True)
class Selection(FieldPart):
    """One selection at a time; it is of the moment, and not saved.

    Attributes
    ----------
    matrix : str
        Key of the matrix; empty when nothing is selected.
    row, column : int or None
        0-based. Both: an entry; one of them: a whole row or column.
    """

    key: ClassVar[str] = "selection"
    kept_by_undo: ClassVar[bool] = True

    matrix: str = ""
    row: int | None = None
    column: int | None = None

    def of(self, matrix: str, columns: int | None = None) -> Selection:
        """Return the selection if it is in this matrix, else an empty one.

        Parameters
        ----------
        matrix : str
        columns : int, optional
            How many columns it has now, if they change: what is selected may be from the page of another arm.
        """
        beyond = columns is not None and self.column is not None and self.column >= columns
        return self if self.matrix == matrix and not beyond else Selection()

    def holds(self, row: int, column: int) -> bool:
        """Return whether an entry is selected, by itself or with its row or column."""
        return bool(self.matrix) and self.row in (None, row) and self.column in (None, column)


PART = PartType(Selection, order=80)


@dataclass(frozen=True)
class Select(Command):
    """Select in a matrix; the same selection again is cleared, as is any when nothing is named."""

    matrix: str
    row: int | None = None
    column: int | None = None
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the selection."""
        whole = not self.matrix or (self.row is None and self.column is None)
        if any(index is not None and index < 0 for index in (self.row, self.column)):
            raise InputError(f"selection: rows and columns count from 0, got {self.row}, {self.column}")
        chosen = Selection() if whole else Selection(self.matrix, self.row, self.column)
        if chosen == state[Selection]:
            chosen = Selection()
        return state if chosen == state[Selection] else state.replace(chosen)
