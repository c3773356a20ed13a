"""The film of the table: the four factors of a row, one after the other, and their growing product."""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray

from armlab.benches.robot.film.clip import (
    CLIP,
    Place,
    end_of,
    has_tool,
    place_of,
    row_product,
    running_product,
    start_of,
)
from armlab.benches.robot.film.ui.scene import COLOURS, amount, symbol
from armlab.kin.arm import Arm
from armlab.kin.dh import Row
from armlab.kin.moves import MOVES, Factors, Move, factors
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import OpenClip, Seek, Timeline
from armlab.session.state import Post, State
from armlab.ui.colours import css
from armlab.ui.form import Form, Pressed
from armlab.ui.format import mathml, matrix, number
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import row
from armlab.ui.matrices import copy_buttons
from armlab.ui.playing import SPACE
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import NAMES, Units, units_of
from armlab.ui.widgets import Gui

DONE = 1e-9
"""Rounding of the share of a move below which the move is complete."""

INTRODUCTION = (
    "Each row of the table is four moves of a frame: a turn and a shift along z, a shift and a turn along x. The film "
    "makes them one by one, from frame 0 to the tool."
)

SIGNS = {"turn": "↻", "shift": "→"}


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the choice of rows, the factors and the products, and open the film."""
    head, matrices = gui.form(post), gui.html()
    if not state[Timeline].clip:
        post(OpenClip(CLIP.key))

    def show(state: State) -> None:
        on = state[Timeline].clip == CLIP.key
        head.show(_head(head, state) if on else _invitation(head))
        matrices.show(_matrices(state) if on else None)

    return show


def _to_row(arm: Arm, row: int) -> Seek:
    return Seek(start_of(arm, row))


def _to_move(arm: Arm, row: int, move: int) -> Seek:
    return Seek(end_of(arm, row, move))


def _invitation(form: Form) -> Inside:
    hint = "Space shows the film, and then plays it"
    show = form.button("show", "▶ Show the film", OpenClip(CLIP.key), "main", hint, data_key=SPACE)
    return tag("p.dim", INTRODUCTION), show


# -- the row ---------------------------------------------------------------------------------------------------------


def _head(form: Form, state: State) -> Inside:
    """Return the choice of rows, and the formula of the present one."""
    joints, place, units = state[Joints], place_of(state), units_of(state)
    names = [str(i + 1) for i in range(joints.arm.n)] + (["E"] if has_tool(joints.arm) else [])
    chips = [
        form.chip(str(i), name, partial(_to_row, joints.arm, i), _hint(name), i == place.row)
        for i, name in enumerate(names)
    ]
    rows = row("Row", chips)
    if place.row == joints.arm.n:
        return rows, tag("h3", f"From frame {{{place.row}}} to the tool {{E}}")
    done = state.derived(_done)
    name = mathml(_matrix_name(state, place.row))
    title = tag("h3", f"From frame {{{place.row}}} to frame {{{place.row + 1}}}: ", name, " =")
    pills = [
        _pill(
            form,
            k,
            move,
            partial(_to_move, joints.arm, place.row, k),
            place,
            symbol(units, move.symbol, place.row, joints.arm.convention),
        )
        for k, move in enumerate(done.moves)
    ]
    line = _sentence(joints.arm.rows[place.row], float(joints.q[place.row]), done, place, units, state)
    return rows, title, tag("div.film", pills), line


def _hint(name: str) -> str:
    return "To the start of the step to the tool" if name == "E" else f"To the start of row {name}"


def _pill(form: Form, k: int, move: Move, to_it: Pressed, place: Place, letter: str) -> Markup:
    when = _when(k, place)
    what = f"{NAMES[move.symbol]}: {'turn about' if move.kind == 'turn' else 'shift along'} {move.axis}"
    return form.button(
        f"{place.row},{k}",
        _factor(move, letter),
        to_it,
        when,
        what,
        style=f"--c:{css(COLOURS[move.symbol])}",
        aria_current="true" if when == "now" else "",
    )


def _when(k: int, place: Place) -> str:
    return "now" if k == place.move else ("past" if k < place.move else "next")


def _factor(move: Move, letter: str) -> Markup:
    """Return the name of an elementary move, such as R_z(θ₁)."""
    return joined("R" if move.kind == "turn" else "T", tag("sub", move.axis), f"({letter})")


def _sentence(row: Row, q: float, done: Factors, place: Place, units: Units, state: State) -> Markup:
    """Return a sentence on the present move, its size, and its progress."""
    move, convention = done.moves[place.move], state[Joints].arm.convention
    letter = symbol(units, move.symbol, place.row, convention)
    turns = move.kind == "turn"
    whole = f"{letter} = {amount(units, move)}"
    if move.variable:
        offset = row.theta if turns else row.d
        value = units.angle if turns else units.length
        name = units.variable(place.row, turns)
        parts = [name if name != letter else value(q)]
        if offset:
            parts.append(f"{'−' if offset < 0.0 else '+'} {value(abs(offset))}")
        if parts != [value(q)]:
            whole = f"{letter} = {' '.join(parts)} = {amount(units, move)}"
    gone = place.part * move.amount
    so_far = units.angle(gone) if turns else units.length(gone)
    verb = "turn about" if turns else "shift along"
    colour = css(COLOURS[move.symbol])
    return tag(
        "div.film-line",
        tag("i", SIGNS[move.kind], style=f"background:{colour}"),
        tag("span", f"{NAMES[move.symbol]}, {verb} {move.axis}", tag("br"), tag("b", whole)),
        tag("span", "so far", tag("br"), so_far),
    )


# -- the matrices ----------------------------------------------------------------------------------------------------


def _done(state: State) -> Factors:
    joints, place = state[Joints], place_of(state)
    return factors(joints.arm, joints.q, place.row, place.progress)


def _matrix_name(state: State, row: int) -> str:
    """Return the matrix of a row in LaTeX: A_i of a standard table, the transform between frames of a modified one."""
    if state[Joints].arm.convention == "standard":
        return f"A_{{{row + 1}}}"
    return f"{{}}^{{{row}}}T_{{{row + 1}}}"


def _matrices(state: State) -> Inside:
    place = place_of(state)
    return _small_factors(state, place), _products(state, place)


def _small_factors(state: State, place: Place) -> Markup | None:
    """Return the four factors two by two; one that has not begun is the identity, in grey."""
    if place.row == state[Joints].arm.n:
        return None
    done, units = state.derived(_done), units_of(state)
    cells = []
    for k, (move, factor) in enumerate(zip(done.moves, done.matrices, strict=True)):
        letter = symbol(units, move.symbol, place.row, state[Joints].arm.convention)
        colour = f"--c:{css(COLOURS[move.symbol])}"
        name = tag("span", _factor(move, letter))
        cells.append(tag(f"div.{_when(k, place)}", name, _small(factor), style=colour))
    return tag("div.factors", cells)


def _small(values: NDArray[np.float64]) -> Markup:
    def cell(value: float) -> Markup:
        if abs(value) < 5e-4:
            return tag("td.zero", "0")
        return tag("td", "1" if value == 1.0 else number(value, 3))

    return tag("table.mat", [tag("tr", [cell(float(value)) for value in line]) for line in values])


def _products(state: State, place: Place) -> Inside:
    """Return the product of the present row so far, and that of all rows so far."""
    arm, i = state[Joints].arm, place.row
    if i == arm.n:
        over = place.part >= 1.0 - DONE
        name, whole = f"{{}}^{{{i}}}T_{{E}}", "{}^{0}T_{E}"
        step = state.derived(row_product)
    else:
        over = place.progress >= MOVES - DONE
        name, whole = _matrix_name(state, i), f"{{}}^{{0}}T_{{{i + 1}}}"
        step = state.derived(_done).product
    before = f"{{}}^{{0}}T_{{{i}}}"
    titles: tuple[Inside, Inside] = "Product so far", (mathml(before), " × product so far")
    if over:
        titles = mathml(name), mathml(f"{whole}={before}\\,{name}")
    return _titled(titles[0], step), _titled(titles[1], state.derived(running_product))


def _titled(title: Inside, values: NDArray[np.float64]) -> Inside:
    return tag("h3", title, tag("span.copies", copy_buttons(values))), matrix(values, 3, rule=3)


PANEL = Panel(
    (RobotPart, Joints, Timeline, Notation), build, rebuilds=(), see_through=True, hides=("gizmo", "gap", "names")
)
