"""How to use the lab."""

from __future__ import annotations

from armlab.session.parts.robot import RobotPart
from armlab.session.state import Post, State
from armlab.ui.commands import shortcuts
from armlab.ui.format import escaped
from armlab.ui.plugin import Panel, Show
from armlab.ui.widgets import Gui

PAGE_KEYS = (
    ("V", "projector: large text, no benches (Esc ends)"),
    ("Page ↑ ↓", "the step before or after, in a lesson"),
    ("space , .", "play, step back, step on"),
)
"""Keys that the page itself answers to."""

MOUSE = (
    ("drag an arrow", "move the target; the arm follows"),
    ("drag a ring", "turn the target (Handle: Turn)"),
    ("drag elsewhere", "orbit"),
    ("right button", "pan"),
    ("wheel, pinch", "zoom"),
    ("arrow keys, W A S D Q E", "fly, when no field or slider has the focus"),
    ("arrow keys on a slider", "move that joint step by step"),
    ("Ctrl+K", "all commands"),
)

UNDO = "Undo takes back what was done to joints, table, target and exercises; not what is shown, or in which units."

WORDS = (
    ("✓ reached", "the tool is at the target"),
    ("✕ limit on joint 3", "only a joint limit keeps the tool away"),
    ("✕ closest possible", "no small move of any joint comes closer"),
    ("✕ out of reach", "farther than all links in a line"),
)


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the text."""
    gui.html("<h3>Keys</h3>" + _table([*((s.shown, s.label) for s in shortcuts() if s.key), *PAGE_KEYS]))
    gui.html(f'<p class="dim">{UNDO}</p>')
    gui.html("<h3>Mouse and touch</h3>" + _table(MOUSE))
    gui.html("<h3>What the verdict says</h3>" + _table(WORDS))
    gui.html(
        "<h3>Units</h3><p>Choose units and names under View; matrices are in metres. Joints count from 1. "
        "Every control has a hint: rest the pointer on its name; that of a joint is on its chip under Hold.</p>"
    )

    def show(state: State) -> None:
        del state

    return show


def _table(rows: object) -> str:
    body = "".join(f"<tr><th>{escaped(a)}</th><td>{escaped(b)}</td></tr>" for a, b in rows)  # type: ignore[attr-defined]
    return f'<table class="keys">{body}</table>'


PANEL = Panel((RobotPart,), build)
