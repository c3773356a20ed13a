"""Runs of kinematic control: experiment, law, method, gains and plant; their results in numbers and over time."""

from __future__ import annotations

from collections.abc import Callable

from armlab.benches.control.follow.chosen import FIELDS
from armlab.benches.control.follow.clip import duration, time_of
from armlab.benches.control.follow.commands import (
    AddRun,
    AimAt,
    ChooseInverse,
    ChooseLaw,
    ChooseReference,
    DropPushes,
    NameRun,
    PushNow,
    RemoveRun,
    SelectRun,
    SetOffset,
    SetOption,
    SetStart,
    SetValue,
    SizePush,
)
from armlab.benches.control.follow.examples import EXAMPLES, ChooseControlExample
from armlab.benches.control.follow.runs import reference_points
from armlab.benches.control.follow.state import CLIP_KEY, Control, fresh, questions
from armlab.benches.control.follow.ui.card import card_markup, runs_markup
from armlab.benches.control.follow.ui.form import (
    law_markup,
    option_of,
    plant_markup,
    plant_words,
    reference_markup,
    value_of,
)
from armlab.benches.control.follow.ui.plots import VIEWS, Plots
from armlab.benches.motion.api import Plan
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import OpenClip, Play, Timeline
from armlab.session.state import Command, Post, State
from armlab.ui.examples import examples_markup
from armlab.ui.fields import Fields
from armlab.ui.format import escaped, number, trimmed
from armlab.ui.markup import button, chips
from armlab.ui.plugin import Panel, Points, Show
from armlab.ui.tried import tried
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make example, runs, form, results and plots."""
    present = state

    def typed(fields: Fields, cell: str, text: str) -> None:
        if not tried(fields, cell, text, lambda: commands(present, cell, text), present, post):
            show(present)

    def look(view: str) -> None:
        if view not in VIEWS:
            return
        chooser.show(_views(chooser, view))
        plots.look_at(view)
        plots.show(present)

    head = gui.fields(lambda cell, text: typed(head, cell, text))
    clock = gui.fields(lambda cell, text: typed(clock, cell, text))
    runs = gui.fields(lambda cell, text: typed(runs, cell, text))
    card = gui.html()
    chooser = gui.fields(lambda view, _: look(view))
    chooser.show(_views(chooser, "error"))
    plots = Plots(gui, state)
    form = gui.fields(lambda cell, text: typed(form, cell, text))
    law = gui.fields(lambda cell, text: typed(law, cell, text))
    plant = gui.fields(lambda cell, text: typed(plant, cell, text))

    written: object = None

    def show(state: State) -> None:
        nonlocal present, written
        present = state
        clock.show(_clock(clock, state))
        plots.show(state)
        # While a run plays only the time changes.
        now = (state[Control], state.derived(questions))
        if now == written and not any(fields.stale for fields in (head, runs, form, law, plant)):
            return
        written = now
        head.show(_head(head, state))
        runs.show(runs_markup(runs, state))
        card.show(card_markup(state))
        form.show(_named(form, state) + reference_markup(form, state))
        law.show(law_markup(law, state))
        words = escaped(plant_words(state[Control].run)).replace("T_s", "T<sub>s</sub>")
        plant.show(f"<h3>Plant <small>{words}</small></h3>{plant_markup(plant, state)}")

    return show


def commands(state: State, cell: str, text: str) -> tuple[Command, ...]:
    """Return what a person asked for.

    Raises
    ------
    InputError
        Not a number; the text names the field.
    """
    simple: dict[str, Callable[[], Command]] = {
        "ref": lambda: ChooseReference(text),
        "law": lambda: ChooseLaw(text),
        "inverse": lambda: ChooseInverse(text),
        "name": lambda: NameRun(text),
        "here": lambda: SetStart(),
        "aim": lambda: AimAt(),
        "add": lambda: AddRun(),
        "push": lambda: PushNow(),
        "drop": lambda: DropPushes(),
        "push-size": lambda: SizePush(units_of(state).read(text, False, "size of a push")),
        "play-control": lambda: OpenClip(CLIP_KEY, play=True),
        "go-on": lambda: Play(True),
        "pause-control": lambda: Play(False),
    }
    if cell == "example":
        return (ChooseControlExample(text),) if text else ()
    if cell in simple:
        return (simple[cell](),)
    prefix, dash, key = cell.partition("-")
    if dash and prefix == "w" and key in FIELDS:
        return (SetValue(key, value_of(state, key, text)),)
    if dash and prefix in ("law", "inverse"):
        return (SetOption(prefix, key, option_of(state, prefix, key, text)),)
    what, _, place = cell.partition(" ")
    return _numbered(state, what, int(place), text) if place.isdecimal() else ()


def _numbered(state: State, what: str, i: int, text: str) -> tuple[Command, ...]:
    run, arm = state[Control].run, state[Joints].arm
    if what == "select":
        return (SelectRun(i),)
    if what == "remove":
        return (RemoveRun(i),)
    if what not in ("start", "offset") or i >= arm.n:
        return ()
    values = list(run.start if what == "start" else run.offset)
    values[i] = units_of(state).read(text, bool(arm.revolute[i]), f"{what} of joint {i + 1}")
    return (SetStart(tuple(values)) if what == "start" else SetOffset(tuple(values)),)


def _head(fields: Fields, state: State) -> str:
    return examples_markup(fields.channel_id, EXAMPLES, state[Control].example, "Experiments")


def _clock(fields: Fields, state: State) -> str:
    """Return play and push."""
    part, timeline, units, channel = state[Control], state[Timeline], units_of(state), fields.channel_id
    on = timeline.clip == CLIP_KEY
    cell, words = ("play-control", "▶ Run")
    if on and timeline.playing:
        cell, words = "pause-control", "❚❚ Pause"
    elif on and 0.0 < timeline.time < duration(state):
        cell, words = "go-on", "▶ Go on"
    play = button(channel, cell, words, "main")
    size = fields.field("push-size", trimmed(part.push / units.factor(False), 3), "How far the tool is pushed")
    push = button(
        channel,
        "push",
        "Push",
        "chip",
        "Push the tool aside at the present time, and run it again",
        off=part.outcome is None,
    )
    count = len(part.run.pushes)
    drop = (
        button(channel, "drop", f"✕ {count}", "chip", "Take the pushes away", "Take the pushes away") if count else ""
    )
    now = "…" if not fresh(state) else f"t = {number(time_of(state), 2)} s" if on else ""
    return (
        f'<div class="bar ct-clock">{play}<span class="dim">{now}</span>'
        f"<span>{push}<label>{size}<i>{units.length_unit}</i></label>{drop}</span></div>"
    )


def _views(fields: Fields, chosen: str) -> str:
    return f'<div class="bar">{chips(fields.channel_id, VIEWS, chosen, "What to look at over time")}</div>'


def _named(fields: Fields, state: State) -> str:
    run = state[Control].run
    name = fields.field("name", run.title, "Name of the run")
    return f'<label class="option wide ct-name"><span>Run {state[Control].selected + 1}</span>{name}</label>'


def _around(state: State) -> Points:
    """Return the ways of the runs, which belong in the picture."""
    outcome = state[Control].outcome
    if outcome is None or outcome.run is None or not fresh(state):
        return reference_points(state[Joints].arm, state[Control].run)
    step = max(1, outcome.run.steps // 20)
    return outcome.run.p_wanted[::step]


def _in_the_way(state: State) -> tuple[str, ...]:
    """Return the layers a run hides: the handle sits on the tool while the run moves the arm."""
    on = state[Timeline].clip == CLIP_KEY
    return ("gizmo", "gap") if on and state[Control].run.reference != "target" else ("gap",) if on else ()


PANEL = Panel((Control, Timeline, Plan, Notation, RobotPart), build, hides_then=_in_the_way, around=_around)
