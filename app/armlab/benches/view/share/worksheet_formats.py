"""Formats of a worksheet: Markdown that is also readable as plain text, and an article in LaTeX.

Names come from people: whatever they typed is text in both formats, never markup.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from armlab.content.check import signed

Array = NDArray[np.float64]

DECIMALS = 4

WIDE = 6
"""Number of columns from which a matrix in LaTeX is set smaller than the text."""

LONGEST_NAME = 120
"""Longest name, in characters, that is written in full."""


class Text(NamedTuple):
    """A text in both formats."""

    markdown: str
    latex: str


class Writer(Protocol):
    """Writer of a worksheet. Texts are markup of the format, made from the results of its methods."""

    def choose(self, text: Text) -> str:
        """Return the text in this format."""
        ...

    def symbol(self, letter: str, index: str = "") -> str:
        """Return a symbol, such as A or alpha, with its index: a number, ``i``, ``i-1`` or a word."""
        ...

    def number(self, value: float) -> str:
        """Return a number with its minus sign."""
        ...

    def degrees(self, value: float) -> str:
        """Return a number of degrees with its unit."""
        ...

    def plus(self, variable: str, offset: float) -> str:
        """Return the sum of a symbol and a number."""
        ...

    def title(self, name: str) -> None:
        """Begin with the name of the arm, as typed by a person."""
        ...

    def heading(self, text: str) -> None:
        """Begin a section."""
        ...

    def line(self, text: str) -> None:
        """Write a paragraph."""
        ...

    def table(self, head: Sequence[str], body: Sequence[Sequence[str]]) -> None:
        """Write a table."""
        ...

    def matrix(self, symbol: str, values: Array) -> None:
        """Write an equation of a symbol and a matrix."""
        ...

    def formulas(self, symbol: str, entries: Sequence[Sequence[str]]) -> None:
        """Write an equation of a symbol and a matrix of formulas, which are in this format."""
        ...

    def finished(self) -> str:
        """Return the whole text, ending with a line break."""
        ...


def one_line(name: str) -> str:
    """Return a name without line breaks and invisible characters, "Arm" if nothing is left."""
    seen = "".join(" " if unicodedata.category(letter)[0] in "CZ" else letter for letter in name)
    return " ".join(seen.split())[:LONGEST_NAME].rstrip() or "Arm"


# --- Markdown

_SUBSCRIPTS = str.maketrans("0123456789-i", "₀₁₂₃₄₅₆₇₈₉₋ᵢ")
_LETTERS = {"alpha": "α", "theta": "θ", "sigma": "σ"}
_MARKDOWN = re.compile(r"[\\`*_\[\]<>#|~$&{}!]|(?<=[a-zA-Z]):(?=//)")


def markdown_text(name: str) -> str:
    """Return a name in which nothing is markup.

    >>> print(markdown_text("a|b *c*"))
    a\\|b \\*c\\*
    """
    return _MARKDOWN.sub(lambda found: f"\\{found[0]}", one_line(name))


class Markdown:
    """Markdown with tables; matrices are blocks of text in columns."""

    def __init__(self) -> None:
        self._blocks: list[str] = []

    def choose(self, text: Text) -> str:
        """Return the text in Markdown."""
        return text.markdown

    def symbol(self, letter: str, index: str = "") -> str:
        """Return a symbol such as A₁, αᵢ₋₁ or J_task."""
        written = _LETTERS.get(letter, letter)
        if not index:
            return written
        return f"{written}_{index}" if len(index) > 1 and index.isalpha() else written + index.translate(_SUBSCRIPTS)

    def number(self, value: float) -> str:
        """Return a number with a true minus sign."""
        return signed(value, DECIMALS)

    def degrees(self, value: float) -> str:
        """Return degrees such as ``90.0000°``."""
        return f"{self.number(value)}°"

    def plus(self, variable: str, offset: float) -> str:
        """Return a sum such as ``q₂ − 90.0000``."""
        return f"{variable} {'−' if offset < 0.0 else '+'} {self.number(abs(offset))}"

    def title(self, name: str) -> None:
        """Begin with a heading of the first level."""
        self._blocks.append(f"# Worksheet: {markdown_text(name)}")

    def heading(self, text: str) -> None:
        """Begin a section."""
        self._blocks.append(f"## {text}")

    def line(self, text: str) -> None:
        """Write a paragraph."""
        self._blocks.append(text)

    def table(self, head: Sequence[str], body: Sequence[Sequence[str]]) -> None:
        """Write a table with bars, all but its first column aligned right."""
        lines = [head, ["---", *("---:" for _ in head[1:])], *body]
        self._blocks.append("\n".join("| " + " | ".join(line) + " |" for line in lines))

    def matrix(self, symbol: str, values: Array) -> None:
        """Write an equation as a block of text."""
        cells = [[self.number(float(value)) for value in row] for row in values]
        width = max(len(cell) for row in cells for cell in row)
        self._columns(f"{symbol} =", [[cell.rjust(width) for cell in row] for row in cells])

    def formulas(self, symbol: str, entries: Sequence[Sequence[str]]) -> None:
        """Write formulas in columns as a block of text, with true minus signs."""
        entries = [[entry.replace("-", "\u2212") for entry in row] for row in entries]
        widths = [max(map(len, column)) for column in zip(*entries, strict=True)]
        cells = [[cell.ljust(width) for cell, width in zip(row, widths, strict=True)] for row in entries]
        self._columns(f"{symbol} in symbols:", cells)

    def _columns(self, head: str, cells: Sequence[Sequence[str]]) -> None:
        rows = ["  ".join(row).rstrip() for row in cells]
        self._blocks += [head, "\n".join(["```text", *rows, "```"])]

    def finished(self) -> str:
        """Return the whole text."""
        return "\n\n".join(self._blocks) + "\n"


# --- LaTeX

_PREAMBLE = r"""\documentclass[a4paper,11pt]{article}
\usepackage[margin=2cm]{geometry}
\usepackage{amsmath}
\usepackage{booktabs}
\setcounter{MaxMatrixCols}{12}
\setlength{\parindent}{0pt}
\setlength{\parskip}{6pt}
\begin{document}"""

_GREEK = {
    letter: unicodedata.name(letter).rpartition(" ")[2].lower().replace("lamda", "lambda")
    for letter in "αβγδεθλμπρστφψω"
}
_SPECIAL = {
    **{sign: f"\\{sign}" for sign in "#$%&_{}"},
    **{letter: rf"$\{name}$" for letter, name in _GREEK.items()},
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": "$<$",
    ">": "$>$",
    "|": "$|$",
    '"': "''",
    "“": "``",
    "”": "''",
    "‘": "`",
    "’": "'",
    "–": "--",
    "—": "---",
    "−": "$-$",
    "×": r"$\times$",
    "·": r"$\cdot$",
    "⁄": "/",
    "°": r"$^\circ$",
    "ß": r"\ss{}",
    "æ": r"\ae{}",
    "Æ": r"\AE{}",
    "ø": r"\o{}",
    "Ø": r"\O{}",
    "ł": r"\l{}",
    "Ł": r"\L{}",
    "ı": r"\i{}",
}
_ACCENTS = {
    "\u0300": "`",
    "\u0301": "'",
    "\u0302": "^",
    "\u0303": "~",
    "\u0304": "=",
    "\u0306": "u",
    "\u0307": ".",
    "\u0308": '"',
    "\u030a": "r",
    "\u030b": "H",
    "\u030c": "v",
    "\u0327": "c",
}
"""Combining marks and their LaTeX commands, which work in every font encoding."""


def latex_text(name: str) -> str:
    """Return a name in which nothing is a command; marks and letters that plain LaTeX lacks are left out or ``?``.

    >>> print(latex_text("50% of Čapek_1"))
    50\\% of \\v{C}apek\\_1
    """
    return "".join(map(_latex_letter, unicodedata.normalize("NFC", one_line(name))))


def _latex_letter(letter: str) -> str:
    if letter in _SPECIAL:
        return _SPECIAL[letter]
    written = ""
    for part in unicodedata.normalize("NFKD", letter):
        if part in _ACCENTS:
            written = f"\\{_ACCENTS[part]}{{{written}}}"
        elif not unicodedata.combining(part):
            written += _SPECIAL.get(part, part if part.isascii() else "?")
    return written


class Latex:
    """A complete article that needs the packages amsmath, booktabs and geometry."""

    def __init__(self) -> None:
        self._blocks: list[str] = [_PREAMBLE]

    def choose(self, text: Text) -> str:
        """Return the text in LaTeX."""
        return text.latex

    def symbol(self, letter: str, index: str = "") -> str:
        """Return a symbol such as ``$A_{1}$``."""
        written = f"\\{letter}" if letter in _LETTERS else letter
        word = rf"\mathrm{{{index}}}" if len(index) > 1 and index.isalpha() else index
        return f"${written}{f'_{{{word}}}' if index else ''}$"

    def number(self, value: float) -> str:
        """Return a number in math mode, which gives it a proper minus sign."""
        return f"${_plain_number(value)}$"

    def degrees(self, value: float) -> str:
        r"""Return degrees such as ``$90.0000^\circ$``."""
        return rf"${_plain_number(value)}^\circ$"

    def plus(self, variable: str, offset: float) -> str:
        """Return a sum such as ``$q_{2} - 90.0000$``."""
        return f"${variable.strip('$')} {'-' if offset < 0.0 else '+'} {_plain_number(abs(offset))}$"

    def title(self, name: str) -> None:
        """Begin with an unnumbered section."""
        self._blocks.append(rf"\section*{{Worksheet: {latex_text(name)}}}")

    def heading(self, text: str) -> None:
        """Begin a section."""
        self._blocks.append(rf"\subsection*{{{text}}}")

    def line(self, text: str) -> None:
        """Write a paragraph."""
        self._blocks.append(text)

    def table(self, head: Sequence[str], body: Sequence[Sequence[str]]) -> None:
        """Write a table with the rules of booktabs, all but its first column aligned right."""
        rows = [" & ".join(cells) + r" \\" for cells in (head, *body)]
        lines = [rf"\begin{{tabular}}{{l{'r' * (len(head) - 1)}}}", r"\toprule", rows[0], r"\midrule", *rows[1:]]
        self._blocks.append("\n".join([*lines, r"\bottomrule", r"\end{tabular}"]))

    def matrix(self, symbol: str, values: Array) -> None:
        """Write a displayed equation; one with many columns is set closer and smaller."""
        rows = [" & ".join(_plain_number(float(value)) for value in row) for row in values]
        cells = " \\\\\n".join(rows)
        body = [r"\[", f"{symbol.strip('$')} =", r"\begin{bmatrix}", cells, r"\end{bmatrix}", r"\]"]
        if values.shape[1] > WIDE:
            body = [_SMALLER, *body, "}"]
        self._blocks.append("\n".join(body))

    def formulas(self, symbol: str, entries: Sequence[Sequence[str]]) -> None:
        """Write a displayed equation of formulas, closer and smaller."""
        cells = " \\\\\n".join(" & ".join(row) for row in entries)
        equation = [rf"\[ {symbol.strip('$')} = \begin{{bmatrix}}", cells, r"\end{bmatrix} \]"]
        self._blocks.append("\n".join([_SMALLER, *equation, "}"]))

    def finished(self) -> str:
        """Return the whole text."""
        return "\n\n".join([*self._blocks, r"\end{document}"]) + "\n"


_SMALLER = r"{\footnotesize\setlength{\arraycolsep}{2pt}"


def _plain_number(value: float) -> str:
    return signed(value, DECIMALS).replace("\u2212", "-")
