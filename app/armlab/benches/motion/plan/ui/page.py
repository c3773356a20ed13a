"""Motion: waypoints, the moves between them, limits, and whether it can be run."""

from __future__ import annotations

from collections.abc import Callable

from armlab.benches.motion.plan.examples import EXAMPLES, TakeExample
from armlab.benches.motion.plan.limits import CompareMoves
from armlab.benches.motion.plan.state import CLIP_KEY, Plan, last_planned, planned
from armlab.benches.motion.plan.ui.around import in_the_way, way_around
from armlab.benches.motion.plan.ui.limits import limit_command, time_markup
from armlab.benches.motion.plan.ui.move import move_command, move_markup
from armlab.benches.motion.plan.ui.points import point_command, points_markup
from armlab.benches.motion.plan.ui.scene_frame import SWITCH as FRAME
from armlab.benches.motion.plan.words import judged
from armlab.session.parts.display import Display
from armlab.session.parts.display import Show as SetSwitch
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.target import Target
from armlab.session.parts.timeline import OpenClip, Play, Timeline
from armlab.session.state import Command, Post, State
from armlab.ui.examples import examples_markup
from armlab.ui.fields import Fields
from armlab.ui.format import capitalised, escaped
from armlab.ui.markup import button, chip
from armlab.ui.plugin import Panel, Show
from armlab.ui.tried import tried
from armlab.ui.verdicts import SIGNS
from armlab.ui.widgets import Gui

MOST_LINES = 6
"""Sentences about a plan that are shown."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the list of waypoints, the choices of a move, time and limits."""
    present = state

    def typed(fields: Fields, cell: str, text: str) -> None:
        if not tried(fields, cell, text, lambda: _commands(present, cell, text), present, post):
            show(present)

    # Each block is sent again only when it has changed: a slider in the hand must not cost the whole page.
    head = gui.fields(lambda cell, text: typed(head, cell, text))
    points = gui.fields(lambda cell, text: typed(points, cell, text))
    move = gui.fields(lambda cell, text: typed(move, cell, text))
    limits = gui.fields(lambda cell, text: typed(limits, cell, text))
    blocks: tuple[tuple[Fields, Callable[[Fields, State], str]], ...] = (
        (head, _head),
        (points, points_markup),
        (move, move_markup),
        (limits, time_markup),
    )

    def show(state: State) -> None:
        nonlocal present
        present = state
        for fields, markup in blocks:
            fields.show(markup(fields, state))

    return show


def _commands(state: State, cell: str, text: str) -> tuple[Command, ...]:
    """Return what a person asked for."""
    if cell == "example":
        return (TakeExample(text),) if text else ()
    if cell == "play-motion":
        return (OpenClip(CLIP_KEY, play=True),)
    if cell == "pause-motion":
        return (Play(False),)
    if cell == "compare":
        return (CompareMoves(not state[Plan].compared),)
    if cell == "frame":
        return (SetSwitch(FRAME.name, not FRAME.on(state)),)
    for find in (point_command, move_command, limit_command):
        if (found := find(state, cell, text)) is not None:
            return found
    return ()


def _head(fields: Fields, state: State) -> str:
    part, channel = state[Plan], fields.channel_id
    examples = examples_markup(channel, EXAMPLES, part.example)
    timeline = state[Timeline]
    playing = timeline.clip == CLIP_KEY and timeline.playing
    runs = planned(state) or last_planned(state)
    off = runs is None or runs.motion is None
    play = (
        button(channel, "pause-motion", "❚❚ Pause", "main")
        if playing
        else button(channel, "play-motion", "▶ Play", "main", off=off)
    )
    return f'{examples}<div class="bar">{play}{_shown(state, channel)}</div>{_held(state)}{_verdict(state)}'


def _shown(state: State, channel: str) -> str:
    """Return what can be drawn besides the way."""
    compared = state[Plan].compared
    hint = "Plan the same waypoints by joint moves instead of Cartesian ones, or the other way round: the thin way"
    return chip(channel, "compare", "Compare", hint, pressed=compared) + chip(
        channel, "frame", FRAME.title, FRAME.hint, pressed=FRAME.on(state)
    )


def _held(state: State) -> str:
    held = [str(i + 1) for i, locked in enumerate(state[Joints].locked) if locked]
    return f'<p class="warn">◐ held, and not moved: joint {", ".join(held)}</p>' if held else ""


def _verdict(state: State) -> str:
    """Return what the plan is worth; while it is being worked out, that of the last one would be untrue."""
    plan = planned(state)
    if plan is None:
        return '<div class="verdict dim"><b>… working it out</b></div>'
    said = judged(plan)
    lines = "".join(f"<p>{escaped(capitalised(line))}.</p>" for line in said.lines[:MOST_LINES])
    more = len(said.lines) - MOST_LINES
    lines += f"<p>… and {more} more.</p>" if more > 0 else ""
    return f'<div class="verdict {said.kind}"><b>{SIGNS[said.kind]} {escaped(capitalised(said.head))}</b>{lines}</div>'


PANEL = Panel(
    (Plan, Timeline, Joints, Target, Display, Notation, RobotPart), build, hides_then=in_the_way, around=way_around
)
