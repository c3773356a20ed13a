"""Reading of one cell of a pasted table: a number with its unit, or the joint variable with its offset."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from armlab.content.arithmetic import evaluate
from armlab.content.symbols import plain_symbols
from armlab.errors import InputError

ANGLES = ("deg", "rad")
MOST_DECIMALS = 15
"""Largest number of decimals of a number that was rounded in writing; more come from a program."""

LARGEST_ROUNDING = 2e-3
"""Largest difference, radians, of an angle from the quarter turn that it stands for: 3.14 means pi."""

LENGTHS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3}

_GREEK = {"θ": "theta", "ϑ": "theta", "⍺": "alpha", "α": "alpha", "σ": "sigma", "Θ": "theta"}
_FRACTION = re.compile(r"\\[dt]?frac\s*(?:\{([^{}]*)\}|(\d))\s*(?:\{([^{}]*)\}|(\d))")
_ROOT = re.compile(r"\\sqrt\s*(?:\{([^{}]*)\}|(\d))")
_WRAPPED = re.compile(r"\\(?:text|textbf|textit|textrm|mathrm|mathbf|mathit|boldsymbol|bm|mbox|hat|bar)\s*\{([^{}]*)\}")
_DEGREES = re.compile(r"\\degree(?![a-zA-Z])|\^\s*\{?\s*\\circ\s*\}?|\\textdegree|\^\{?[oO]\}?|\\circ")
_SPACES = re.compile(r"\\(?:left|right|displaystyle|quad|qquad|limits)(?![a-zA-Z])|\\[,;:! ]|~")
_SIUNITX = re.compile(r"\\(?:SI|qty)\s*\{([^{}]*)\}\s*\{([^{}]*)\}|\\(ang|num)\s*\{([^{}]*)\}")
_UNIT_NAMES = {
    r"\milli": "m",
    r"\centi": "c",
    r"\metre": "m",
    r"\meter": "m",
    r"\radian": "rad",
    r"\mm": "mm",
    r"\m": "m",
}
_INDEX = re.compile(r"([_^])\{([^{}\\]*)\}")
_NAMES = re.compile(r"\\(?:var)?(theta|alpha|pi|sigma)(?![a-zA-Z])")
_VARIABLE = re.compile(
    r"(?<![a-z])(?P<name>q|theta|th|d|r|var(?:iable)?)_?\{?(?P<index>[0-9]{1,2}|[ijkn])?\}?"
    r"(?P<mark>\s*\*(?!\s*[\d(a-z])|\^\{?\*\}?|\(t\)|')?(?![a-z0-9])"
)
_DECIMAL = re.compile(r"(\d*\.(\d+))(?:e([-+]?\d+))?")
_UNIT = re.compile(r"(?<=[\d.)i])\s*(deg(?:rees?)?|°|rad(?:ians?)?|mm|cm|m)(?![a-z])")


@dataclass(frozen=True)
class Cell:
    """The content of a cell.

    Attributes
    ----------
    value : float
        The number, or the offset of the variable; in ``unit``.
    unit : str
        ``deg``, ``rad``, ``m``, ``cm``, ``mm``, or empty where the cell names none. A cell with pi is in radians.
    variable : str
        The symbol of the joint variable, such as ``theta``; empty in a cell that is a plain number.
    starred : bool
        Whether the variable is marked as one, as in ``theta_1*``.
    rounding : float
        Largest error of the value due to the rounding of its only decimal number; else 0.
    """

    value: float
    unit: str = ""
    variable: str = ""
    starred: bool = False
    rounding: float = 0.0


def plain(text: str) -> str:
    r"""Return a cell in the signs of a keyboard, without LaTeX and Markdown.

    >>> plain(r"$-\frac{\pi}{2}$"), plain("**θ₁ − 90°**")
    ('-((pi)/(2))', 'theta1 - 90°')
    """
    text = text.strip().strip("`").strip()
    text = re.sub(r"^(\*\*|__|\*)(.+)\1$", r"\2", text)
    text = re.sub(r"\\[()]|\$", "", _SPACES.sub(" ", text))
    text = text.replace("{,}", ",").replace(r"\cdot", "*").replace(r"\times", "*").replace(r"\ast", "*")
    text = _SIUNITX.sub(_with_unit, text)
    text = re.sub(r"\\%|\\#|\\_", lambda match: match[0][1:], text)
    text = plain_symbols(_DEGREES.sub("°", text))
    text = _NAMES.sub(lambda match: match[1], text)
    for letter, name in _GREEK.items():
        text = text.replace(letter, name)
    previous = ""
    while previous != text:  # from the inside out
        previous = text
        text = _WRAPPED.sub(r"\1", _INDEX.sub(r"\1\2", text))
        text = _ROOT.sub(lambda m: f"sqrt({m[1] or m[2]})", text)
        text = _FRACTION.sub(lambda m: f"(({m[1] or m[2]})/({m[3] or m[4]}))", text)
    return re.sub(r"\s+", " ", text).strip()


def _with_unit(match: re.Match[str]) -> str:
    r"""Return number and unit of ``\SI{90}{\degree}`` or ``\ang{90}``."""
    number, unit, macro, alone = match.groups()
    if macro:
        return f"{alone}°" if macro == "ang" else str(alone)
    for name, short in _UNIT_NAMES.items():
        unit = re.sub(re.escape(name) + r"(?![a-z])", short, unit)
    return f"{number} {unit}"


def read_cell(text: str, decimal_comma: bool = False) -> Cell:
    """Read one cell of the columns a, alpha, d and theta.

    Parameters
    ----------
    text : str
        The text as typed.
    decimal_comma : bool
        Whether ``0,5`` may be one half.

    Raises
    ------
    InputError
        It is neither a number nor a joint variable plus a number; the text begins with what was expected.
    """
    written = plain(text)
    lowered = written.lower()
    if decimal_comma:
        lowered = re.sub(r"(?<=\d),(?=\d)", ".", lowered)
    if lowered in ("-", "--", "---"):
        return Cell(0.0)
    if re.fullmatch(r"-?\d+,\d+", lowered):
        raise InputError(f"expected a decimal point, got {text!r}; a comma separates columns here")
    found = list(_VARIABLE.finditer(lowered))
    if len(found) > 1:
        raise InputError(f"expected one joint variable, got {text!r}")
    units = {unit_named(match[1]) for match in _UNIT.finditer(lowered)}
    if len(units) > 1:
        raise InputError(f"expected one unit, got {text!r}")
    bare = _UNIT.sub("", lowered)
    unit = units.pop() if units else "rad" if re.search(r"(?<![a-z])pi(?![a-z])", bare) else ""
    try:
        if not found:
            bare = bare.strip("{}") if "{" in bare else bare
            return Cell(evaluate(bare), unit, rounding=rounding_of(bare))
        name, mark = found[0]["name"], found[0]["mark"]
        offset, *more = (evaluate(_VARIABLE.sub(value, bare)) for value in ("(0)", "(1)", "(2)"))
    except InputError:
        constant = "; write the value of this constant" if re.fullmatch(r"-?[a-z]_?\d*", lowered) else ""
        raise InputError(
            "expected a number such as 90, -pi/2 or 0.4, or a joint variable such as q1 or theta1 + 90, "
            f"got {text!r}{constant}"
        ) from None
    if any(abs(value - offset - step) > 1e-9 * max(1.0, abs(offset)) for step, value in enumerate(more, start=1)):
        raise InputError(f"expected the joint variable plus a number, got {text!r}; the variable counts once, with +")
    rounding = rounding_of(_VARIABLE.sub("(0)", bare))
    return Cell(offset, unit, "theta" if name == "th" else name, bool(mark and "*" in mark), rounding)


def quarter_turn(value: float, rounding: float, most: float = LARGEST_ROUNDING) -> float:
    """Return an angle in radians, or the multiple of a quarter turn of which it is the rounding, at most by ``most``.

    >>> quarter_turn(1.571, 5e-4) == math.pi / 2, quarter_turn(1.571, 5e-5)
    (True, 1.571)
    """
    nearest = round(value / (math.pi / 2)) * (math.pi / 2)
    return nearest if abs(nearest - value) <= min(rounding, most) else value


def rounding_of(text: str) -> float:
    """Return the change of an expression when its only decimal number grows by half a unit of the last digit."""
    found = list(_DECIMAL.finditer(text))
    if len(found) != 1:
        return 0.0
    number, decimals, exponent = found[0].groups()
    power = int(exponent or 0)
    if abs(power) > MOST_DECIMALS or len(decimals) > MOST_DECIMALS:
        return 0.0
    grown = (float(number) + 0.5 * 10.0 ** -len(decimals)) * 10.0**power
    try:
        return abs(evaluate(f"{text[: found[0].start()]}{grown!r}{text[found[0].end() :]}") - evaluate(text))
    except InputError:  # the root of a difference that has become negative
        return 0.0


def unit_named(text: str) -> str:
    """Return ``deg``, ``rad``, ``m``, ``cm`` or ``mm`` for a unit as written.

    >>> unit_named("°"), unit_named("radians")
    ('deg', 'rad')
    """
    if text.startswith(("deg", "°")):
        return "deg"
    return "rad" if text.startswith("rad") else text
