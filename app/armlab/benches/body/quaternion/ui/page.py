"""The page of quaternions: two whole turns until q is back, and the product of two of them."""

from __future__ import annotations

from functools import partial

import numpy as np

from armlab.benches.body.forms.stage import around_both
from armlab.benches.body.forms.state import Body
from armlab.benches.body.forms.ui.numbers import axis_markup
from armlab.benches.body.forms.ui.page import HIDES
from armlab.benches.body.quaternion.film import DURATION, angle_at, film_time, present, products, second
from armlab.benches.body.quaternion.state import CLIP_KEY, Quaternions, SetSecond
from armlab.kin.rotations import rotation_from_quaternion
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Command, Post, State
from armlab.ui.form import Form
from armlab.ui.format import MINUS, mathml, number, readable, scientific
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import verdict_box
from armlab.ui.playing import clock
from armlab.ui.plugin import Panel, Show
from armlab.ui.tables import head_line, line
from armlab.ui.units import plain_number, units_of
from armlab.ui.widgets import Gui

BACK = 1e-9
"""Largest difference of an entry up to which the body is back."""

PRODUCT = (
    r"p\,q=(\eta,\epsilon),\quad\eta=\eta_1\eta_2-\epsilon_1^T\epsilon_2",
    r"\epsilon=\eta_1\epsilon_2+\eta_2\epsilon_1+\epsilon_1\times\epsilon_2",
)
"""The product of p = (eta_1, epsilon_1) and q = (eta_2, epsilon_2), which would be too wide for one line."""

COMPONENTS = ("w", "x", "y", "z")


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the axis, the clock, the quaternion at present, the second one, and both products."""
    form = gui.form(post)

    def show(state: State) -> None:
        form.show(
            axis_markup(form, state),
            tag("h3", "Two whole turns about r"),
            clock(form, state, CLIP_KEY, DURATION),
            cover_markup(state),
            tag("h3", "Product"),
            tag("div.eq.small", mathml(PRODUCT[0]), tag("br"), mathml(PRODUCT[1])),
            _second(form, state),
            product_markup(state),
        )

    return show


def cover_markup(state: State) -> Markup:
    """Return the angle, the quaternion of half of it, and what has come back."""
    units, angle, q = units_of(state), angle_at(film_time(state)), present(state)
    said = f"θ = {units.angle(angle)}, θ/2 = {units.angle(0.5 * angle)}"
    rows = [line(*_numbers(each), name=name) for name, each in (("q", q), (f"{MINUS}q", -q))]
    table = tag("table.kit-points.bo-angles", head_line(None, *COMPONENTS), rows)
    return joined(tag("p", said), table, _back(q))


def _back(q: np.ndarray) -> Markup:
    if np.abs(rotation_from_quaternion(q) - np.eye(3)).max() > BACK:
        return tag(
            "p.dim", f"q = (cos θ/2, r sin θ/2). R(q) = R({MINUS}q), since every term of R has two factors of q."
        )
    if q[0] < 0.0:
        return verdict_box(
            "warn", f"The body is back, q is not: q = {MINUS}1", tag("p", "It takes another whole turn.")
        )
    return verdict_box("ok", "Body and quaternion are as at the start", tag("p", "q = 1 after two whole turns."))


def _numbers(values: np.ndarray) -> list[str]:
    return [number(float(value), 4) for value in values]


def _second(form: Form, state: State) -> Markup:
    def taken(k: int, text: str) -> Command:
        return SetSecond(k, plain_number(text, f"p {COMPONENTS[k]}"))

    fields = [
        form.field(f"p {k}", readable(value, 4), f"p {COMPONENTS[k]}", partial(taken, k))
        for k, value in enumerate(state[Quaternions].p)
    ]
    return tag("table.kit-points", head_line(None, *COMPONENTS), line(*fields, name="p"))


def product_markup(state: State) -> Inside:
    """Return the products in both orders, and how far they are from those of the matrices."""
    p, q, (one, other) = second(state), present(state), products(state)
    R = [np.asarray(rotation_from_quaternion(each)) for each in (p, q, one)]
    away = float(np.abs(R[0] @ R[1] - R[2]).max())
    apart = float(np.abs(one - other).max())
    rows = [line(*_numbers(each), name=name) for name, each in (("p/|p|", p), ("p q", one), ("q p", other))]
    order = "Here both orders are the same." if apart < BACK else "The order matters, as of matrices."
    said = f"R(p) R(q) = R(p q): the largest difference of an entry is {scientific(away)}. {order}"
    return tag("table.kit-points.bo-angles", head_line(None, *COMPONENTS), rows), tag("p", said)


PANEL = Panel((Body, Quaternions, Timeline), build, rebuilds=(Notation,), hides=HIDES, around=around_both)
