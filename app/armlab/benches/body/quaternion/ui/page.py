"""The page of quaternions: two whole turns until q is back, the algebra of two, R to q, and the way between two."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from armlab.benches.body.forms.commands import SetBodyTurn, SetWholeAxis, SetWholeQuaternion
from armlab.benches.body.forms.stage import around, around_both
from armlab.benches.body.forms.state import Body, Four
from armlab.benches.body.forms.ui.numbers import axis_markup, quaternion_markup
from armlab.benches.body.forms.ui.page import HIDES
from armlab.benches.body.quaternion.between import film_share
from armlab.benches.body.quaternion.film import DURATION, angle_at, film_time, present, products, second
from armlab.benches.body.quaternion.state import CLIP_KEY, Quaternions, SetSecond
from armlab.benches.body.quaternion.state_view import SHOWN, QuaternionView
from armlab.benches.body.quaternion.ui.algebra import COMPONENTS, from_matrix_markup, inverse_markup, numbers
from armlab.benches.body.quaternion.ui.way import Speeds, way_markup
from armlab.kin.rotations import rotation_from_quaternion
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Command, Post, State
from armlab.ui.form import Form
from armlab.ui.format import MINUS, mathml, readable, scientific
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import verdict_box
from armlab.ui.playing import clock
from armlab.ui.plugin import Panel, Points, Show
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

TURNS: dict[str, tuple[str, tuple[Command, ...]]] = {
    "third": ("120° about (1,1,1)", (SetWholeAxis((1.0, 1.0, 1.0)), SetBodyTurn(2.0 * math.pi / 3.0))),
    "half": ("180° about (1,2,2)", (SetWholeQuaternion((0.0, 1.0, 2.0, 2.0)),)),
    "nearly": ("nearly 180°", (SetWholeAxis((1.0, 2.0, 2.0)), SetBodyTurn(math.pi - 1e-8))),
}
"""Rotations to begin with, by key: title and commands; half a turn has a matrix that is symmetric to the last digit."""

ENDS: dict[str, tuple[str, Four, Four]] = {
    "wander": ("wandering", (0.242, -0.664, 0.123, 0.696), (-0.414, -0.61, -0.291, 0.61)),
    "far": ("p·q < 0", (1.0, 0.0, 0.0, 0.0), (-0.5, 0.5, 0.5, 0.5)),
    "half": ("half a turn", (1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 2.0, 2.0)),
    "same": ("q = −p", (0.9, 0.1, -0.3, 0.3), (-0.9, -0.1, 0.3, -0.3)),
}
"""Pairs of orientations to begin with, by key: title, p and q."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the choice of what is shown, its fields and its numbers, and the plot of the ways."""
    form = gui.form(post)
    plot = Speeds(gui, state)

    def show(state: State) -> None:
        shown = state[QuaternionView].shown
        chips = form.chips("shown", SHOWN, shown, "What is shown", partial(Set, QuaternionView, "shown"))
        form.show(tag("div.cases", chips), VIEWS[shown](form, state))
        plot.show(state, film_share(state), shown == "way")

    return show


def _cover(form: Form, state: State) -> Inside:
    """Return the axis, the film of two whole turns, and q beside its opposite."""
    return (
        axis_markup(form, state),
        tag("h3", "Two whole turns about r"),
        clock(form, state, CLIP_KEY, DURATION, film_time(state)),
        cover_markup(state),
    )


def _algebra(form: Form, state: State) -> Inside:
    """Return both quaternions to type, their products, inverses and logarithms."""
    return (
        quaternion_markup(form, state),
        _second(form, state),
        tag("h3", "Product"),
        tag("div.eq.small", mathml(PRODUCT[0]), tag("br"), mathml(PRODUCT[1])),
        product_markup(state),
        inverse_markup(state),
    )


def _from_matrix(form: Form, state: State) -> Inside:
    """Return rotations to begin with, axis and angle, and the quaternion of R by three methods."""
    chips = [form.chip(f"turn {key}", title, commands) for key, (title, commands) in TURNS.items()]
    return tag("div.cases", chips), axis_markup(form, state), from_matrix_markup(state)


def _way(form: Form, state: State) -> Inside:
    """Return both orientations to type, and the ways between them."""
    chips = [
        form.chip(f"ends {key}", title, (Set(Quaternions, "p", p), SetWholeQuaternion(q)))
        for key, (title, p, q) in ENDS.items()
    ]
    return tag("div.cases", chips), _second(form, state), quaternion_markup(form, state), way_markup(form, state)


VIEWS = {"cover": _cover, "algebra": _algebra, "matrix": _from_matrix, "way": _way}


def cover_markup(state: State) -> Markup:
    """Return the angle, the quaternion of half of it, and what has come back."""
    units, angle, q = units_of(state), angle_at(film_time(state)), present(state)
    said = f"θ = {units.angle(angle)}, θ/2 = {units.angle(0.5 * angle)}"
    rows = [line(*numbers(each), name=name) for name, each in (("q", q), (f"{MINUS}q", -q))]
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
    rows = [line(*numbers(each), name=name) for name, each in (("p/|p|", p), ("p q", one), ("q p", other))]
    order = "Here both orders are the same." if apart < BACK else "The order matters, as of matrices."
    said = f"R(p) R(q) = R(p q): the largest difference of an entry is {scientific(away)}. {order}"
    return tag("table.kit-points.bo-angles", head_line(None, *COMPONENTS), rows), tag("p", said)


def _around(state: State) -> Points:
    """Return what belongs in the picture: one body on the way, or two."""
    return around(state) if state[QuaternionView].shown == "way" else around_both(state)


PANEL = Panel(
    (Body, Quaternions, QuaternionView, Timeline),
    build,
    rebuilds=(Notation,),
    hides=HIDES,
    around=_around,
    looks=lambda state: state[QuaternionView].shown == "way",
)
