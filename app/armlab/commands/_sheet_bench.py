"""The commands and checked facts of benches in a lesson, in words for the solution sheet."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from armlab.content.bench_words import BenchWord
from armlab.content.check import Check
from armlab.content.checks.all_of import AllOf
from armlab.content.checks.fact import FactIs
from armlab.content.lesson_values import written
from armlab.errors import UnknownName
from armlab.page import Page
from armlab.plugins import constant_of
from armlab.session.facts import fact_of
from armlab.session.words import pages_with_words, word


def bench_words(action: BenchWord) -> str:
    """Return what is to be done on a bench: its page, what its command is called, and its arguments."""
    try:
        known = word(action.word)
    except UnknownName:
        return action.word
    page = constant_of(pages_with_words()[action.word.rpartition(".")[0]], "PAGE", Page)
    label = known.label or re.split("[:.;,]", known.says)[0].lower()
    return f"on the page {page.name}: {label}{_given(action.given)}"


def facts_asked(check: Check) -> Iterator[str]:
    """Yield what a check asks of facts, one text each."""
    if isinstance(check, AllOf):
        for each in check.checks:
            yield from facts_asked(each)
    elif isinstance(check, FactIs):
        try:
            _, fact = fact_of(check.fact)
        except UnknownName:
            yield check.fact
        else:
            yield f"{check.titled(fact.title)}: {check.asked(fact.unit)}"


def _given(arguments: Mapping[str, Any]) -> str:
    said = ", ".join(f"{name} {_said(value)}" for name, value in arguments.items())
    return f" ({said})" if said else ""


def _said(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (int, float)):
        return written(float(value))
    if isinstance(value, list):
        return f"({', '.join(map(_said, value))})"
    if isinstance(value, dict):
        return f"({', '.join(f'{name} {_said(each)}' for name, each in value.items())})"
    return str(value)
