"""Notation of transforms: names with indices, the chain of factors, elementary factors with numbers."""

from __future__ import annotations

from armlab.benches.pose.tool.state import TOOL, WORLD, PoseView, step_of
from armlab.kin.arm import Arm
from armlab.ui.factors import FACTORS, elementary, product_latex
from armlab.ui.format import mathml, number
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.units import Units

NAMES = {WORLD: "world", TOOL: "tool"}

AXES = tuple(tag(f"b.axis-{axis}", axis) for axis in "xyz")
"""Letters of the axes in their colours."""

INVERSE = r"T^{-1}=\begin{pmatrix}R^{T} & -R^{T}p\\ 0 & 1\end{pmatrix}"


def symbol(reference: str, frame: str) -> str:
    """Return the LaTeX name of the pose of one frame in another."""
    return rf"{{}}^{{{reference}}}T_{{{frame}}}"


def short_symbol(reference: str, frame: str) -> Markup:
    """Return the name for a small button."""
    return joined(tag("sup", reference), "T", tag("sub", frame))


def in_words(reference: str, frame: str) -> str:
    """Return a transform in words: tool in the world, frame 3 in frame 0."""
    moved = NAMES.get(frame, f"frame {frame}")
    seen_from = f"the {NAMES[reference]}" if reference in NAMES else f"frame {reference}"
    return f"{moved} in {seen_from}"


def title(view: PoseView) -> Inside:
    """Return the heading of the matrix of the chosen transform."""
    return (
        mathml(symbol(view.reference, view.frame)),
        " ",
        tag("small", f"{in_words(view.reference, view.frame)}, p in m"),
    )


def chain(view: PoseView) -> Markup | None:
    """Return the transform as the product from which it is computed, as MathML, or None for a constant one."""
    reference, frame = view.outer_pair
    i = step_of(view)
    name = symbol(reference, frame)
    if i is not None:
        return mathml(f"{name}=A_{{{i}}}")
    first = 1 if reference in (WORLD, "0") else view.n + 1 if reference == TOOL else int(reference) + 1
    last = view.n if frame == TOOL else 0 if frame == WORLD else int(frame)
    links = [f"A_{{{k}}}" for k in range(first, last + 1)]
    if not links:
        return None
    product = r"\,".join(links if len(links) <= 4 else [*links[:2], r"\cdots", links[-1]])
    before = symbol(WORLD, "0") + r"\," if reference == WORLD else ""
    after = r"\," + symbol(str(view.n), TOOL) if frame == TOOL else ""
    return mathml(f"{name}={before}{product}{after}")


def link_product(arm: Arm, parameters: dict[str, float], units: Units) -> Markup:
    """Return A_i as the product of its elementary transforms with the present numbers, which breaks between factors."""
    texts = {
        name: units.angle(value) if name in ("alpha", "theta") else units.length(value)
        for name, value in parameters.items()
    }
    factors = (elementary(kind, axis, texts[name]) for kind, axis, name in FACTORS[arm.convention])
    return joined(factors, between=" ")


def link_symbols(arm: Arm, i: int, units: Units) -> Markup:
    """Return A_i as the product of its elementary transforms in the symbols of the table, as MathML."""
    return mathml(f"A_{{{i}}}={product_latex(arm.convention, units, str(i), str(i - 1))}")


def cosine(value: float, angle: float, units: Units) -> str:
    """Return the cosine of an angle as text, ``cos 57.3° = 0.540``."""
    return f"cos {units.angle(angle)} = {number(value, 3)}"
