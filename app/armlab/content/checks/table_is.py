"""The arm has a given Denavit-Hartenberg table."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, get_args

from armlab.content.check import PLAIN, CheckType, Words, angle_tolerance, length_tolerance, turn_between, with_edge
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import Robot
from armlab.kin.arm import MAX_JOINTS
from armlab.kin.assignment import CELLS, judge_row
from armlab.kin.dh import CONVENTIONS, Convention, Kind, Row

SYMBOLS = {"a": "a", "alpha": "α", "d": "d", "theta": "θ"}
"""Names of the cells in sentences, in the order in which they are compared."""

TOLERANCE_M, TOLERANCE_DEG = 1e-3, 0.1
"""Default tolerances, metres and degrees."""

_NOT_THE_VALUE = ("", "wrong", "not a number")


@dataclass(frozen=True)
class TableIs:
    """Rows in m and rad, angles up to whole turns; tolerances ``within`` and ``turned_within`` are for every cell."""

    of_table: ClassVar[bool] = True

    rows: tuple[Row, ...]
    convention: Convention
    within: float
    turned_within: float

    def is_met(self, observation: Observation) -> bool:
        """Return whether convention, joint types and all cells are right."""
        arm = observation.arm
        if arm.convention != self.convention or arm.n != len(self.rows):
            return False
        return all(
            got.kind == row.kind and not self._wrong_cells(row, got)
            for row, got in zip(self.rows, arm.rows, strict=True)
        )

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return a sentence on the first wrong cell and a recognised mistake, without the right value."""
        arm = observation.arm
        if arm.n != len(self.rows):
            return f"The table has {_rows(arm.n)}; it should have {_rows(len(self.rows))}."
        if arm.convention != self.convention:
            return f"The table is in the {arm.convention} convention; the {self.convention} one is asked for."
        if self._is_shifted(arm.rows):
            other = next(convention for convention in CONVENTIONS if convention != self.convention)
            return (
                f"The columns a and α are shifted by a row, as in the {other} convention; the {self.convention} "
                f"one is asked for."
            )
        for i, (row, got) in enumerate(zip(self.rows, arm.rows, strict=True), start=1):
            mistake = self._mistake(row, got, words)
            if mistake:
                return f"Row {i}, {mistake}."
        return "The table is right."

    def _mistake(self, row: Row, got: Row, words: Words) -> str:
        """Return a sentence on the first wrong cell of a row, or ""."""
        if got.kind != row.kind:
            return f"joint type: the joint should be {'revolute' if row.revolute else 'prismatic'}"
        wrong = self._wrong_cells(row, got)
        if not wrong:
            return ""
        name = wrong[0]
        verdict = judge_row(row, {cell: getattr(got, cell) for cell in CELLS}, self.within)[name]
        if verdict.mistake not in _NOT_THE_VALUE:
            text = verdict.text.replace("alpha", "α").replace("theta", "θ")
            return f"{SYMBOLS[name]}: {text}"
        written = words.length if CELLS[name] == "length" else words.angle
        return f"{SYMBOLS[name]}: {written(getattr(got, name))} is not right"

    def _wrong_cells(self, row: Row, got: Row) -> list[str]:
        return [name for name in SYMBOLS if not self._same(name, row, got)]

    def _same(self, name: str, row: Row, got: Row) -> bool:
        expected, value = getattr(row, name), getattr(got, name)
        if CELLS[name] == "length":
            return bool(abs(value - expected) <= with_edge(self.within))
        return abs(turn_between(expected, value)) <= with_edge(self.turned_within)

    def _is_shifted(self, got: tuple[Row, ...]) -> bool:
        """Return whether the links are in the rows of the other convention, everything else being right."""
        asked = self.rows
        shifted = (Row("R"), *asked[:-1]) if self.convention == "standard" else (*asked[1:], Row("R"))
        return (
            self._agree(("d", "theta"), asked, got)
            and self._agree(("a", "alpha"), shifted, got)
            and not self._agree(("a", "alpha"), asked, got)
        )

    def _agree(self, names: tuple[str, ...], rows: tuple[Row, ...], got: tuple[Row, ...]) -> bool:
        return all(self._same(name, row, other) for row, other in zip(rows, got, strict=True) for name in names)


def _rows(count: int) -> str:
    return f"{count} row{'s' * (count > 1)}"


def read(table: Table, robot: Robot) -> TableIs:
    """Read tables ``rows`` with ``type``, ``a``, ``alpha_deg``, ``d``, ``theta_deg``, 0 where left out.

    Then ``convention`` (that of the robot), ``tolerance_m`` (0.001) and ``tolerance_deg`` (0.1).
    """
    entries = table.tables("rows")
    if not 1 <= len(entries) <= MAX_JOINTS:
        raise table.fail("rows", f"expected 1 to {MAX_JOINTS} tables [[rows]], got {len(entries)}")
    convention = table.choice("convention", CONVENTIONS, robot.arm.convention)
    return TableIs(
        tuple(_row(entry) for entry in entries),
        next(known for known in CONVENTIONS if known == convention),
        length_tolerance(table, robot, TOLERANCE_M),
        angle_tolerance(table, TOLERANCE_DEG),
    )


def _row(entry: Table) -> Row:
    kinds: tuple[Kind, ...] = get_args(Kind)
    kind = entry.choice("type", kinds)
    row = Row(
        next(known for known in kinds if known == kind),
        a=entry.number("a", 0.0),
        alpha=math.radians(entry.number("alpha_deg", 0.0)),
        d=entry.number("d", 0.0),
        theta=math.radians(entry.number("theta_deg", 0.0)),
    )
    entry.done()
    return row


CHECK = CheckType("table_is", 60, read)
