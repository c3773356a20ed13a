"""The page of a point in three kinds of coordinates: each to type, the way between them, and where angles fail."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import numpy as np

from armlab.benches.frames.chain.stage import box_of
from armlab.benches.frames.chain.ui.page import HIDES
from armlab.benches.frames.coordinates.examples import EXAMPLES, ChoosePointExample
from armlab.benches.frames.coordinates.state import (
    SHOWN,
    Coordinates,
    SetCartesian,
    SetCylindrical,
    SetSpherical,
    Where,
    where_of,
)
from armlab.benches.frames.coordinates.ui.colours import COLOURS
from armlab.benches.frames.coordinates.ui.quadrants import quadrants
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.state import Command, Post, State
from armlab.ui.colours import css
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import dot, mathml
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import verdict_box
from armlab.ui.plugin import Panel, Points, Show
from armlab.ui.tables import head_line, line
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

LETTERS = {"theta": "θ", "phi": "φ"}

ANGLES = ("theta", "phi")

BEYOND = "; beyond a pole it is θ that differs by half a turn"
"""End of the sentence on an angle from the z axis that names no point."""

SAME = 1e-9
"""Difference of two angles, radians, up to which they are the same."""

EQUATIONS = (
    r"r=\sqrt{x^2+y^2},\quad\theta=\mathrm{atan2}(y,x),\quad h=z",
    r"r=\sqrt{x^2+y^2+z^2},\quad\varphi=\mathrm{atan2}(\sqrt{x^2+y^2},\,z)",
)

BACK = (
    r"x=r\cos\theta,\quad y=r\sin\theta,\quad z=h",
    r"x=r\sin\varphi\cos\theta,\quad y=r\sin\varphi\sin\theta,\quad z=r\cos\varphi",
)


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the fields of all coordinates, their equations, the quadrants, and what is not defined."""
    form = gui.form(post)

    def show(state: State) -> None:
        part, found, units = state[Coordinates], state.derived(where_of), units_of(state)
        chips = form.chips("shown", SHOWN, part.shown, "What is drawn", partial(Set, Coordinates, "shown"))
        form.show(
            examples(form, EXAMPLES, part.example, ChoosePointExample, said=units.said),
            tag("h3", "One point, three kinds of coordinates"),
            _fields(form, found, units),
            tag("div.bar", tag("span.dim", "drawn in the scene "), chips),
            _singular(found),
            _equations(part.shown),
            _azimuth(found, units),
        )

    return show


def _fields(form: Form, found: Where, units: Units) -> Markup:
    """Return the fields of all coordinates, each below its letter, its colour in the scene and its unit."""
    x, y, z = found.p.tolist()
    kinds: tuple[tuple[str, dict[str, float], Callable[[str, float], Command]], ...] = (
        ("Cartesian", {"x": x, "y": y, "z": z}, lambda name, value: SetCartesian("xyz".index(name), value)),
        ("cylindrical", {"r": found.r, "theta": found.theta, "h": found.h}, SetCylindrical),
        ("spherical", {"r": found.R, "theta": found.theta, "phi": found.phi}, SetSpherical),
    )
    rows = []
    for kind, values, action in kinds:
        heads = [(dot(css(COLOURS[name])) if name in COLOURS else None, _head(name, units)) for name in values]
        cells = [_field(form, kind, name, value, units, action) for name, value in values.items()]
        rows += [head_line(None, *heads), line(*cells, name=kind)]
    return tag("table.kit-points.fr-coordinates", rows)


def _head(name: str, units: Units) -> str:
    return f"{LETTERS.get(name, name)}, {units.unit(name in ANGLES)}"


def _field(
    form: Form, kind: str, name: str, value: float, units: Units, action: Callable[[str, float], Command]
) -> Markup:
    turns, letter = name in ANGLES, LETTERS.get(name, name)

    def taken(text: str) -> Command:
        if name == "phi":
            return action(name, units.read(text, True, letter, within=(0.0, math.pi), why=BEYOND))
        return action(name, units.read(text, turns, letter))

    return form.field(f"{kind.lower()} {name}", units.entry(value, turns), f"{letter}, {kind}", taken)


def _singular(found: Where) -> Markup | None:
    """Return what is not defined where the point is."""
    if found.at_origin:
        return verdict_box(
            "warn",
            "At the origin neither θ nor φ is defined",
            tag("p", "With r = 0 all angles name the same point. The fields keep the last ones."),
        )
    if found.on_axis:
        return verdict_box(
            "warn",
            "On the z axis θ is not defined",
            tag("p", "Every θ names this point⟦; 3.15 leaves atan2(0, 0) undefined⟧. The field keeps the last one."),
        )
    return None


def _equations(shown: str) -> Markup:
    k = list(SHOWN).index(shown)
    return tag("div.eq.small", mathml(EQUATIONS[k]), tag("br"), mathml(BACK[k]))


def _azimuth(found: Where, units: Units) -> Inside:
    """Return the azimuth by atan2 beside that by atan, with a picture of the quadrants."""
    if found.on_axis:
        return None
    x, y, _ = found.p.tolist()
    by_atan = found.by_atan
    told = "– (x = 0)" if by_atan is None else units.angle(by_atan)
    off = by_atan is None or abs(by_atan - found.theta) > SAME
    said = (
        "They agree: x is positive, the point lies in the first or the fourth quadrant."
        if not off
        else "atan gets the quotient only, in which the signs are lost: it is off by half a turn."
        if by_atan is not None
        else "atan would divide by zero: the point lies above or below the y axis."
    )
    return (
        tag("h3", "The azimuth θ, seen from above"),
        tag(
            "div.fr-azimuth",
            quadrants(x, y, found.theta, by_atan, f"atan2 gives {units.angle(found.theta)}, atan {told}"),
            tag(
                "div",
                tag("p", "atan2(y, x) = ", tag("b", units.orientation(found.theta))),
                tag("p", "atan(y / x) = ", tag("b", told)),
                tag("p.dim", said),
            ),
        ),
        tag("p.dim", RANGE),
    )


RANGE = (
    "atan2 gives angles above −180° and up to 180°⟦; the text before 3.15 prints “(π to π or 0 to 2π)”⟧. Across the "
    "negative x axis it jumps by a whole turn."
)


def around(state: State) -> Points:
    """Return the corners (2, 3) of what belongs in the picture."""
    p = state.derived(where_of).p
    size = max(float(np.linalg.norm(p)), 0.3)
    low, high = -0.5 * size * np.ones(3), size * np.ones(3)
    return box_of(np.array([low, high, p]), 0.1 * size)


def looks(state: State) -> tuple[str, int]:
    """Return what there is to look at: another example, or a point twice as far away."""
    size = max(float(np.linalg.norm(state.derived(where_of).p)), 0.3)
    return state[Coordinates].example, round(math.log2(size))


PANEL = Panel((Coordinates,), build, rebuilds=(Notation,), hides=HIDES, around=around, looks=looks)
