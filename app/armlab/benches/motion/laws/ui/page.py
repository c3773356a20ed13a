"""Timing laws side by side: s and its derivatives, peaks and classes, time scaling, and bounds on a path."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from armlab.benches.motion.laws.bounds import FIELDS, joint_paths
from armlab.benches.motion.laws.clip import present_time
from armlab.benches.motion.laws.commands import (
    AddLaw,
    AsFastAsAllowed,
    ChooseBoundPath,
    ChooseLaw,
    LeaveAsTyped,
    LowerSpeed,
    RemoveLaw,
    SetBound,
    SetBoundOption,
    SetLawOption,
    SetQuantity,
    ShowBounds,
    Stretch,
    StretchLaw,
    StretchOptimally,
    TakeBounds,
)
from armlab.benches.motion.laws.examples import ChooseLawExample
from armlab.benches.motion.laws.state import CLIP_KEY, Laws
from armlab.benches.motion.laws.timing import QUANTITIES
from armlab.benches.motion.laws.ui.form import form_markup, head_markup, scaling_markup
from armlab.benches.motion.laws.ui.plots import Plots, race_markup
from armlab.benches.motion.laws.ui.tables import bounds_markup, stretch_markup, values_markup
from armlab.content.arithmetic import evaluate
from armlab.errors import InputError
from armlab.kin.field import Field
from armlab.kin.motion import free_law_types
from armlab.session.amounts import amount
from armlab.session.parts.timeline import OpenClip, Play, Seek, Timeline
from armlab.session.state import Command, Post, State
from armlab.ui.fields import Fields
from armlab.ui.markup import button
from armlab.ui.option_form import option_value
from armlab.ui.plugin import Panel, Show
from armlab.ui.tried import tried
from armlab.ui.widgets import Gui

SLOWEST, FASTEST, STEP = 5.0, 0.1, 0.005
"""Ends and step of the slider of k."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make form, plots, tables, the slider of k and the calculator."""
    present = state

    def typed(fields: Fields, cell: str, text: str) -> None:
        if not tried(fields, cell, text, lambda: commands(present, cell, text), present, post):
            show(present)

    head = gui.fields(lambda cell, text: typed(head, cell, text))
    bounds = gui.fields(lambda cell, text: typed(bounds, cell, text))
    form = gui.fields(lambda cell, text: typed(form, cell, text))
    clock = gui.fields(lambda cell, text: typed(clock, cell, text))
    plots, values = Plots(gui), gui.html()
    scaling = gui.fields(lambda cell, text: typed(scaling, cell, text))
    slider = gui.slider("k", FASTEST, SLOWEST, STEP, 1.0, lambda k: post(Stretch(k)), "New time over old time")
    after = gui.html()

    def show(state: State) -> None:
        nonlocal present
        present = state
        part = state[Laws]
        head.show(head_markup(head, part))
        bounds.show(bounds_markup(bounds, part.bounded) if part.bounds_shown else "")
        form.show(form_markup(form, part))
        clock.show(_clock(clock, state))
        plots.show(state)
        values.show(values_markup(part, present_time(state)))
        scaling.show(scaling_markup(scaling, part))
        slider.show(round(min(max(part.k, FASTEST), SLOWEST), 5))
        after.show(stretch_markup(part))

    return show


def _clock(fields: Fields, state: State) -> str:
    """Return play and time, and the race of the laws."""
    playing = state[Timeline].clip == CLIP_KEY and state[Timeline].playing
    cell, text = ("pause-laws", "❚❚ Pause") if playing else ("play-laws", "▶ Play")
    play = button(fields.channel_id, cell, text, "main")
    time = fields.field("time", amount(present_time(state)), "Time in seconds")
    return (
        f'<div class="bar kit-clock">{play}<label>t = {time} <i>of {amount(state[Laws].end, "s")}</i></label></div>'
        + race_markup(state)
    )


def commands(state: State, cell: str, text: str) -> tuple[Command, ...]:
    """Return what a person asked for.

    Raises
    ------
    InputError
        Not a number; the text names the field.
    """
    simple: dict[str, Callable[[], tuple[Command, ...]]] = {
        "example": lambda: (ChooseLawExample(text),) if text else (),
        "play-laws": lambda: _play(state),
        "pause-laws": lambda: (Play(False),),
        "time": lambda: _to_time(state, text),
        "view laws": lambda: (ShowBounds(False),),
        "view bounds": lambda: (ShowBounds(True),),
        "mode time": lambda: (AsFastAsAllowed(False),),
        "mode fast": lambda: (AsFastAsAllowed(True),),
        "add": lambda: (AddLaw(),),
        "optimal": lambda: (StretchOptimally(),),
        "unscaled": lambda: (Stretch(1.0),),
        "path": lambda: (ChooseBoundPath(text),),
        "lower": lambda: (LowerSpeed(),),
        "take": lambda: (TakeBounds(),),
    }
    if cell in simple:
        return simple[cell]()
    prefix, dash, name = cell.partition("-")
    if dash:
        command = _option(state, prefix, name, text)
        return () if command is None else (command,)
    what, _, place = cell.partition(" ")
    numbered: dict[str, Callable[[int], Command]] = {
        "law": lambda i: ChooseLaw(i, text),
        "remove": RemoveLaw,
        "typed": lambda i: LeaveAsTyped(i, True),
        "fitted": lambda i: LeaveAsTyped(i, False),
        "scale": StretchLaw,
    }
    return (numbered[what](int(place)),) if what in numbered and place.isdecimal() else ()


def _option(state: State, prefix: str, name: str, text: str) -> Command | None:
    """Return what sets a field of a form, whose cell begins with the form's letter."""
    part = state[Laws]
    if prefix == "t":
        found = _read(QUANTITIES, name, text, getattr(part.timing, name, None))
        return SetQuantity(name, found)
    if prefix == "b":
        return SetBound(name, _read(FIELDS, name, text, None))
    if prefix == "p":
        path = part.bounded.path
        return SetBoundOption(name, _read(joint_paths()[path.key].fields, name, text, path.options.get(name)))
    if prefix[:1] == "l" and prefix[1:].isdecimal() and int(prefix[1:]) < len(part.entries):
        i = int(prefix[1:])
        chosen = part.entries[i].chosen
        return SetLawOption(i, name, _read(free_law_types()[chosen.key].fields, name, text, chosen.options.get(name)))
    return None


def _read(fields: tuple[Field, ...], name: str, text: str, now: Any) -> Any:
    kind = next((field for field in fields if field.key == name), None)
    if kind is None:
        raise InputError(f"unknown field {name[:40]!r}")
    return option_value(kind, text, now)


def _play(state: State) -> tuple[Command, ...]:
    """Go on from where the film stands; it is put on where it is not."""
    return (Play(True),) if state[Timeline].clip == CLIP_KEY else (OpenClip(CLIP_KEY, play=True),)


def _to_time(state: State, text: str) -> tuple[Command, ...]:
    try:
        time = evaluate(text.strip().replace("−", "-").replace(",", "."))
    except InputError:
        raise InputError(f"t: expected seconds, got {text.strip()[:40]!r}") from None
    end = state[Laws].end
    if not 0.0 <= time <= end:
        raise InputError(f"t: expected 0 to {amount(end, 's')}, got {amount(time)}")
    on = () if state[Timeline].clip == CLIP_KEY else (OpenClip(CLIP_KEY),)
    return (*on, Seek(time))


PANEL = Panel((Laws, Timeline), build, rebuilds=())
