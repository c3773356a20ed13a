"""The page of the plan: waypoints, the moves between them, limits, and whether the motion can be run."""

from __future__ import annotations

from collections.abc import Callable

from armlab.benches.motion.plan.examples import EXAMPLES, TakeExample
from armlab.benches.motion.plan.limits import CompareMoves
from armlab.benches.motion.plan.state import CLIP_KEY, Plan, last_planned, planned_now
from armlab.benches.motion.plan.ui.around import in_the_way, way_around
from armlab.benches.motion.plan.ui.limits import time_markup
from armlab.benches.motion.plan.ui.move import move_markup
from armlab.benches.motion.plan.ui.points import points_markup
from armlab.benches.motion.plan.ui.scene_frame import SWITCH as FRAME
from armlab.benches.motion.plan.words import judged, listed
from armlab.session.parts.display import Display
from armlab.session.parts.display import Show as SetSwitch
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import Target
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Post, State
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import capitalised
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.markup import verdict_box
from armlab.ui.playing import play_button
from armlab.ui.plugin import Panel, Show
from armlab.ui.widgets import Gui

MOST_LINES = 6
"""Largest number of sentences about a plan that are shown."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the list of waypoints, the choices of a move, the time and the limits."""
    # Each block is sent again only when it has changed: a slider in the hand must not cost the whole page.
    blocks: tuple[tuple[Form, Callable[[Form, State], Inside]], ...] = (
        (gui.form(post), head_markup),
        (gui.form(post), points_markup),
        (gui.form(post), move_markup),
        (gui.form(post), time_markup),
    )

    def show(state: State) -> None:
        for form, markup in blocks:
            form.show(markup(form, state))

    return show


def head_markup(form: Form, state: State) -> Markup:
    """Return the choice of an example, the buttons of the film and of further drawings, and the verdict on the plan."""
    chooser = examples(form, EXAMPLES, state[Plan].example, TakeExample)
    runs = planned_now(state) or last_planned(state)
    play = play_button(form, state, CLIP_KEY, "motion", off=runs is None or runs.motion is None)
    return joined(chooser, tag("div.bar", play, _shown(form, state)), _held(state), _verdict(state))


def _shown(form: Form, state: State) -> Inside:
    """Return the switches for drawings besides the path."""
    compared, framed = state[Plan].compared, FRAME.on(state)
    hint = "Also plan joint moves in place of Cartesian ones, or the reverse, between the same waypoints: the thin line"
    compare = form.chip("compare", "Compare", CompareMoves(not compared), hint, compared)
    return compare, form.chip("frame", FRAME.title, SetSwitch(FRAME.name, not framed), FRAME.hint, framed)


def _held(state: State) -> Markup | None:
    held = [str(i + 1) for i, locked in enumerate(state[Joints].locked) if locked]
    if not held:
        return None
    who = f"Joint {held[0]} is" if len(held) == 1 else f"Joints {listed(held)} are"
    return tag("p.warn", f"◐ {who} held and will not move.")


def _verdict(state: State) -> Markup:
    """Return the verdict on the plan; while it is being computed the last one would be wrong."""
    planned = planned_now(state)
    if planned is None:
        return verdict_box("dim", "… planning", sign="")
    said = judged(planned)
    lines = [tag("p", f"{capitalised(line)}.") for line in said.lines[:MOST_LINES]]
    more = len(said.lines) - MOST_LINES
    return verdict_box(said.kind, capitalised(said.head), lines, tag("p", f"… and {more} more.") if more > 0 else None)


PANEL = Panel(
    (Plan, Timeline, Joints, Target, Display, Notation, RobotPart), build, hides_then=in_the_way, around=way_around
)
