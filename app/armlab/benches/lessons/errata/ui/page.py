"""The page of the errata: a list to look up, one of them with both forms run, and tasks to spot the error."""

from __future__ import annotations

import asyncio
from functools import partial

from armlab.benches.lessons.errata.examples import EXAMPLES, ChooseErrataExample
from armlab.benches.lessons.errata.state import VIEWS, Errata
from armlab.benches.lessons.errata.ui.arm import on_this_arm
from armlab.benches.lessons.errata.ui.card import card, where
from armlab.benches.lessons.errata.ui.listed import entries, filters
from armlab.benches.lessons.errata.ui.practice import Spotting, view_chips
from armlab.benches.lessons.errata.ui.scene import around
from armlab.content.errata_sheet import FORMATS, sheet
from armlab.content.lessons import lessons_read
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Post, State
from armlab.teaching.parts.errata_practice import Practice
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.html import Inside, tag
from armlab.ui.markup import fold
from armlab.ui.paper import in_language
from armlab.ui.picks import lessons_to_come
from armlab.ui.plugin import Panel, Show
from armlab.ui.recording import maker
from armlab.ui.widgets import Gui

SHEET = "All of them on paper, by chapter: printed and correct side by side, with both residuals."


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the choice of a view, the list, the card and the task."""
    head, found, listed, shown = (gui.form(post) for _ in range(4))
    on_arm, places, task, printed = (gui.form(post) for _ in range(4))
    spotting = Spotting(task)

    def show(state: State) -> None:
        part = state[Errata]
        look = part.view == "look"
        loaded = examples(head, EXAMPLES, part.example, ChooseErrataExample) if look else None
        head.show(tag("div.er-top", view_chips(head, state, VIEWS), loaded))
        found.show(filters(found, state) if look else None)
        if look and not listed.shows(part.listed, part.chosen, state[Practice].done):
            listed.show(entries(listed, state))
        if not look:
            listed.show()
        shown.show(card(shown, state) if look else None)
        on_arm.show(on_this_arm(on_arm, state) if look else None)
        places.show(where(places, part.erratum, gui.open_panel) if look else None)
        task.show(None if look else spotting.markup(state))
        printed.show(_sheet(gui, printed) if look else None)

    return show


def _sheet(gui: Gui, form: Form) -> Inside:
    chips = (
        form.chip(
            f"errata-{key}", f"Save as {each.title}", partial(_save, gui, key), f"A file that ends with .{each.ending}"
        )
        for key, each in FORMATS.items()
    )
    return fold("On paper", tag("p.dim", SHEET), tag("div.bar", chips))


def _save(gui: Gui, key: str) -> None:
    """Let the browser save the list, which takes a second to make, once for all who ask for it together."""
    made = asyncio.get_running_loop().run_in_executor(maker(), _written, key, gui.language)
    made.add_done_callback(lambda found: gui.save(f"errata.{FORMATS[key].ending}", found.result()))


def _written(key: str, language: str) -> str:
    return in_language(sheet(key), language) if key == "html" else sheet(key)


PANEL = Panel(
    (Errata, Practice, Joints, RobotPart, Notation),
    build,
    rebuilds=(Notation,),
    around=around,
    outside=lessons_read,
    waits=lessons_to_come,
)
