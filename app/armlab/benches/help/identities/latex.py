"""A typed formula as LaTeX, so that a person sees how it was read."""

from __future__ import annotations

from typing import NamedTuple

from armlab.content.expressions import Expression
from armlab.content.identity import GREEK

_SUM, _SIGNED, _PRODUCT, _POWER, _CALL, _ATOM = range(6)

_GREEK = frozenset(GREEK.values())

_OWN = frozenset({"sin", "cos", "tan", "sec", "csc", "cot", "sinh", "cosh", "tanh", "ln", "exp", "min", "max"})
"""Functions that LaTeX has by their names."""


class _Printed(NamedTuple):
    """A part of a formula in LaTeX, how strongly it holds together, and the function of `_OWN` that it begins with."""

    text: str
    binding: int
    function: str = ""


class _Latex:
    """Prints a formula from its innermost parts outwards."""

    def number(self, value: float) -> _Printed:
        text = f"{value:.12g}"
        if value == 3.141592653589793:
            return _Printed(r"\pi", _ATOM)
        mantissa, _, exponent = text.partition("e")
        return _Printed(
            rf"{mantissa}\cdot 10^{{{int(exponent)}}}" if exponent else mantissa, _PRODUCT if exponent else _ATOM
        )

    def name(self, name: str) -> _Printed:
        letter = name.rstrip("0123456789")
        index = name[len(letter) :]
        text = rf"\{letter}" if letter in _GREEK else letter
        return _Printed(f"{text}_{{{index}}}" if index else text, _ATOM)

    def operation(self, operation: str, arguments: list[_Printed]) -> _Printed:
        if operation == "minus":
            return _Printed(f"-{_held(arguments[0], _PRODUCT)}", _SIGNED)
        if operation in ("+", "-"):
            left, right = arguments
            held = _held(right, _PRODUCT) if operation == "-" else _held(right, _SIGNED + 1)
            return _Printed(f"{left.text}{operation}{held}", _SUM)
        if operation == "*":
            return _Printed(_product(*arguments), _PRODUCT)
        if operation == "/":
            return _Printed(rf"\frac{{{arguments[0].text}}}{{{arguments[1].text}}}", _POWER)
        if operation == "^":
            return _power(*arguments)
        return _function(operation, [each.text for each in arguments])


def latex_of(formula: Expression) -> str:
    r"""Return a formula in LaTeX.

    Examples
    --------
    >>> from armlab.content.identity import read_formula
    >>> print(latex_of(read_formula("2 sin(x)^2/(1 - y)")))
    \frac{2\,\sin^{2}(x)}{1-y}
    """
    return formula.folded(_Latex()).text


def _power(base: _Printed, exponent: _Printed) -> _Printed:
    r"""Return a power; of a function as in textbooks, but for \sin^{-1}, which would be the inverse function."""
    if base.function and exponent.text.isdigit():
        inside = base.text.removeprefix(base.function)
        return _Printed(f"{base.function}^{{{exponent.text}}}{inside}", _POWER)
    return _Printed(f"{{{_held(base, _ATOM)}}}^{{{exponent.text}}}", _POWER)


def _held(part: _Printed, least: int) -> str:
    """Return a part in brackets unless it holds together as strongly as it must."""
    return part.text if part.binding >= least else _bracketed(part.text)


def _bracketed(text: str) -> str:
    """Return a text in brackets, which are tall around fractions only."""
    return rf"\left({text}\right)" if r"\frac" in text else f"({text})"


def _product(left: _Printed, right: _Printed) -> str:
    one, other = _held(left, _PRODUCT), _held(right, _PRODUCT)
    # Without a sign 2 times 3^x would be read as 23^x, and 2 times 1/2 as two and a half.
    mixed = one[-1:].isdigit() and other.startswith(r"\frac")
    between = r"\cdot " if mixed or other.lstrip("{")[:1].isdigit() else r"\,"
    return f"{one}{between}{other}"


def _function(name: str, inside: list[str]) -> _Printed:
    if name == "sqrt":
        return _Printed(rf"\sqrt{{{inside[0]}}}", _ATOM)
    if name == "abs":
        return _Printed(rf"\left|{inside[0]}\right|", _ATOM)
    if name == "conj":
        return _Printed(rf"\overline{{{inside[0]}}}", _ATOM)
    if name == "rad":
        return _Printed(rf"{inside[0]}°" if inside[0].replace(".", "").isdigit() else f"({inside[0]})°", _ATOM)
    shown = rf"\{name}" if name in _OWN else rf"\mathrm{{{name}}}"
    return _Printed(f"{shown}{_bracketed(','.join(inside))}", _CALL, shown if name in _OWN else "")
