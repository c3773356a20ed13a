"""Variants of a lesson: the number of a variant determines its values, the same for everyone."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Self

from armlab.content.expressions import RESERVED, Expression, parse
from armlab.content.lesson_fields import Fields
from armlab.content.reader import Table, shown
from armlab.errors import InputError
from armlab.kin.checks import whole_number

Value = float | str

NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,31}\Z")
MOST_NAMES, MOST_VALUES, LONGEST_TEXT = 50, 10_000, 200

SHORT_RANGE, LOOKED_AT = 12, 1000
"""Largest number of values of a range that are all tried, and number of variants among which values are looked for."""


class NoValue(InputError):
    """A name of a variant has no value.

    Parameters
    ----------
    name, problem : str
    """

    def __init__(self, name: str, problem: str) -> None:
        super().__init__(f"variants.{name} has no value: {problem}")
        self.name, self.problem = name, problem


@dataclass(frozen=True)
class Variants:
    """The varying values of a lesson.

    Attributes
    ----------
    seed : str
        The lesson's key.
    choices : mapping of str to tuple
        Values to choose from, numbers or texts, by name.
    expressions : mapping of str to Expression
        Expressions of earlier names, by name. A name is in one of the two.
    order : tuple of str
        All names as they stand in the file.
    listed : frozenset of str
        Names whose values are listed one by one, by ``choose``.
    """

    seed: str
    choices: Mapping[str, tuple[Value, ...]]
    expressions: Mapping[str, Expression]
    order: tuple[str, ...]
    listed: frozenset[str] = frozenset()

    @property
    def varies(self) -> bool:
        """Whether there are any values to choose."""
        return any(len(values) > 1 for values in self.choices.values())

    @classmethod
    def read(cls, seed: str, table: Table | None) -> Self:
        """Read a table ``[variants]``.

        Raises
        ------
        ContentError
            A name that cannot be used, an empty or endless choice, an expression that cannot be read.
        """
        if table is None:
            return cls(seed, {}, {}, ())
        choices: dict[str, tuple[Value, ...]] = {}
        expressions: dict[str, Expression] = {}
        fields = Fields.of(table)
        names = fields.keys
        if len(names) > MOST_NAMES:
            raise fields.fail(names[MOST_NAMES], f"expected at most {MOST_NAMES} names, got {len(names)}")
        for name in names:
            _check_name(fields, name)
            found = _read(fields, name, [*_numeric(choices), *expressions])
            if isinstance(found, tuple):
                choices[name] = found
            else:
                expressions[name] = found
        listed = frozenset(name for name in choices if "choose" in fields.value(name))
        return cls(seed, choices, expressions, names, listed)

    def draw(self, number: int) -> dict[str, Value]:
        """Return the values of a variant; number 0 has the first value of each.

        The value of a name depends only on the lesson, the name and the number, so that a further name changes none.

        Raises
        ------
        InputError
            Not a whole number from 0.
        NoValue
            An expression without a value there.
        """
        number = whole_number(number, "variant", 0)
        values: dict[str, Value] = {}
        for name in self.order:
            if name in self.choices:
                values[name] = self._chosen(name, number)
            else:
                values[name] = self._follows(name, values)
        return values

    def _chosen(self, name: str, number: int) -> Value:
        options = self.choices[name]
        return options[_place(f"{self.seed}/{name}/{number}", len(options)) if number else 0]

    def to_try(self, first: int, most: int) -> tuple[tuple[int, ...], bool]:
        """Return the variants in which a mistake would show, and whether they have all values that matter.

        These are all values of lists and of short ranges, and both ends of others.

        Parameters
        ----------
        first : int
            The variants 0 to this one are among them in any case.
        most : int
            Largest number of others, each with a value that none before it has.
        """
        if not self.varies:
            return (0,), True
        found = list(range(first + 1))
        missing = {(name, value) for name in self.choices for value in self._telling(name)}
        missing -= {(name, self._chosen(name, number)) for name in self.choices for number in found}
        for number in range(first + 1, first + 1 + LOOKED_AT):
            if not missing or len(found) > first + most:
                break
            new = missing & {(name, self._chosen(name, number)) for name in self.choices}
            if new:
                found.append(number)
                missing -= new
        return tuple(found), not missing

    def _telling(self, name: str) -> tuple[Value, ...]:
        options = self.choices[name]
        whole = name in self.listed or len(options) <= SHORT_RANGE
        return options if whole else (options[0], options[-1])

    def _follows(self, name: str, values: Mapping[str, Value]) -> float:
        numbers = {each: value for each, value in values.items() if not isinstance(value, str)}
        try:
            return self.expressions[name].value(numbers)
        except InputError as error:
            raise NoValue(name, str(error)) from None


def _place(words: str, count: int) -> int:
    """Return a number from 0 to count - 1 that looks random and is the same on every computer."""
    return int.from_bytes(hashlib.sha256(words.encode()).digest()[:8], "big") % count


def _check_name(table: Table, name: str) -> None:
    if not NAME.match(name):
        raise table.fail(name, "expected a name of letters, digits and underscores that begins with a letter")
    if name in RESERVED:
        raise table.fail(name, f"the name means something else in formulas, as do {', '.join(sorted(RESERVED))}")


def _numeric(choices: Mapping[str, tuple[Value, ...]]) -> list[str]:
    return [name for name, values in choices.items() if not isinstance(values[0], str)]


def _read(table: Fields, name: str, earlier: list[str]) -> tuple[Value, ...] | Expression:
    """Return the values from which a name is chosen, or the expression that gives it."""
    given = table.value(name)
    if isinstance(given, str):
        try:
            return parse(given.strip().removeprefix("="), earlier, together=False)
        except InputError as error:
            known = f"Earlier names: {', '.join(earlier)}." if earlier else "There is no name before it."
            raise table.fail(name, f"{str(error).rstrip('.')}. {known}") from None
    if not isinstance(given, dict):
        raise table.fail(
            name,
            f"expected {{ from = 0.4, to = 0.9, step = 0.1 }}, {{ choose = [1, 2] }} or an expression as a text, "
            f"got {shown(given)}",
        )
    entry = Fields(table.file, given, f"{table.where}.{name}" if table.where else name)
    found = _chosen(entry) if entry.has("choose") else _grid(entry)
    entry.done()
    return found


def _chosen(entry: Fields) -> tuple[Value, ...]:
    given = entry.value("choose")
    if not isinstance(given, list) or not 1 <= len(given) <= MOST_VALUES:
        raise entry.fail("choose", f"expected 1 to {MOST_VALUES} numbers or texts in brackets, got {shown(given)}")
    if isinstance(given[0], str):
        for i, text in enumerate(given):
            if not isinstance(text, str) or len(text) > LONGEST_TEXT or not text.isprintable():
                raise entry.fail(
                    f"choose[{i + 1}]",
                    f"expected a text like the first, in one line of at most {LONGEST_TEXT} characters, "
                    f"got {shown(text)}",
                )
        return tuple(given)
    return tuple(float(value) for value in entry.numbers("choose", len(given)))


def _grid(entry: Fields) -> tuple[Value, ...]:
    """Take a grid with its first and, when the steps lead to it, its last number, without rounding noise."""
    low, high, step = entry.number("from"), entry.number("to"), entry.number("step")
    if step <= 0:
        raise entry.fail("step", f"expected a positive number, got {step:g}")
    if high < low:
        raise entry.fail("to", f"expected a number not below from, {low:g}, got {high:g}")
    # A number in the file, such as 0.1, is meant as this decimal fraction, not as the nearest float.
    first, last, by = (Fraction(repr(value)) for value in (low, high, step))
    count = (last - first) // by + 1
    if count > MOST_VALUES:
        raise entry.fail("step", f"expected at most {MOST_VALUES} values, got {count:.3g}")
    return tuple(float(first + k * by) for k in range(count))
