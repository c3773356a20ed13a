"""Checks of lessons: a condition on the state of the arm, and a sentence for when it is not met.

A check is to be met on purpose: tolerances are the author's, but too large ones are refused when the file is read.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from html import escape
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from armlab.content import checks as _folder
from armlab.content.joint_limits import outside
from armlab.content.observation import Observation
from armlab.content.quantities import ROUNDING
from armlab.content.reader import Table, joint_values
from armlab.content.robots import Robot
from armlab.plugins import discover_in_benches

Tolerance = TypeVar("Tolerance", float, NDArray[np.float64])

LARGEST_PART = 0.2
"""Largest tolerance of a length, relative to the arm's reach: with a larger one a random pose would do."""

LARGEST_ANGLE_DEG = 45.0
"""Largest tolerance of an angle, degrees."""

JOINT_VALUES = ("q_deg", "q_m", "q_deg_m")


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
    """Return an angle, given in radians, in degrees with one decimal."""
    return f"{signed(math.degrees(value), 1)}°"


def spaced(key: str) -> str:
    """Return a key as words.

    >>> spaced("joint_types")
    'joint types'
    """
    return key.replace("_", " ")


@dataclass(frozen=True)
class Words:
    """Wording: metres and radians with their units; panels, switches and films by their titles."""

    length: Callable[[float], str] = metres
    angle: Callable[[float], str] = degrees
    title: Callable[[str], str] = spaced


PLAIN = Words()


class Check(Protocol):
    """One check of a step."""

    def is_met(self, observation: Observation) -> bool:
        """Return whether the arm is as the step asks."""
        ...

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return the sentence for a check that is not met: actual value, required value, and a recognised mistake."""
        ...


@dataclass(frozen=True, eq=False)
class Goal:
    """A ball in the world, shown in the scene, in which the tool has to be.

    Attributes
    ----------
    position : ndarray, shape (3,)
        Its centre, metres.
    within : float
        Its radius, metres.
    """

    position: NDArray[np.float64]
    within: float


@dataclass(frozen=True)
class CheckType:
    """One kind of check, the constant ``CHECK`` of a module in `armlab.content.checks`, or of ``check.py`` of a page.

    Parameters
    ----------
    key : str
        The ``kind`` in lesson files.
    order : int
        Place in lists.
    read : callable
        ``read(table, robot) -> Check``: takes the fields of the kind from the table; the caller takes ``kind`` and
        reports what is left over.
    alone : bool
        Whether it may be the whole check of a step; one that asks next to nothing stands only in ``all_of``.
    """

    key: str
    order: int
    read: Callable[[Table, Robot], Check]
    alone: bool = True


@cache
def check_types() -> dict[str, CheckType]:
    """Return all kinds of checks by key."""
    return discover_in_benches("check", "CHECK", CheckType, _folder)


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


@dataclass(frozen=True, eq=False)
class WrongState:
    """A state a lesson expects of those who make a certain mistake.

    Attributes
    ----------
    check : Check
        Met in that state.
    says : str
        The lesson's text on the mistake, as HTML.
    q : ndarray, shape (n,), or None
        A configuration in which it is met, radians and metres.
    """

    check: Check
    says: str
    q: NDArray[np.float64] | None = None


@dataclass(frozen=True, eq=False)
class StateCheck:
    """The check of a step, with the mistakes that the lesson names."""

    check: Check
    wrong: tuple[WrongState, ...] = ()

    @property
    def of_table(self) -> bool:
        """Whether the student works on the table: then an edited arm is still the lesson's."""
        return bool(getattr(self.check, "of_table", False))

    @property
    def observes(self) -> tuple[str, ...]:
        """Keys of benches, such as ``"motion"``, of which the check or a named mistake looks at what they tell."""
        checks = (self.check, *(each.check for each in self.wrong))
        return tuple(dict.fromkeys(key for check in checks for key in getattr(check, "observes", ())))

    @property
    def facts(self) -> tuple[str, ...]:
        """Words of the facts of benches that the check or a named mistake uses."""
        checks = (self.check, *(each.check for each in self.wrong))
        return tuple(dict.fromkeys(word for check in checks for word in getattr(check, "facts", ())))

    @property
    def noted(self) -> tuple[str, ...]:
        """Conditions that no file proves, such as the time that has passed: they are only noted as reported."""
        return tuple(dict.fromkeys(getattr(self.check, "noted", ())))

    @property
    def panels(self) -> tuple[str, ...]:
        """Keys of the panels that it asks to open."""
        return tuple(getattr(self.check, "panels", ()))

    @property
    def switches(self) -> tuple[str, ...]:
        """Names of the switches that the check or a named mistake looks at."""
        checks = (self.check, *(each.check for each in self.wrong))
        return tuple(name for check in checks for name in getattr(check, "switches", ()))

    @property
    def goals(self) -> tuple[Goal, ...]:
        """Goals that the lesson marks in the scene."""
        return tuple(getattr(self.check, "goals", ()))

    def is_met(self, observation: Observation) -> bool:
        """Return whether the check is met."""
        return self.check.is_met(observation)

    def says(self, observation: Observation, words: Words = PLAIN) -> str:
        """Return the sentence of the check itself, plain text, without the lesson's texts on mistakes."""
        return self.check.says(observation, words)

    def judge(self, observation: Observation, words: Words = PLAIN) -> tuple[bool, str]:
        """Return whether the check is met, and the sentence for the student, as HTML."""
        if self.check.is_met(observation):
            return True, escape(self.check.says(observation, words), quote=False)
        for wrong in self.wrong:
            if wrong.check.is_met(observation):
                return False, wrong.says
        return False, escape(self.check.says(observation, words), quote=False)


def read_state_check(table: Table, robot: Robot, to_html: Callable[[str, str], str]) -> StateCheck:
    """Read the check of a step.

    Parameters
    ----------
    table : Table
        ``kind`` and its fields, and tables ``wrong``: ``says`` (Markdown), ``kind`` and its fields, and perhaps
        ``q_deg``, ``q_m`` or ``q_deg_m``, a configuration that gets this verdict.
    robot : Robot
    to_html : callable
        Makes HTML of Markdown; the second argument is its key in the file.

    Raises
    ------
    ContentError
    """
    wrong = tuple(_wrong_state(entry, robot, to_html) for entry in table.tables("wrong"))
    kind = table.choice("kind", check_types())
    if not check_types()[kind].alone:
        raise table.fail("kind", f"{kind!r} is met by doing next to nothing; put it into the checks of an 'all_of'")
    return StateCheck(read_check(table, robot), wrong)


def _wrong_state(entry: Table, robot: Robot, to_html: Callable[[str, str], str]) -> WrongState:
    says = to_html(entry.text("says"), f"{entry.where}.says")
    q = configuration(entry, robot) if any(entry.has(key) for key in JOINT_VALUES) else None
    return WrongState(read_check(entry, robot), says, q)


def configuration(table: Table, robot: Robot) -> NDArray[np.float64]:
    """Take joint values inside the limits, shape (n,): ``q_deg``, ``q_m`` or ``q_deg_m``; read-only."""
    q = joint_values(table, "".join(row.kind for row in robot.arm.rows))
    if not robot.arm.within_limits(q):
        key = next(key for key in JOINT_VALUES if table.has(key))
        raise table.fail(key, f"outside the joint limits of {robot.name}: {outside(robot.arm, q)}")
    q.setflags(write=False)
    return q


def tolerance(table: Table, key: str, default: float | None = None) -> float:
    """Take a number above zero."""
    value = table.number(key, default)
    if value <= 0:
        raise table.fail(key, f"expected a positive number, got {value:g}")
    return value


def length_tolerance(table: Table, robot: Robot, default: float | None = None) -> float:
    """Take ``tolerance_m``, metres, at most `LARGEST_PART` of the reach."""
    value, most = tolerance(table, "tolerance_m", default), LARGEST_PART * 2.0 * robot.arm.length_scale
    if value > most * (1.0 + 1e-9):
        raise table.fail(
            "tolerance_m",
            f"{value:g} m is met by chance; expected at most {most:.3g} m, {LARGEST_PART:.0%} of the reach",
        )
    return value


def angle_tolerance(table: Table, default_deg: float | None = None) -> float:
    """Take ``tolerance_deg``, at most `LARGEST_ANGLE_DEG`; return radians."""
    value = tolerance(table, "tolerance_deg", default_deg)
    if value > LARGEST_ANGLE_DEG:
        raise table.fail("tolerance_deg", f"{value:g} is met by chance; expected at most {LARGEST_ANGLE_DEG:g} degrees")
    return math.radians(value)


def with_edge(tolerance: Tolerance) -> Tolerance:
    """Return a tolerance a little wider, so that what is on its edge is within it: computed, 0.4 - 0.3 is above 0.1."""
    return tolerance * (1.0 + ROUNDING)


def turn_between(angle: float, other: float) -> float:
    """Return the rotation from one angle to the other, in (-pi, pi] rad."""
    turn = math.remainder(other - angle, 2 * math.pi)
    return math.pi if turn == -math.pi else turn
