"""The velocity loop of one mass: block diagram, velocities over time, and the frequency response."""

from __future__ import annotations

import math

import numpy as np

from armlab.benches.control.loop.examples import EXAMPLES, ChooseLoopExample
from armlab.benches.control.loop.state import CLIP_KEY, FIELDS, KINDS, ChooseLoopReference, Loop, SetLoop, present_time
from armlab.benches.control.loop.ui.pictures import ERROR, REACHED, WISH, bode, diagram
from armlab.content.arithmetic import evaluate
from armlab.errors import InputError
from armlab.session.amounts import amount
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import OpenClip, Play, Seek, Timeline
from armlab.session.state import Command, State
from armlab.ui.colours import GREY
from armlab.ui.examples import examples_markup
from armlab.ui.format import escaped, mathml, number, pairs
from armlab.ui.markup import button, chips, row
from armlab.ui.option_form import option_markup, option_value
from armlab.ui.plot import TIME, Curve, Plot
from armlab.ui.plugin import Panel, Post, Show
from armlab.ui.tried import tried
from armlab.ui.units import Units, units_of
from armlab.ui.verdicts import SIGNS
from armlab.ui.widgets import Fields, Gui

VELOCITIES, ERRORS = "v_d,\\;v", "e=v_d-v"
RESPONSE = r"W(s)=1/(\frac{M}{K}s+1)"
GAIN, PHASE, ERROR_GAIN = r"|W(j\omega)|", r"W(j\omega)", r"|1-W(j\omega)|"

WISHED = "v<sub>d</sub>"

FOLLOWS, FAILS = 0.05, 0.5
"""Parts of the wish below which the lasting error is small, and from which the loop is said not to follow."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make example, diagram, numbers, plots and the frequency response."""
    present, units = state, units_of(state)

    def typed(fields: Fields, cell: str, text: str) -> None:
        if not tried(fields, cell, text, lambda: commands(present, cell, text), present, post):
            show(present)

    head = gui.fields(lambda cell, text: typed(head, cell, text))
    drawn = gui.html()
    form = gui.fields(lambda cell, text: typed(form, cell, text))
    clock = gui.fields(lambda cell, text: typed(clock, cell, text))
    plots, verdict = _Plots(gui), gui.html()
    gui.heading(f"Frequency response {mathml(RESPONSE)}")
    response = gui.html()

    def show(state: State) -> None:
        nonlocal present
        present = state
        part = state[Loop]
        head.show(_head(head, part))
        drawn.show(diagram(part, present_time(state)))
        form.show(_form(form, part))
        clock.show(_clock(clock, state))
        plots.show(state)
        verdict.show(_verdict(part, units))
        response.show(bode(part, units) + _numbers(part, units))

    return show


class _Plots:
    """Velocities and error over time."""

    def __init__(self, gui: Gui) -> None:
        wish, v = Curve("v_d, m/s", WISH, dash=(6, 4)), Curve("v, m/s", REACHED)
        self._v = Plot(
            gui, f"<span>{mathml(VELOCITIES)} (dashed: wanted), m/s</span>", "t, s", [wish, v], "velocity", legend=False
        )
        lasting = [Curve(f"lasting amplitude {sign}, m/s", GREY, 1.2, dash=(3, 3)) for sign in ("above", "below")]
        name = f"<span>{mathml(ERRORS)}, m/s (grey: what stays)</span>"
        self._e = Plot(gui, name, "t, s", [Curve("e, m/s", ERROR), *lasting], "velocity_error", legend=False)
        self._shown: Loop | None = None

    def show(self, state: State) -> None:
        """Show the curves when they are others, and the cursor while the film is on."""
        part = state[Loop]
        if part != self._shown:
            self._shown = part
            t, wish = part.times, part.reference
            v = part.loop.velocity(t, wish, part.v0)
            self._v.show(t, [wish.at(t), v])
            level = np.full(len(t), part.loop.steady_error(wish))
            self._e.show(t, [wish.at(t) - v, level, -level])
        on = state[Timeline].clip == CLIP_KEY
        for plot in (self._v, self._e):
            plot.cursor(TIME if on else None)


def _written(says: str) -> str:
    return escaped(says).replace("v_d", WISHED)


def _head(fields: Fields, part: Loop) -> str:
    examples = examples_markup(fields.channel_id, EXAMPLES, part.example, written=_written)
    formula = mathml(r"M\,\dot v=F,\quad F=K\,(v_d-v)")
    title = "A mass without friction whose velocity is controlled by a force; notes 7.3-7.10"
    return f'{examples}<div class="eq small" title="{title}">&emsp;{formula}</div>'


def _form(fields: Fields, part: Loop) -> str:
    kinds = chips(
        fields.channel_id,
        {f"kind {key}": text for key, text in KINDS.items()},
        f"kind {part.kind}",
        "What velocity is wanted from t = 0 on",
    )
    given = option_markup(fields, "l-", part.fields, part.values)
    return f'{row("Wanted", kinds, wide=True)}<div class="options loop-form">{given}</div>'


def _clock(fields: Fields, state: State) -> str:
    playing = state[Timeline].clip == CLIP_KEY and state[Timeline].playing
    cell, text = ("pause-loop", "❚❚ Pause") if playing else ("play-loop", "▶ Play")
    play = button(fields.channel_id, cell, text, "main")
    time = fields.field("time", amount(present_time(state)), "Time in seconds")
    end = amount(state[Loop].end, "s")
    return f'<div class="bar kit-clock">{play}<label>t = {time} <i>of {end}</i></label></div>'


def _verdict(part: Loop, units: Units) -> str:
    """Return what stays of the error, and why."""
    if part.kind == "step":
        loop = part.loop
        left = math.exp(-loop.cutoff * part.end)
        body = (
            f"The error falls to 37 % in each M/K = {amount(loop.time_constant, 's')}; after {amount(part.end, 's')} "
            f"{amount(100.0 * left)} % of the first one are left."
        )
        return _card("ok", "The error dies out", body)
    share, error = float(part.loop.error_gain(part.omega)), part.loop.steady_error(part.reference)
    kind = "ok" if share < FOLLOWS else "warn" if share < FAILS else "no"
    head = f"Error that stays: {amount(error, 'm/s')}, {number(100.0 * share, 1)} % of v_d"
    phase = -float(part.loop.phase(part.omega))
    body = (
        f"v has {number(100.0 * float(part.loop.closed_gain(part.omega)), 1)} % of the amplitude of v_d and comes "
        f"{units.angle(phase)}, {amount(1e3 * phase / part.omega, 'ms')}, later."
    )
    return _card(kind, head, body)


def _card(kind: str, head: str, body: str) -> str:
    text = f'<div class="verdict {kind}"><b>{SIGNS[kind]} {escaped(head)}</b>{escaped(body)}</div>'
    return text.replace("v_d", WISHED)


def _numbers(part: Loop, units: Units) -> str:
    loop = part.loop
    rows = [
        (f"Cutoff {mathml('K/M')}", f"{amount(loop.cutoff, 'rad/s')} = {amount(loop.cutoff / (2.0 * math.pi), 'Hz')}"),
        (f"Time constant {mathml('M/K')}", amount(loop.time_constant, "s")),
    ]
    if part.kind == "sine":
        gain = float(loop.closed_gain(part.omega))
        rows += [
            (f"Gain {mathml(GAIN)}", f"{number(gain, 3)} = {number(20.0 * math.log10(gain), 2)} dB"),
            (f"Phase of {mathml(PHASE)}", units.angle(float(loop.phase(part.omega)))),
            (f"Error gain {mathml(ERROR_GAIN)}", number(float(loop.error_gain(part.omega)), 3)),
        ]
    return pairs(rows)


def commands(state: State, cell: str, text: str) -> tuple[Command, ...]:
    """Return what a person asked for.

    Raises
    ------
    InputError
        Not a number; the text names the field.
    """
    if cell == "example":
        return (ChooseLoopExample(text),) if text else ()
    if cell == "play-loop":
        return (Play(True),) if state[Timeline].clip == CLIP_KEY else (OpenClip(CLIP_KEY, play=True),)
    if cell == "pause-loop":
        return (Play(False),)
    if cell == "time":
        return _to_time(state, text)
    what, _, key = cell.partition(" ")
    if what == "kind":
        return (ChooseLoopReference(key),)
    prefix, _, name = cell.partition("-")
    if prefix == "l" and name in FIELDS:
        return (SetLoop(name, option_value(FIELDS[name], text)),)
    return ()


def _to_time(state: State, text: str) -> tuple[Command, ...]:
    try:
        time = evaluate(text.strip().replace("−", "-").replace(",", "."))
    except InputError:
        raise InputError(f"t: expected seconds, got {text.strip()[:40]!r}") from None
    end = state[Loop].end
    if not 0.0 <= time <= end:
        raise InputError(f"t: expected 0 to {amount(end, 's')}, got {amount(time)}")
    on = () if state[Timeline].clip == CLIP_KEY else (OpenClip(CLIP_KEY),)
    return (*on, Seek(time))


PANEL = Panel((Loop, Timeline), build, rebuilds=(Notation,))
