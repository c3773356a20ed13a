"""Values of a variant in lesson files: ``"= l1 + l2"`` in tables, ``{{=l1 : .2f}}`` in texts."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

import numpy as np

from armlab.content.expressions import parse
from armlab.content.variants import Value
from armlab.errors import ContentError, InputError

_FIELD = re.compile(r"\{\{=([^{}\n]*)\}\}")
_FORM = re.compile(r"\+?(\.\d{1,2})?[fg]|d")
_DIGITS = 6
"""Significant digits of a number without a given format."""

_ROUNDING = 1e-12
"""Magnitude below which a number is what rounding left of zero, such as the cosine of 90 degrees."""

TYPED = ("answer",)
"""Keys with texts as a student would type them, in which a minus sign is a hyphen."""


def evaluated(expression: str, values: Mapping[str, Value]) -> Value:
    """Return the value of an expression of the names of a variant; a name alone may stand for a text.

    Raises
    ------
    InputError
        It cannot be read, has an unknown name, or no finite value.
    """
    name = expression.strip()
    if name in values:
        return values[name]
    numbers = {each: value for each, value in values.items() if not isinstance(value, str)}
    for word in re.findall(r"[A-Za-z]\w*", name):
        if word in values and word not in numbers:
            raise InputError(f"{word} is a text; only numbers can be calculated with")
    return parse(name, list(numbers), together=False).value(numbers)


def written(value: Value, form: str = "", minus: str = "\u2212") -> str:
    """Return a value as text; a number without a form has six significant digits and no zeros at its end.

    >>> written(0.1 + 0.2), written(-2.0), written(6e-17), written(0.5, ".2f"), written("elbow up")
    ('0.3', '−2', '0', '0.50', 'elbow up')
    """
    if isinstance(value, str):
        if form:
            raise InputError(f"{value!r} is a text and takes no form, got {form!r}")
        return value
    if not form:
        value = 0.0 if abs(value) < _ROUNDING else value
        text = np.format_float_positional(float(f"{value:.{_DIGITS}g}") + 0.0, trim="-")
    elif not _FORM.fullmatch(form):
        raise InputError(f"expected a form such as .2f, .3g or d after the colon, got {form!r}")
    elif form == "d":
        text = str(round(value))
    else:
        text = f"{value:{form}}"
        text = text.replace("-", "") if not re.search("[1-9]", text) else text
    return text.replace("-", minus)


def filled(text: str, values: Mapping[str, Value], minus: str = "\u2212") -> str:
    """Return a text with ``{{=expression}}`` and ``{{=expression : form}}`` replaced by their values.

    Raises
    ------
    InputError
    """

    def one(field: re.Match[str]) -> str:
        expression, _, form = field[1].partition(":")
        return written(evaluated(expression, values), form.strip(), minus)

    result = _FIELD.sub(one, text)
    if "{{=" in _FIELD.sub("", text):
        raise InputError("expected {{=expression}} in one line, without other braces inside")
    return result


def filled_data(data: Any, values: Mapping[str, Value], file: str, where: str, minus: str = "\u2212") -> Any:
    """Return what a TOML table holds with all its texts filled in; one that begins with "=" becomes its value.

    Raises
    ------
    ContentError
        With the key of the text.
    """
    if isinstance(data, dict):
        return {
            key: filled_data(entry, values, file, f"{where}.{key}" if where else key, "-" if key in TYPED else minus)
            for key, entry in data.items()
        }
    if isinstance(data, list):
        return [filled_data(entry, values, file, f"{where}[{i + 1}]", minus) for i, entry in enumerate(data)]
    if not isinstance(data, str):
        return data
    try:
        return evaluated(data[1:], values) if data.startswith("=") else filled(data, values, minus)
    except InputError as error:
        raise ContentError(file, where, str(error)) from None
