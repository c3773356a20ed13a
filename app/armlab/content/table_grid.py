"""Division of a pasted table into cells, for tables of any origin."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass, replace

from armlab.content.symbols import plain_symbols
from armlab.content.table_programs import read_links, refuse_other_files
from armlab.errors import InputError

LONGEST = 20_000
"""Longest text, in characters; twelve joints need a tenth of it."""

_BARS = re.compile(r"[│┃║|]")
_RULE = re.compile(r"[\s|\u2500-\u257f+:=_-]+")
"""A line between rows, of box-drawing characters of any weight or of those of a keyboard."""

_FOOT = re.compile(r"\s*[└-┛╘-╝╰]")
"""Beginning of the line below a drawn table."""

_ENVIRONMENT = re.compile(r"\\begin\s*\{(tabular[x*]?|array|[bBpvV]?matrix|smallmatrix|longtable)\}")
_LATEX_RULES = re.compile(
    r"\\(?:hline|toprule|midrule|bottomrule|addlinespace|centering|endhead|endfirsthead)(?![a-zA-Z])(?:\[[^\]]*\])?"
    r"|\\(?:cline|cmidrule)(?:\([a-z]*\))?\s*\{[^}]*\}"
)
_OWN_PRINT = re.compile(r"^\s*joint\s+a(\(i-1\))?, m\s", re.MULTILINE)
_AFTER_OWN_PRINT = re.compile(r"(base|tool|task): ")
_IN_OWN_COMMENT = re.compile(r"^(?:#|%|<!--) (base|tool), not in the table", re.MULTILINE)
_WORDS = {
    "standard": ("standard", "classic", "classical", "distal"),
    "modified": ("modified", "proximal"),
}
_BOOKS = {"standard": r"siciliano|spong|sdh", "modified": r"craig|khalil|mdh"}
_SUBJECT = r"(?:DH|D-H|Denavit|convention)\b"
_DENIED = re.compile(
    r"(?:\b(?:non|not|than|unlike|instead of)|n't)[\s-]+(?:(?:the|a|in)\s+)?"
    rf"(?:{'|'.join(word for words in _WORDS.values() for word in words)})\b",
    re.IGNORECASE,
)
"""A convention that the text says is not the one: non-standard, not the modified."""


@dataclass(frozen=True)
class Grid:
    """The cells of a table.

    Attributes
    ----------
    lines : tuple of tuple of str
        Cells as typed, without surrounding blanks.
    decimal_comma : bool
        Whether a comma may be a decimal one because something else separates the cells.
    said : str
        ``"standard"`` or ``"modified"`` when a title says so, else empty.
    named : str
        The same when the text names a book of that convention, else empty.
    left_out : str
        Text beside the table that is not read, in words.
    """

    lines: tuple[tuple[str, ...], ...]
    decimal_comma: bool = False
    said: str = ""
    left_out: str = ""
    named: str = ""


def _conventions(text: str) -> tuple[str, str]:
    """Return the convention a text states and the one of the books it names; none when two differ."""
    said, named = set(), set()
    text = _DENIED.sub(" ", plain_symbols(text))
    for convention, words in _WORDS.items():
        word = rf"\b(?:{'|'.join(words)})"
        if re.search(rf"{word}\s+{_SUBJECT}|{_SUBJECT}\s*[:,(]\s*{word}\b", text, re.IGNORECASE):
            said.add(convention)
        if re.search(rf"\b(?:{_BOOKS[convention]})\b", text, re.IGNORECASE):
            named.add(convention)
    return (said.pop() if len(said) == 1 else ""), (named.pop() if len(named) == 1 else "")


def read_grid(text: str) -> Grid:
    """Return the cells of the first table in a text.

    Raises
    ------
    InputError
        There is none, or it stands in a file or a program that is not read.
    """
    if len(text) > LONGEST:
        raise InputError(f"the table: expected at most {LONGEST} characters, got {len(text)}")
    text = text.replace("\r\n", "\n").replace("\r", "\n").strip("\n\ufeff ")
    if not text.strip():
        raise InputError("the table: expected one row for each joint, got nothing")
    refuse_other_files(text)
    links = read_links(text)
    if links is not None:
        return Grid(links[0], said=links[1], left_out=links[2])
    said, named = _conventions(text)
    grid = _cells(text)
    left_out = grid.left_out or " and ".join(_IN_OWN_COMMENT.findall(text))
    return replace(grid, said=said, named=named, left_out=left_out)


def _cells(text: str) -> Grid:
    if _ENVIRONMENT.search(text) or ("&" in text and "\\\\" in text):
        return Grid(_latex(text), True)
    if _OWN_PRINT.search(text):
        return _own_print(text)
    if text.startswith("["):  # a list of lists of Python, or a matrix of MATLAB
        text = re.sub(r"\]\s*,?|;", "\n", text).replace("[", "")
    content = [line for line in text.split("\n") if line.strip() and not line.lstrip().startswith(("#", "%"))]
    if sum(len(_BARS.findall(line)) >= 2 for line in content) >= 2 or any(line.count("|") >= 3 for line in content):
        return Grid(_bars(text), True)
    for separator in ("\t", ";", ","):
        if sum(separator in line for line in content) > len(content) / 2:
            return Grid(_separated(content, separator), separator != ",")
    return Grid(tuple(_spaced(line) for line in content if not _RULE.fullmatch(line)), True)


def _bars(text: str) -> tuple[tuple[str, ...], ...]:
    """Split Markdown or drawn tables; the first block of lines with bars is the table."""
    lines: list[tuple[str, ...]] = []
    for line in text.split("\n"):
        closed = _FOOT.match(line) or not (_BARS.search(line) or _RULE.fullmatch(line))
        if lines and (closed or not line.strip()):
            break
        if _BARS.search(line) and not _RULE.fullmatch(line):
            inner = re.sub(r"^[│┃║|]|[│┃║|]$", "", line.strip())
            lines.append(tuple(cell.strip() for cell in _BARS.split(inner)))
    return tuple(lines)


def _separated(lines: list[str], separator: str) -> tuple[tuple[str, ...], ...]:
    reader = csv.reader(
        (line for line in lines if separator in line), delimiter=separator, skipinitialspace=True, strict=True
    )
    try:
        rows = [tuple(cell.strip() for cell in row) for row in reader]
    except csv.Error:
        raise InputError("the table: its quotation marks do not match") from None
    # A separator at the end of every line is a habit, not an empty column.
    if all(len(row) > 1 and row[-1] == "" for row in rows):
        rows = [row[:-1] for row in rows]
    return tuple(rows)


def _spaced(line: str) -> tuple[str, ...]:
    """Split at two blanks or more, or at each blank in a line without these."""
    cells = re.split(r"\s{2,}", line.strip())
    return tuple(cells if len(cells) > 1 else line.split())


def _own_print(text: str) -> Grid:
    """Split the output of ``print(arm)``."""
    lines = text.split("\n")
    first = next(i for i, line in enumerate(lines) if _OWN_PRINT.match(line + " "))
    rows, after = [], []
    for line in lines[first:]:
        name = _AFTER_OWN_PRINT.match(line.strip())
        if name:
            after.append(name[1])
        elif line.strip():
            rows.append(_spaced(line))
    return Grid(tuple(rows), False, left_out=" and ".join(name for name in after if name != "task"))


def _latex(text: str) -> tuple[tuple[str, ...], ...]:
    body = re.sub(r"(?<!\\)%[^\n]*", "", _environment(text))
    body = _LATEX_RULES.sub(" ", body.replace(r"\tabularnewline", r"\\"))
    rows = [row for row in re.split(r"\\\\\*?(?:\s*\[[^\]]*\])?", body) if row.strip()]
    return tuple(tuple(cell.strip() for cell in re.split(r"(?<!\\)&", row)) for row in rows)


def _environment(text: str) -> str:
    """Return the content of the first tabular, array or matrix, without its column types."""
    begin = _ENVIRONMENT.search(text)
    if begin is None:
        return text
    name, rest = begin[1], text[begin.end() :]
    end = rest.find(f"\\end{{{name}}}")
    if end < 0:
        raise InputError(f"the table: \\begin{{{name}}} has no \\end{{{name}}}")
    rest = re.sub(r"^\s*\[[^\]]*\]", "", rest[:end])
    groups = 0 if name.endswith("matrix") else 2 if name in ("tabularx", "tabular*") else 1
    for _ in range(groups):
        rest = _without_group(rest)
    return rest


def _without_group(text: str) -> str:
    """Return a text without its leading group in braces."""
    text = text.lstrip()
    if not text.startswith("{"):
        return text
    depth = 0
    for i, letter in enumerate(text):
        depth += {"{": 1, "}": -1}.get(letter, 0)
        if depth == 0:
            return text[i + 1 :]
    raise InputError("the table: the braces of its column types do not close")
