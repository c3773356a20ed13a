"""Equations of a derivation as markup: with symbols, and with the present numbers in the units of the reader."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import lru_cache

from armlab.kin.ik.by_hand import Line, Quantity, Step
from armlab.ui.format import filled, mathml, number
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.units import Units

DECIMALS = 4
"""Number of decimals of numbers without a unit."""

_NAME = re.compile(r"<(\w+)>")

_GREEK = {"theta": "θ", "gamma": "γ", "alpha": "α", "beta": "β", "rho": "ρ", "varphi": "φ", "psi": "ψ", "ell": "ℓ"}
_BELOW = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


def equation(line: Line, step: Step, units: Units) -> Markup:
    """Return the rows of an equation: in symbols, in numbers, and its result, each beginning at the sign."""
    result = step.values.get(line.left)
    symbols = mathml(_NAME.sub(lambda found: _symbol(found[1], step.values), line.right))
    sign = "+" if step.sign > 0 else "−"
    numbers = _with_numbers(line.right, step.values, sign, units) if _NAME.search(line.right) else None
    if result is None:
        shown = tag("div.bh-eq.bare", tag("span"), tag("span", symbols), tag("span"), tag("span", numbers))
        return tag("div.eq", shown)
    rows: list[Inside] = [tag("span", mathml(result.symbol)), tag("span", _equal(), symbols)]
    if numbers is not None:
        rows += [tag("span"), tag("span", _equal(), numbers)]
    rows += [tag("span"), tag("b", _equal(), _value(result, units))]
    return tag("div.eq", tag("div.bh-eq", rows))


def _equal() -> Markup:
    return tag("i", "= ")


def _symbol(name: str, values: Mapping[str, Quantity]) -> str:
    return r"\pm" if name == "sign" else rf"{{{values[name].symbol}}}"


def _with_numbers(right: str, values: Mapping[str, Quantity], sign: str, units: Units) -> Markup:
    """Return a formula with the present numbers."""
    names = {name for name in _NAME.findall(right) if name != "sign"}
    texts = {"sign": sign}
    for name in names:
        value = values[name].value
        if isinstance(value, tuple):
            texts |= {f"{name}{k}": text_of(each, values[name], units) for k, each in enumerate(value)}
        else:
            texts[name] = text_of(value, values[name], units)
            texts[f"{name}0"] = _bracketed(texts[name])
    sizes = tuple(sorted((name, _size(values[name])) for name in names))
    return filled(_with_places(right, sizes), texts)


@lru_cache(maxsize=512)
def _with_places(right: str, sizes: tuple[tuple[str, int], ...]) -> str:
    """Return LaTeX with places for numbers; that of ``name0`` is where a negative one needs brackets."""
    known = dict(sizes)

    def place(found: re.Match[str]) -> str:
        name = found[1]
        if name == "sign":
            return _place(name)
        if known[name]:
            return _column([_place(f"{name}{k}") for k in range(known[name])])
        begins = right[: found.start()].rstrip()[-1:] in ("", "(", ",", "=", "{")
        alone = begins and not right[found.end() :].startswith("^")
        return f"{{{_place(name if alone else f'{name}0')}}}"

    return _NAME.sub(place, right)


def _place(name: str) -> str:
    return rf"\text{{@{name}@}}"


def _size(quantity: Quantity) -> int:
    """Return the number of components, 0 for a number."""
    return len(quantity.value) if isinstance(quantity.value, tuple) else 0


def _column(cells: list[str]) -> str:
    """Return a column in brackets, or for nine components a matrix."""
    rows = [" & ".join(cells[k : k + 3]) for k in (0, 3, 6)] if len(cells) == 9 else cells
    inside = r" \\ ".join(rows)
    return rf"\begin{{bmatrix}}{inside}\end{{bmatrix}}"


def _value(quantity: Quantity, units: Units) -> Inside:
    """Return a result with its unit."""
    if isinstance(quantity.value, float):
        return with_unit(quantity, units)
    unit = f" {units.length_unit}" if quantity.unit == "m" else None
    texts = {str(k): text_of(each, quantity, units) for k, each in enumerate(quantity.value)}
    return filled(_column([_place(str(k)) for k in range(len(quantity.value))]), texts), unit


def with_unit(quantity: Quantity, units: Units) -> str:
    """Return a number with its unit."""
    assert isinstance(quantity.value, float)
    if quantity.unit == "rad":
        return units.angle(quantity.value)
    return units.length(quantity.value) if quantity.unit == "m" else number(quantity.value, DECIMALS)


def text_of(value: float, quantity: Quantity, units: Units) -> str:
    """Return a number in an equation: angles with their sign of degrees, lengths in the unit that all of them have."""
    if quantity.unit == "rad":
        return units.angle(value) if units.in_degrees else units.text(value, True)
    return units.text(value, False) if quantity.unit == "m" else number(value, DECIMALS)


def _bracketed(text: str) -> str:
    return f"({text})" if text.startswith("−") else text


def plain(symbol: str) -> str:
    """Return a symbol as it can stand in the scene, such as θ₁ of ``\\theta_1``."""
    text = re.sub(r"\\([a-zA-Z]+)", lambda found: _GREEK.get(found[1], ""), symbol)
    text = re.sub(r"_\{?([\d,]+)\}?", lambda found: found[1].replace(",", "").translate(_BELOW), text)
    return re.sub(r"[{}\\,\s]", "", text)
