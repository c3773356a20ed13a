"""The page for velocities: the speed of each joint, J as vectors, and the resulting motion of tool and links."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from armlab.benches.velocity.speeds.clip import LONGEST
from armlab.benches.velocity.speeds.commands import (
    DrawVelocities,
    MoveAlone,
    SetAllSpeeds,
    Unfold,
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
from armlab.benches.velocity.speeds.ui.scene_swept import SWITCH as SWEPT
from armlab.benches.velocity.speeds.ui.sliders import SpeedSliders, dotted
from armlab.benches.velocity.speeds.ui.words import in_words
from armlab.session.fields import Set
from armlab.session.parts.display import Display
from armlab.session.parts.display import Show as SetSwitch
from armlab.session.parts.joints import Joints
from armlab.session.parts.selection import Selection
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Command, Post, State
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import mathml, number
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.matrices import MatrixView
from armlab.ui.playing import play_button
from armlab.ui.plugin import Panel, Points, Show
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

MARGIN = 1.5
"""Length of an arrow with its label, in lengths of the arrow."""

AXES = {"world": "world", "base": "base", "tool": "tool"}

FRAMES = {"world": "w", "base": "0", "tool": "E"}

MOST_WIDE = 6
"""Largest number of columns of J with room for a third decimal."""

MARKS = {
    "v": ("v", "What each joint gives to v, tip to tail, their sum, and ω"),
    "omega": ("ω parts", "What each joint gives to ω, tip to tail"),
    "points": ("two points", "v₁, v₂ and ω × r₁₂ of two points of a link"),
}


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the examples, the sliders, J, the sum and the folded parts."""
    top = gui.form(post)
    sliders = SpeedSliders(gui, state, post, units_of(state))
    below, axes = gui.form(post), gui.form(post)
    matrix = MatrixView(gui, post, MATRIX)
    words, total = gui.html(), gui.html()
    points, higher = gui.form(post), gui.form(post)

    def show(state: State) -> None:
        moving = state.derived(moving_of)
        top.show(head_markup(top, state))
        sliders.show(state)
        below.show(below_markup(below, state))
        axes.show(axes_markup(axes, state))
        decimals = 3 if moving.J.shape[1] <= MOST_WIDE else 2
        matrix.show(state, _title(state), moving.matrix, decimals, None, columns_of(state), ROWS)
        words.show(tag("p.dim.ve-said", in_words(state, moving)))
        total.show(size_markup(state), sum_markup(state))
        points.show(folded_markup("points", "Two points of a link", points, state, points_markup))
        higher.show(
            folded_markup("higher", "Acceleration and jerk", higher, state, lambda _, state: higher_markup(state))
        )

    return show


def head_markup(form: Form, state: State) -> Markup:
    """Return the examples, the button of the film, and the switches for what is drawn."""
    chooser = examples(form, EXAMPLES, state[Velocity].example, ChooseVelocityExample)
    every = form.chip("all", "all", SetAllSpeeds(True), "Each with its usual speed")
    none = form.chip("none", "none", SetAllSpeeds(False), "q̇ = 0")
    hint = "Move the joints with these speeds, until one is at a limit"
    play = play_button(form, state, CLIP_KEY, "speeds", "Drive", hint=hint)
    last = first_at_limit(state)
    told = "All joints are at rest." if last is None else _until(last, time_left(state))
    title = tag("h3", "Joint speeds", tag("span.copies", every, none))
    return joined(chooser, title, tag("div.bar", play, tag("span.dim", told)))


def _until(joint: int, seconds: float) -> str:
    """Return in words when the drive ends."""
    if seconds > LONGEST:
        return f"No joint at its limit within {LONGEST:g} s."
    return f"Joint {joint + 1} at its limit in {number(seconds, 1)} s."


def below_markup(form: Form, state: State) -> Markup:
    """Return the choice of one joint alone, and of the marks in the scene."""
    part, arm, units = state[Velocity], state[Joints].arm, units_of(state)
    moving = [i for i, speed in enumerate(part.qdot) if speed]
    alone = [
        form.chip(f"alone {i}", dotted(arm, i, units), MoveAlone(i), "Move only this joint", moving == [i])
        for i in range(arm.n)
    ]
    drawn = [
        _switch(form, f"mark {name}", text, partial(DrawVelocities, name), hint, name in part.marks)
        for name, (text, hint) in MARKS.items()
    ]
    way = "The path of the tool if only this joint moved"
    swept = _switch(form, "swept", "γ", partial(SetSwitch, SWEPT.name), way, SWEPT.on(state))
    return joined(_bar("One alone", alone), _bar("In the scene", drawn, swept))


def _bar(name: str, *chips: Inside) -> Markup:
    return tag("div.bar", tag("span.dim", name), chips)


def _switch(form: Form, cell: str, text: str, switched: Callable[[bool], Command], hint: str, on: bool) -> Markup:
    return form.chip(f"{cell} {'off' if on else 'on'}", text, switched(not on), hint, on)


def axes_markup(form: Form, state: State) -> Markup:
    """Return the choice of the axes of J."""
    chosen = form.chips(
        "axes", AXES, state[Velocity].axes, "In whose axes the rows of J are", partial(Set, Velocity, "axes")
    )
    return _bar("J in the axes of", chosen)


def _title(state: State) -> Markup:
    frame = FRAMES[state[Velocity].axes]
    units = "m or 1 above, 1 below" if not state[Joints].arm.revolute.all() else "m above, 1 below"
    return joined(tag("span.ve-j", mathml(f"{{}}^{{{frame}}}J(q)")), " ", tag("small", units))


def folded_markup(key: str, title: str, form: Form, state: State, markup: Callable[[Form, State], Inside]) -> Markup:
    """Return a part of the page that is folded until the student opens it."""
    open_now = key in state[Velocity].unfolded
    head = form.button(
        f"fold {key} {'off' if open_now else 'on'}",
        title,
        Unfold(key, not open_now),
        "kit-unfolds",
        aria_expanded=str(open_now).lower(),
    )
    return joined(head, markup(form, state) if open_now else None)


def _around(state: State) -> Points:
    """Return the tips of v and omega, which must be inside the picture."""
    moving, part = state.derived(moving_of), state[Velocity]
    scales = drawn_scales(state[Joints].arm, part.qdot)
    tips = [moving.point + MARGIN * scales[k] * moving.twist[3 * k : 3 * k + 3] for k in range(2)]
    return np.asarray(tips)


PANEL = Panel((Velocity, Joints, Selection, Timeline, Display), build, see_through=True, around=_around)
