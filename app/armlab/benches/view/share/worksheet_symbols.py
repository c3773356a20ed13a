"""The matrices of a worksheet in symbols: of a row, of the tool and the Jacobian, where they are short enough."""

from __future__ import annotations

from armlab.benches.view.share.worksheet_formats import Text
from armlab.kin.arm import Arm
from armlab.kin.graph.printing import Style
from armlab.kin.symbolic import PoseFormulas
from armlab.kin.velocity.symbolic_jacobian import MOST_TERMS, jacobian_formulas

Rows = list[list[str]]

LONGEST = 120
"""Largest number of characters of an entry."""

LAST = ["0", "0", "0", "1"]

_STANDARD = (
    ("cos θᵢ", "−sin θᵢ cos αᵢ", "sin θᵢ sin αᵢ", "aᵢ cos θᵢ"),
    ("sin θᵢ", "cos θᵢ cos αᵢ", "−cos θᵢ sin αᵢ", "aᵢ sin θᵢ"),
    ("0", "sin αᵢ", "cos αᵢ", "dᵢ"),
)
_MODIFIED = (
    ("cos θᵢ", "−sin θᵢ", "0", "aᵢ₋₁"),
    ("sin θᵢ cos αᵢ₋₁", "cos θᵢ cos αᵢ₋₁", "−sin αᵢ₋₁", "−dᵢ sin αᵢ₋₁"),
    ("sin θᵢ sin αᵢ₋₁", "cos θᵢ sin αᵢ₋₁", "cos αᵢ₋₁", "dᵢ cos αᵢ₋₁"),
)
_LATEX = {"ᵢ₋₁": "_{i-1}", "ᵢ": "_i", "θ": r"\theta", "α": r"\alpha", "−": "-", "sin ": r"\sin", "cos ": r"\cos"}

COLUMN = Text(
    "Column i is (z × (p − c), z) of a joint that turns and (z, 0) of one that slides, with the axis z of joint i, a "
    "point c on it and the tool point p.",
    r"Column $i$ is $(z\times(p-c),\ z)$ of a joint that turns and $(z,\ 0)$ of one that slides, with the axis $z$ of "
    r"joint $i$, a point $c$ on it and the tool point $p$.",
)


def row_in_symbols(convention: str, style: Style) -> Rows:
    """Return the transform of any row. Notes 4.13 (standard); Craig, *Introduction to Robotics*, 3.6 (modified)."""
    entries = [[*row] for row in (_STANDARD if convention == "standard" else _MODIFIED)]
    rows = [*entries, LAST]
    return rows if style == "text" else [[_latex(entry) for entry in row] for row in rows]


def tool_in_symbols(arm: Arm, style: Style) -> Rows | None:
    """Return the pose of the tool in frame 0; None where it is too long to read."""
    pose = PoseFormulas(arm)
    if any(terms > MOST_TERMS for terms in pose.terms.values()):
        return None
    printed = pose.printed(style)
    rows = [[*(printed[f"r{i}{k}"] for k in (1, 2, 3)), printed[f"p{axis}"]] for i, axis in enumerate("xyz", start=1)]
    return _short([*rows, LAST])


def jacobian_in_symbols(arm: Arm, style: Style) -> Rows | None:
    """Return the geometric Jacobian at the tool point in axes of frame 0; None where it is too long to read."""
    rows = jacobian_formulas(arm, style)
    return None if rows is None else _short(rows)


def _short(rows: Rows) -> Rows | None:
    return rows if max(len(entry) for row in rows for entry in row) <= LONGEST else None


def _latex(entry: str) -> str:
    for sign, command in _LATEX.items():
        entry = entry.replace(sign, command)
    return entry
