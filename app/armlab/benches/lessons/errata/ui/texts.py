"""Texts of errata on the page: their Markdown as markup, places and residuals in words."""

from __future__ import annotations

import math
from functools import lru_cache

from armlab.content.errata import FILE, Erratum
from armlab.content.markdown import to_html
from armlab.ui.format import capitalised, scientific
from armlab.ui.html import Markup, tag

ALIKE = 1e-17
"""Residual below which both values are exactly the same."""


@lru_cache(maxsize=512)
def written(text: str) -> Markup:
    """Return a text of an erratum, Markdown with LaTeX, as markup."""
    return Markup(to_html(text, FILE))


def task_part(html: str) -> Markup:
    """Return a part of a task, which its reader has made of LaTeX, as markup."""
    return Markup(html)


def headline(each: Erratum) -> str:
    """Return where an erratum is in the notes, to stand alone: ``Equation 1.58``."""
    return capitalised(each.place)


def asked_at(each: Erratum) -> str:
    """Return where an erratum is in the notes without the entry of the matrix, which is to be found."""
    return capitalised(each.place.partition(", row ")[0])


def residual(value: float, unit: str) -> str:
    """Return a residual with its unit in words; an infinite one belongs to what has no value."""
    if math.isinf(value):
        return "no value"
    if value < ALIKE:
        return "0"
    text = f"{value:.3g}" if 1e-3 <= value < 1e4 else scientific(value)
    return f"{text} {unit}".rstrip()


def severity(each: Erratum) -> Markup:
    """Return how bad an erratum is, in words after its letter."""
    return tag("span.er-severity", tag("b", each.severity), f" {each.says}")
