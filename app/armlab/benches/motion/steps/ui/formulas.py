"""The formula of each kind of path, with the letter of the quantity along it."""

from __future__ import annotations

from armlab.benches.motion.chosen import Chosen
from armlab.kin.motion.path import Path
from armlab.kin.motion.path_types import path_types

QUARTIC = r"X^{(4)}(s)=0\ \text{or}\ \text{const.}"
"""Formula of lines with quartic blends, which have an option for the curve."""


def formula_of(chosen: Chosen, letter: str) -> str:
    """Return the formula of a path in LaTeX, with the letter of the quantity; empty if none is known."""
    formula = QUARTIC if _quartic(chosen) else path_types()[chosen.key].formula
    return formula.replace("X", rf"\mathbf{{{letter}}}")


def says_of(chosen: Chosen, path: Path | None) -> str:
    """Return a sentence on a path, with the degree if that depends on the knots."""
    said = path_types()[chosen.key].says
    if _quartic(chosen):
        said = said.replace("a parabola", "a quartic")
    several = chosen.key in ("polynomial", "interpolating")
    return f"{said} Degree {path.degree}." if several and path is not None and path.degree is not None else said


def rounds_corners(chosen: Chosen) -> bool:
    """Return whether a path has blends in place of corners, so that it passes by the knots between."""
    return any(field.key == "shape" for field in path_types()[chosen.key].fields)


def _quartic(chosen: Chosen) -> bool:
    return chosen.options.get("shape") == "quartic"
