"""Arms written as programs or in files of other software: what of it is read as a table, and what to paste instead."""

from __future__ import annotations

import re

from armlab.errors import InputError

Lines = tuple[tuple[str, ...], ...]

INSTEAD = (
    "paste its Denavit-Hartenberg table instead, a row with a, alpha, d, theta for each joint: from a spreadsheet, "
    "CSV, Markdown or LaTeX"
)

_OF_LINK = ("theta", "d", "a", "alpha", "sigma", "offset")
_XML = re.compile(r"<(?:\?xml|!--|robot|sdf|mujoco)", re.IGNORECASE)
_LINK = re.compile(r"(?<!\w)Link\s*\(\s*\[([^\]]*)\]([^)\n]*)\)")
_PROGRAM = re.compile(
    r"\b(?:rigidBody\w*|setFixedTransform|SerialLink|DHRobot)\("
    r"|\b(?:Link|DHLink|(?:Revolute|Prismatic)(?:M?DH)?)\(\s*(?:['\"]\w+['\"]\s*,|\w+\s*=)"
)
"""A call that makes a link or an arm, in toolboxes of MATLAB and Python."""

_COMMENT = re.compile(
    r"^[ \t]*%\{[ \t]*$.*?(?:^[ \t]*%\}|\Z)|%[^\n]*|^[ \t]*#[^\n]*|\.\.\.[^\n]*\n", re.MULTILINE | re.DOTALL
)
_OF_ARM = re.compile(r"\b(?:SerialLink|DHRobot)\s*\(")
_CALL = re.compile(r"(?<!\w)Link\s*\(")
_OPTION = re.compile(r"(?<=,)\s*(?!['\"](?:mod|sta|qlim))['\"]?\b[a-zA-Z]\w*.*")
"""An option of a link that is neither its convention nor its limits."""

_CHANGED = re.compile(
    r"[\w()]{0,20}\.(?:offset|mdh|sigma|jointtype|theta|d|a|alpha|flip)\s*=(?!=)|['\"](?:offset|modified|mdh)['\"]"
)
"""An assignment to a property of a link, or an option of the whole arm, that changes what the numbers mean."""

_PLACED = re.compile(r"['\"](base|tool)['\"]|\b(base|tool)\s*=(?!=)")


def refuse_other_files(text: str) -> None:
    """Raise `InputError` for a URDF or another description of a robot in XML."""
    if _XML.match(text):
        raise InputError(f"the table: a URDF or another file in XML is not read; {INSTEAD}")


def read_links(text: str) -> tuple[Lines, str, str] | None:
    """Return the table of ``Link([theta d a alpha sigma offset])`` in Peter Corke's toolbox, and its convention.

    The toolbox ignores the number of the joint variable, theta or d: what counts is the offset.

    Returns
    -------
    tuple or None
        Lines with a header, ``"standard"`` or ``"modified"``, and what is not read, in words: base and tool; None for a
        text that is no program.

    Raises
    ------
    InputError
        Another program, a link in another form or with too few numbers, or links of both conventions.

    >>> read_links("L(1) = Link([0 0.4 0.1 -pi/2], 'modified');")[1]
    'modified'
    """
    code = _COMMENT.sub(" ", text)
    links = list(_LINK.finditer(code))
    beside = _OF_ARM.sub(" ", _LINK.sub(" ", code))
    if _PROGRAM.search(beside if links else code) or (links and _CALL.search(beside)):
        raise InputError(f"the table: of programs only Link([theta d a alpha]) is read; {INSTEAD}")
    if not links:
        return None
    changed = _CHANGED.search(beside) or next((got for link in links if (got := _OPTION.search(link[2]))), None)
    if changed:
        raise InputError(
            "the table: expected everything about a link inside Link([theta d a alpha sigma offset], 'modified'), "
            f"got {changed[0].strip()!r}; {INSTEAD}"
        )
    said = {"modified" if re.search(r"""['"]mod""", link[2]) else "standard" for link in links}
    if len(said) > 1:
        raise InputError("the table: expected all links in one convention, got some with 'modified' and some without")
    header = ("theta [rad]", "d", "a", "alpha [rad]", "type")
    lines = (header, *(_row(i, link[1]) for i, link in enumerate(links, start=1)))
    placed = {found[1] or found[2] for found in _PLACED.finditer(beside)}
    return lines, said.pop(), " and ".join(sorted(placed))


def _row(i: int, inside: str) -> tuple[str, ...]:
    cells = [cell for cell in re.split(r"[\s,]+", inside) if cell]
    if not 4 <= len(cells) <= len(_OF_LINK):
        names = ", ".join(_OF_LINK[:4])
        raise InputError(f"link {i}: expected {names}, perhaps sigma and offset, got {len(cells)} numbers: {inside!r}")
    theta, d, a, alpha, sigma, offset = [*cells, "0", "0"][: len(_OF_LINK)]
    if sigma not in ("0", "1"):
        raise InputError(f"link {i}: expected sigma 0 (turns) or 1 (slides), got {sigma!r}")
    variable = f"q{i} + ({offset})"
    return (theta, variable, a, alpha, "P") if sigma == "1" else (variable, d, a, alpha, "R")
