"""The page of identities: two typed formulas compared at seeded points, and drawn over one variable."""

from __future__ import annotations

from functools import partial

from armlab.benches.help.identities.examples import EXAMPLES, ChooseIdentity, example_of, groups
from armlab.benches.help.identities.latex import latex_of
from armlab.benches.help.identities.state import (
    SIDES,
    Identities,
    OtherPoints,
    SetKind,
    SetSide,
    comparison_of,
    formulas_of,
    kinds_of,
)
from armlab.benches.help.identities.sweep import sweep_of
from armlab.benches.help.identities.ui.verdict import verdict_markup
from armlab.content.identity import KINDS, POINTS
from armlab.session.fields import Set
from armlab.session.state import Command, Post, State
from armlab.ui.colours import BLUE, ORANGE
from armlab.ui.form import Form
from armlab.ui.format import mathml
from armlab.ui.html import Markup, joined, tag
from armlab.ui.markup import fold
from armlab.ui.plot import Curve, Plot
from armlab.ui.plugin import Panel, Show
from armlab.ui.widgets import Gui

HEIGHT = 120

CURVES = (Curve("left side", BLUE, width=3.0), Curve("right side", ORANGE, dash=(6, 4)))

WRITTEN = (
    "+ − * / ^ and brackets; π, e and i; letters and Greek letters, perhaps with a number. Products need no sign. "
    "sin cos tan sec csc cot asin acos atan atan2 sinh cosh tanh exp ln sqrt abs arg re im conj min max, each with its "
    "bracket. n, k and m are whole numbers, z and w are complex, all others are real, unless you choose another kind."
)


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the choice, both sides, the kinds of the variables, the verdict and the plots."""
    form, numbers = gui.form(post), gui.html()
    plots = [Plot(gui, title, "x", CURVES, f"identity_{name}", height=HEIGHT) for name, title in _TITLES.items()]
    gui.html(fold("What can be typed", tag("p.dim", WRITTEN)))
    drawn: Identities | None = None

    def show(state: State) -> None:
        nonlocal drawn
        sides = [_side(form, state, side) for side in SIDES]
        form.show(_chooser(form, state), sides, _variables(form, state), _equation(state))
        numbers.show(verdict_markup(state))
        part = state[Identities]
        if part != drawn:
            drawn = part
            _draw(plots, state)

    return show


_TITLES = {"re": "Both sides, real part", "im": "Both sides, imaginary part"}
"""Titles of the plots."""


def _chooser(form: Form, state: State) -> Markup:
    chosen = example_of(state)
    texts = {"": {"": "Choose …"}, **groups()}
    chooser = form.select_in_groups("example", "Identities of the appendix", texts, chosen, ChooseIdentity)
    says = EXAMPLES[chosen].says if chosen else ""
    return joined(tag("div.kit-head", tag("span.dim", "Examples"), chooser), tag("p.kit-look", says) if says else None)


def _side(form: Form, state: State, side: str) -> Markup:
    def taken(text: str) -> Command:
        return SetSide(side, text)

    typed = form.field(side, getattr(state[Identities], side), f"{side} side", taken, spellcheck="false")
    return tag("div.id-side", tag("span.dim", side), typed)


def _equation(state: State) -> Markup:
    left, right = (latex_of(side) for side in formulas_of(state))
    found = comparison_of(state)
    differ = len(found.left) > 0 and not found.close.all()
    sign = "=" if found.agrees else r"\neq" if differ else r"\overset{?}{=}"
    return tag("div.eq.small.scroll", mathml(left), " ", mathml(sign), " ", mathml(right))


def _variables(form: Form, state: State) -> Markup:
    """Return the choice of the kind of each variable, and the seed."""
    kinds = [
        tag(
            "label",
            tag("i", name),
            " ",
            form.select(f"kind {name}", f"Kind of {name}", KINDS, kind, partial(SetKind, name)),
        )
        for name, kind in kinds_of(state).items()
    ]
    seed = form.field("seed", str(state[Identities].seed), "Seed of the points", _seeded)
    more = form.chip("others", "other", OtherPoints(), f"Compare at {POINTS} other points")
    return tag("div.kit-numbers.id-kinds", kinds, tag("label", "seed ", seed), more)


def _seeded(text: str) -> Command:
    return Set(Identities, "seed", int(text) if text.strip().isdecimal() and len(text) < 9 else text)


def _draw(plots: list[Plot], state: State) -> None:
    found = sweep_of(state)
    real, imaginary = plots
    real.visible(found is not None)
    imaginary.visible(found is not None and found.complex)
    if found is None:
        return
    real.name_x(found.name)
    imaginary.name_x(found.name)
    real.show(found.x, [found.left.real, found.right.real])
    real.cursor(found.at)
    if found.complex:
        imaginary.show(found.x, [found.left.imag, found.right.imag])
        imaginary.cursor(found.at)


PANEL = Panel((Identities,), build, rebuilds=(), apart=True)
