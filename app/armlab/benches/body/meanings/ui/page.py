"""The page of the three meanings of a rotation matrix, each with its equation in present numbers."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
from numpy.typing import NDArray

from armlab.benches.body.forms.rotation import forms_of
from armlab.benches.body.forms.stage import around
from armlab.benches.body.forms.state import Body
from armlab.benches.body.forms.ui.numbers import angles_markup, places_markup
from armlab.benches.body.forms.ui.page import HIDES
from armlab.benches.body.meanings.state import (
    AXES,
    MATRIX,
    SHOWN,
    Elementary,
    Meanings,
    SetVector,
    TurnElementary,
    elementary_of,
    image_of,
)
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.selection import Selection
from armlab.session.state import Command, Post, State
from armlab.ui.form import Form
from armlab.ui.format import mathml, matrix, number, readable
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import fold, row
from armlab.ui.matrices import MatrixView
from armlab.ui.plugin import Panel, Show
from armlab.ui.tables import head_line, line
from armlab.ui.units import plain_number, units_of
from armlab.ui.widgets import Gui

SAID: dict[str, str] = {
    "orientation": "R says how the body stands: its columns are the axes x′, y′, z′ of the body, written in the base "
    "frame. Every entry is the cosine of the angle between an axis of the base and one of the body⟦; the text after "
    "3.5 calls it the angle itself⟧. Select a column, a row or an entry.",
    "coordinates": "R changes coordinates: nothing moves. The same vector p has other coordinates in the frame B of "
    "the body (thick steps) and in the frame A of the base (fine steps), and R leads from B to A.",
    "operator": "R moves: it rotates the vector v about the axis r by θ. There is one frame only, that of the base, in "
    "which both v and v′ are written.",
}

EQUATIONS = {
    "orientation": r"R=\left[\begin{array}{ccc}x'&y'&z'\end{array}\right],\quad r_{ij}=\cos\angle(i,j')",
    "coordinates": r"{}^{A}p={}^{A}R_B\,{}^{B}p,\qquad {}^{B}p=R^T\,{}^{A}p",
    "operator": r"v'=R\,v,\qquad |v'|=|v|",
}

COLUMNS, ROWS = ("x′", "y′", "z′"), ("x", "y", "z")


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the choice of the meaning, the equation with its numbers, and the fields of the vector and of R."""
    top = gui.form(post)
    view = MatrixView(gui, post, MATRIX)
    numbers = gui.form(post)

    def show(state: State) -> None:
        shown = state[Meanings].shown
        chips = top.chips("shown", SHOWN, shown, "What R means", partial(Set, Meanings, "shown"))
        top.show(
            tag("h3", "One matrix, three meanings"),
            tag("div.cases", chips),
            tag("p", SAID[shown]),
            tag("div.eq", mathml(EQUATIONS[shown])),
        )
        view.visible(shown == "orientation")
        title = tag("span", "R ", tag("small", "columns x′ y′ z′, rows x y z"))
        view.show(state, title, state.derived(forms_of).R, columns=COLUMNS, rows=ROWS)
        numbers.show(_numbers(numbers, state), _turned(numbers, state))

    return show


def _numbers(form: Form, state: State) -> Inside:
    """Return what R does in the meaning that is shown, in numbers."""
    shown, R = state[Meanings].shown, state.derived(forms_of).R
    if shown == "orientation":
        return _cosines(state, R)
    p, image = np.array(state[Meanings].p), image_of(state)
    names = [(tag("sup", "B"), "p"), (tag("sup", "A"), "p")] if shown == "coordinates" else ["v", "v′"]
    rows = [line(*_fields(form, p, False), name=names[0])]
    rows.append(line(*_fields(form, image, True), name=names[1]))
    letter = "p" if shown == "coordinates" else "v"
    table = tag("table.kit-points", head_line(None, *ROWS), rows)
    product = tag("div.bo-product", _column(image), "=", matrix(R, 3), _column(p))
    more = _elementary(form, state) if shown == "operator" else None
    lengths = f"|{letter}| = {number(float(np.linalg.norm(p)), 4)} before and after: R keeps lengths and angles."
    return joined(table, product, tag("p.dim", lengths), more)


def _elementary(form: Form, state: State) -> Markup:
    """Return the choice of an elementary rotation, and what it does to the vector in the plane across its axis."""
    found, units = elementary_of(state), units_of(state)
    chosen = found.axis if found else ""
    names = {axis: f"about {axis}" for axis in AXES}
    chips = form.chips("elementary", names, chosen, "Turn about this axis by the present angle", TurnElementary)
    head = row("Elementary", chips)
    if found is None:
        return joined(head, tag("p.dim", "Choose one to see what it does in the plane perpendicular to its axis."))
    one, other = found.plane[0], found.plane[1]
    alpha, theta = units.angle(found.alpha), units.angle(found.theta)
    turned = units.angle(found.alpha + found.theta)
    said = (
        f"In the plane of {one} and {other} the vector has the length {number(found.radius, 4)} and the angle "
        f"α = {alpha}, afterwards α + θ = {alpha} + {theta} = {turned}; {found.axis} stays."
    )
    return joined(head, tag("p", said), tag("div.eq.small", mathml(_in_plane(one, other))), _of_the_notes(found))


def _in_plane(one: str, other: str) -> str:
    """Return the two components of the rotated vector in LaTeX."""
    first = rf"{one}'={one}\cos\theta-{other}\sin\theta"
    return rf"{first},\quad {other}'={one}\sin\theta+{other}\cos\theta"


def _of_the_notes(found: Elementary) -> Markup:
    """Return by how much the line of the notes would miss, in which sine and cosine of y are those of alpha."""
    y = found.radius * math.sin(found.alpha)
    first = y * (math.sin(found.theta) - math.sin(found.alpha))
    second = y * (math.cos(found.alpha) - math.cos(found.theta))
    off = number(math.hypot(first, second), 4)
    return tag(
        "p.dim", f"⟦The line before 3.16 prints sin α and cos α with the second component: it would miss by {off}.⟧"
    )


def _fields(form: Form, values: NDArray[np.float64], in_base: bool) -> list[Markup]:
    def field(k: int) -> Markup:
        where = f"{'base' if in_base else 'vector'} {ROWS[k]}"

        def taken(text: str) -> Command:
            return SetVector(k, plain_number(text, where), in_base)

        return form.field(f"{'image' if in_base else 'p'} {k}", readable(float(values[k]), 4), where, taken)

    return [field(k) for k in range(3)]


def _column(values: NDArray[np.float64]) -> Markup:
    return matrix(values.reshape(3, 1), 3)


def _cosines(state: State, R: NDArray[np.float64]) -> Inside:
    """Return the angles between the axes of both frames, of which the entries are the cosines."""
    units, selected = units_of(state), state[Selection].of(MATRIX)
    angles = np.arccos(np.clip(R, -1.0, 1.0))
    rows = [line(*[units.text(float(angle), True) for angle in angles[i]], name=ROWS[i]) for i in range(3)]
    head = tag("h3", "Angles between the axes ", tag("small", units.angle_unit))
    table = tag("table.kit-points.bo-angles", head_line(None, *COLUMNS), rows)
    if selected.row is None or selected.column is None:
        return joined(head, table)
    i, j = selected.row, selected.column
    entry = f"{number(float(R[i, j]), 4)} = cos {units.angle(float(angles[i, j]))}"
    return joined(
        head, table, tag("p", f"Between {ROWS[i]} and {COLUMNS[j]}: r", tag("sub", f"{i + 1}{j + 1}"), f" = {entry}.")
    )


def _turned(form: Form, state: State) -> Markup:
    return fold("Turn the body", places_markup(form), angles_markup(form, state), key="turn", opened=False)


PANEL = Panel((Body, Meanings, Selection), build, rebuilds=(Notation,), hides=HIDES, around=around)
