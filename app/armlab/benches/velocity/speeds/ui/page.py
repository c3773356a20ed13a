"""Velocities: the speed of each joint, J as vectors, and what they make of the tool and of the links."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from armlab.benches.velocity.speeds.clip import LONGEST
from armlab.benches.velocity.speeds.commands import (
    DrawVelocities,
    LookAtLink,
    MoveAlone,
    SetAllSpeeds,
    SetLinkPoint,
    Unfold,
    WriteJacobianIn,
)
from armlab.benches.velocity.speeds.examples import EXAMPLES, ChooseVelocityExample
from armlab.benches.velocity.speeds.motion import first_at_limit, moving_of, time_left
from armlab.benches.velocity.speeds.state import CLIP_KEY, MATRIX, Velocity, drawn_scales
from armlab.benches.velocity.speeds.ui.numbers import (
    ROWS,
    columns_of,
    higher_markup,
    points_markup,
    size_markup,
    sum_markup,
)
from armlab.benches.velocity.speeds.ui.sliders import SpeedSliders, dotted
from armlab.benches.velocity.speeds.ui.words import in_words
from armlab.session.parts.display import Display
from armlab.session.parts.display import Show as SetSwitch
from armlab.session.parts.joints import Joints
from armlab.session.parts.selection import Selection
from armlab.session.parts.timeline import OpenClip, Play, Timeline
from armlab.session.state import Command, Post, State
from armlab.ui.examples import examples_markup
from armlab.ui.fields import Fields
from armlab.ui.format import mathml, number
from armlab.ui.markup import button, chip, chips
from armlab.ui.matrices import MatrixView
from armlab.ui.plugin import Panel, Points, Show
from armlab.ui.scene.swept import SWITCH as SWEPT
from armlab.ui.tried import tried
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

MARGIN = 1.2
"""Of an arrow with its label, in lengths of the arrow."""

AXES = {"axes world": "world", "axes base": "base", "axes tool": "tool"}

FRAMES = {"world": "w", "base": "0", "tool": "E"}

LONGEST_INDEX = 3
"""Digits of a place in a list."""

MOST_WIDE = 6
"""Columns of J for whose third decimal there is room."""

MARKS = {
    "v": ("v", "What each joint gives to v, tip to tail, their sum, and ω"),
    "omega": ("ω parts", "What each joint gives to ω, tip to tail"),
    "points": ("two points", "v₁, v₂ and ω × r₁₂ of two points of a link"),
}


def build(gui: Gui, state: State, post: Post) -> Show:
    """Make the examples, the sliders, J, the sum and the folded rest."""
    present, units = state, units_of(state)

    def typed(fields: Fields, cell: str, text: str) -> None:
        if not tried(fields, cell, text, lambda: commands(present, cell, text), present, post):
            show(present)

    top = gui.fields(lambda cell, text: typed(top, cell, text))
    sliders = SpeedSliders(gui, state, post, units)
    below = gui.fields(lambda cell, text: typed(below, cell, text))
    axes = gui.fields(lambda cell, text: typed(axes, cell, text))
    matrix = MatrixView(gui, post, MATRIX)
    words, total = gui.html(), gui.html()
    points = gui.fields(lambda cell, text: typed(points, cell, text))
    higher = gui.fields(lambda cell, text: typed(higher, cell, text))

    def show(state: State) -> None:
        nonlocal present
        present = state
        moving = state.derived(moving_of)
        top.show(_head(top, state))
        sliders.show(state)
        below.show(_below(below, state))
        axes.show(_axes(axes, state))
        decimals = 3 if moving.J.shape[1] <= MOST_WIDE else 2
        matrix.show(state, _title(state), moving.matrix, decimals, None, columns_of(state), ROWS)
        words.show(f'<p class="dim ve-said">{in_words(state, moving)}</p>')
        total.show(sum_markup(state) + size_markup(state))
        points.show(_folded("points", "Two points of a link", points, state, points_markup))
        higher.show(_folded("higher", "Acceleration and jerk", higher, state, lambda _, state: higher_markup(state)))

    return show


def _head(fields: Fields, state: State) -> str:
    """Return the examples, what plays, and what is drawn."""
    part, channel, timeline = state[Velocity], fields.channel_id, state[Timeline]
    examples = examples_markup(channel, EXAMPLES, part.example)
    both = chip(channel, "all", "all", "Each with its usual speed") + chip(channel, "none", "none", "q̇ = 0")
    on = timeline.clip == CLIP_KEY
    cell, text = ("pause", "❚❚ Pause") if on and timeline.playing else ("drive", "▶ Drive")
    last = first_at_limit(state)
    play = button(channel, cell, text, "main", "Move the joints with these speeds, until one is at a limit")
    told = "All joints stand still." if last is None else _until(last, time_left(state))
    return (
        f'{examples}<h3>Joint speeds<span class="copies">{both}</span></h3>'
        f'<div class="bar">{play}<span class="dim">{told}</span></div>'
    )


def _until(joint: int, seconds: float) -> str:
    """Return when the drive ends."""
    if seconds > LONGEST:
        return f"No joint at its limit within {LONGEST:g} s."
    return f"Joint {joint + 1} at its limit in {number(seconds, 1)} s."


def _below(fields: Fields, state: State) -> str:
    """Return one joint alone, all or none, and what is drawn in the scene."""
    part, channel, arm, units = state[Velocity], fields.channel_id, state[Joints].arm, units_of(state)
    moving = [i for i, speed in enumerate(part.qdot) if speed]
    alone = "".join(
        chip(channel, f"alone {i}", dotted(arm, i, units), "Move this joint alone", moving == [i]) for i in range(arm.n)
    )
    drawn = "".join(
        chip(channel, f"mark {name} {'off' if name in part.marks else 'on'}", text, hint, name in part.marks)
        for name, (text, hint) in MARKS.items()
    )
    swept = SWEPT.on(state)
    drawn += chip(
        channel, f"swept {'off' if swept else 'on'}", "γ", "The way of the tool if one joint alone moved", swept
    )
    return (
        f'<div class="bar"><span class="dim">One alone</span>{alone}</div>'
        f'<div class="bar"><span class="dim">In the scene</span>{drawn}</div>'
    )


def _axes(fields: Fields, state: State) -> str:
    hint = "In whose axes the rows of J are"
    chosen = chips(fields.channel_id, AXES, f"axes {state[Velocity].axes}", hint)
    return f'<div class="bar"><span class="dim">J in the axes of</span>{chosen}</div>'


def _title(state: State) -> str:
    frame = FRAMES[state[Velocity].axes]
    units = "m or 1 above, 1 below" if not state[Joints].arm.revolute.all() else "m above, 1 below"
    return f'<span class="ve-j">{mathml(f"{{}}^{{{frame}}}J(q)")}</span> <small>{units}</small>'


def _folded(key: str, title: str, fields: Fields, state: State, markup: Callable[[Fields, State], str]) -> str:
    """Return a part of the page that is folded away until it is asked for."""
    open_now = key in state[Velocity].unfolded
    head = button(
        fields.channel_id,
        f"fold {key} {'off' if open_now else 'on'}",
        f"{'▾' if open_now else '▸'} {title}",
        "ve-fold",
        aria_expanded=str(open_now).lower(),
    )
    return head + (markup(fields, state) if open_now else "")


def commands(state: State, cell: str, text: str) -> tuple[Command, ...]:
    """Return what a person asked for; none for what no page of ours sends.

    Raises
    ------
    InputError
        What was typed is no length; the text names the point.
    """
    name, _, rest = cell.partition(" ")
    what, _, switch = rest.partition(" ")
    on = switch == "on" if switch else what == "on"
    if name == "point":
        return _point(state, rest, text)
    simple: dict[str, Callable[[], tuple[Command, ...]]] = {
        "example": lambda: (ChooseVelocityExample(text),) if text else (),
        "drive": lambda: (Play(True),) if state[Timeline].clip == CLIP_KEY else (OpenClip(CLIP_KEY, play=True),),
        "pause": lambda: (Play(False),),
        "alone": lambda: (MoveAlone(int(rest)),) if _index(rest) else (),
        "all": lambda: (SetAllSpeeds(True),),
        "none": lambda: (SetAllSpeeds(False),),
        "axes": lambda: (WriteJacobianIn(rest),),
        "mark": lambda: (DrawVelocities(what, on),),
        "swept": lambda: (SetSwitch(SWEPT.name, on),),
        "link": lambda: (LookAtLink(int(text)),) if _index(text) else (),
        "fold": lambda: (Unfold(what, on),),
    }
    return simple[name]() if name in simple else ()


def _index(text: str) -> bool:
    """Return whether a text is a place in a list; longer ones are none of a page of ours."""
    return text.isdecimal() and len(text) <= LONGEST_INDEX


def _point(state: State, rest: str, text: str) -> tuple[Command, ...]:
    """Return the command of a typed coordinate."""
    numbers = [int(each) for each in rest.split() if _index(each)]
    if len(numbers) != 2 or numbers[0] > 1 or numbers[1] > 2:
        return ()
    which, k = numbers
    xyz = list(state[Velocity].points[which])
    xyz[k] = units_of(state).read(text, False, f"point {which + 1}, {'xyz'[k]}")
    x, y, z = xyz
    return (SetLinkPoint(which, (x, y, z)),)


def _around(state: State) -> Points:
    """Return the tips of v and omega, which belong in the picture."""
    moving, part = state.derived(moving_of), state[Velocity]
    scales = drawn_scales(state[Joints].arm, part.qdot)
    tips = [moving.point + MARGIN * scales[k] * moving.twist[3 * k : 3 * k + 3] for k in range(2)]
    return np.asarray(tips)


PANEL = Panel((Velocity, Joints, Selection, Timeline, Display), build, see_through=True, around=_around)
