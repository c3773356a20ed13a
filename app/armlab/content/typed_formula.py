"""Formulas as a person would type them, made from the MathML of lessons, for reports in plain text."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree

_ONE = re.compile(r"√?[\w.°]*")
"""Pattern of operands that need no brackets."""


def typed_formula(mathml: str) -> str:
    """Return a formula as plain text, indices behind their letters.

    Examples
    --------
    >>> typed_formula("<math><msup><mi>l</mi><mn>2</mn></msup><mo>+</mo><msqrt><mi>a</mi><mi>b</mi></msqrt></math>")
    'l^2+√ab'
    """
    return _text(ElementTree.fromstring(mathml))


def _text(element: ElementTree.Element) -> str:
    tag, parts = element.tag.rpartition("}")[2], [_text(child) for child in element]
    if tag == "mspace":
        return " "
    if tag == "msqrt":
        return f"√{_grouped(''.join(parts))}"
    if tag == "mroot":
        return f"{_grouped(parts[0])}^(1/{parts[1]})"
    if tag == "mfrac":
        return f"{_grouped(parts[0])}/{_grouped(parts[1])}"
    if tag in ("msup", "msubsup"):
        return f"{''.join(parts[:-1])}^{_grouped(parts[-1])}"
    if tag in ("mtable", "mtr"):
        return ("; " if tag == "mtable" else " ").join(parts)
    return (element.text or "") + "".join(parts)


def _grouped(text: str) -> str:
    text = text.strip()
    return text if _ONE.fullmatch(text) else f"({text})"
