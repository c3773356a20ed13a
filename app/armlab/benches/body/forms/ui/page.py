"""The page of a body that the student turns: its rotation in all forms, each of which can be typed."""

from __future__ import annotations

from armlab.benches.body.forms.stage import around
from armlab.benches.body.forms.state import Body
from armlab.benches.body.forms.ui.count import count_markup
from armlab.benches.body.forms.ui.numbers import (
    angles_markup,
    axis_markup,
    matrix_markup,
    places_markup,
    quaternion_markup,
)
from armlab.session.parts.notation import Notation
from armlab.session.state import Post, State
from armlab.ui.html import tag
from armlab.ui.plugin import OF_THE_ARM, Panel, Show
from armlab.ui.widgets import Gui

HIDES = (*OF_THE_ARM, "gizmo", "gap")
"""Layers in whose place the body is drawn."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the fields of all forms."""
    form = gui.form(post)

    def show(state: State) -> None:
        form.show(
            tag("h3", "Turn the body ", tag("small", "by its rings in the scene, or type any form")),
            places_markup(form),
            tag("h3", "Three angles"),
            angles_markup(form, state),
            axis_markup(form, state),
            quaternion_markup(form, state),
            matrix_markup(form, state),
            count_markup(state),
        )

    return show


PANEL = Panel((Body,), build, rebuilds=(Notation,), hides=HIDES, around=around)
