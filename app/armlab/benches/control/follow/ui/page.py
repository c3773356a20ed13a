"""Runs of kinematic control: experiment, law, method, gains and plant, with their results in numbers and over time."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from armlab.benches.control.follow.chosen import REFERENCES
from armlab.benches.control.follow.clip import duration, time_of
from armlab.benches.control.follow.commands import DropPushes, PushNow, SizePush
from armlab.benches.control.follow.examples import EXAMPLES, ChooseControlExample
from armlab.benches.control.follow.runs import reference_points
from armlab.benches.control.follow.state import CLIP_KEY, Control, fresh, made_step, questions
from armlab.benches.control.follow.ui.card import card_markup, name_markup, runs_markup, speeds_markup
from armlab.benches.control.follow.ui.form import law_markup, law_words, plant_markup, plant_words, reference_markup
from armlab.benches.control.follow.ui.plots import VIEWS, Plots
from armlab.benches.motion.api import Plan
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import OpenClip, Play, Timeline
from armlab.session.state import Post, State
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import number, trimmed
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import fold
from armlab.ui.playing import SPACE, by_space
from armlab.ui.plugin import Panel, Points, Show
from armlab.ui.symbols import with_symbol
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the example, the runs, the form, the results and the plots."""
    head, runs = gui.form(post), gui.form(post)
    form, law, plant = gui.form(post), gui.form(post), gui.form(post)
    clock, card, chooser = gui.form(post), gui.html(), gui.form(post)
    plots, speeds = Plots(gui, state), gui.html()
    view, written = "error", object()

    def look(at: str) -> None:
        nonlocal view
        view = at
        plots.look_at(view)

    def show(state: State) -> None:
        nonlocal written
        clock.show(clock_markup(clock, state))
        chooser.show(_views(chooser, view, look))
        plots.show(state)
        # While a run plays only the time changes.
        now = (state[Control], state.derived(questions))
        if now == written and not any(each.stale for each in (head, runs, form, law, plant)):
            return
        written = now
        example, said = state[Control].example, units_of(state).said
        head.show(examples(head, EXAMPLES, example, ChooseControlExample, "Experiments", said=said))
        runs.show(runs_markup(runs, state))
        card.show(card_markup(state))
        speeds.show(fold("Peak speeds of the joints", speeds_markup(state)))
        run = state[Control].run
        named = name_markup(form, state)
        form.show(_fold("Reference", REFERENCES[run.reference], named, reference_markup(form, state)))
        law.show(_fold("Control law", law_words(run), law_markup(law, state)))
        plant.show(_fold("Plant", with_symbol(plant_words(run, made_step(state)), "T_s"), plant_markup(plant, state)))

    return show


def _fold(title: str, words: Inside, *inside: Inside) -> Markup:
    """Return a fold whose head says what is set inside."""
    return fold((title, " ", tag("small", words)), *inside, key=title)


def clock_markup(form: Form, state: State) -> Markup:
    """Return the buttons that play and push, and the time."""
    part, units, on = state[Control], units_of(state), state[Timeline].clip == CLIP_KEY
    now = "…" if not fresh(state) else f"t = {number(time_of(state), 2)} s" if on else ""
    return tag("div.bar.ct-clock", _play(form, state), tag("span.dim", now), tag("span", _push(form, part, units)))


def _play(form: Form, state: State) -> Markup:
    timeline = state[Timeline]
    on = timeline.clip == CLIP_KEY
    if on and timeline.playing:
        return form.button("pause-control", "❚❚ Pause", Play(False), "main", by_space(), data_key=SPACE)
    if on and 0.0 < timeline.time < duration(state):
        return form.button("go-on", "▶ Go on", Play(True), "main", by_space(), data_key=SPACE)
    run = OpenClip(CLIP_KEY, play=True)
    return form.button("play-control", "▶ Run", run, "main", by_space(), data_key=SPACE)


def _push(form: Form, part: Control, units: Units) -> Inside:
    """Return the button that pushes, the field for the distance, and the button that removes all pushes."""
    hint = "Push the tool aside at the present time, and compute the run again"
    push = form.button("push", "Push", PushNow(), "chip", hint, off=part.outcome is None)

    def sized(text: str) -> SizePush:
        return SizePush(units.read(text, False, "size of a push"))

    shown = trimmed(part.push / units.factor(False), 3)
    size = form.field("push-size", shown, "How far the tool is pushed", sized)
    count, away = len(part.run.pushes), "Remove the pushes"
    drop = form.button("drop", f"✕ {count}", DropPushes(), "chip", away, away) if count else None
    return push, tag("label", size, tag("i", units.length_unit)), drop


def _views(form: Form, chosen: str, look: Callable[[str], None]) -> Markup:
    hint = "What to look at over time"
    return tag(
        "div.bar", [form.chip(key, text, partial(look, key), hint, key == chosen) for key, text in VIEWS.items()]
    )


def _around(state: State) -> Points:
    """Return the paths of the runs, which must be inside the picture."""
    outcome = state[Control].outcome
    if outcome is None or outcome.run is None or not fresh(state):
        return reference_points(state[Joints].arm, state[Control].run)
    step = max(1, outcome.run.steps // 20)
    return outcome.run.p_wanted[::step]


def _in_the_way(state: State) -> tuple[str, ...]:
    """Return the layers that a run hides: the handle would cover the tool while the run moves the arm."""
    on = state[Timeline].clip == CLIP_KEY
    return ("gizmo", "gap") if on and state[Control].run.reference != "target" else ("gap",) if on else ()


PANEL = Panel((Control, Timeline, Plan, Notation, RobotPart), build, hides_then=_in_the_way, around=_around)
