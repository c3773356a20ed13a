"""Room around the names of functions in formulas: sin θ cos φ.

TeX leaves a thin space between a function and its argument, and between a factor and the function behind it, but none
before a bracket. MathML has no such rule for names, so a browser writes sinθcosφ.
"""

from __future__ import annotations

import re
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

NAMESPACE = "http://www.w3.org/1998/Math/MathML"

THIN = "0.167em"
"""Width of the room, as of TeX's thin space."""

_ROWS = frozenset({"math", "mrow", "mtd", "msqrt", "mstyle"})
"""Elements whose parts stand side by side."""

_FACTORS = frozenset({"mi", "mn", "msub", "msup", "msubsup", "mfrac", "msqrt", "mroot", "mover", "munder", "mtable"})


_NAMED = re.compile("<mi>[a-z]{2}")


def with_room(mathml: str) -> str:
    """Return a formula with the spaces that are missing in it, as a converter writes it."""
    if not _NAMED.search(mathml):
        return mathml
    root = ElementTree.fromstring(mathml)
    without_namespace(root)
    add_room(root)
    root.set("xmlns", NAMESPACE)
    return ElementTree.tostring(root, encoding="unicode", short_empty_elements=False)


def without_namespace(root: Element) -> None:
    """Take the namespace of MathML from the names of all elements."""
    for element in root.iter():
        element.tag = element.tag.removeprefix(f"{{{NAMESPACE}}}")


def add_room(root: Element) -> None:
    """Insert the spaces that are missing in a formula, whose elements have names without a namespace.

    >>> formula = ElementTree.fromstring("<mrow><mi>q</mi><mi>cos</mi><mi>q</mi><mo>)</mo></mrow>")
    >>> add_room(formula)
    >>> [part.tag for part in formula]
    ['mi', 'mspace', 'mi', 'mspace', 'mi', 'mo']
    """
    for row in [element for element in root.iter() if element.tag in _ROWS]:
        parts = list(row)
        for i in range(len(parts) - 1, 0, -1):
            before, after = parts[i - 1], parts[i]
            if (_is_name(before) and _follows(after)) or (_is_name(after) and _precedes(before)):
                row.insert(i, Element("mspace", width=THIN))


def _is_name(part: Element) -> bool:
    """Return whether it is a function such as sin, or a power of one."""
    if part.tag in ("msup", "msub", "msubsup"):
        return _is_name(part[0])
    name = part.text or ""
    return part.tag == "mi" and len(name) > 1 and name.isascii() and name.isalpha()


def _follows(part: Element) -> bool:
    """Return whether it is an argument that no bracket sets apart."""
    return part.tag in _FACTORS or (part.tag == "mrow" and len(part) > 0 and part[0].tag != "mo")


def _precedes(part: Element) -> bool:
    """Return whether it is a factor."""
    return part.tag in _FACTORS or (part.tag == "mo" and part.text in (")", "]"))
