"""Two lines to drag, and the common normal that defines a and alpha of the table."""

from __future__ import annotations

import math

import numpy as np

from armlab.benches.robot.normal.state import (
    SNAP_ANGLE,
    SNAP_DISTANCE,
    HandleLines,
    KeepLines,
    Lines,
    PlaceLines,
    TakeAxes,
    table_entry,
)
from armlab.benches.robot.normal.ui.scene import COLOURS
from armlab.kin.lines import CommonNormal
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Post, State
from armlab.ui.colours import css
from armlab.ui.form import Form
from armlab.ui.format import dot, mathml, number, pairs, subscript
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import verdict_box
from armlab.ui.plugin import OF_THE_ARM, Panel, Show
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

CASES = {"skew": "Skew", "parallel": "Parallel", "intersecting": "Intersecting", "coincident": "Coincident"}
OWN = "own"
SAME = 1e-9
"""Difference, m and rad, up to which the table and the lines agree."""

DIRECTION = r"n=z_1\times z_2,\quad x=\pm\frac{n}{|n|}"
LENGTH = r"a=(p_2-p_1)\cdot x"
TWIST = r"\alpha=\mathrm{atan2}\big((z_1\times z_2)\cdot x,\;z_1\cdot z_2\big)"
NO_CROSS = {
    "parallel": "x is taken perpendicular to both lines, from the first to the second.",
    "coincident": "x is any direction perpendicular to the line; here one is chosen.",
}
"""Sentences on the direction of x if the cross product is zero."""

FOOT = r"f_1=p_1+\frac{\big((p_2-p_1)\times z_2\big)\cdot n}{|n|^2}\,z_1"


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the cases, the axes of the arm, and the numbers."""
    units, n = units_of(state), state[Joints].arm.n
    gui.heading("Two lines")
    cases = gui.form(post)
    handle = gui.segments(
        "Handles",
        {"move": "Move", "turn": "Turn"},
        state[Lines].handle,
        lambda key: post(HandleLines(key)),
        "What dragging a line does; close to a special case it snaps to it",
    )
    axes = None
    if n > 1:
        axes = gui.dropdown(
            "Axes of arm",
            {OWN: "my own lines", **{str(i): _pair(i, state) for i in range(n - 1)}},
            _chosen(state),
            lambda key: post(KeepLines() if key == OWN else TakeAxes(int(key))),
            "Two neighbouring joint axes take the place of the lines; a and α are then those of the DH table.",
        )
    card, numbers, table = gui.html(), gui.html(), gui.html()
    gui.html(_formulas())
    products = gui.html()

    def show(state: State) -> None:
        lines = state[Lines]
        cases.show(_cases(cases, lines.normal.kind))
        handle.show(lines.handle)
        if axes is not None:
            axes.show(_chosen(state))
        card.show(_card(lines, units))
        numbers.show(_numbers(lines, units))
        table.show(_table(state, units))
        products.show(_products(lines))

    return show


def _cases(form: Form, kind: str) -> Markup:
    hint = "Bring the lines into this position"
    chips = [form.chip(key, text, PlaceLines(key), hint, key == kind) for key, text in CASES.items()]
    return tag("div.cases", chips)


def _pair(i: int, state: State) -> str:
    shift = 0 if state[Joints].arm.convention == "standard" else 1
    return f"joints {i + 1} and {i + 2}: {subscript('z', i + shift)}, {subscript('z', i + 1 + shift)}"


def _chosen(state: State) -> str:
    pair = state[Lines].pair
    return OWN if pair is None else str(pair)


def _card(lines: Lines, units: Units) -> Markup:
    normal = lines.normal
    kind = "ok" if normal.kind == "skew" else "warn"
    near = f"{units.angle(SNAP_ANGLE)} or {units.length(SNAP_DISTANCE * lines.scale)}"
    snapped = f" Snapped: the line was within {near} of it." if lines.snapped else ""
    return verdict_box(kind, CASES[normal.kind], f"{normal.free}{snapped}")


def _numbers(lines: Lines, units: Units) -> Markup:
    normal, unit = lines.normal, f", {units.length_unit}"
    rows: list[tuple[Inside, Inside]] = [
        (("length of the normal ", mathml("a")), tag("b", units.length(normal.a))),
        (("twist ", mathml(r"\alpha"), " about x"), tag("b", units.angle(normal.alpha))),
    ]
    for k, line in enumerate((lines.first, lines.second)):
        rows.append(((dot(css(COLOURS[k])), mathml(f"z_{k + 1}")), _vector(line.direction, 3)))
    rows += [
        (("x of the normal ", mathml("x")), _vector(normal.normal, 3)),
        (("foot ", mathml("f_1"), unit), _point(normal.foot1, units)),
        (("foot ", mathml("f_2"), unit), _point(normal.foot2, units)),
    ]
    return pairs(rows)


def _vector(values: object, decimals: int) -> str:
    return "\u2002".join(number(float(value), decimals) for value in values)  # type: ignore[attr-defined]


def _point(point: object, units: Units) -> str:
    return "\u2002".join(units.text(float(value), False) for value in point)  # type: ignore[attr-defined]


def _table(state: State, units: Units) -> Inside:
    """Return the entries of the table for the chosen axes, and why they may differ in sign."""
    entry = table_entry(state)
    if entry is None:
        return None
    row, a, alpha = entry
    modified = state[RobotPart].robot.arm.convention == "modified"
    index = row if modified else row + 1
    twist = f"{units.latex('alpha')}_{{{index}}}"
    values = [
        ((mathml(f"a_{{{index}}}"), " of the table"), units.constant(a, False)),
        ((mathml(twist), " of the table"), units.constant(alpha, True)),
    ]
    agreement = tag("p", _agreement(state[Lines].normal, a, alpha))
    return tag("h3", f"Row {row + 1} of the table"), pairs(values), agreement


def _agreement(normal: CommonNormal, a: float, alpha: float) -> str:
    """Return a sentence that compares a and alpha of the table with those of the normal."""
    if abs(normal.a - a) < SAME and _turned(normal.alpha - alpha) < SAME:
        return "They agree with those of the normal."
    free = "the direction of x is free" if normal.kind != "skew" else "a may be negative"
    return f"The same normal with x reversed ({free}): both change sign."


def _turned(angle: float) -> float:
    return abs(math.remainder(angle, 2.0 * math.pi))


def _formulas() -> Inside:
    lines = [
        tag("div.eq.small", mathml(latex), title=hint)
        for latex, hint in (
            (DIRECTION, "x from the first line to the second; lines as p + v t⟦, notes 4.8 and 4.9⟧"),
            (LENGTH, "Distance of the lines along x⟦; notes, definition 6⟧"),
            (TWIST, "Right in all quadrants⟦; notes, definition 7⟧"),
            (FOOT, "The foot on the first line; that on the second is found in the same way"),
        )
    ]
    return tag("h3", "How they are found"), lines


def _products(lines: Lines) -> Inside:
    """Return the products in the formulas, in numbers."""
    z1, z2, normal = lines.first.direction, lines.second.direction, lines.normal
    rows = [
        (mathml("z_1\\cdot z_2"), number(float(z1 @ z2), 4)),
        (mathml(r"(z_1\times z_2)\cdot x"), number(float(np.cross(z1, z2) @ normal.normal), 4)),
    ]
    taken = NO_CROSS.get(normal.kind)
    return pairs(rows), tag("p.dim", mathml("n=0"), f": {taken}") if taken else None


def in_the_way(state: State) -> tuple[str, ...]:
    """Return the layers of the arm while the lines belong to the student, because they run through it."""
    return OF_THE_ARM if state[Lines].pair is None else ()


PANEL = Panel((Lines, Joints, RobotPart), build, see_through=True, hides=("gizmo", "gap"), hides_then=in_the_way)
