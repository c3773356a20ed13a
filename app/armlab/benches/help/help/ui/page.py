"""Instructions for the lab."""

from __future__ import annotations

from collections.abc import Iterable

from armlab.session.parts.robot import RobotPart
from armlab.session.state import Post, State
from armlab.teaching.parts.welcome import ShowCard
from armlab.ui.commands import shortcuts
from armlab.ui.html import Markup, tag
from armlab.ui.jog import KEYS as JOG
from armlab.ui.markup import fold
from armlab.ui.plugin import Panel, Show
from armlab.ui.welcome import tour_from
from armlab.ui.widgets import Gui

PAGE_KEYS = (
    ("V", "projector: large text, panels hidden (Esc ends)"),
    ("Page ↑ ↓", "the step before or after, in a lesson"),
    ("space , .", "play what the open page shows, step back, step on"),
    ("X", "the plots of the open page, large; again: close them"),
    ("Esc", "close a question, or the plots"),
)
"""Keys that are handled by the page itself."""

MOUSE = (
    ("drag an arrow", "move the target; the arm follows"),
    ("drag a ring", "turn the target (Handle: Turn)"),
    ("drag elsewhere", "orbit"),
    ("right button", "pan"),
    ("wheel, pinch", "zoom"),
    ("arrow keys, W A S D Q E", "fly, when no field or slider has the focus"),
    ("arrow keys on a slider", "move that joint step by step"),
    ("arrow keys on a solution", "to the next one, half a second each"),
    ("Ctrl+K, /", "search: pages, arms, lessons, topics, commands, files"),
)

UNDO = "Undo takes back what was done to joints, table, target and exercises; not what is shown, or in which units."

UNITS = (
    "Choose units and names under View; matrices are in metres. Joints count from 1. Every control has a hint: rest "
    "the pointer on its name; that of a joint is on its chip under Hold."
)

WORDS = (
    ("✓ reached", "the tool is at the target"),
    ("✕ limit on joint 3", "at this limit no move comes closer; from another posture one may"),
    ("✕ closest possible from here", "no small move of any joint comes closer; from another posture one may"),
    ("✕ out of reach", "farther than the fully stretched arm"),
)


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the text."""
    start = gui.form(post)
    keys = _table([*((s.shown, s.label) for s in shortcuts() if s.key), *PAGE_KEYS])
    gui.html(fold("Mouse and touch", _table(MOUSE), opened=True))
    gui.html(fold("What the verdict says", _table(WORDS), opened=True))
    gui.html(fold("Keys", keys, tag("p.dim", UNDO)))
    gui.html(fold("Keys while Jog is chosen on Joints or Target", _table(JOG)))
    gui.html(fold("Units and hints", tag("p", UNITS)))

    def show(state: State) -> None:
        del state
        start.show(
            tag("h3", "New here?"),
            tag(
                "div.bar",
                start.chip("help-start", "Start here", ShowCard(), "Three lessons to begin with"),
                start.chip("help-tour", "Show me around", tour_from(0), "A tour of four stops"),
            ),
        )

    return show


def _table(rows: Iterable[tuple[str, str]]) -> Markup:
    return tag("table.keys", [tag("tr", tag("th", name), tag("td", text)) for name, text in rows])


PANEL = Panel((RobotPart,), build)
