"""Turning: three angles and their rates against the angular velocity, and why omega cannot be integrated."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from armlab.benches.motion.api import sphere_of
from armlab.benches.velocity.speeds.state import Velocity
from armlab.benches.velocity.turning.commands import LookAtTurning, SetTurning, TakeToolAngles, WriteAngles
from armlab.benches.velocity.turning.motion import film_time, laws_time, turned_of
from armlab.benches.velocity.turning.state import CLIP_KEY, MATRIX, Turning
from armlab.benches.velocity.turning.ui.numbers import (
    columns_markup,
    columns_of,
    form_markup,
    laws_markup,
    rates_markup,
    small_markup,
    tool_markup,
    views_markup,
)
from armlab.kin.velocity.rates import rate_determinant
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.selection import Selection
from armlab.session.parts.timeline import OpenClip, Play, Timeline
from armlab.session.state import Command, Post, State
from armlab.ui.colours import BLUE
from armlab.ui.fields import Fields
from armlab.ui.format import mathml, number
from armlab.ui.markup import button
from armlab.ui.matrices import MatrixView
from armlab.ui.plot import Curve, Plot
from armlab.ui.plugin import Panel, Points, Show
from armlab.ui.tried import tried
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

ROWS = tuple(f"ω<sub>{axis}</sub>" for axis in "xyz")

TITLE = f"{mathml('T')} <small>columns are the axes of the turns, in the fixed axes</small>"

HEIGHT = 100
POINTS = 181


class _Second:
    """det T over the second angle, with a cursor where it is."""

    def __init__(self, gui: Gui, state: State) -> None:
        units = units_of(state)
        self._factor = units.factor(True)
        name = f"second angle, {units.angle_unit}"
        self._plot = Plot(gui, "det T over the second angle", name, [Curve("det T", BLUE)], "det_T", height=HEIGHT)
        self._shown: tuple[str, bool] | None = None

    def show(self, state: State) -> None:
        """Show the curve of the sequence; only the cursor follows the angle."""
        part = state[Turning]
        self._plot.visible(part.shown == "angles")
        if part.shown != "angles":
            return
        if self._shown != (part.axes, part.fixed):
            self._shown = part.axes, part.fixed
            middle = np.linspace(-math.pi, math.pi, POINTS)
            angles = np.stack([np.zeros(POINTS), middle, np.zeros(POINTS)], axis=1)
            self._plot.show(middle / self._factor, [rate_determinant(angles, part.axes, part.fixed)])
        now = float(state.derived(turned_of).angles[1])
        self._plot.cursor(math.remainder(now, 2.0 * math.pi) / self._factor)


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the form, T, the numbers, the plot, and the two laws."""
    present = state

    def typed(fields: Fields, cell: str, text: str) -> None:
        if not tried(fields, cell, text, lambda: commands(present, cell, text), present, post):
            show(present)

    top = gui.fields(lambda cell, text: typed(top, cell, text))
    form = gui.fields(lambda cell, text: typed(form, cell, text))
    matrix = MatrixView(gui, post, MATRIX)
    numbers = gui.html()
    plot = _Second(gui, state)
    rest = gui.html()

    def show(state: State) -> None:
        nonlocal present
        present = state
        angles = state[Turning].shown == "angles"
        top.show(views_markup(top, state) + _clock(top, state))
        form.show(form_markup(form, state) if angles else "")
        matrix.visible(angles)
        if angles:
            matrix.show(
                state,
                TITLE,
                state.derived(turned_of).T,
                3,
                None,
                columns_of(state),
                ROWS,
            )
        numbers.show(columns_markup(state) + rates_markup(state) if angles else "")
        plot.show(state)
        rest.show(tool_markup(state) if angles else laws_markup(state) + small_markup())

    return show


def _clock(fields: Fields, state: State) -> str:
    """Return what plays, and the time of what is shown."""
    timeline = state[Timeline]
    on = timeline.clip == CLIP_KEY
    cell, text = ("pause", "❚❚ Pause") if on and timeline.playing else ("play", "▶ Turn")
    play = button(fields.channel_id, cell, text, "main", "The body beside the arm turns")
    time = laws_time(state) if state[Turning].shown == "laws" else film_time(state)
    return f'<div class="bar">{play}<span class="dim">t = {number(time, 2)} s</span></div>'


def commands(state: State, cell: str, text: str) -> tuple[Command, ...]:
    """Return what a person asked for; none for what no page of ours sends.

    Raises
    ------
    InputError
        What was typed is no angle; the text names the field.
    """
    name, _, rest = cell.partition(" ")
    if name in ("angles", "rates"):
        if rest not in ("0", "1", "2"):
            return ()
        where = f"{'angle' if name == 'angles' else 'rate'} {int(rest) + 1}"
        return (SetTurning(name, int(rest), units_of(state).read(text, True, where)),)
    simple: dict[str, Callable[[], tuple[Command, ...]]] = {
        "shown": lambda: (LookAtTurning(rest),),
        "play": lambda: (Play(True),) if state[Timeline].clip == CLIP_KEY else (OpenClip(CLIP_KEY, play=True),),
        "pause": lambda: (Play(False),),
        "axes": lambda: (WriteAngles(axes=text),) if text else (),
        "about": lambda: (WriteAngles(fixed=rest == "fixed"),),
        "tool": lambda: (TakeToolAngles(),),
    }
    return simple[name]() if name in simple else ()


def _around(state: State) -> Points:
    """Return a box around the body beside the arm."""
    centre, radius = sphere_of(state)
    return np.asarray(centre + radius * np.array([[1.0, 1, 1], [-1, -1, -1]]))


PANEL = Panel((Turning, Timeline, Selection, Joints, Velocity), build, rebuilds=(Notation,), around=_around)
