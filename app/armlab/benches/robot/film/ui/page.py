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
from armlab.ui.matrices import copy_buttons
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import NAMES, Units, units_of
from armlab.ui.widgets import Gui

DONE = 1e-9
"""Part of a move that is as good as the whole."""

SIGNS = {"turn": "↻", "shift": "→"}


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the rows to choose from, the factors and the products; put the film on."""
    head, matrices = gui.form(post), gui.html()
    if not state[Timeline].clip:
        post(OpenClip(CLIP.key))

    def show(state: State) -> None:
        on = state[Timeline].clip == CLIP.key
        head.show(_head(head, state) if on else _invitation(head))
        matrices.show(_matrices(state) if on else "")

    return show


def _to_row(arm: Arm, row: int) -> Seek:
    return Seek(start_of(arm, row))


def _to_move(arm: Arm, row: int, move: int) -> Seek:
    return Seek(end_of(arm, row, move))


def _invitation(form: Form) -> str:
    return (
        '<p class="dim">Each row of the table is four moves of a frame: a turn and a shift along z, a shift and a turn'
        " along x. The film makes them one by one, from frame 0 to the tool.</p>"
        + form.button("show", "▶ Show the film", OpenClip(CLIP.key), "main")
    )


# -- the row ---------------------------------------------------------------------------------------------------------


def _head(form: Form, state: State) -> str:
    """Return the rows to choose from, and the formula of the present one."""
    joints, place, units = state[Joints], place_of(state), units_of(state)
    names = [str(i + 1) for i in range(joints.arm.n)] + (["E"] if has_tool(joints.arm) else [])
    chips = "".join(
        form.chip(str(i), name, partial(_to_row, joints.arm, i), _hint(name), i == place.row)
        for i, name in enumerate(names)
    )
    rows = f'<div class="row"><span>Row</span><div>{chips}</div></div>'
    if place.row == joints.arm.n:
        return f"{rows}<h3>From frame {{{place.row}}} to the tool {{E}}</h3>"
    done = state.derived(_done)
    title = f"<h3>From frame {{{place.row}}} to frame {{{place.row + 1}}}: {mathml(_matrix_name(state, place.row))} ="
    pills = "".join(
        _pill(
            form,
            k,
            move,
            partial(_to_move, joints.arm, place.row, k),
            place,
            symbol(units, move.symbol, place.row, joints.arm.convention),
        )
        for k, move in enumerate(done.moves)
    )
    line = _sentence(joints.arm.rows[place.row], float(joints.q[place.row]), done, place, units, state)
    return f'{rows}{title}</h3><div class="film">{pills}</div>{line}'


def _hint(name: str) -> str:
    return "To the start of the step to the tool" if name == "E" else f"To the start of row {name}"


def _pill(form: Form, k: int, move: Move, to_it: Pressed, place: Place, letter: str) -> str:
    kind = "R" if move.kind == "turn" else "T"
    when = "now" if k == place.move else ("past" if k < place.move else "next")
    what = f"{NAMES[move.symbol]}: {'turn about' if move.kind == 'turn' else 'shift along'} {move.axis}"
    return form.button(
        f"{place.row},{k}",
        f"{kind}<sub>{move.axis}</sub>({letter})",
        to_it,
        when,
        what,
        style=f"--c:{css(COLOURS[move.symbol])}",
        aria_current="true" if when == "now" else "",
    )


def _sentence(row: Row, q: float, done: Factors, place: Place, units: Units, state: State) -> str:
    """Return what the present move is, how far it goes, and how far it has gone."""
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
    return (
        f'<div class="film-line"><i style="background:{colour}">{SIGNS[move.kind]}</i><span>{NAMES[move.symbol]},'
        f" {verb} {move.axis}<br><b>{whole}</b></span><span>so far<br>{so_far}</span></div>"
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


def _matrices(state: State) -> str:
    place = place_of(state)
    return _small_factors(state, place) + _products(state, place)


def _small_factors(state: State, place: Place) -> str:
    """Return the four factors two by two; one that has not begun is the identity, pale."""
    if place.row == state[Joints].arm.n:
        return ""
    done, units = state.derived(_done), units_of(state)
    cells = []
    for k, (move, factor) in enumerate(zip(done.moves, done.matrices, strict=True)):
        letter = symbol(units, move.symbol, place.row, state[Joints].arm.convention)
        when = "now" if k == place.move else ("past" if k < place.move else "next")
        name = f"{'R' if move.kind == 'turn' else 'T'}<sub>{move.axis}</sub>({letter})"
        cells.append(
            f'<div class="{when}" style="--c:{css(COLOURS[move.symbol])}"><span>{name}</span>{_small(factor)}</div>'
        )
    return f'<div class="factors">{"".join(cells)}</div>'


def _small(values: NDArray[np.float64]) -> str:
    def cell(value: float) -> str:
        if abs(value) < 5e-4:
            return '<td class="zero">0</td>'
        return f"<td>{'1' if value == 1.0 else number(value, 3)}</td>"

    rows = ("".join(cell(float(value)) for value in row) for row in values)
    return f'<table class="mat">{"".join(f"<tr>{row}</tr>" for row in rows)}</table>'


def _products(state: State, place: Place) -> str:
    """Return the product of the row so far, and that of all rows so far."""
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
    titles = ("Product so far", f"{mathml(before)} × product so far")
    if over:
        titles = (mathml(name), mathml(f"{whole}={before}\\,{name}"))
    return _titled(titles[0], step) + _titled(titles[1], state.derived(running_product))


def _titled(title: str, values: NDArray[np.float64]) -> str:
    return f'<h3>{title}<span class="copies">{copy_buttons(values)}</span></h3>{matrix(values, 3, rule=3)}'


PANEL = Panel(
    (RobotPart, Joints, Timeline, Notation), build, rebuilds=(), see_through=True, hides=("gizmo", "gap", "names")
)
