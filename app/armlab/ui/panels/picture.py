"""What is drawn, from where, and in which theme."""

from __future__ import annotations

from armlab.session.parts.display import Display
from armlab.session.parts.display import Show as Switch
from armlab.session.session import StartFresh
from armlab.session.state import State
from armlab.ui.camera import PRESETS
from armlab.ui.plugin import Panel, Post, Show
from armlab.ui.widgets import Gui

SWITCHES = {
    "names": ("Joint names", "The names q₁ to qₙ at the joints. Key N."),
    "frames": ("Frames", "All Denavit–Hartenberg frames {0} to {n} and the tool's frame {E}. Key F."),
    "skeleton": ("Skeleton", "Textbook symbols instead of bodies: cylinders turn, boxes slide. Key K."),
    "trace": ("Trace", "The path of the tool point. Switch off to clear it. Key T."),
    "shadows": (
        "Shadows",
        "Without them the picture moves twice as fast on a computer with a weak graphics processor.",
    ),
    "dark": ("Dark theme", "Key L."),
}


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the switches and the buttons."""
    gui.heading("Show")
    switches = {
        name: gui.checkbox(title, getattr(state[Display], name), lambda on, name=name: post(Switch(name, on)), hint)
        for name, (title, hint) in SWITCHES.items()
    }
    gui.heading("Look from")
    gui.buttons("Camera", tuple(PRESETS), gui.camera.look_from, "Drag to orbit, wheel to zoom, right button to pan.")
    gui.heading("Shared computer")
    gui.html('<p class="dim">Work is kept for this browser: the next person should start fresh.</p>')
    gui.button(
        "Start fresh ...",
        lambda: gui.confirm(
            "Start fresh?",
            "This arm, its pose and all steps of undo are forgotten. This cannot be undone.",
            "Yes, start fresh",
            lambda: post(StartFresh()),
        ),
        "For the next person at this computer.",
    )

    def show(state: State) -> None:
        for name, switch in switches.items():
            switch.show(getattr(state[Display], name))

    return show


PANEL = Panel("picture", "View", "EYE", 40, (Display,), build)
