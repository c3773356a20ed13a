"""The page of two rotations in both orders: how far apart they end, and how that falls with their size."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from armlab.benches.body.forms.stage import around_both
from armlab.benches.body.forms.ui.page import HIDES
from armlab.benches.body.forms.ui.steps import factor, steps_bar
from armlab.benches.body.order.examples import EXAMPLES, ChooseOrderExample, example_of
from armlab.benches.body.order.facts import SAME
from armlab.benches.body.order.film import Ends, curves, ends_of, pairs_of
from armlab.benches.body.order.state import (
    ABOUT,
    CLIP_KEY,
    ENDS,
    MOST_TURNED,
    NAMES,
    Order,
    ScaleAngles,
    SetOrderAngle,
    SetOrderAxis,
    ShowRotation,
    film_time,
)
from armlab.benches.body.order.ui.scene import COLOURS
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Command, Post, State
from armlab.ui.colours import BLUE, GREEN, VERMILLION, css
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import dot, mathml, number, pairs, readable, scientific
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import row, verdict_box
from armlab.ui.plot import Curve, Plot
from armlab.ui.plugin import Panel, Show
from armlab.ui.tables import head_line, line
from armlab.ui.units import plain_number, units_of
from armlab.ui.widgets import Gui

HEIGHT = 130

SMALL = 1e-3
"""Angle, radians, below which it is written with a power of ten."""

SECOND_ORDER = (0.5, 1.1)
"""Bounds of the angle between the ends, in that of the rule of second order, between which the rule holds nearly."""

CURVES = (
    Curve("between the ends", VERMILLION, width=3.0),
    Curve("θa θb |a × b|", BLUE, dash=(7, 5)),
    Curve("beyond I + S(dφ)", GREEN, dash=(2, 6)),
)

PRODUCTS = {"base": (r"R_b\,R_a", r"R_a\,R_b"), "body": (r"R_a\,R_b", r"R_b\,R_a")}
"""Products of the orders a, b and b, a in LaTeX, by whose axes are turned about."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the two rotations, the film, both products, the angle between them, and the plot."""
    form, numbers = gui.form(post), gui.html()
    title = joined("log₁₀ of what is left ", tag("small", "rad, and entry of R"))
    plot = Plot(gui, title, "log₁₀ of the larger angle, rad", CURVES, "order", height=HEIGHT)
    drawn: Order | None = None

    def show(state: State) -> None:
        nonlocal drawn
        form.show(
            examples(form, EXAMPLES, example_of(state), ChooseOrderExample, said=units_of(state).said),
            rotations_markup(form, state),
            steps_bar(form, state, CLIP_KEY, "rotation", ShowRotation, ENDS),
        )
        numbers.show(products_markup(state), ends_markup(state))
        part = state[Order]
        if part != drawn:
            drawn = part
            powers, *found = curves(part)
            plot.show(powers, found)
            largest = ends_of(state).largest
            plot.cursor(math.log10(largest) if largest else None)

    return show


def rotations_markup(form: Form, state: State) -> Markup:
    """Return angle and axis of both rotations, whose axes they are, and what makes both angles smaller or larger."""
    part, units = state[Order], units_of(state)
    heads = head_line(None, f"θ, {units.angle_unit}", "x", "y", "z")
    rows = [
        line(_angle(form, state, k), *_axis(form, state, k), name=tag("span.or-name", dot(css(COLOURS[k])), name))
        for k, name in enumerate(NAMES)
    ]
    about = form.chips("about", ABOUT, part.about, "About which axes is turned", partial(Set, Order, "about"))
    sizes = [
        form.chip("size down", "÷ 10", ScaleAngles(0.1), "Divide both angles by ten"),
        form.chip("size up", "× 10", ScaleAngles(10.0), "Multiply both angles by ten"),
    ]
    return joined(
        tag("table.kit-points.bo-angles", heads, rows),
        row("About", about),
        row("Angles", sizes),
    )


def _angle(form: Form, state: State, k: int) -> Markup:
    units = units_of(state)

    def taken(text: str) -> Command:
        return SetOrderAngle(k, units.read(text, True, f"angle {NAMES[k]}", within=(-MOST_TURNED, MOST_TURNED)))

    shown = readable(state[Order].angles[k] / units.factor(True), 3)
    return form.field(f"angle {k}", shown, f"Angle of rotation {NAMES[k]}", taken)


def _axis(form: Form, state: State, k: int) -> list[Markup]:
    values = (state[Order].a, state[Order].b)[k]

    def taken(index: int, text: str) -> Command:
        return SetOrderAxis(k, index, plain_number(text, f"{NAMES[k]} {'xyz'[index]}"))

    return [
        form.field(f"axis{k} {index}", readable(value, 4), f"{NAMES[k]} {'xyz'[index]}", partial(taken, index))
        for index, value in enumerate(values)
    ]


def products_markup(state: State) -> Markup:
    """Return both products as far as they are made."""
    time, named = film_time(state), PRODUCTS[state[Order].about]
    columns = []
    for pair, product in zip(pairs_of(state), named, strict=True):
        first, second = (NAMES[k] for k in pair.order)
        columns.append(factor((f"{first}, then {second}: ", mathml(product)), pair.at(time)))
    return tag("div.or-both", columns)


def ends_markup(state: State) -> Inside:
    """Return how far apart the ends are, beside the rule of second order."""
    found = ends_of(state)
    ratio = number(found.apart / found.rule, 3) if found.rule > 0.0 else "–"
    rows: list[tuple[Inside, Inside]] = [
        ("angle between the ends", angle_text(found.apart, state)),
        ((mathml(r"\theta_a\theta_b|a\times b|"), f"; the angle is {ratio} of it"), angle_text(found.rule, state)),
        ("largest difference of an entry from I + S(dφ)", scientific(found.beyond, 2)),
    ]
    if found.apart < SAME:
        box = verdict_box("ok", "Both orders end alike", tag("p", _alike(state)))
    else:
        box = verdict_box(
            "warn", joined("The ends are ", angle_text(found.apart, state), " apart"), tag("p", _counts(found))
        )
    return pairs(rows), box


def _counts(found: Ends) -> str:
    """Return what is left of the angle between the ends as the angles fall: a hundredth only where the rule holds."""
    low, high = SECOND_ORDER
    if low < found.apart / found.rule < high:
        falls = "a tenth of the angles leaves about a hundredth of this."
    else:
        falls = "where the angles are small, a tenth of them leaves about a hundredth between the ends."
    return f"The order counts, by terms of second order: {falls} Displacements end alike in either order."


def _alike(state: State) -> str:
    part, found = state[Order], ends_of(state)
    if found.largest < 1e-4 and min(map(abs, part.angles)) > 0.0 and found.rule > 0.0:
        return "The angle between the ends is too small to be told from rounding in a matrix."
    if min(map(abs, part.angles)) == 0.0:
        return "One of the rotations is none."
    cross = np.linalg.norm(np.cross(part.a, part.b))
    if cross < 1e-9 * math.hypot(*part.a) * math.hypot(*part.b):
        return "Both axes are one line, so the angles add in either order."
    return "These two happen to commute: half turns about perpendicular axes, or whole turns."


def angle_text(value: float, state: State) -> Markup:
    """Return an angle in the unit on screen, or in radians with a power of ten when it is small."""
    units = units_of(state)
    return tag("span.or-name", f"{scientific(value, 2)} rad" if value < SMALL else units.angle(value))


PANEL = Panel((Order, Timeline), build, rebuilds=(Notation,), hides=HIDES, around=around_both)
