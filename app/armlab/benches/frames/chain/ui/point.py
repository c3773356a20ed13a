"""The point in all frames, its change of coordinates between the two of the pair, and what that takes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.frames.chain.point import GivePointIn, SetPointCoordinate
from armlab.benches.frames.chain.state import FARTHEST, WORLD, Chain
from armlab.benches.frames.chain.tree import counts_of, pair_of, points_of
from armlab.benches.frames.chain.ui.colours import FROM_FRAME, ORIGINS
from armlab.benches.frames.chain.ui.symbols import point_name, transform_name
from armlab.kin.operations import COSTS, Count, worth_multiplying
from armlab.session.fields import Set
from armlab.session.state import Command, State
from armlab.ui.colours import INK, css
from armlab.ui.form import Form
from armlab.ui.format import EN_SPACE, dot
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import fold
from armlab.ui.switches import DARK
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units, plain_number, units_of

Floats = NDArray[np.float64]

AXES = ("x", "y", "z")

KINDS = {"rotation": "rotations, 3 × 3", "transform": "transforms", "whole": "4 × 4, all entries"}

NOTES = (
    "⟦The text before 3.109 says that the matrix leads from A to B; the equation itself is right: it leads from B to "
    "A. 3.112 is printed with three rows: the product has four numbers, of which the last stays 1. 3.6 and 3.7 print "
    "RF, a frame, where its rotation matrix R is meant.⟧"
)


def point_markup(form: Form, state: State) -> Inside:
    """Return the point in all frames, and its change of coordinates in numbers."""
    part, units = state[Chain], units_of(state)
    heads = head_line(f"p, {units.length_unit}", *AXES)
    rows = [_row(form, part, name, p, units) for name, p in state.derived(points_of).items()]
    shown = (("steps", "Components", "Components along the axes of both frames, as steps"), ("globe", "Globe", GLOBE))
    chips = [
        form.chip(key, text, Set(Chain, key, not getattr(part, key)), hint, getattr(part, key))
        for key, text, hint in shown
    ]
    return (
        tag("h3", "A point in all frames ", tag("span.copies", chips)),
        tag("table.kit-points.fr-points", heads, rows),
        _change(state),
        tag("p.dim", NOTES),
    )


GLOBE = "A globe about the frame in which the point is given, with the point on it"


def _row(form: Form, part: Chain, name: str, p: Floats, units: Units) -> Markup:
    given = name == part.given
    where = "the world" if name == WORLD else name
    hint = f"The point is given in {where} and moves with it" if given else f"Give the point in {where}, where it is"
    chip = form.chip(f"given {name}", name, GivePointIn(name), hint, given)
    if not given:
        return line(*[units.text(float(value), False) for value in p], name=chip)

    def field(k: int) -> Markup:
        def taken(text: str) -> Command:
            return SetPointCoordinate(k, units.read(text, False, AXES[k], within=(-FARTHEST, FARTHEST)))

        label = f"{AXES[k]} of the point in {where}, in {units.length_unit}"
        return form.field(f"point {k}", units.entry(float(p[k]), False), label, taken)

    return line(*[field(k) for k in range(3)], name=chip)


def _change(state: State) -> Markup:
    """Return 3.109 for the pair, in symbols and numbers, with the colours of the arrows in the scene."""
    part, units, points = state[Chain], units_of(state), state.derived(points_of)
    i, j = part.reference, part.frame
    T = state.derived(pair_of).T
    shift, turned = T[:3, 3], T[:3, :3] @ points[j]
    rows = (
        (dot(css(INK[DARK.on(state)])), point_name(i), points[i], "from the origin of the reference to the point"),
        (
            dot(css(ORIGINS)),
            tag("span", "= ", tag("sup", i), "p", tag("sub", f"{i}{j}")),
            shift,
            "from origin to origin",
        ),
        (
            dot(css(FROM_FRAME)),
            tag("span", "+ ", transform_name(i, j, "R"), " ", point_name(j)),
            turned,
            "from the frame to it",
        ),
    )
    lines = [
        tag("tr", tag("th", colour, name), [tag("td", units.text(float(value), False)) for value in values], title=hint)
        for colour, name, values, hint in rows
    ]
    return tag("table.kit-points.fr-change", lines)


def counts_markup(form: Form, state: State) -> Markup:
    """Return what it takes to change the coordinates of points along the chain, folded."""
    found, part = state.derived(counts_of), state[Chain]

    def taken(text: str) -> Command:
        value = plain_number(text, "points", "a whole number of points")
        return Set(Chain, "count", int(value) if float(value).is_integer() else value)

    if found is None:
        return fold("Operations", tag("p.dim", "Both frames are the same: there is nothing to calculate."))
    matrices = "1 matrix" if found.steps == 1 else f"{found.steps} matrices"
    field = form.field("count", str(part.count), "Number of points", taken)
    return fold(
        "Operations",
        tag("div.kit-numbers", tag("label", "points ", field), tag("span", f"through {matrices}")),
        tag(
            "table.kit-points",
            head_line("products / sums", "multiplied first", "one by one"),
            [_counted(kind, found.first[kind], found.each[kind]) for kind in COSTS],
        ),
        tag("p.dim", _said(found.steps)),
    )


def _counted(kind: str, first: Count, each: Count) -> Markup:
    texts = [_both(count, count.products < other.products) for count, other in ((first, each), (each, first))]
    return line(*texts, name=KINDS[kind])


def _both(count: Count, fewer: bool) -> Markup:
    text = f"{count.products}{EN_SPACE}/{EN_SPACE}{count.sums}"
    return tag("b", text, title="fewer products") if fewer else joined(text)


def _said(steps: int) -> str:
    if steps == 1:
        return "With one matrix there is nothing to multiply first."
    enough = [worth_multiplying(kind) for kind in ("rotation", "transform")]
    return (
        f"Multiplying the matrices first takes fewer products from {enough[0]} points on for rotations, and from "
        f"{enough[1]} on for transforms, however long the chain is. The smaller number of products is bold. The last "
        "row of transforms is not calculated."
    )
