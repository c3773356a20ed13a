"""The page of products of elementary rotations: every entry as a formula, its number, and a formula to compare."""

from __future__ import annotations

import re
from functools import partial

import numpy as np

from armlab.benches.body.forms.stage import around
from armlab.benches.body.forms.ui.page import HIDES
from armlab.benches.body.forms.ui.rings import COLOURS
from armlab.benches.body.products.copies import copies
from armlab.benches.body.products.examples import EXAMPLES, ChooseProductExample, example_of
from armlab.benches.body.products.facts import matrix_of, typed_of
from armlab.benches.body.products.state import (
    ChooseProduct,
    Products,
    SelectEntry,
    SetProductAngle,
    TakeBodyAngles,
    TypeEntry,
)
from armlab.benches.body.products.ui.scene import GREEK
from armlab.content.identity import POINTS, TOLERANCE
from armlab.kin.euler import SEQUENCES
from armlab.kin.rotation_products import ANGLES, PAIRS, product_entries
from armlab.session.parts.notation import Notation
from armlab.session.state import Command, Post, State
from armlab.ui.colours import css
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import MINUS, dot, mathml, matrix, number, readable
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import copy_button, verdict_box
from armlab.ui.plugin import Panel, Show
from armlab.ui.tables import head_line, line
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

GROUPS = {
    "three axes": {axes: axes.upper() for axes in sorted(SEQUENCES)},
    "two axes": {axes: axes.upper() for axes in PAIRS},
}

_SIGN = re.compile(r" (?=[+-] )")


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the axes and angles, the matrix of formulas, the selected entry and the field for a formula."""
    form = gui.form(post)

    def show(state: State) -> None:
        form.show(
            examples(form, EXAMPLES, example_of(state), ChooseProductExample),
            _head(form, state),
            _angles(form, state),
            _formulas(form, state),
            _entry(form, state),
            tag("h3", "Numbers ", tag("small", "at the present angles")),
            tag("div.bo-product", "R = ", matrix(matrix_of(state), 4)),
        )

    return show


def _head(form: Form, state: State) -> Markup:
    axes = state[Products].axes
    chooser = form.select_in_groups("axes", "Axes of the product", GROUPS, axes, ChooseProduct)
    take = form.chip("take body", "angles of the body", TakeBodyAngles(), "Sequence and angles of the page Forms")
    return tag("div.kit-head", tag("span.dim", "Axes"), chooser, take)


def _angles(form: Form, state: State) -> Markup:
    part, units = state[Products], units_of(state)

    def taken(k: int, text: str) -> Command:
        return SetProductAngle(k, units.read(text, True, GREEK[k]))

    count = len(part.axes)
    heads = [(dot(css(COLOURS[k])), f"{GREEK[k]} about {axis}") for k, axis in enumerate(part.axes)]
    fields = [
        form.field(f"angle {k}", units.entry(part.angles[k], True), f"{GREEK[k]}, angle {k + 1}", partial(taken, k))
        for k in range(count)
    ]
    return tag("table.kit-points.bo-angles", head_line(None, *heads), line(*fields, name=units.angle_unit))


def _formulas(form: Form, state: State) -> Markup:
    """Return the matrix of formulas, of which each entry can be selected."""
    part = state[Products]
    product = "".join(rf"R_{axis}(\{angle})" for axis, angle in zip(part.axes, ANGLES, strict=False))
    buttons = [copy_button(name, text) for name, text in copies(part.axes).items()]
    rows = [
        tag("tr", [tag("td", _button(form, part, i, j, entry)) for j, entry in enumerate(row)])
        for i, row in enumerate(product_entries(part.axes))
    ]
    head = tag("h3", mathml(product), " =", tag("span.copies", buttons))
    return joined(head, tag("table.mat.pr-formulas", rows), _short())


def _short() -> Markup:
    cosine, sine = mathml(r"c_\alpha=\cos\alpha"), mathml(r"s_\alpha=\sin\alpha")
    return tag("p.dim", cosine, ", ", sine, ". Press an entry to look at it.")


def _button(form: Form, part: Products, i: int, j: int, entry: str) -> Markup:
    """Return an entry with one term in a line."""
    lines = [tag("span", mathml(term)) for term in _SIGN.split(entry)]
    return form.button(
        f"entry {i}{j}",
        lines,
        SelectEntry(i + 1, j + 1),
        "pr-entry",
        f"Entry ({i + 1},{j + 1})",
        pressed=(part.row, part.column) == (i + 1, j + 1),
    )


def _entry(form: Form, state: State) -> Inside:
    """Return the selected entry with its number, and the field for a formula to be compared with it."""
    part = state[Products]
    i, j = part.row - 1, part.column - 1
    value = float(matrix_of(state)[i, j])
    equation = mathml(f"r_{{{part.row}{part.column}}}={product_entries(part.axes)[i][j]}")
    typed = form.field("typed", part.typed, "Your formula for the entry", TypeEntry, spellcheck="false")
    return (
        tag("div.eq.small", equation, f" = {number(value, 4)}"),
        tag("div.pr-typed", tag("label", "Your formula for ", mathml(f"r_{{{part.row}{part.column}}}"), " ", typed)),
        _verdict(state),
    )


def _verdict(state: State) -> Markup:
    """Return how the typed formula compares with the entry."""
    found = typed_of(state)
    if found is None:
        return tag("p.dim", "Type one to compare it at 50 points: cos(α), cos(alpha) or ca, with spaces for products.")
    if found.agrees:
        return verdict_box("ok", f"It agrees with the entry at {POINTS} points")
    if len(found.left) == 0:
        return verdict_box("no", "It has no value at any point")
    k = found.worst
    places = dict(zip(found.names, found.points[k].real.tolist(), strict=True))
    units = units_of(state)
    at = ", ".join(f"{GREEK[ANGLES.index(name)]} = {units.angle(value)}" for name, value in places.items())
    where = f"At {at} it" if at else "It"
    here = tag(
        "p",
        f"{where} is {_value(complex(found.left[k]))}, and the entry is {readable(float(np.real(found.right[k])), 4)}.",
    )
    return verdict_box("no", f"It is off by up to {readable(float(found.difference[k]), 4)}", here)


def _value(value: complex) -> str:
    """Return the number of a formula, with its imaginary part if i has left one.

    >>> _value(0.5 + 0j), _value(-2 - 1.5j)
    ('0.5', '−2 − 1.5 i')
    """
    real = readable(value.real, 4)
    if abs(value.imag) <= TOLERANCE * max(1.0, abs(value)):
        return real
    return f"{real} {MINUS if value.imag < 0.0 else '+'} {readable(abs(value.imag), 4)} i"


PANEL = Panel((Products,), build, rebuilds=(Notation,), hides=HIDES, around=around)
