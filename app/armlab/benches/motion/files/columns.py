"""The columns of a table that hold the time and the joints of an arm, and their units."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass

from armlab.errors import InputError
from armlab.kin.arm import Arm

TIMES = {"": 1.0, "s": 1.0, "sec": 1.0, "seconds": 1.0, "ms": 1e-3}
TURNS = {"": 1.0, "rad": 1.0, "deg": math.pi / 180.0, "degrees": math.pi / 180.0, "°": math.pi / 180.0}
SLIDES = {"": 1.0, "m": 1.0, "mm": 1e-3, "cm": 1e-2}
"""Factors of the units in a header; without a unit the numbers are in s, rad, m."""

TIME = re.compile(r"(?:time|t)(?![a-z])(.*)")
JOINT = re.compile(r"(?:q|joint|theta|θ|ϑ|d)[ _]?(\d{1,3})(.*)")
AROUND = " _,()[]{}/"
"""Separators around a unit, as in ``q1_rad``, ``q1 [deg]``, ``t, s``."""

PLAIN = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")

MOST_NAMES = 200
"""Largest number of characters of a header that are shown when a column is missing."""


@dataclass(frozen=True)
class Column:
    """A column of the table.

    Attributes
    ----------
    index : int
        From 0.
    name : str
        As the header has it.
    factor : float
        To s, rad or m.
    unit : str
        As the header has it; empty for none.
    """

    index: int
    name: str
    factor: float
    unit: str


def columns_of(arm: Arm, names: Sequence[str], row: int = 1) -> list[Column]:
    """Return the columns of the time and of joints 1 to n.

    The time is called ``time`` or ``t``, joint 1 ``q1``, ``joint1``, ``theta1`` or ``d1``, with a unit behind it
    (``q1_deg``, ``q1 [deg]``, ``q1, °``) or none for s, rad and m. Another ending, as in ``q1_ref`` beside ``q1``,
    makes another quantity; a column with one is refused only where it is all that there is.

    Parameters
    ----------
    arm : Arm
    names : sequence of str
    row : int
        Where the header stands.

    Raises
    ------
    InputError
        A column is missing, there twice, of a joint the arm has not, or in a unit it cannot have.

    Examples
    --------
    >>> import armlab
    >>> found = columns_of(armlab.load("planar_2r"), ["q2_deg", "t", "q1"])
    >>> [(column.name, round(column.factor, 4)) for column in found]
    [('t', 1.0), ('q1', 1.0), ('q2_deg', 0.0175)]
    """
    found: dict[int, Column] = {}
    refused: dict[int, InputError] = {}
    for index, name in enumerate(names):
        read = _read(arm, index, name, row)
        if read is None:
            continue
        place, column = read
        if isinstance(column, InputError):
            refused.setdefault(place, column)
            continue
        if place in found:
            what = "the time" if place == 0 else f"joint {place}"
            raise InputError(
                f"table, row {row}: {what} is there twice, in columns {found[place].name[:30]} and {name[:30]}"
            )
        found[place] = column
    for place, refusal in refused.items():
        if place not in found:
            raise refusal
    missing = ["time" if place == 0 else f"q{place}" for place in range(arm.n + 1) if place not in found]
    if missing:
        there = ", ".join(names)
        there = there if len(there) <= MOST_NAMES else there[:MOST_NAMES] + " ..."
        raise InputError(f"table, row {row}: no column {', '.join(missing)}; there are: {there}")
    return [found[place] for place in range(arm.n + 1)]


def rate_columns(arm: Arm, names: Sequence[str], order: int) -> list[Column] | None:
    """Return the columns of velocities (1) or accelerations (2) of joints 1 to n, or None unless all are there.

    They are called ``qdot1`` and ``qddot1``, in rad and m and seconds, with the units behind them or without.
    """
    name = re.compile(rf"q{'d' * order}ot(\d{{1,3}})(?:_(?:rad|m)_s{'2' if order == 2 else ''})?")
    found = {}
    for index, text in enumerate(names):
        match = name.fullmatch(text.strip().lower().translate(PLAIN))
        if match is not None:
            found[int(match[1])] = Column(index, text, 1.0, "")
    return [found[k] for k in range(1, arm.n + 1)] if set(found) >= set(range(1, arm.n + 1)) else None


def headless(arm: Arm, count: int, row: int = 1) -> list[Column]:
    """Return the columns of a table without a header: time, joint 1, ..., in s, rad and m."""
    if count != arm.n + 1:
        raise InputError(
            f"table, row {row}: expected the names time, q1 to q{arm.n}, or {arm.n + 1} numbers in this order, got "
            f"{count} numbers"
        )
    return [Column(index, str(index + 1), 1.0, "") for index in range(count)]


def _read(arm: Arm, index: int, name: str, row: int) -> tuple[int, Column | InputError] | None:
    """Return the joint of a column, 0 for the time, and how it is read or why not, or None for another quantity."""
    plain = name.strip().lower().translate(PLAIN)
    where = f"table, row {row}, column {name[:30]}"
    time = TIME.fullmatch(plain)
    if time is not None:
        return 0, _column(index, name, time[1], TIMES, f"{where}: expected the time")
    joint = JOINT.fullmatch(plain)
    if joint is None or joint[2][:1].isalpha():
        return None
    number = int(joint[1])
    if not 1 <= number <= arm.n:
        raise InputError(f"{where}: there is no joint {number}; this arm has joints 1 to {arm.n}")
    turns = bool(arm.revolute[number - 1])
    what = f"joint {number}, which is {'revolute' if turns else 'prismatic'},"
    return number, _column(index, name, joint[2], TURNS if turns else SLIDES, f"{where}: expected {what}")


def _column(index: int, name: str, ending: str, units: dict[str, float], expected: str) -> Column | InputError:
    """Return a column with the unit at the end of its name, or the refusal of one that is no unit."""
    unit = ending.strip(AROUND)
    if unit not in units:
        return InputError(f"{expected} in {', '.join(filter(None, units))}, got {unit[:30]!r}")
    return Column(index, name, units[unit], unit)
