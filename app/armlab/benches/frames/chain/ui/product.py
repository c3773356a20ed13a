"""The transform between two frames: the choice of the pair, its product, and its inverse in two ways."""

from __future__ import annotations

from functools import partial

from armlab.benches.frames.chain.point import LookAtFrames
from armlab.benches.frames.chain.state import WORLD, Chain
from armlab.benches.frames.chain.tree import Pair, pair_of
from armlab.benches.frames.chain.ui.symbols import called, product, transform_name
from armlab.session.state import State
from armlab.ui.form import Form
from armlab.ui.format import mathml, matrix, scientific
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import fold

DECIMALS = 4
RULE = 3
"""Column before which a dashed line stands: the position."""


def pair_markup(form: Form, state: State) -> Inside:
    """Return the choice of both frames, and the product of which the transform comes."""
    part, found = state[Chain], state.derived(pair_of)
    texts = {name: "world" if name == WORLD else name for name in part.names}

    def chosen(what: str, name: str) -> LookAtFrames:
        return LookAtFrames(**{what: name})

    frame = form.select("frame", "Frame of the transform", texts, part.frame, partial(chosen, "frame"))
    reference = form.select("reference", "Reference", texts, part.reference, partial(chosen, "reference"))
    turned = form.chip(
        "exchange", "⇄", LookAtFrames(part.frame, part.reference), "Exchange both frames: the inverse transform"
    )
    return (
        tag("h3", "Transform between two frames"),
        tag("div.kit-head", tag("span.dim", "pose of"), frame, tag("span.dim", "in"), reference, turned),
        tag("div.eq.fr-product", _product(found)),
        _against(found),
    )


def _product(found: Pair) -> Inside:
    name = transform_name(found.reference, found.frame)
    if not found.steps:
        return (name, " = I")
    return (name, " = ", product(found.steps))


def _against(found: Pair) -> Markup | None:
    """Return which factors are inverses of what is given."""
    against = [step for step in found.steps if step.against]
    if not against:
        return None
    names = [
        (
            ", " if k else "",
            transform_name(step.reference, step.frame),
            " of ",
            transform_name(step.frame, step.reference),
        )
        for k, step in enumerate(against)
    ]
    return tag("p.dim", "Inverses of what is given: ", names, ".")


def title_of(found: Pair) -> Inside:
    """Return the heading of the matrix."""
    name = transform_name(found.reference, found.frame)
    return (name, " ", tag("small", f"{called(found.frame)} in {called(found.reference)}, p in m"))


def inverse_markup(state: State) -> Markup:
    """Return the factors in numbers, and the inverse by the transpose beside that of any matrix, folded."""
    found = state.derived(pair_of)
    name = transform_name(found.frame, found.reference)
    factors = [
        tag("div.fr-factor", tag("small", transform_name(step.reference, step.frame)), matrix(T, 3, RULE))
        for step, T in zip(found.steps, found.factors, strict=True)
    ]
    inverses = (
        tag(
            "p",
            name,
            " = ",
            mathml(r"\begin{pmatrix}R^{T}&-R^{T}p\\0&1\end{pmatrix}"),
            ", in place of the inverse of any 4 × 4 matrix by elimination:",
        ),
        tag("div.fr-pair", _named("Rᵀ, −Rᵀp", found.inverse), _named("by elimination", found.general)),
        tag(
            "p.dim",
            f"They differ by {scientific(found.difference)} at most in an entry. The transpose takes nine products for "
            "the position and none for the orientation.",
        ),
    )
    return tag("div", fold("Factors in numbers", factors or tag("p.dim", "None.")), fold("Inverse", inverses))


def _named(name: str, T: object) -> Markup:
    return tag("div.fr-factor", tag("small", name), matrix(T, 3, RULE))  # type: ignore[arg-type]
