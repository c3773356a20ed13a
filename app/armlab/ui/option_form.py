"""A form for the options of a path or a law, made from their descriptions, so that a new kind needs no own form."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from armlab.kin.field import Field, seen_fields
from armlab.ui.form import Form, Typed, Wish
from armlab.ui.format import capitalised, readable
from armlab.ui.html import Markup, classes, joined, tag
from armlab.ui.option_text import DECIMALS, PLAIN, Scale, factor_of, option_value, scale_of, unit_text
from armlab.ui.symbols import named

MOST_LINES = 8
"""Largest number of lines of a table that are visible at once."""


def option_form(
    form: Form,
    prefix: str,
    kinds: Sequence[Field],
    given: Mapping[str, Any],
    action: Callable[[str, Any], Wish],
    scales: Sequence[Scale] = PLAIN,
    needed: bool = False,
    off: Collection[str] = (),
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
    needed : bool
        Whether a field that was emptied is refused.
    off : collection of str
        Keys of the numbers that do not count now, whose fields are grey.
    """

    def made(kind: Field) -> Markup:
        value = given.get(kind.key, kind.default)

        def taken(text: str) -> Wish:
            return action(kind.key, option_value(kind, text, value, scales, needed))

        return _bound(form, prefix + kind.key, kind, value, taken, scales, kind.key in off)

    return joined(map(made, seen_fields(kinds, given)))


def _bound(form: Form, cell: str, kind: Field, value: Any, taken: Typed, scales: Sequence[Scale], off: bool) -> Markup:
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
    typed = form.field(cell, text, title, taken, off=off)
    wide = kind.kind == "list" or (kind.kind == "vector" and len(scales) > 1)
    symbol = named(kind.symbol) if kind.symbol else tag("span", title)
    return tag(classes("label.option", wide=wide), symbol, typed, unit, title=title)


def _units(kind: Field, scales: Sequence[Scale]) -> str:
    units = dict.fromkeys(unit_text(kind, scale_of(kind, scales, j)) for j in range(len(scales)))
    return ", ".join(units)


def _text(kind: Field, value: Any, scales: Sequence[Scale]) -> str:
    if value is None:
        return ""
    if kind.kind == "rows":
        return "\n".join(_line(kind, row, scales) for row in value)
    return _line(kind, np.atleast_1d(np.asarray(value, dtype=float)), scales)


def _line(kind: Field, numbers: Iterable[float], scales: Sequence[Scale]) -> str:
    return "  ".join(
        readable(float(number) / factor_of(kind, scale_of(kind, scales, j)), DECIMALS)
        for j, number in enumerate(numbers)
    )
