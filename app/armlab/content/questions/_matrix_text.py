"""Reading of matrices as people type or paste them: ``1 0; 0 1``, with commas, lines, NumPy's or MATLAB's brackets."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from armlab.content.angle_terms import OpenUnit, refuse_open_units
from armlab.content.expressions import parse
from armlab.content.quantities import UNITS, read_quantity
from armlab.content.symbols import MINUS_SIGNS
from armlab.errors import InputError

LONGEST = 2000
"""Longest matrix, in characters."""

_SIGNS = str.maketrans({**dict.fromkeys(MINUS_SIGNS, "-"), **dict.fromkeys("\u00a0\u2007\u2009\u202f\u200a\t", " ")})
_SQUARE = re.compile("(?<![⁺⁻⁰¹²³⁴-⁹])²(?![⁰¹²³⁴-⁹])")
"""The square of a unit such as m/s²; no part of another power such as 10⁻² or 10²⁰."""

_UNIT = "|".join(map(re.escape, [*filter(None, UNITS), "°", "°/s", "°/s^2"]))
_MADE_BY = re.compile(r"\b(?:np\.|numpy\.|sp\.|sympy\.)?(?:array|matrix|Matrix)\s*\(")


def read_matrix(text: str, shape: tuple[int, int], unit: str = "") -> NDArray[np.float64]:
    """Return a matrix as typed; its entries are formulas such as ``sqrt(2)/2``.

    Parameters
    ----------
    text : str
    shape : tuple of int
        The shape that is asked: of the ways a row can be split the one that gives it is taken.
    unit : str
        Unit of the entries returned; one may be typed with its own unit, ``500mm``.

    Returns
    -------
    ndarray
        Of any shape.

    Raises
    ------
    InputError
        An entry cannot be read, is missing (``?``) or has another kind of unit, or the rows differ in length; the
        text names row and column.
    """
    if len(text) > LONGEST:
        raise InputError(f"A matrix has at most {LONGEST} characters; this has {len(text)}.")
    lines = _lines(text)
    if not lines:
        raise InputError("Write the rows with ; between them, such as 1 0; 0 1.")
    ways = [[split(line) for line in lines] for split in (_at_commas, _decimal_commas, _at_both)]
    entries = next((rows for rows in ways if (len(rows), *{len(row) for row in rows}) == shape), ways[0])
    if len({len(row) for row in entries}) > 1:
        lengths = ", ".join(str(len(row)) for row in entries)
        raise InputError(f"The rows differ in length: they have {lengths} entries.")
    return np.array([[_entry(word, i, k, unit) for k, word in enumerate(row, 1)] for i, row in enumerate(entries, 1)])


def _lines(text: str) -> list[str]:
    """Return the rows without enclosing brackets."""
    source = _SQUARE.sub("^2", text.translate(_SIGNS).strip())
    made = _MADE_BY.match(source)
    if made:
        source = source[made.end() :].rstrip().removesuffix(")")
    bracketed = re.search(r"\[\s*\[|\(\s*\[", source) is not None
    source = re.sub(r"\]\s*[,;]?\s*\[", ";", source)
    source = re.sub(r"[\[\]{}]", " ", source)
    # NumPy breaks long rows into lines; its rows have brackets of their own.
    source = source.replace("\n", " " if bracketed else ";")
    lines = [line.strip().strip(",").strip() for line in source.split(";")]
    return [line for line in lines if line]


def _at_commas(line: str) -> list[str]:
    """Split at commas outside of brackets, or at spaces when there are none."""
    words = _outside(line, ",")
    return [word.strip() for word in words] if len(words) > 1 else _at_spaces(line)


def _decimal_commas(line: str) -> list[str]:
    """Split at spaces, with commas as decimal points."""
    return [re.sub(r"(?<=\d),(?=\d)", ".", word.rstrip(",")) for word in _at_spaces(line)]


def _at_both(line: str) -> list[str]:
    """Split at commas and at spaces."""
    return [word for part in _outside(line, ",") for word in _at_spaces(part.strip())]


def _at_spaces(line: str) -> list[str]:
    """Split at spaces outside of brackets, except around an operator or before a unit.

    ``1 - 2`` is one entry, ``1 -2`` two, ``60 deg`` one.
    """
    line = re.sub(r"\s*([*/^·×])\s*", r"\1", line)
    line = re.sub(rf"(?<=[\d.)])\s+(?=(?:{_UNIT})(?:\s|$))", "", line)
    line = re.sub(r"(?<=[\w)°])\s+([-+])\s+(?=\S)", r"\1", line)
    line = re.sub(r"([a-z])\s+\(", r"\1(", line)
    return [word for word in _outside(line, " ") if word]


def _outside(line: str, separator: str) -> list[str]:
    """Split at a character outside of round brackets."""
    parts, depth = [""], 0
    for letter in line:
        depth += {"(": 1, ")": -1}.get(letter, 0)
        if letter == separator and depth <= 0:
            parts.append("")
        else:
            parts[-1] += letter
    return parts


def _entry(word: str, i: int, k: int, unit: str) -> float:
    place = f"Row {i}, column {k}"
    if word == "?":
        raise InputError(f"{place} is empty.")
    # As a formula 60° is a number of radians: where entries have a unit, their own one is looked for first.
    value = _with_unit(word, place, unit) if unit else None
    if value is not None:
        return value
    try:
        formula = parse(word)
        refuse_open_units(word, word, is_angle=False)
        return formula.value({})
    except InputError as error:
        value = _with_unit(word, place, unit)
        if value is None:
            raise InputError(f"{place}: {error}") from None
        return value


def _with_unit(word: str, place: str, unit: str) -> float | None:
    """Return an entry that has its own unit, or None when it has none."""
    try:
        number, own = read_quantity(word, unit)
    except OpenUnit as error:
        raise InputError(f"{place}: {error}") from None
    except InputError:
        return None
    if own is None:
        return None
    (asked, size), (kind, own_size) = UNITS[unit], UNITS[own]
    if kind != asked:
        raise InputError(f"{place}: this is {kind}; write {f'{asked} in {unit}' if unit else 'the number alone'}.")
    return number * own_size / size
