"""Formulas as a person would type them, made from the MathML of lessons, for reports in plain text."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree

_ONE = re.compile(r"√?[\w.°]*")
"""Pattern of operands that need no brackets."""

_ABOVE = {"˙": "\u0307", "¨": "\u0308", "⃛": "\u20db", "^": "\u0302", "ˆ": "\u0302", "~": "\u0303"}
"""Signs above letters that are characters of their own, and those that stand above the letter before them."""


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
    if tag in ("mover", "msub", "msubsup"):
        return _decorated(tag, parts)
    if tag == "msqrt":
        return f"√{_grouped(''.join(parts))}"
    if tag == "mroot":
        return f"{_grouped(parts[0])}^(1/{parts[1]})"
    if tag == "mfrac":
        return f"{_grouped(parts[0])}/{_grouped(parts[1])}"
    if tag == "msup":
        return f"{parts[0]}^{_grouped(parts[1])}"
    if tag in ("mtable", "mtr"):
        return ("; " if tag == "mtable" else " ").join(parts)
    return (element.text or "") + "".join(parts)


def _decorated(tag: str, parts: list[str]) -> str:
    """Return a letter with a dot or a hat, or with an index; an index of letters stands behind a line: ``p_EA``."""
    letter, index = parts[:2]
    if tag == "mover":
        return letter + _ABOVE.get(index, index)
    power = f"^{_grouped(parts[2])}" if tag == "msubsup" else ""
    line = "_" if letter and index[:1].isalpha() else ""
    return f"{letter}{line}{index if index.isalnum() else _grouped(index)}{power}"


def _grouped(text: str) -> str:
    text = text.strip()
    return text if _ONE.fullmatch(text) else f"({text})"
