"""A product in symbols as text to copy: LaTeX, Python, and plain text."""

from __future__ import annotations

from armlab.kin.rotation_products import ANGLES, product_entries


def copies(axes: str) -> dict[str, str]:
    """Return the texts by name."""
    return {"LaTeX": latex(axes), "Python": python(axes), "text": plain(axes)}


def latex(axes: str) -> str:
    """Return an equation in LaTeX with the entries as a matrix."""
    letters = [rf"R_{axis}(\{angle})" for axis, angle in zip(axes, ANGLES, strict=False)]
    rows = " \\\\\n".join("  " + " & ".join(row) for row in product_entries(axes, "latex"))
    return f"{' '.join(letters)} = \\begin{{bmatrix}}\n{rows}\n\\end{{bmatrix}}"


def python(axes: str) -> str:
    """Return a function in Python that makes the matrix as a list of rows."""
    angles = ", ".join(ANGLES[: len(axes)])
    rows = ",\n".join(f"        [{', '.join(row)}]" for row in product_entries(axes, "text"))
    return f"from math import cos, sin\n\n\ndef rotation_{axes}({angles}):\n    return [\n{rows},\n    ]\n"


def plain(axes: str) -> str:
    """Return one line for each entry."""
    return "\n".join(
        f"r{i + 1}{j + 1} = {entry}"
        for i, row in enumerate(product_entries(axes, "text"))
        for j, entry in enumerate(row)
    )
