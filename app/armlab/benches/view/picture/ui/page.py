"""The view of the scene: its layers, the camera, and the theme."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from armlab.content.languages import languages
from armlab.session.fields import Set
from armlab.session.parts.display import Display
from armlab.session.parts.display import Show as SetSwitch
from armlab.session.parts.language import OF_BROWSER, LanguagePart, ReadIn
from armlab.session.parts.notation import Notation
from armlab.session.session import StartFresh
from armlab.session.state import Post, State
from armlab.ui.camera import PRESETS
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.plugin import Panel, Show, switches
from armlab.ui.settings import NOTATION
from armlab.ui.switches import GENERAL, Switch
from armlab.ui.widgets import Gui

LANGUAGE = "Of this page and its lessons; files that you save stay English"

ARM = ("skeleton", "frames", "names")
"""Switches for drawings of the arm itself; those of other layers are overlays."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the switches and the buttons."""
    grid = gui.form(post)
    gui.heading("Units and names")
    choices = {
        name: gui.segments(each.title, each.options, getattr(state[Notation], name), _chooser(name, post), each.hint)
        for name, each in NOTATION.items()
    }
    language = gui.segments(
        "Language", {OF_BROWSER: "As the browser", **languages()}, OF_BROWSER, lambda key: post(ReadIn(key)), LANGUAGE
    )
    gui.heading("Look from")
    gui.buttons("Camera", tuple(PRESETS), gui.camera.look_from, "Drag to orbit, wheel to zoom, right button to pan.")
    gui.heading("Shared computer")
    gui.html(tag("p.dim", "Work is kept in this browser: the next person should start fresh."))
    fresh = gui.form(post)
    fresh.show(
        fresh.chip("start-fresh", "Start fresh ...", partial(_ask, gui, post), "For the next person at this computer.")
    )

    def show(state: State) -> None:
        grid.show(_switches(grid, state))
        for name, choice in choices.items():
            choice.show(getattr(state[Notation], name))
        language.show(state[LanguagePart].chosen)

    return show


def _ask(gui: Gui, post: Post) -> None:
    """Ask before everything is forgotten."""
    gui.confirm(
        "Start fresh?",
        "This arm, its pose, all steps of undo and the progress in all lessons are discarded. This cannot be "
        "undone. Work to hand in or to go on with elsewhere: save it first, in each lesson under Save my work.",
        "Yes, start fresh",
        lambda: post(StartFresh()),
    )


def _chooser(name: str, post: Post) -> Callable[[str], None]:
    """Return the callback that chooses one unit or name."""
    return lambda key: post(Set(Notation, name, key))


def _switches(form: Form, state: State) -> Inside:
    """Return all switches in two columns, by their subject."""
    return [
        (tag("h3", title), tag("div.switches", [_switch(form, switch, state) for switch in group]))
        for title, group in _groups().items()
    ]


def _switch(form: Form, switch: Switch, state: State) -> Markup:
    on = switch.on(state)
    return form.button(
        switch.name,
        (switch.title, tag("kbd", switch.key)),
        SetSwitch(switch.name, not on),
        "switch",
        _hint(switch),
        switch.title,
        role="checkbox",
        aria_checked="true" if on else "false",
    )


def _groups() -> dict[str, list[Switch]]:
    """Return the switches by heading; a switch that no heading names is an overlay."""
    groups: dict[str, list[Switch]] = {"Arm": [], "Overlays": [], "Picture": []}
    for switch in switches():
        heading = "Arm" if switch.name in ARM else "Picture" if switch in GENERAL else "Overlays"
        groups[heading].append(switch)
    return groups


def _hint(switch: Switch) -> str:
    return f"{switch.hint} Key {switch.key}." if switch.key else switch.hint


PANEL = Panel((Display, Notation, LanguagePart), build)
