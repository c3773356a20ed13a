"""What is drawn, from where, and in which theme."""

from __future__ import annotations

from collections.abc import Callable

from armlab.session.parts.display import Display
from armlab.session.parts.display import Show as SetSwitch
from armlab.session.parts.notation import Label, Notation
from armlab.session.session import StartFresh
from armlab.session.state import Post, State
from armlab.ui.camera import PRESETS
from armlab.ui.format import escaped
from armlab.ui.markup import button
from armlab.ui.plugin import Panel, Show, switches
from armlab.ui.switches import GENERAL, Switch
from armlab.ui.units import BOOKS
from armlab.ui.widgets import Gui

NOTATION = {
    "angle": ("Angles in", {"deg": "°", "rad": "rad"}, "Labels only: nothing is computed differently"),
    "length": ("Lengths in", {"mm": "mm", "m": "m"}, "Matrices are always in metres"),
    "variable": ("Variables", {"q": "q", "theta": "θ, d"}, "One letter for all joint variables, or as in the table"),
    "book": (
        "Table as in",
        {key: book.title for key, book in BOOKS.items()},
        "Order of the columns and letters; standard or modified is chosen with the table",
    ),
}


ARM = ("skeleton", "frames", "names")
"""Switches of the arm's own picture; those of other layers are overlays."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the switches and the buttons."""
    grid = _Switches(gui, post)
    gui.heading("Units and names")
    choices = {
        name: gui.segments(title, options, getattr(state[Notation], name), _chooser(name, post), hint)
        for name, (title, options, hint) in NOTATION.items()
    }
    gui.heading("Look from")
    gui.buttons("Camera", tuple(PRESETS), gui.camera.look_from, "Drag to orbit, wheel to zoom, right button to pan.")
    gui.heading("Shared computer")
    gui.html('<p class="dim">Work is kept for this browser: the next person should start fresh.</p>')
    gui.button(
        "Start fresh ...",
        lambda: gui.confirm(
            "Start fresh?",
            "This arm, its pose, all steps of undo and the progress in all lessons are forgotten. This cannot be "
            "undone. Work to hand in or to go on with elsewhere: save it first, in each lesson under Save my work.",
            "Yes, start fresh",
            lambda: post(StartFresh()),
        ),
        "For the next person at this computer.",
    )

    def show(state: State) -> None:
        grid.show(state)
        for name, choice in choices.items():
            choice.show(getattr(state[Notation], name))

    return show


def _chooser(name: str, post: Post) -> Callable[[str], None]:
    """Return what chooses one unit or name."""
    return lambda key: post(Label(name, key))


class _Switches:
    """All switches in two columns, by what they are about."""

    def __init__(self, gui: Gui, post: Post) -> None:
        self._post = post
        self._fields = gui.fields(lambda name, _: self._pressed(name))
        self._on: dict[str, bool] = {}

    def _pressed(self, name: str) -> None:
        if name in self._on:
            self._post(SetSwitch(name, not self._on[name]))

    def show(self, state: State) -> None:
        """Show how all switches stand."""
        self._on = {switch.name: switch.on(state) for switch in switches()}
        self._fields.show("".join(self._group(title, group) for title, group in _groups().items()))

    def _group(self, title: str, group: list[Switch]) -> str:
        return f'<h3>{title}</h3><div class="switches">{"".join(self._switch(switch) for switch in group)}</div>'

    def _switch(self, switch: Switch) -> str:
        return button(
            self._fields.channel_id,
            switch.name,
            f"{escaped(switch.title)}<kbd>{switch.key}</kbd>",
            "switch",
            _hint(switch),
            switch.title,
            role="checkbox",
            aria_checked="true" if self._on[switch.name] else "false",
        )


def _groups() -> dict[str, list[Switch]]:
    """Return the switches by heading; what another file brings is an overlay."""
    groups: dict[str, list[Switch]] = {"Arm": [], "Overlays": [], "Picture": []}
    for switch in switches():
        heading = "Arm" if switch.name in ARM else "Picture" if switch in GENERAL else "Overlays"
        groups[heading].append(switch)
    return groups


def _hint(switch: Switch) -> str:
    return f"{switch.hint} Key {switch.key}." if switch.key else switch.hint


PANEL = Panel((Display, Notation), build)
