"""The page of skew matrices and dyads: a matrix in two parts, S(v) u, and the sum of the dyads of its columns."""

from __future__ import annotations

from functools import partial

import numpy as np

from armlab.benches.body.forms.stage import around
from armlab.benches.body.forms.ui.page import HIDES
from armlab.benches.body.skew.facts import cross_of, dyad_of, matrix_of, orthonormal, sum_of, swapped
from armlab.benches.body.skew.state import (
    SHOWN,
    SetSkewEntry,
    SetSkewMatrix,
    SetSkewVector,
    Skew,
    TakeBodyMatrix,
)
from armlab.kin.matrix_parts import quadratic_form, skew_part, skew_vector, symmetric_part
from armlab.kin.rotations import skew
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.state import Command, Post, State
from armlab.ui.form import Form
from armlab.ui.format import components, mathml, matrix, number, pairs, readable, scientific
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import row, verdict_box
from armlab.ui.plugin import Panel, Show
from armlab.ui.tables import head_line, line
from armlab.ui.units import plain_number, typed_numbers
from armlab.ui.widgets import Gui

AXES = ("x", "y", "z")

PLACES = {
    "I": (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
    "Upper": (1.0, 2.0, 0.0, 0.0, 1.0, 2.0, 0.0, 0.0, 1.0),
    "Skew": (0.0, -3.0, 2.0, 3.0, 0.0, -1.0, -2.0, 1.0, 0.0),
}
"""Matrices to begin with, by name."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the choice of what is shown, its fields and its numbers."""
    form = gui.form(post)

    def show(state: State) -> None:
        shown = state[Skew].shown
        chips = form.chips("shown", SHOWN, shown, "What is shown", partial(Set, Skew, "shown"))
        form.show(tag("div.cases", chips), {"split": _split, "cross": _cross, "dyads": _dyads}[shown](form, state))

    return show


def _split(form: Form, state: State) -> Inside:
    """Return the two parts of the matrix, and what each adds to the quadratic form."""
    A, x = matrix_of(state), state[Skew].x
    one, other = symmetric_part(A), skew_part(A)
    forms = [quadratic_form(each, x) for each in (A, one, other)]
    rows: list[tuple[Inside, Inside]] = [
        (mathml(r"x^TA\,x"), number(forms[0], 4)),
        ((mathml(r"x^T(A+A^T)\,x/2"), ", symmetric part"), number(forms[1], 4)),
        ((mathml(r"x^T(A-A^T)\,x/2"), ", skew part"), number(forms[2], 4) if abs(forms[2]) > 1e-9 else "0"),
    ]
    return (
        _matrix(form, state, "A"),
        tag("div.eq.small", mathml(r"A=\frac{A+A^T}{2}+\frac{A-A^T}{2}")),
        tag("div.sk-both", _part("symmetric", one), _part("skew", other)),
        tag("p", f"The skew part is S(v) with v = ({components(skew_vector(A), 3)}): three numbers describe it."),
        _vectors(form, state, "x"),
        pairs(rows),
        tag(
            "p.dim",
            "A skew matrix turns x into S x, perpendicular to x, so xᵀS x is the number 0, for every x"
            "⟦; 3.41 prints a vector⟧. Only the symmetric part counts.",
        ),
    )


def _cross(form: Form, state: State) -> Inside:
    """Return S(v), and the cross product by it and by the other vector."""
    part = state[Skew]
    found = cross_of(state)
    other = skew(part.u).T @ np.array(part.v)
    away = float(np.abs(found - np.cross(part.v, part.u)).max())
    v, u = np.array(part.v), np.array(part.u)
    rows: list[tuple[Inside, Inside]] = [
        (mathml(r"S(v)\,u=v\times u"), components(found, 3)),
        (mathml(r"S^T(u)\,v"), components(other, 3)),
        ("scalar products with v, u", f"{number(float(found @ v), 4)}, {number(float(found @ u), 4)}"),
        ("difference from v × u", scientific(away)),
    ]
    return (
        _vectors(form, state, "v", "u"),
        tag(
            "div.eq.small", mathml(r"S(v)=\left[\begin{array}{ccc}0&-v_z&v_y\\v_z&0&-v_x\\-v_y&v_x&0\end{array}\right]")
        ),
        tag(
            "div.bo-product",
            matrix(np.asarray(skew(part.v)), 3),
            matrix(u.reshape(3, 1), 3),
            "=",
            matrix(found.reshape(3, 1), 3),
        ),
        pairs(rows),
        tag(
            "p.dim",
            "It is perpendicular to both. Three dimensions only: in others there is no such vector"
            "⟦; the notes say Rⁿ, and call v × u a dot product before 3.44⟧.",
        ),
    )


def _dyads(form: Form, state: State) -> Inside:
    """Return a dyad of two columns, the sum of those of each column with itself, and what comes of it."""
    part = state[Skew]
    columns = {str(k): f"b{'₁₂₃'[k - 1]}" for k in (1, 2, 3)}
    chosen = row(
        "Dyad",
        joined(
            form.select("first", "First column", columns, str(part.first), lambda key: Set(Skew, "first", int(key))),
            " ",
            form.select(
                "second", "Second column", columns, str(part.second), lambda key: Set(Skew, "second", int(key))
            ),
        ),
    )
    name = rf"b_{part.first}\,b_{part.second}^T"
    total = sum_of(state)
    return (
        _matrix(form, state, "B", "columns b₁ b₂ b₃"),
        chosen,
        tag(
            "div.sk-both",
            _part(mathml(name), dyad_of(state)),
            _part(mathml(r"b_1b_1^T+b_2b_2^T+b_3b_3^T"), total),
        ),
        _sum_verdict(state),
        _vectors(form, state, "x"),
        _parts_of_x(state),
    )


def _sum_verdict(state: State) -> Markup:
    part = state[Skew]
    if orthonormal(state):
        mixed = part.first != part.second
        largest = float(np.abs(dyad_of(state)).max())
        told = f" They are not zero: the largest entry of this one is {number(largest, 3)}." if mixed else ""
        said = (
            "The columns are perpendicular and of length 1: B Bᵀ = I⟦, where 3.35 writes CᵀC⟧. Mixed dyads are missing "
            "because I has zeros beside its diagonal⟦, and not because they vanish⟧."
        )
        return verdict_box("ok", "The sum is I", tag("p", said, told))
    said = f"The sum is B Bᵀ, of the columns. BᵀB differs from it by up to {number(swapped(state), 3)} in an entry."
    return verdict_box("warn", "The sum is not I: B is no rotation", tag("p", said))


def _parts_of_x(state: State) -> Markup:
    """Return what each dyad b b^T makes of x: of unit vectors its projections."""
    A, x = matrix_of(state), np.array(state[Skew].x)
    rows: list[tuple[Inside, Inside]] = [
        (mathml(rf"b_{k + 1}(b_{k + 1}^Tx)"), components(A[:, k] * float(A[:, k] @ x), 3)) for k in range(3)
    ]
    rows.append(("their sum", components(sum_of(state) @ x, 3)))
    return pairs(rows)


def _matrix(form: Form, state: State, name: str, small: str = "") -> Markup:
    A = matrix_of(state)
    lines = [tag("tr", [tag("td", _entry(form, A, name, i, j)) for j in range(3)]) for i in range(3)]
    chips = [form.chip(f"place {key}", key, SetSkewMatrix(values)) for key, values in PLACES.items()]
    body = form.chip("take body", "R of the body", TakeBodyMatrix(), "The rotation of the page Forms")
    head = tag("h3", name, " ", tag("small", small), tag("span.copies", chips, body))
    return joined(head, tag("table.kit-points.bo-matrix", lines))


def _entry(form: Form, A: np.ndarray, name: str, i: int, j: int) -> Markup:
    where = f"{name} row {i + 1}, column {j + 1}"

    def taken(text: str) -> Command:
        values = typed_numbers(text, where, 9, "the matrix")
        return SetSkewMatrix(tuple(values)) if len(values) == 9 else SetSkewEntry(i, j, values[0])

    return form.field(f"A {i}{j}", readable(float(A[i, j]), 4), where, taken)


def _vectors(form: Form, state: State, *names: str) -> Markup:
    def taken(name: str, k: int, text: str) -> Command:
        return SetSkewVector(name, k, plain_number(text, f"{name} {AXES[k]}"))

    rows = [
        line(
            *[
                form.field(f"{name} {k}", readable(value, 4), f"{name} {AXES[k]}", partial(taken, name, k))
                for k, value in enumerate(getattr(state[Skew], name))
            ],
            name=name,
        )
        for name in names
    ]
    return tag("table.kit-points", head_line(None, *AXES), rows)


def _part(name: Inside, values: np.ndarray) -> Markup:
    return tag("div.bo-factor", tag("small", name), matrix(values, 3))


PANEL = Panel((Skew,), build, rebuilds=(Notation,), hides=HIDES, around=around)
