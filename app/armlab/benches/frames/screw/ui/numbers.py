"""The screw in numbers, each of which can be typed, what kind of motion it is, and both ways compared."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from armlab.benches.frames.chain.state import FARTHEST
from armlab.benches.frames.screw.film import Ways, part_of, ways_of
from armlab.benches.frames.screw.state import KINDS, MakeScrew, Screw
from armlab.kin.screw_motion import ScrewMotion
from armlab.session.fields import Set
from armlab.session.sizes import MOST_TURNED
from armlab.session.state import Command, State
from armlab.ui.form import Form
from armlab.ui.format import capitalised, components, number, pairs, readable
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import fold, row, unparted, verdict_box
from armlab.ui.units import Units, typed_numbers, units_of

AXES = ("x", "y", "z")

SAME = 1e-9
"""Difference of two directions up to which they are the same, and distance from the axis, metres, that is none."""

SAID = {
    "none": "Nothing moves. There is no axis to find, or any line is one.",
    "translation": "Nothing turns: the pitch is infinite, and any line in this direction would do as an axis.",
    "rotation": "The pitch is zero: nothing slides along the axis.",
    "screw": "It turns about one line and slides along it, both at an even rate.",
}
"""Notes on the kinds of motion."""

HALF = " At half a turn the opposite axis is as good: the body may turn either way about the same line."


def verdict(state: State) -> Markup:
    """Return what kind of motion it is."""
    found = state.derived(ways_of).screw
    half = HALF if found.half_turn else ""
    return verdict_box(
        "warn" if found.kind == "none" or half else "ok",
        capitalised(KINDS[found.kind]),
        tag("p", SAID[found.kind], half),
    )


def screw_form(form: Form, state: State) -> Inside:
    """Return axis, angle and distance to type; pose 2 goes where the typed screw brings pose 1."""
    found, units = state.derived(ways_of), units_of(state)
    screw = found.screw
    direction, point = _shown_direction(state, screw), found.foot
    angle, distance = screw.angle, screw.distance

    def turned(text: str) -> Command:
        typed = units.read(text, True, "angle", within=(-MOST_TURNED, MOST_TURNED))
        return MakeScrew(tuple(direction), tuple(point.tolist()), typed, distance)

    def slid(text: str) -> Command:
        typed = units.read(text, False, "distance", within=(-2.0 * FARTHEST, 2.0 * FARTHEST))
        return MakeScrew(tuple(direction), tuple(point.tolist()), angle, typed)

    def about(values: Sequence[float]) -> Command:
        return MakeScrew(tuple(values), tuple(point.tolist()), angle, distance)

    def through(k: int, value: float) -> Command:
        moved = [value if i == k else each for i, each in enumerate(point.tolist())]
        return MakeScrew(tuple(direction), tuple(moved), angle, distance)

    fields = (
        tag(
            "label",
            unparted(f"angle, {units.angle_unit} "),
            form.field("screw angle", units.entry(angle, True), "Angle about the axis", turned),
        ),
        tag(
            "label",
            unparted(f"along it, {units.length_unit} "),
            form.field("screw distance", units.entry(distance, False), "Distance along the axis", slid),
        ),
    )
    return (
        row("direction", _direction(form, direction, about), wide=True, cells=True),
        row(
            f"through, {units.length_unit}",
            [_point(form, k, float(point[k]), units, through) for k in range(3)],
            wide=True,
            cells=True,
            hint="The point of the axis that is nearest to pose 1",
        ),
        tag("div.kit-numbers", fields, tag("span", "pitch ", tag("b", _pitch(screw, units)))),
    )


def _shown_direction(state: State, screw: ScrewMotion) -> list[float]:
    """Return the direction in the length in which it was typed, if it still is that of the axis."""
    typed = np.array(state[Screw].axis)
    if screw.kind == "none" or float(np.abs(typed / np.linalg.norm(typed) - screw.direction).max()) < SAME:
        shown: list[float] = typed.tolist()
        return shown
    unit: list[float] = screw.direction.tolist()
    return unit


def _direction(form: Form, direction: list[float], about: Callable[[Sequence[float]], Command]) -> list[Markup]:
    def field(k: int) -> Markup:
        where = f"direction {AXES[k]}"

        def taken(text: str) -> Command:
            found = typed_numbers(text, where, 3, "the direction")
            return about(found if len(found) > 1 else [found[0] if i == k else d for i, d in enumerate(direction)])

        return form.field(f"screw direction {k}", readable(direction[k], 4), where, taken)

    return [field(k) for k in range(3)]


def _point(form: Form, k: int, value: float, units: Units, through: Callable[[int, float], Command]) -> Markup:
    where = f"{AXES[k]} of a point of the axis"

    def taken(text: str) -> Command:
        return through(k, units.read(text, False, where, within=(-FARTHEST, FARTHEST)))

    return form.field(f"screw point {k}", units.entry(value, False), f"{where} in {units.length_unit}", taken)


def _pitch(screw: ScrewMotion, units: Units) -> str:
    """Return the pitch for a whole turn, as makers of screws give it."""
    if screw.kind == "none":
        return "–"
    if not math.isfinite(screw.pitch):
        return "∞"
    return f"{units.length(2.0 * math.pi * screw.pitch)} a turn"


def ways_markup(form: Form, state: State) -> Inside:
    """Return the twist, and the screw beside the straight way."""
    found, part, units = state.derived(ways_of), state[Screw], units_of(state)
    chip = form.chip(
        "straight",
        "Straight way",
        Set(Screw, "straight", not part.straight),
        "The straight line with an even turn, dashed",
        part.straight,
    )
    return (
        tag("h3", "Compared with the straight path ", tag("span.copies", chip)),
        pairs(_compared(found, part_of(state), units)),
        tag("p.dim", _said(found)),
        fold("Twist", _twist(found)),
    )


def _compared(found: Ways, s: float, units: Units) -> list[tuple[Inside, Inside]]:
    apart = float(np.linalg.norm(found.at(s)[:3, 3] - found.straight(s)[:3, 3]))
    return [
        ("path of the origin on the screw", units.length(found.length)),
        ("straight path", units.length(found.chord)),
        ("distance between them now", units.length(apart)),
    ]


def _said(found: Ways) -> str:
    if found.screw.kind in ("none", "translation"):
        return "Without a rotation both paths are the same."
    if found.radius < SAME:
        return "The origin is on the axis, so that both paths are the same."
    return (
        "At every time the body has the same orientation on both paths: the angles of exp(s [S]) and of slerp grow "
        "evenly about one axis. Only the positions differ."
    )


def _twist(found: Ways) -> Inside:
    twist = found.screw.twist
    rows: list[tuple[Inside, Inside]] = [
        ("v, m", components(twist[:3])),
        ("ω, rad", components(twist[3:])),
        ("pitch, m/rad", "∞" if not math.isfinite(found.screw.pitch) else number(found.screw.pitch, 4)),
    ]
    said = (
        "[S] is the 4 × 4 matrix of the twist (v; ω) in the world: S(ω) with v beside it, and zeros below. Its matrix "
        "exponential is T₂ T₁⁻¹; with s from 0 to 1 before it, it is every pose between."
    )
    return pairs(rows), tag("p.dim", said)
