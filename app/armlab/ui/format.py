"""Numbers, units and mathematics on screen: degrees and millimetres, fixed decimals, typeset matrices."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from functools import lru_cache

import latex2mathml.converter
import numpy as np
from markupsafe import escape
from numpy.typing import NDArray

from armlab.content.formula_room import with_room
from armlab.ui.html import Inside, Markup, classes, tag

MINUS = "\u2212"

EN_SPACE = "\N{EN SPACE}"

FIGURES, TINY, ROUNDING = 4, 1e-6, 1e-12
"""Least number of digits in a field, value below which a power of ten is written, and relative rounding."""

_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_SUPERSCRIPTS = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")


def number(value: float, decimals: int) -> str:
    """Return a number with fixed decimals and a true minus sign; never minus zero.

    >>> number(-0.04, 1), number(-3.25, 2)
    ('0.0', '−3.25')
    """
    text = f"{round(value, decimals) + 0.0:.{decimals}f}"
    return text.replace("-", MINUS)


def trimmed(value: float, decimals: int) -> str:
    """Return a number with at most the given number of decimals, without zeros at its end.

    >>> trimmed(0.4318, 5), trimmed(-90.0, 1)
    ('0.4318', '−90')
    """
    text = number(value, decimals)
    return text.rstrip("0").rstrip(".") if "." in text else text


def so_many(count: int | str, noun: str) -> str:
    """Return a number, perhaps with a sign, and what is counted, in the singular where it is one.

    >>> so_many(1, "joint"), so_many(0, "joint"), so_many("−1", "more point"), so_many("1.5", "year")
    ('1 joint', '0 joints', '−1 more point', '1.5 years')
    """
    return f"{count} {noun}{'' if str(count).lstrip('+−-') == '1' else 's'}"


def readable(value: float, decimals: int) -> str:
    """Return a number for a field, which reads back as nearly the same value, however small it is.

    It has at most so many decimals, and more where `FIGURES` figures need them; below `TINY` a power of ten in the way
    it can be typed.

    >>> readable(0.4318, 5), readable(-1 / 6000, 3), readable(1.5e-9, 3), readable(-1e-15, 3)
    ('0.4318', '−0.0001667', '1.5e−9', '0')
    """
    if abs(value) < ROUNDING:
        return "0"
    if abs(value) < TINY:
        mantissa, exponent = f"{value:.{FIGURES - 1}e}".split("e")
        return f"{mantissa.rstrip('0').rstrip('.')}e{int(exponent)}".replace("-", MINUS)
    return trimmed(value, max(decimals, FIGURES - 1 - math.floor(math.log10(abs(value)))))


def components(values: NDArray[np.floating], decimals: int = 4) -> str:
    """Return the components of a vector in a row."""
    return EN_SPACE.join(number(float(value), decimals) for value in values)


def subscript(letter: str, index: int) -> str:
    """Return a symbol with its index, such as q₁₂."""
    return f"{letter}{str(index).translate(_SUBSCRIPTS)}"


_INDEXED = re.compile(r"\b([a-zO]|α|θ|ϑ)(\d{1,2})\b")


def subscripts(text: str) -> str:
    """Return a text with the numbers of its symbols as indices.

    >>> subscripts("2R, where q4 and a10 are given")
    '2R, where q₄ and a₁₀ are given'
    """
    return _INDEXED.sub(lambda match: subscript(match[1], int(match[2])), text)


def capitalised(text: str) -> str:
    """Return the text with a capital first letter and nothing else changed."""
    return text[:1].upper() + text[1:]


def lowered(text: str) -> str:
    """Return the text with a small first letter and nothing else changed."""
    return text[:1].lower() + text[1:]


@lru_cache(maxsize=4096)
def mathml(latex: str, block: bool = False) -> Markup:
    """Return a formula as MathML."""
    return Markup(with_room(latex2mathml.converter.convert(latex, display="block" if block else "inline")))


PLACE = re.compile(r"@(\w+)@")
"""Place of a text in a formula, inside ``\\text{}``."""


def filled(latex: str, texts: Mapping[str, str]) -> Markup:
    """Return a formula as MathML with present texts in its places, which are ``\\text{@name@}``.

    It is converted once, however often the texts change. They stand as numbers, so that operators between them have
    room.

    >>> print(filled(r"\\text{@a@}", {"a": "1 < 2"}))
    <math xmlns="http://www.w3.org/1998/Math/MathML" display="inline"><mrow><mn>1 &lt; 2</mn></mrow></math>
    """
    made = _with_places(latex)
    return Markup(PLACE.sub(lambda found: str(escape(texts[found[1]])), made))


@lru_cache(maxsize=1024)
def _with_places(latex: str) -> str:
    return str(mathml(latex)).replace("mtext>", "mn>")


def matrix(values: NDArray[np.floating], decimals: int = 3, rule: int | None = None) -> Markup:
    """Return a matrix in brackets; zeros are grey, ``rule`` draws a line before that column."""

    def cell(j: int, value: float) -> Markup:
        zero = abs(value) < 0.5 * 10.0**-decimals
        return tag(classes("td", zero=zero, ruled=j == rule), "0" if zero else number(value, decimals))

    return tag("table.mat", [tag("tr", [cell(j, float(value)) for j, value in enumerate(row)]) for row in values])


def pairs(rows: Sequence[tuple[Inside, Inside]]) -> Markup:
    """Return names and values in two columns."""
    return tag("div.kv", [(tag("span", name), tag("span", value)) for name, value in rows])


def dot(colour: str) -> Markup:
    """Return a small round mark."""
    return tag("span.dot", style=f"background:{colour}")


def scientific(value: float, decimals: int = 1) -> str:
    """Return a number with a power of ten, unless that would be 1.

    >>> scientific(0.000123), scientific(-2.5e-12), scientific(1.57, 2)
    ('1.2·10⁻⁴', '−2.5·10⁻¹²', '1.57')
    """
    if value == 0.0:
        return "0"
    if not math.isfinite(value):
        return "∞" if math.isinf(value) else "–"
    mantissa, exponent = f"{value:.{decimals}e}".split("e")
    power = int(exponent)
    return mantissa.replace("-", MINUS) + (f"·10{str(power).translate(_SUPERSCRIPTS)}" if power else "")
