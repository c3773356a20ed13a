"""Recognition of the header of a pasted table: meaning, unit and convention of the columns."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

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
_FOREIGN = re.compile(r"[\[(/,_ ]\s*(in(?:ch(?:es)?)?|ft|feet|foot|[uµμ]m|dm|km|grad|gon|turns?|rev)\s*[\])]?\s*$")
_UNIT = re.compile(r"(?:[\[(,/_ ]|\bin )\s*(deg(?:rees?)?|°|rad(?:ians?)?|mm|cm|m)\s*[\])]?\s*$")


@dataclass(frozen=True)
class Column:
    """A column: role, unit (or none), index of its symbol such as ``i-1`` (or none), original text, name."""

    role: str
    unit: str
    index: str
    written: str
    name: str = ""


def read_header(cells: Sequence[str]) -> tuple[Column, ...] | None:
    """Return the columns, or None for a line with fewer than two of the names a, alpha, d, theta."""
    columns = tuple(_column(cell) for cell in cells)
    if len({column.role for column in columns if column.role in DH}) < 2:
        return None
    columns = _with_r(columns)
    for role in DH:
        same = [column.written for column in columns if column.role == role]
        if len(same) != 1:
            seen = ", ".join(column.written or "–" for column in columns)
            problem = f"{len(same)} of them" if same else "none"
            raise InputError(f"the header: expected one column {role}, got {problem}; the columns are {seen}")
    return columns


def _column(cell: str) -> Column:
    text = plain(cell).lower()
    unit = _UNIT.search(text)
    bare = re.sub(r"[\s_{}()\[\],:*/\\.'\"]", "", text[: unit.start()] if unit else text)
    for role, names in _NAMES.items():
        match = re.fullmatch(f"(?P<name>{names}){_INDEX}", bare)
        if match:
            return Column(role, unit_named(unit[1]) if unit else "", match["index"] or "", cell, match["name"])
    _refuse_unit(cell, text)
    return Column("", "", "", cell)


def _refuse_unit(cell: str, text: str) -> None:
    """Refuse a column a, alpha, d or theta in a unit that is not read."""
    unit = _FOREIGN.search(text)
    role = _column(text[: unit.start()]).role if unit else ""
    if role in DH:
        raise unit_refused(role, cell)


def unit_refused(role: str, written: str) -> InputError:
    """Return the refusal of a column a, alpha, d or theta in a unit that is none of its own."""
    units = "m, cm or mm" if role in ("a", "d") else "deg or rad"
    return InputError(f"the header: column {role}: expected {units}, got {written!r}")


def _with_r(columns: tuple[Column, ...]) -> tuple[Column, ...]:
    """Return the columns of a header with d and r in their roles: in Khalil's book d is a, and r is d.

    There d stands beside alpha and r beside theta; where it is the other way round, as in some encyclopaedias, r is a.
    With a column sigma it is Khalil's, and a(j) is no length but the link before.
    """
    names = [column.name for column in columns]
    sigma = "sigma" in names
    if "d" not in names or "r" not in names or ("a" in names and not sigma):
        return columns
    order = [column.role if column.role in ("alpha", "theta") else column.name for column in columns]
    pairs = "".join(name[0] if name != "alpha" else "x" for name in order if name in ("alpha", "theta", "d", "r"))
    if not sigma and {"".join(sorted(pairs[:2])), "".join(sorted(pairs[2:]))} == {"dt", "rx"}:
        return columns
    roles = {"d": "a", "r": "d", "a": ""}
    return tuple(replace(column, role=roles.get(column.name, column.role)) for column in columns)


def is_khalil(columns: Sequence[Column]) -> bool:
    """Return whether the column r is the length along z, as in Khalil's book."""
    return any((column.role, column.name) == ("d", "r") for column in columns)


def in_order_of_craig(columns: Sequence[Column]) -> bool:
    """Return whether the columns are in the order of Craig's book."""
    return tuple(column.role for column in columns if column.role in DH) == ("alpha", "a", "d", "theta")


def convention_of(columns: Sequence[Column]) -> str:
    """Return ``"modified"`` for a(i-1) and alpha(i-1), ``"standard"`` for a_i and alpha_i, empty without an index.

    Khalil's tables are modified, with any index.

    Raises
    ------
    InputError
        One of them has i-1 and the other i.
    """
    if is_khalil(columns):
        return "modified"
    found = {column.role: column.index for column in columns if column.role in ("a", "alpha")}
    before = [role for role, index in found.items() if index.endswith("-1")]
    at = [role for role, index in found.items() if index and not index.endswith("-1")]
    if before and at:
        raise InputError(
            f"the header: {before[0]}(i-1) is of the modified convention and {at[0]}(i) of the standard one; "
            "expected both alike"
        )
    return "modified" if before else "standard" if at else ""
