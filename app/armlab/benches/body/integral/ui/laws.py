"""The fields of both time laws: for each piece its axis, its rate and its duration."""

from __future__ import annotations

from functools import partial

from armlab.benches.body.integral.film import film_time, runs_of
from armlab.benches.body.integral.state import (
    MOST_PIECES,
    RATE,
    SECONDS,
    AddPiece,
    Integral,
    Law,
    RemovePiece,
    ReverseLaw,
    SetPiece,
)
from armlab.benches.body.integral.ui.scene import COLOURS
from armlab.session.state import Command, State
from armlab.ui.colours import css
from armlab.ui.form import Form
from armlab.ui.format import dot, readable
from armlab.ui.html import Markup, classes, joined, tag
from armlab.ui.tables import head_line
from armlab.ui.units import Units, plain_number, units_of


def laws_markup(form: Form, state: State) -> Markup:
    """Return the pieces of both laws."""
    units, time = units_of(state), film_time(state)
    return joined(
        [
            _law(form, k, law, run.piece_at(time), units)
            for k, (law, run) in enumerate(zip(state[Integral].laws, runs_of(state), strict=True))
        ]
    )


def _law(form: Form, k: int, law: Law, now: int, units: Units) -> Markup:
    full = len(law) >= MOST_PIECES
    add = form.chip(f"add {k}", "+ piece", AddPiece(k), "One more piece at the end", off=full)
    other = form.chip(f"reverse {k}", f"law {2 - k} reversed", ReverseLaw(k), "The pieces of the other law, last first")
    head = tag("h3", dot(css(COLOURS[k])), f"Law {k + 1}", tag("span.copies", add, other))
    names = head_line("axis x", "y", "z", f"{units.angle_unit}/s", "s", None)
    rows = [_piece(form, k, index, law, now, units) for index in range(len(law))]
    return joined(head, tag("table.kit-points.in-law", names, rows))


def _piece(form: Form, k: int, index: int, law: Law, now: int, units: Units) -> Markup:
    piece, where = law[index], f"law {k + 1}, piece {index + 1}"

    def number(what: int, text: str) -> Command:
        name = f"{where}, {'xyz'[what]}" if what < RATE else f"{where}, duration"
        value = plain_number(text, name, "a number" if what < RATE else "seconds")
        return SetPiece(k, index, what, value)

    def rate(text: str) -> Command:
        return SetPiece(k, index, RATE, units.read(text, True, f"{where}, rate", "/s"))

    fields = [
        form.field(
            f"axis{k} {index} {what}", readable(piece[what], 4), f"{where}, axis {'xyz'[what]}", partial(number, what)
        )
        for what in range(RATE)
    ]
    shown = readable(piece.rate / units.factor(True), 3)
    fields.append(form.field(f"rate{k} {index}", shown, f"{where}, rate", rate))
    shown = readable(piece.seconds, 3)
    fields.append(form.field(f"seconds{k} {index}", shown, f"{where}, duration", partial(number, SECONDS)))
    remove = form.button(
        f"remove{k} {index}",
        "×",
        RemovePiece(k, index),
        "chip",
        "Remove the piece",
        f"Remove {where}",
        off=len(law) == 1,
    )
    return tag(classes("tr", now=index == now), [tag("td", each) for each in (*fields, remove)])
