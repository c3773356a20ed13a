"""Numbers, units and mathematics on screen: degrees and millimetres, fixed decimals, matrices set as matrices."""

from __future__ import annotations

import html
import math
from collections.abc import Sequence
from functools import cache

import latex2mathml.converter
import numpy as np
from numpy.typing import NDArray

from armlab.kin.ik import Verdict

MINUS = "\u2212"
_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


def degrees(value: float) -> float:
    """Return an angle in degrees, rounded to 0.1 as everywhere on screen."""
    return round(math.degrees(value), 1) + 0.0


def millimetres(value: float) -> float:
    """Return a length in millimetres, rounded to 0.1."""
    return round(1000.0 * value, 1) + 0.0


def number(value: float, decimals: int) -> str:
    """Return a number with fixed decimals and a true minus sign; never minus zero.

    >>> number(-0.04, 1), number(-3.25, 2)
    ('0.0', '−3.25')
    """
    text = f"{round(value, decimals) + 0.0:.{decimals}f}"
    return text.replace("-", MINUS)


def angle(value: float, decimals: int = 1) -> str:
    """Return an angle given in radians, in degrees with its unit."""
    return f"{number(math.degrees(value), decimals)}°"


def turn(value: float, decimals: int = 1) -> str:
    """Return an angle given in radians as degrees in (-180, 180], without a unit; what rounds to -180 is 180.

    >>> turn(-3.14159)
    '180.0'
    """
    text = number(math.degrees(value), decimals)
    return text[1:] if text == f"{MINUS}{180.0:.{decimals}f}" else text


def length(value: float) -> str:
    """Return a length in millimetres with its unit; below 0.1 mm in micrometres."""
    size = abs(value)
    if 1e-7 <= size < 1e-4:
        return f"{number(1e6 * value, 1)} µm"
    return f"{number(1e3 * value, 1 if size < 0.1 else 0)} mm"


def subscript(letter: str, index: int) -> str:
    """Return a symbol with its index, such as q₁₂."""
    return f"{letter}{str(index).translate(_SUBSCRIPTS)}"


def capitalised(text: str) -> str:
    """Return the text with a capital first letter and nothing else changed."""
    return text[:1].upper() + text[1:]


def escaped(text: str) -> str:
    """Return text that cannot become markup."""
    return html.escape(text, quote=True)


@cache
def mathml(latex: str, block: bool = False) -> str:
    """Return a formula as MathML."""
    converted: str = latex2mathml.converter.convert(latex, display="block" if block else "inline")
    return converted


def matrix(values: NDArray[np.floating], decimals: int = 3, rule: int | None = None) -> str:
    """Return a matrix in brackets; zeros are grey, ``rule`` draws a line before that column."""

    def cell(j: int, value: float) -> str:
        zero = abs(value) < 0.5 * 10.0**-decimals
        classes = [name for name, on in (("zero", zero), ("ruled", j == rule)) if on]
        mark = f' class="{" ".join(classes)}"' if classes else ""
        return f"<td{mark}>{'0' if zero else number(value, decimals)}</td>"

    rows = ("".join(cell(j, float(value)) for j, value in enumerate(row)) for row in values)
    return f'<table class="mat">{"".join(f"<tr>{row}</tr>" for row in rows)}</table>'


def pairs(rows: Sequence[tuple[str, str]]) -> str:
    """Return name and value in two columns; the markup of both is the caller's."""
    return '<div class="kv">' + "".join(f"<span>{name}</span><span>{value}</span>" for name, value in rows) + "</div>"


def dot(colour: str) -> str:
    """Return a small round mark."""
    return f'<span class="dot" style="background:{colour}"></span>'


SIGNS = {"ok": "✓", "warn": "◐", "no": "✕"}


def verdict_kind(verdict: Verdict) -> str:
    """Return ``ok``, ``warn`` or ``no``."""
    return {"reached": "ok", "moving": "warn"}.get(verdict.status, "no")


def verdict_words(verdict: Verdict) -> tuple[str, str]:
    """Return the verdict in a word or two, and what there is to say about it with numbers and units."""
    short = _shortfall(verdict)
    if verdict.status == "reached":
        return "reached", f"{length(verdict.position_error)} {angle(verdict.rotation_error)}"
    if verdict.status == "limit":
        return verdict.reason, short
    if verdict.status == "beyond":
        return "out of reach", f"{short}; farther than all links in a line"
    if verdict.status == "closest":
        return "closest possible", short
    return "on the way", short


def _shortfall(verdict: Verdict) -> str:
    """Return how far away the target is, in the components that matter."""
    said = []
    if verdict.position_error >= 5e-5:
        said.append(f"{length(verdict.position_error)} short")
    if verdict.rotation_error >= math.radians(0.05):
        said.append(f"{angle(verdict.rotation_error)} turned away")
    return ", ".join(said) or "within 0.1 mm and 0.1°"


def verdict_card(verdict: Verdict) -> str:
    """Return the verdict as a coloured card with a sign and words."""
    kind = verdict_kind(verdict)
    head, body = verdict_words(verdict)
    return f'<div class="verdict {kind}"><b>{SIGNS[kind]} {capitalised(escaped(head))}</b>{escaped(body)}</div>'


def verdict_line(verdict: Verdict) -> str:
    """Return the verdict in one line."""
    kind = verdict_kind(verdict)
    head, body = verdict_words(verdict)
    return f'<b class="{kind}">{SIGNS[kind]} {escaped(head)}</b> {escaped(body)}'
