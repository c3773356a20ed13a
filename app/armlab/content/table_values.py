"""From the cells of a pasted table to joint types, radians and metres, with a note on every conclusion."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence

from armlab.content.table_cells import ANGLES, LENGTHS, Cell, plain, quarter_turn, read_cell
from armlab.content.table_header import DH, Column, unit_refused
from armlab.errors import InputError
from armlab.kin.dh import LARGEST_ANGLE, Kind

LARGEST_RADIANS = 6.3
"""Largest angle in radians: a larger one without a unit is taken as degrees."""

LARGEST_METRES = 20.0
"""Largest length in metres: a larger one without a unit is taken as millimetres."""

TOOL = re.compile(r"flange|tool|tcp|hand|gripper|ee|end[ -]?effector")
"""Names of what comes after the last joint, in lower case."""

FIXED = re.compile(rf"{TOOL.pattern}|base|world")
"""Names of what is no joint, unless its row has a variable."""

_PRISMATIC = re.compile(r"\b(p|pris\w*|sliding|linear|transl\w*|p ?\d+)\b")
_REVOLUTE = re.compile(r"\b(r|rev\w*|rotary|rotation\w*|turning|r ?\d+)\b")
_NUMBERED = re.compile(r"(?:joint|link|j|l|axis|frame|q)?[ _.]*\d+\.?(?: ?(?:to|->|-) ?\d+)?|")
_KIND_OF_UNIT = {**dict.fromkeys(ANGLES, "an angle"), **dict.fromkeys(LENGTHS, "a length")}


EXACT = 1e-12
"""Change of an angle, radians, below which it counts as unchanged."""


def _in_quarters(value: float) -> str:
    """Return a multiple of a quarter turn with pi.

    >>> _in_quarters(-3 * math.pi / 2), _in_quarters(math.pi)
    ('-3π/2', 'π')
    """
    quarters = round(value / (math.pi / 2))
    times, over = (quarters // 2, "") if quarters % 2 == 0 else (quarters, "/2")
    return f"{'-' if times < 0 else ''}{abs(times) if abs(times) != 1 else ''}π{over}"


class PastedCells:
    """The cells of the rows by column, read.

    Parameters
    ----------
    lines : sequence of sequence of str
        The rows without the header.
    columns : sequence of Column
    decimal_comma : bool

    Raises
    ------
    InputError
        A row is shorter or longer than the header, or a cell cannot be read.
    """

    def __init__(self, lines: Sequence[Sequence[str]], columns: Sequence[Column], decimal_comma: bool) -> None:
        self._columns = {column.role: column for column in columns}
        self._words: list[dict[str, list[str]]] = []
        self._written: list[dict[str, str]] = []
        self._cells: list[dict[str, Cell]] = []
        for i, line in enumerate(lines):
            if len(line) != len(columns):
                raise InputError(f"row {i + 1}: expected {len(columns)} cells, got {len(line)}: {', '.join(line)}")
            words: dict[str, list[str]] = {}
            for column, text in zip(columns, line, strict=True):
                words.setdefault(column.role, []).append(text)
            self._words.append(words)
            self._written.append({role: words[role][0] for role in (*DH, "offset") if role in words})
            self._cells.append(
                {role: self._read(i, role, text, decimal_comma) for role, text in self._written[i].items()}
            )

    def variables(self, i: int) -> list[str]:
        """Return the symbols of joint variables in a row."""
        return [cell.variable for cell in self._cells[i].values() if cell.variable]

    def marked(self, n: int) -> bool:
        """Return whether each of the first n rows tells the type of its joint."""
        return all(self._kind(i) is not None for i in range(n))

    def kinds(self, n: int, notes: list[str]) -> list[Kind]:
        """Return the types of the joints, which are the first n rows."""
        found = [self._kind(i) for i in range(n)]
        unmarked = [str(i + 1) for i, kind in enumerate(found) if kind is None]
        if unmarked:
            rows = "row " if len(unmarked) == 1 else "rows "
            notes.append(
                f"No joint variable is marked in {rows}{', '.join(unmarked)}: taken as revolute, with theta its offset."
            )
        return [kind or "R" for kind in found]

    def in_radians(self, kinds: Sequence[Kind], notes: list[str]) -> dict[str, list[float]]:
        """Return alpha and theta of all rows; the offset of a revolute joint is in theta."""
        cells = list(self._those("alpha", "theta", kinds, "R"))
        default = self._unit_of_angles(cells, notes)
        mixed = [self._place(i, role) for i, role, cell in cells if self._is_pi_in_degrees(role, cell)]
        if mixed:
            notes.append(f"The header says degrees, but values with pi are taken as radians: {' · '.join(mixed)}.")
        values = {role: [0.0] * len(kinds) for role in ("alpha", "theta")}
        meant: dict[str, str] = {}
        for i, role, cell in cells:
            unit = self._checked(i, role, cell, ANGLES) or self._column_unit(role, ANGLES) or default
            value = math.radians(cell.value) if unit == "deg" else quarter_turn(cell.value, cell.rounding)
            if abs(value) > LARGEST_ANGLE + EXACT:
                raise self._fail(i, role, "expected at most a full turn either way")
            if unit == "rad" and abs(value - cell.value) > EXACT:
                meant.setdefault(plain(self._written[i][role]), _in_quarters(value))
            values["theta" if role == "offset" else role][i] += value
        if meant:
            pairs = ", ".join(f"{written} ({exact})" for written, exact in meant.items())
            notes.append(f"Rounded angles are taken as quarter turns: {pairs}.")
        beyond = [i for i, theta in enumerate(values["theta"]) if abs(theta) > LARGEST_ANGLE]
        for i in beyond:
            values["theta"][i] -= math.copysign(math.tau, values["theta"][i])
        if beyond:
            rows = " · ".join(self._place(i, "theta") for i in beyond)
            notes.append(f"With its offset an angle is beyond a full turn, which is left out: {rows}.")
        return values

    def in_metres(self, kinds: Sequence[Kind], notes: list[str]) -> dict[str, list[float]]:
        """Return a and d of all rows; the offset of a prismatic joint is in d."""
        cells = list(self._those("a", "d", kinds, "P"))
        bare = self._bare(cells, tuple(LENGTHS))
        default = self._other_unit(("a", "d"), LENGTHS) or "m"
        if default == "m" and any(abs(value) > LARGEST_METRES for value in bare):
            default = "mm"
            notes.append(f"Lengths beyond {LARGEST_METRES:g} without a unit: all of them are taken as millimetres.")
        values = {role: [0.0] * len(kinds) for role in ("a", "d")}
        for i, role, cell in cells:
            unit = self._checked(i, role, cell, tuple(LENGTHS)) or self._column_unit(role, LENGTHS) or default
            values["d" if role == "offset" else role][i] += cell.value * LENGTHS[unit]
        return values

    def _unit_of_angles(self, cells: Sequence[tuple[int, str, Cell]], notes: list[str]) -> str:
        """Return the unit of angles for which neither cell nor header has one."""
        bare = self._bare(cells, ANGLES)
        unit = self._other_unit(("alpha", "theta"), ANGLES)
        if unit or not any(bare):
            return unit or "rad"
        if any(cell.unit == "deg" for _, _, cell in cells):
            notes.append("Some angles are marked as degrees: those without a unit are taken as degrees, too.")
            return "deg"
        if any(abs(value) > LARGEST_RADIANS for value in bare):
            notes.append("Angles beyond a full turn of 6.28 without a unit: they are taken as degrees.")
            return "deg"
        notes.append("Angles without a unit are taken as radians.")
        return "rad"

    def _kind(self, i: int) -> Kind | None:
        """Return the type of a joint, or None when nothing determines it."""
        cells = self._cells[i]
        for role in ("a", "alpha", "offset"):
            if role in cells and cells[role].variable:
                raise self._fail(i, role, "expected a number; the joint variable is in theta or d")
        other = "d" if self._columns["d"].name == "r" else "r"
        for role, wrong in (("theta", ("d", "r")), ("d", ("theta", other))):
            if cells[role].variable in wrong:
                raise self._fail(i, role, "expected a number or the joint variable of this column")
        said = self._said(i)
        marked = [role for role in ("theta", "d") if cells[role].variable]
        starred = [role for role in marked if cells[role].starred]
        if len(marked) == 2 and len(starred) != 1 and said is None:
            first, second = self._written[i]["theta"], self._written[i]["d"]
            raise InputError(
                f"row {i + 1}: {first!r} and {second!r} both look like the joint variable; a joint turns or slides: "
                "write the number of the one that is constant"
            )
        variable = {"R": "theta", "P": "d"}[said] if said else (starred or marked or [""])[0]
        for role in marked:
            if role != variable:
                kind = "revolute" if variable == "theta" else "prismatic"
                raise self._fail(i, role, f"expected a number, because the joint is {kind}")
        return {"theta": "R", "d": "P"}.get(variable)  # type: ignore[return-value]

    def _said(self, i: int) -> Kind | None:
        """Return the type that the columns of type, joint and variable give."""
        words = self._words[i]
        for role in ("type", "joint", "variable"):
            for text in words.get(role, []):
                word = plain(text).lower()
                if role == "type" and word in ("0", "1"):  # Khalil's sigma
                    return "P" if word == "1" else "R"
                if role == "variable" and word.startswith(("theta", "d")):
                    return "P" if word.startswith("d") else "R"
                found = [kind for kind, words_ in (("R", _REVOLUTE), ("P", _PRISMATIC)) if words_.search(word)]
                if len(found) == 1:
                    return "R" if found[0] == "R" else "P"
                numbered = _NUMBERED.fullmatch(word) or FIXED.fullmatch(word)
                if found or role == "type" or (role == "joint" and not numbered):
                    raise InputError(
                        f"row {i + 1}, column {role}: expected a joint number or R (revolute) or P (prismatic), "
                        f"got {text!r}"
                    )
        return None

    def _those(self, first: str, second: str, kinds: Sequence[Kind], kind: Kind) -> Iterable[tuple[int, str, Cell]]:
        """Yield row, column and cell of two columns, and of the offsets of joints of one type."""
        for i, cells in enumerate(self._cells):
            yield from ((i, role, cells[role]) for role in (first, second))
            if "offset" in cells and kinds[i] == kind:
                yield i, "offset", cells["offset"]

    def _bare(self, cells: Iterable[tuple[int, str, Cell]], units: Sequence[str]) -> list[float]:
        return [cell.value for _, role, cell in cells if not cell.unit and not self._column_unit(role, units)]

    def _other_unit(self, roles: Sequence[str], units: Iterable[str]) -> str:
        """Return the unit that one of two columns has in its header, for the one that has none."""
        return next((unit for role in roles if (unit := self._column_unit(role, units))), "")

    def _column_unit(self, role: str, units: Iterable[str]) -> str:
        unit, own = self._columns[role].unit, tuple(units)
        if unit and unit not in own and role != "offset":
            raise unit_refused(role, self._columns[role].written)
        return unit if unit in own else ""

    def _is_pi_in_degrees(self, role: str, cell: Cell) -> bool:
        return cell.unit == "rad" and self._column_unit(role, ANGLES) == "deg"

    def _checked(self, i: int, role: str, cell: Cell, units: Sequence[str]) -> str:
        if cell.unit and cell.unit not in units:
            raise self._fail(i, role, f"expected {_KIND_OF_UNIT[units[0]]}")
        return cell.unit

    def _read(self, i: int, role: str, text: str, decimal_comma: bool) -> Cell:
        if role == "offset" and not text:
            return Cell(0.0)
        try:
            return read_cell(text, decimal_comma)
        except InputError as error:
            raise InputError(f"{self._place(i, role)}: {error}") from None

    def _place(self, i: int, role: str) -> str:
        return f"row {i + 1}, column {role}"

    def _fail(self, i: int, role: str, expected: str) -> InputError:
        return InputError(f"{self._place(i, role)}: {expected}, got {self._written[i][role]!r}")
