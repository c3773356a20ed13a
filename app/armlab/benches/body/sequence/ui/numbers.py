"""The products of elementary rotations of both bodies, step by step, and how their ends compare."""

from __future__ import annotations

from armlab.benches.body.forms.state import Body
from armlab.benches.body.forms.timing import DURATION, step_at
from armlab.benches.body.forms.ui.rings import COLOURS
from armlab.benches.body.forms.ui.steps import factor
from armlab.benches.body.forms.ui.words import LETTERS, turn_names
from armlab.benches.body.sequence.film import Turns, apart, difference, turns_of
from armlab.benches.body.sequence.state import Sequence, film_time
from armlab.kin.euler import angle_symbols
from armlab.session.state import State
from armlab.ui.colours import css
from armlab.ui.factors import elementary, turns
from armlab.ui.format import dot, scientific
from armlab.ui.html import Markup, classes, joined, tag
from armlab.ui.markup import verdict_box
from armlab.ui.units import Units, units_of

ALIKE = 1e-9
"""Angle between the bodies, radians, up to which they stand alike."""

SAID = {
    False: "About an axis of the body: the new turn is post-multiplied, it stands on the right.",
    True: "About an axis of the base: the new turn is pre-multiplied, it stands on the left.",
}


def products_markup(state: State) -> Markup:
    """Return both bodies beside each other: their turns, and the product up to the present one."""
    part, units, time = state[Body], units_of(state), film_time(state)
    letters = [LETTERS[symbol] for symbol in angle_symbols(part.axes, part.fixed)]
    columns = [tag("div", _list(one, time, letters, units), _steps(one, time, units)) for one in turns_of(state)]
    return tag("div.sq-both", columns)


def _list(one: Turns, time: float, letters: list[str], units: Units) -> Markup:
    """Return the turns in the order in which they are made; the present one is marked."""
    names, now = turn_names(one.axes, one.fixed), step_at(time)
    rows = []
    for k, place in enumerate(one.places):
        text = f"{letters[place]} = {units.angle(float(one.angles[k]))} about {names[k]}"
        rows.append(tag(classes("tr", now=k == now), tag("td", f"{k + 1} ", dot(css(COLOURS[place]))), tag("td", text)))
    return joined(tag("h3", "Fixed axes" if one.fixed else "Moving axes"), tag("table.kit-table.sq-turns", rows))


def _steps(one: Turns, time: float, units: Units) -> Markup:
    """Return the present turn times what was made before, in the order of the product, and what comes of it."""
    k = step_at(time)
    angles = [units.angle(float(angle)) for angle in one.angles_at(time)]
    before = factor(tag("span", "after turn ", str(k)) if k else "at the start", one.after(k))
    new = factor(joined("turn ", str(k + 1), ": ", elementary("R", one.axes[k], angles[k])), one.turn(k, time), True)
    first, second = (new, before) if one.fixed else (before, new)
    product = turns(one.axes[: k + 1], one.fixed, angles[: k + 1])
    return joined(
        first,
        second,
        factor("= R", one.at(time)),
        tag("p.sq-product", "R = ", product),
        tag("p.dim", SAID[one.fixed]),
    )


def ends_markup(state: State) -> Markup:
    """Return how far the bodies are from each other, and at the end why."""
    units, time = units_of(state), film_time(state)
    one, other = turns_of(state)
    here, there = one.at(time), other.at(time)
    angle, reverse = apart(here, there), state[Sequence].order == "reverse"
    if time < DURATION:
        told = "stand alike here" if angle < ALIKE else f"are {units.angle(angle)} apart at present"
        return tag("p", f"The bodies {told}.")
    if angle >= ALIKE:
        why = "The same turns in the same order: about fixed axes they make another rotation than about moving ones."
        return verdict_box("warn", f"The bodies end {units.angle(angle)} apart", tag("p", why))
    why = (
        "The same product, made from its two ends⟦ (theorem 2)⟧. "
        if reverse
        else "The same order happens to make the same product here. "
    )
    digits = f"The largest difference of an entry is {scientific(difference(here, there))}."
    return verdict_box("ok", "The bodies end alike", tag("p", why, digits))
