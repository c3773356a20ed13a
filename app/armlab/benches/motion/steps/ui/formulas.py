"""The formula of each kind of path, with the letter of the quantity along it."""

from __future__ import annotations

from armlab.kin.motion.path import Path
from armlab.kin.motion.path_types import PathType


def formula_of(kind: PathType, letter: str) -> str:
    """Return the formula of a kind of path in LaTeX, with the letter of the quantity; empty if none is known."""
    return kind.formula.replace("X", rf"\mathbf{{{letter}}}")


def says_of(kind: PathType, path: Path | None) -> str:
    """Return a sentence on a kind of path, with the degree if that depends on the knots."""
    said = kind.says
    several = kind.key in ("polynomial", "interpolating")
    return f"{said} Degree {path.degree}." if several and path is not None and path.degree is not None else said
