"""Products of elementary transforms, written with symbols and with numbers."""

from __future__ import annotations

from collections.abc import Sequence

from armlab.kin.dh import Convention
from armlab.ui.html import Markup, joined, tag
from armlab.ui.units import Units

FACTORS = {
    "standard": (("R", "z", "theta"), ("T", "z", "d"), ("T", "x", "a"), ("R", "x", "alpha")),
    "modified": (("R", "x", "alpha"), ("T", "x", "a"), ("R", "z", "theta"), ("T", "z", "d")),
}
"""The elementary transforms of A_i in order: turn or shift, axis, and the entry of the table."""


def elementary(kind: str, axis: str, text: str) -> Markup:
    """Return one elementary turn or shift with its number, as MathML; it is not cached, because the numbers change."""
    left, right = (tag("mo", sign, stretchy="false") for sign in "()")
    return tag("math", tag("msub", tag("mi", kind), tag("mi", axis)), left, tag("mn", text), right)


def product_latex(convention: Convention, units: Units, index: str, before: str) -> str:
    """Return the product of the moves of a row in LaTeX; the modified table counts a and alpha from the row before."""
    modified = convention == "modified"
    return r"\,".join(
        rf"{kind}_{axis}({units.latex(name)}_{{{before if modified and name in ('a', 'alpha') else index}}})"
        for kind, axis, name in FACTORS[convention]
    )


def turns(axes: str, fixed: bool, texts: Sequence[str]) -> Markup:
    """Return a product of turns with numbers in the order of multiplication, for fixed axes the first turn last."""
    factors = [elementary("R", axis, text) for axis, text in zip(axes, texts, strict=True)]
    return joined(reversed(factors) if fixed else factors, between=" ")
