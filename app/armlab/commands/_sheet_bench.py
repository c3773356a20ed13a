"""The commands and checked facts of benches in a lesson, in words for the solution sheet."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from armlab.content.bench_words import BenchWord
from armlab.content.check import Check
from armlab.content.checks.all_of import AllOf
from armlab.content.checks.fact import FactIs
from armlab.content.lesson_values import written
from armlab.errors import UnknownName
from armlab.kin.field import Field
from armlab.page import Page
from armlab.plugins import constant_of
from armlab.session.arguments import FACTORS
from armlab.session.facts import fact_of
from armlab.session.fields import FieldPart, fields_of
from armlab.session.put_words import PutPart
from armlab.session.state import Command, Part
from armlab.session.words import Word, pages_with_words, word

FROM_ZERO = (
    *("across", "after", "branch", "column", "component", "first", "i", "index", "joint", "k", "last", "law", "like"),
    *("pair", "piece", "place", "point", "row", "run", "slot", "up", "way", "wheel", "which"),
)
"""Arguments of commands that count places from 0."""

SELECTED = ("scaled", "selected")
"""Fields that hold a place in a list, from 0."""

CALLED = {"i": "number", "index": "number", "k": "number", "place": "number", "which": "number"}
"""Arguments with other names for a person."""

AXES = {"axis": ("x", "y", "z")}

DEGREE = "°"


def bench_words(action: BenchWord) -> str:
    """Return what is to be done on a bench: its page, what its command is called, and its arguments."""
    try:
        known = word(action.word)
    except UnknownName:
        return action.word
    page = constant_of(pages_with_words()[action.word.rpartition(".")[0]], "PAGE", Page)
    return f"on the page {page.name}: {_done(known, action.given)}"


def facts_asked(check: Check) -> Iterator[str]:
    """Yield what a check asks of facts, one text each."""
    if isinstance(check, AllOf):
        for each in check.checks:
            yield from facts_asked(each)
    elif isinstance(check, FactIs):
        try:
            found, fact = fact_of(check.fact)
        except UnknownName:
            yield check.fact
        else:
            asked = replace(check, value=_named(check.value, found.parts)) if fact.kind == "text" else check
            yield f"{check.titled(fact.title)}: {asked.asked(fact.unit)}"


def _named(value: Any, parts: Iterable[type[Part]]) -> Any:
    """Return the words for a choice of a page, or a text without the lines of names in programs."""
    if not isinstance(value, str):
        return value
    specs = (spec for part in parts if issubclass(part, FieldPart) for spec in fields_of(part).values())
    words = (dict(spec.choices).get(value) for spec in specs)
    return next(filter(None, words), value.replace("_", " "))


def _done(known: Word, given: Mapping[str, Any]) -> str:
    """Return the command and its arguments; fields are named by their titles alone."""
    fields = {argument.name: argument.field for argument in known.arguments}
    if isinstance(known.make, partial) and known.make.func is PutPart:
        return "put it as the lesson has saved it"
    if isinstance(known.make, partial):
        return "; ".join(_set(key, value, fields.get(_bare(key, fields))) for key, value in given.items())
    label = known.label or re.split("[:.;,]", known.says)[0].lower()
    command = known.make if isinstance(known.make, type) and issubclass(known.make, Command) else Command
    said = ", ".join(_argument(key, value, command) for key, value in given.items())
    return f"{label} ({said})" if said else label


def _bare(key: str, names: Iterable[str]) -> str:
    """Return an argument without the unit in its name."""
    return key if key in names else re.sub(f"({'|'.join(FACTORS)})$", "", key)


def _set(key: str, value: Any, field: Field | None) -> str:
    if field is None:
        return f"{_bare(key, ()).replace('_', ' ')}: {_with_unit(value, _unit_of_name(key))}"
    if field.kind == "choice":
        return f"{field.title}: {dict(field.choices).get(value, value)}"
    unit = "" if field.unit == "1" else field.unit
    if key in SELECTED:
        value += 1
    elif key.endswith("_deg"):
        unit = DEGREE if unit == "rad" else unit.replace("rad", "deg")
    elif key.endswith("_mm"):
        unit = "mm"
    elif unit == "rad":
        value, unit = np.degrees(value).tolist(), DEGREE
    return f"{field.title}: {_with_unit(value, unit)}"


def _argument(key: str, value: Any, command: type[Command]) -> str:
    """Return an argument of a command: places are counted from 1, or named."""
    names = {**AXES, **command.places}.get(key)
    if names and isinstance(value, (int, float)):
        name = names[int(value)] if 0 <= value < len(names) else written(value)
        return f"{key} {name}" if key in AXES else name
    if names is None and key in FROM_ZERO and isinstance(value, (int, float)):
        return f"{CALLED.get(key, key)} {written(value + 1)}"
    said = _with_unit(value, command.units.get(key, _unit_of_name(key)))
    return f"{_bare(key, ()).replace('_', ' ')} {said}"


def _unit_of_name(key: str) -> str:
    return DEGREE if key.endswith("_deg") else "mm" if key.endswith("_mm") else ""


def _with_unit(value: Any, unit: str) -> str:
    said = _said(value)
    return f"{said}{unit}" if unit == DEGREE else f"{said} {unit}".rstrip()


def _said(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (int, float)):
        return written(float(value))
    if isinstance(value, list):
        return f"({', '.join(map(_said, value))})"
    if isinstance(value, dict):
        return f"({', '.join(f'{name} {_said(each)}' for name, each in value.items())})"
    return value.replace("_", " ") if isinstance(value, str) and re.fullmatch(r"\w+", value) else str(value)
