"""The page of the screw motion between two poses: poses and screw to type, the film, and the straight way beside it."""

from __future__ import annotations

from functools import partial

import numpy as np

from armlab.benches.frames.chain.stage import box_of
from armlab.benches.frames.chain.state import FARTHEST, HANDLES
from armlab.benches.frames.chain.ui.page import HIDES
from armlab.benches.frames.chain.ui.posed import angle_row, length_row
from armlab.benches.frames.screw.examples import EXAMPLES, ChooseScrewExample
from armlab.benches.frames.screw.film import DURATION, film_time, part_of, ways_of
from armlab.benches.frames.screw.state import CLIP_KEY, NONE, POSES, Screw, SetPoseAngle, SetPosePosition
from armlab.benches.frames.screw.ui.numbers import screw_form, verdict, ways_markup
from armlab.session.fields import Set
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Post, State
from armlab.ui.examples import examples
from armlab.ui.form import Form
from armlab.ui.format import number
from armlab.ui.html import Inside, tag
from armlab.ui.matrices import MatrixView
from armlab.ui.playing import clock
from armlab.ui.plugin import Panel, Points, Show
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

FAR = 3.0
"""Distance of the axis from pose 1, in lengths of the straight way, beyond which it is not brought into the picture."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the fields of both poses, the screw, the clock, and the pose at present."""
    top = gui.form(post)
    view = MatrixView(gui, post)
    rest = gui.form(post)

    def show(state: State) -> None:
        found, s = state.derived(ways_of), part_of(state)
        top.show(
            examples(top, EXAMPLES, state[Screw].example, ChooseScrewExample, said=units_of(state).said),
            _poses(top, state),
            tag("h3", "The screw from pose 1 to pose 2"),
            verdict(state),
            screw_form(top, state),
            tag("div.fr-clock", clock(top, state, CLIP_KEY, DURATION, film_time(state))),
        )
        view.show(state, _title(state), found.at(s), 4, 3)
        rest.show(ways_markup(rest, state))

    return show


def _title(state: State) -> Inside:
    on = state[Timeline].clip == CLIP_KEY
    told = f"at {number(film_time(state), 2)} s" if on else "halfway"
    return "exp(s [S]) T₁ ", tag("small", f"{told}, p in m")


def _poses(form: Form, state: State) -> Inside:
    part, units = state[Screw], units_of(state)
    rows: list[Inside] = []
    for which, name in POSES.items():
        chosen = NONE if part.selected == which else which
        on = part.selected == which
        chip = form.chip(f"select {which}", name, Set(Screw, "selected", chosen), "Its handle in the scene", on)
        position = part.position1 if which == "first" else part.position2
        angles = part.angles1 if which == "first" else part.angles2
        rows += [
            length_row(form, f"position {which}", chip, position, units, partial(SetPosePosition, which), FARTHEST),
            angle_row(form, f"angle {which}", "roll pitch yaw", angles, units, partial(SetPoseAngle, which)),
        ]
    handle = form.chips("handle", HANDLES, part.handle, "What dragging does", partial(Set, Screw, "handle"))
    return tag("h3", "Two poses in the world ", tag("span.copies", handle)), rows


def around(state: State) -> Points:
    """Return the corners (2, 3) of what belongs in the picture: both ways, and the foot on the axis."""
    found = state.derived(ways_of)
    way = found.at(np.linspace(0.0, 1.0, 9))[:, :3, 3]
    places = np.vstack([way, found.first[:3, 3], found.second[:3, 3], np.zeros(3), near_foot(state)])
    return box_of(places, 0.15)


def near_foot(state: State) -> Points:
    """Return the foot on the axis, or pose 1 if the axis is so far away that its picture would show nothing else."""
    found = state.derived(ways_of)
    far = found.radius > FAR * max(found.chord, 0.1)
    return found.first[:3, 3] if far else found.foot


PANEL = Panel(
    (Screw, Timeline),
    build,
    rebuilds=(Notation,),
    hides=HIDES,
    around=around,
    looks=lambda state: state[Screw].example,
)
