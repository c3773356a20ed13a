"""Recognise the header of a pasted table: which column is which, in what unit, in which convention."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from armlab.content.table_cells import plain, unit_named
from armlab.errors import InputError

DH = ("a", "alpha", "d", "theta")
SHOWN = "a, alpha, d, theta"

_NAMES = {
    "a": r"a|r|l|length|linklength",
    "alpha": r"alpha|twist|linktwist|twistangle|alph",
    "d": r"d|linkoffset|jointoffset|distance|jointdistance",
    "theta": r"theta|th|jointangle|angle",
    "offset": r"offset|offsets?q|q0|thetaoffset",
    "type": r"type|jointtype|kind|sigma|pr|rp",
    "joint": r"joint|link|i|j|n|k|no\.?|nr\.?|number|axis|row|#|frame|jointnumber|jointno\.?|linkno\.?|jointi|linki|",
    "variable": r"variable|var|jointvariable|q",
    "limits": r"limits?|q-|q\+|qmin|qmax|min|max|range|jointlimits?|qlim|home|name|mass|description|notes?|speed",
}
_INDEX = r"(?P<index>[ijknm](?P<before>-1)?|i\+1)?"
_UNIT = re.compile(r"(?:[\[(,/_ ]|\bin )\s*(deg(?:rees?)?|°|rad(?:ians?)?|mm|cm|m)\s*[\])]?\s*$")


@dataclass(frozen=True)
class Column:
    """One column: its role, its unit (or none), the index of its symbol such as ``i-1`` (or none), what was written."""

    role: str
    unit: str
    index: str
    written: str


def read_header(cells: Sequence[str]) -> tuple[Column, ...] | None:
    """Return the columns, or None when this line is no header: fewer than two names of a, alpha, d, theta."""
    columns = tuple(_column(cell) for cell in cells)
    if len({column.role for column in columns if column.role in DH}) < 2:
        return None
    for role in DH:
        same = [column.written for column in columns if column.role == role]
        if len(same) != 1:
            seen = ", ".join(column.written or "(empty)" for column in columns)
            problem = f"{len(same)} of them" if same else "none"
            raise InputError(f"the header: expected one column {role}, got {problem}; the columns are {seen}")
    return columns


def _column(cell: str) -> Column:
    text = plain(cell).lower()
    unit = _UNIT.search(text)
    bare = re.sub(r"[\s_{}()\[\],:*/\\.'\"]", "", text[: unit.start()] if unit else text)
    for role, names in _NAMES.items():
        match = re.fullmatch(f"(?:{names}){_INDEX}", bare)
        if match:
            return Column(role, unit_named(unit[1]) if unit else "", match["index"] or "", cell)
    return Column("", "", "", cell)


def convention_of(columns: Sequence[Column]) -> str:
    """Return ``"modified"`` for a(i-1) and alpha(i-1), ``"standard"`` for a_i and alpha_i, empty without an index.

    Raises
    ------
    InputError
        One of them has i-1 and the other i.
    """
    found = {column.role: column.index for column in columns if column.role in ("a", "alpha")}
    before = [role for role, index in found.items() if index.endswith("-1")]
    at = [role for role, index in found.items() if index and not index.endswith("-1")]
    if before and at:
        raise InputError(
            f"the header: {before[0]}(i-1) is of the modified convention and {at[0]}(i) of the standard one; "
            "expected both alike"
        )
    return "modified" if before else "standard" if at else ""
