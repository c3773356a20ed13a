"""Texts of the lab and of students as plain text, for terminals and files."""

from __future__ import annotations

import re
from html import escape
from html.parser import HTMLParser

from armlab.content.typed_formula import typed_formula

_MATH = re.compile("<math.*?</math>", re.DOTALL)


def printable(text: str) -> str:
    """Return a text without what could steer a terminal or cannot be written to a file.

    >>> printable("Ada\\x1b[2J \\ud800")
    'Ada�[2J �'
    """
    return "".join(letter if letter.isprintable() else "\ufffd" for letter in text)


def plain(html: str) -> str:
    """Return the text of markup on one line; formulas as they would be typed.

    >>> plain("<p>one &lt; <b>two</b></p>"), plain("<math><mfrac><mn>1</mn><msqrt><mn>3</mn></msqrt></mfrac></math>")
    ('one < two', '1/√3')
    """
    parser = _Text()
    parser.feed(_MATH.sub(lambda found: escape(typed_formula(found[0])), html))
    parser.close()
    return " ".join("".join(parser.found).split())


class _Text(HTMLParser):
    """A parser that collects the text between the tags."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.found: list[str] = []

    def handle_data(self, data: str) -> None:
        """Keep a piece of text."""
        self.found.append(data)
