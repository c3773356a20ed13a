"""The page of atan2: a point to drag around the origin, and where atan of the quotient is wrong."""

from __future__ import annotations

from functools import partial

from armlab.benches.body.atan2.angle import CASES, POINTS, Angle, angle_of, present
from armlab.benches.body.atan2.state import DragPoint, Plane, SetCoordinate
from armlab.benches.body.atan2.ui.picture import caption, picture, place_of
from armlab.benches.body.forms.stage import around
from armlab.benches.body.forms.ui.page import HIDES
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.state import Command, Post, State
from armlab.ui.form import Form
from armlab.ui.format import mathml, readable
from armlab.ui.html import Inside, Markup, classes, tag
from armlab.ui.markup import verdict_box
from armlab.ui.plugin import Panel, Show
from armlab.ui.tables import head_line
from armlab.ui.units import Units, plain_number, units_of
from armlab.ui.widgets import Gui

NONE = "–"


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the picture, the coordinates, what both functions give, the cases, and points all around."""
    form = gui.form(post)

    def show(state: State) -> None:
        found, units = present(state), units_of(state)
        form.show(
            tag("h3", "Drag the point ", tag("small", "or type its coordinates")),
            picture(found, _label(found, units), form.place("plane", _put, drag=True)),
            caption(),
            _fields(form, state),
            verdict(found, units),
            tag("div.at-both", _cases(found), _around(form, found, units)),
            tag(
                "p.dim",
                "atan2 lies in (−π, π]⟦; the notes print (π to π or 0 to 2π)⟧. A computer's atan2 gives 0 at the "
                "origin, and −π where y is minus zero and x < 0.",
            ),
        )

    return show


def _put(across: float, down: float, drag: int) -> DragPoint:
    return DragPoint(*place_of(across, down), drag)


def _label(found: Angle, units: Units) -> str:
    both, quotient = (NONE if angle is None else units.angle(angle) for angle in (found.atan2, found.atan))
    where = f"quadrant {found.quadrant}" if found.quadrant else "an axis"
    return f"The point ({readable(found.x, 3)}, {readable(found.y, 3)}) in {where}: atan2 {both}, atan {quotient}"


def _fields(form: Form, state: State) -> Markup:
    def taken(k: int, text: str) -> Command:
        return SetCoordinate(k, plain_number(text, "xy"[k]))

    fields = [
        tag("label", f"{'xy'[k]} = ", form.field(f"point {k}", readable(value, 3), "xy"[k], partial(taken, k)))
        for k, value in enumerate(state[Plane].point)
    ]
    return tag("div.kit-numbers", fields)


def verdict(found: Angle, units: Units) -> Markup:
    """Return what both functions give, and why they differ."""
    if found.atan2 is None:
        return verdict_box("no", "The origin has no angle", tag("p", "Every direction leads away from it."))
    both = units.angle(found.atan2)
    if found.atan is None:
        said = f"The quotient y/x does not exist. atan2(y, x) = {both}."
        return verdict_box("no", "atan(y/x) has no value", tag("p", said))
    quotient = units.angle(found.atan)
    if found.right:
        return verdict_box("ok", f"Both are {both}", tag("p", "For x > 0 the quotient is enough."))
    said = (
        "The quotient of (x, y) is that of (−x, −y) as well: atan cannot tell a direction from its opposite, and gives "
        "that with x > 0."
    )
    head = f"atan2 = {both}, but atan = {quotient}"
    return verdict_box("warn", head, tag("p", said, f" It is off by {units.angle(abs(found.apart or 0.0))}."))


def _cases(found: Angle) -> Markup:
    """Return the definition, with the present case marked."""
    rows = [
        tag(classes("tr", now=k == found.case), tag("td", mathml(value)), tag("td", when))
        for k, (value, when) in enumerate(CASES)
    ]
    return tag("div", tag("h3", mathml(r"\mathrm{atan2}(y,x)=")), tag("table.kit-table.at-cases", rows))


def _around(form: Form, found: Angle, units: Units) -> Markup:
    """Return points all around, each with both angles, to go to."""
    rows = [_point(form, k, found, angle_of(x, y), units) for k, (x, y) in enumerate(POINTS)]
    heads = head_line("x, y", "atan2", "atan")
    return tag("div", tag("h3", "All around, ", units.angle_unit), tag("table.kit-table.at-around", heads, rows))


def _point(form: Form, k: int, now: Angle, each: Angle, units: Units) -> Markup:
    def text(angle: float | None) -> Inside:
        return NONE if angle is None else units.text(angle, True)

    name = f"{readable(each.x, 0)}, {readable(each.y, 0)}"
    go = form.chip(f"go {k}", name, Set(Plane, "point", [each.x, each.y]), f"Put the point at ({name})")
    wrong = classes("td", **{"at-off": not each.right})
    here = (now.x, now.y) == (each.x, each.y)
    return tag(classes("tr", now=here), tag("td", go), tag("td", text(each.atan2)), tag(wrong, text(each.atan)))


PANEL = Panel((Plane,), build, rebuilds=(Notation,), hides=HIDES, around=around)
