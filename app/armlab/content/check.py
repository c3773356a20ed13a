"""What a check of a lesson is: a question to the state of the arm, and a sentence for when the answer is no."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Protocol

from armlab.content import checks as _folder
from armlab.content.observation import Observation
from armlab.content.reader import Table
from armlab.content.robots import Robot
from armlab.plugins import discover


def signed(value: float, decimals: int) -> str:
    """Return a number with a true minus sign and fixed decimals; never minus zero.

    >>> signed(-0.25, 2), signed(-0.0001, 2)
    ('−0.25', '0.00')
    """
    return f"{round(value, decimals) + 0.0:.{decimals}f}".replace("-", "\u2212")


def metres(value: float) -> str:
    """Return a length with three decimals and its unit."""
    return f"{signed(value, 3)} m"


def degrees(value: float) -> str:
    """Return an angle given in radians in degrees with one decimal."""
    return f"{signed(math.degrees(value), 1)}°"


@dataclass(frozen=True)
class Words:
    """How quantities are written: functions from metres and from radians to text with its unit."""

    length: Callable[[float], str] = metres
    angle: Callable[[float], str] = degrees


PLAIN = Words()


class Check(Protocol):
    """One check of one step."""

    def is_met(self, observation: Observation) -> bool:
        """Whether the arm is as the step asks."""
        ...

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return the sentence for a check that is not met: what is, what is asked, and the mistake if one is seen."""
        ...


@dataclass(frozen=True)
class CheckType:
    """One kind of check, the constant ``CHECK`` of a module in `armlab.content.checks`.

    Parameters
    ----------
    key : str
        The ``kind`` in lesson files.
    order : int
        Place in lists.
    read : callable
        ``read(table, robot) -> Check``: takes the fields of the kind from the table; the caller takes ``kind`` and
        reports what is left over.
    """

    key: str
    order: int
    read: Callable[[Table, Robot], Check]


@cache
def check_types() -> dict[str, CheckType]:
    """Return all kinds of checks by key."""
    return discover(_folder, "CHECK", CheckType)


def read_check(table: Table, robot: Robot) -> Check:
    """Read a check of any kind.

    Raises
    ------
    ContentError
        An unknown kind, a missing, wrong or unknown field.
    """
    check = check_types()[table.choice("kind", check_types())].read(table, robot)
    table.done()
    return check


def tolerance(table: Table, key: str, default: float | None = None) -> float:
    """Take a number above zero."""
    value = table.number(key, default)
    if value <= 0:
        raise table.fail(key, f"expected a positive number, got {value:g}")
    return value


def turn_between(angle: float, other: float) -> float:
    """Return the turn from one angle to the other, in (-pi, pi] rad."""
    turn = math.remainder(other - angle, 2 * math.pi)
    return math.pi if turn == -math.pi else turn
