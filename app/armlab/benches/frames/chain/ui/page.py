"""The page of a chain of frames: frames to place, the transform between any two, and a point in all of them."""

from __future__ import annotations

from armlab.benches.frames.chain.examples import EXAMPLES, ChooseChainExample
from armlab.benches.frames.chain.stage import around, places_of, unit_of
from armlab.benches.frames.chain.state import Chain
from armlab.benches.frames.chain.tree import pair_of
from armlab.benches.frames.chain.ui.frames import frames_markup
from armlab.benches.frames.chain.ui.point import counts_markup, point_markup
from armlab.benches.frames.chain.ui.product import DECIMALS, RULE, inverse_markup, pair_markup, title_of
from armlab.session.parts.display import Display
from armlab.session.parts.notation import Notation
from armlab.session.state import Post, State
from armlab.ui.examples import examples
from armlab.ui.matrices import MatrixView
from armlab.ui.plugin import OF_THE_ARM, Panel, Show
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

HIDES = (*OF_THE_ARM, "gizmo", "gap")
"""Layers in whose place the frames are drawn."""


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the fields of the frames, the matrix of the pair, and the fields of the point."""
    top = gui.form(post)
    view = MatrixView(gui, post)
    rest = gui.form(post)

    def show(state: State) -> None:
        found = state.derived(pair_of)
        top.show(
            examples(top, EXAMPLES, state[Chain].example, ChooseChainExample, said=units_of(state).said),
            frames_markup(top, state),
            pair_markup(top, state),
        )
        view.show(state, title_of(found), found.T, DECIMALS, RULE)
        rest.show(point_markup(rest, state), inverse_markup(state), counts_markup(rest, state))

    return show


def looks(state: State) -> tuple[str, int, float]:
    """Return what there is to look at: another example, another number of frames, or a picture of another size."""
    part = state[Chain]
    return part.example, len(part.frames), round(unit_of(state.derived(places_of)), 3)


PANEL = Panel((Chain, Display), build, rebuilds=(Notation,), hides=HIDES, around=around, looks=looks)
