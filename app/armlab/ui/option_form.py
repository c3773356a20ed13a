"""A form for the options of a path or a law, made from their descriptions, so that a new kind needs no own form."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from armlab.content.arithmetic import evaluate
from armlab.errors import InputError
from armlab.kin.field import Field, seen_fields
from armlab.ui.form import Form, Typed, Wish
from armlab.ui.format import capitalised, readable
from armlab.ui.html import Markup, classes, joined, tag
from armlab.ui.symbols import with_indices

DECIMALS = 4

MOST_LINES = 8
"""Largest number of lines of a table that are visible at once."""


@dataclass(frozen=True)
class Scale:
    """Unit on screen that stands for the unit ``q`` of a coordinate.

    Attributes
    ----------
    unit : str
        Such as ``"°"``; empty for a pure number.
    factor : float
        The size of the unit on screen in radians or metres.
    """

    unit: str = ""
    factor: float = 1.0


ANGLES = ("°", "rad")

PLAIN = (Scale(),)


def unit_text(field: Field, scale: Scale) -> str:
    """Return the unit of an option on screen; empty for a pure number.

    >>> unit_text(Field("v", "v", "speed", "number", unit="q/s"), Scale("mm", 1e-3))
    'mm/s'
    """
    unit = field.unit
    if unit.startswith("q"):
        return (scale.unit or "1") + unit[1:] if unit != "q" else scale.unit
    return {"1": "", "rad": "°"}.get(unit, unit)


def _factor(field: Field, scale: Scale) -> float:
    if field.unit.startswith("q"):
        return scale.factor
    return float(np.pi / 180.0) if field.unit == "rad" else 1.0


def option_form(
    form: Form,
    prefix: str,
    kinds: Sequence[Field],
    given: Mapping[str, Any],
    action: Callable[[str, Any], Wish],
    scales: Sequence[Scale] = PLAIN,
) -> Markup:
    """Return fields and choices for the options that can be used with those given.

    Parameters
    ----------
    form : Form
    prefix : str
        Their cells are this, followed by the key of the option.
    kinds : sequence of Field
    given : mapping
        The values that were chosen, by key; others are as they come.
    action : callable
        ``action(key, value)`` gets the chosen value, radians and metres, or None if the field was emptied.
    scales : sequence of Scale
        One for each coordinate. Numbers and lists are lengths over all of them: in an angle where any turns, otherwise
        in the first (`armlab.benches.motion.plan.paths.joint_scales`).
    """

    def made(kind: Field) -> Markup:
        value = given.get(kind.key, kind.default)

        def taken(text: str) -> Wish:
            return action(kind.key, option_value(kind, text, value, scales))

        return _bound(form, prefix + kind.key, kind, value, taken, scales)

    return joined(map(made, seen_fields(kinds, given)))


def _bound(form: Form, cell: str, kind: Field, value: Any, taken: Typed, scales: Sequence[Scale]) -> Markup:
    title = capitalised(kind.title)
    if kind.kind == "choice":
        chooser = form.select(cell, title, dict(kind.choices), str(value), taken)
        return tag("label.option.wide", tag("span", title), chooser)
    if kind.kind == "flag":
        pressed = form.chip(cell, "✓ yes" if value else "no", lambda: taken(""), title, pressed=bool(value))
        return tag("div.option.wide", tag("span", title), pressed)
    text, unit = _text(kind, value, scales), tag("i", _units(kind, scales))
    if kind.kind == "rows":
        head = f"{kind.symbol}: {kind.title}" if kind.symbol else title
        lines = min(max(text.count("\n") + 1, 2), MOST_LINES)
        typed = form.area(cell, text, title, lines, taken)
        return tag("label.option.wide.rows", tag("span", f"{head} ", unit), typed)
    typed = form.field(cell, text, title, taken)
    wide = kind.kind == "list" or (kind.kind == "vector" and len(scales) > 1)
    symbol = tag("span", with_indices(kind.symbol) if kind.symbol else title)
    return tag(classes("label.option", wide=wide), symbol, typed, unit, title=title)


def _units(kind: Field, scales: Sequence[Scale]) -> str:
    units = dict.fromkeys(unit_text(kind, _scale_of(kind, scales, j)) for j in range(len(scales)))
    return ", ".join(units)


def _text(kind: Field, value: Any, scales: Sequence[Scale]) -> str:
    if value is None:
        return ""
    if kind.kind == "rows":
        return "\n".join(_line(kind, row, scales) for row in value)
    return _line(kind, np.atleast_1d(np.asarray(value, dtype=float)), scales)


def _line(kind: Field, numbers: Iterable[float], scales: Sequence[Scale]) -> str:
    return "  ".join(
        readable(float(number) / _factor(kind, _scale_of(kind, scales, j)), DECIMALS)
        for j, number in enumerate(numbers)
    )


def _scale_of(kind: Field, scales: Sequence[Scale], j: int) -> Scale:
    if kind.kind in ("vector", "rows"):
        return scales[min(j, len(scales) - 1)]
    return next((scale for scale in scales if scale.unit in ANGLES), scales[0])


def option_value(kind: Field, text: str, now: Any = None, scales: Sequence[Scale] = PLAIN) -> Any:
    """Return a typed or pressed value of an option, radians and metres, or None if the field was emptied.

    Parameters
    ----------
    kind : Field
    text : str
    now : value
        The present value: pressing a truth value turns it round.
    scales : sequence of Scale

    Raises
    ------
    InputError
        Not numbers; the text names the option.
    """
    if kind.kind == "flag":
        return not (kind.default if now is None else now)
    if kind.kind == "choice":
        return text
    if not text.strip():
        return None
    if kind.kind == "rows":
        return [_read(kind, row, scales) for row in text.replace("\n", ";").split(";") if row.strip()]
    if kind.kind not in ("vector", "list") and len(_cells(text)) != 1:
        raise InputError(f"{kind.title}: expected one number, got {text.strip()[:40]!r}")
    numbers = _read(kind, text, scales)
    if kind.kind in ("vector", "list"):
        return numbers
    if kind.kind == "whole":
        if numbers[0] != round(numbers[0]):
            raise InputError(f"{kind.title}: expected a whole number, got {text.strip()[:40]!r}")
        return round(numbers[0])
    return numbers[0]


def _read(kind: Field, text: str, scales: Sequence[Scale]) -> list[float]:
    return [_number(kind, cell) * _factor(kind, _scale_of(kind, scales, j)) for j, cell in enumerate(_cells(text))]


def _cells(text: str) -> list[str]:
    """Return the words of a text between blanks, with or without commas."""
    return text.replace(", ", " ").replace("−", "-").split()


def _number(kind: Field, text: str) -> float:
    try:
        return evaluate(text.replace(",", "."))
    except InputError:
        raise InputError(f"{kind.title}: expected numbers separated by blanks, got {text[:40]!r}") from None
