"""The page of geometry: one curve in space with its frame, and turning between two orientations."""

from __future__ import annotations

import numpy as np

from armlab.benches.motion.space_curve.stage import sphere_of, stage_of
from armlab.benches.motion.space_curve.state import SpaceCurve, curve_of
from armlab.benches.motion.space_curve.ui.form import curve_form, head, law_form, marks
from armlab.benches.motion.space_curve.ui.numbers import at_present, moving, whole
from armlab.benches.motion.space_curve.ui.plots import CurvePlots, TurnPlots
from armlab.benches.motion.space_curve.ui.turn import turn_form, turn_numbers, turn_words
from armlab.session.parts.notation import Notation
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Post, State
from armlab.ui.plugin import Panel, Points, Show
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the choice of an example, the form, the numbers and the plots."""
    top, form, numbers = gui.form(post), gui.form(post), gui.form(post)
    motion, words = gui.html(), gui.html()
    curve_plots, turn_plots = CurvePlots(gui, units_of(state)), TurnPlots(gui, units_of(state))

    def show(state: State) -> None:
        top.show(head(top, state))
        if state[SpaceCurve].shown == "curve":
            form.show(marks(form, state), curve_form(form, state), law_form(form, state))
            numbers.show(at_present(numbers, state))
            motion.show(moving(state))
            words.show(whole(state))
        else:
            form.show(turn_form(form, state), law_form(form, state))
            numbers.show(turn_numbers(numbers, state))
            motion.show()
            words.show(turn_words())
        curve_plots.show(state)
        turn_plots.show(state)

    return show


def _around(state: State) -> Points:
    """Return what must be in the picture: the curve with the ends of its frame, or a box around the sphere."""
    if state[SpaceCurve].shown == "turn":
        centre, radius = sphere_of(state)
        return np.asarray(centre + radius * np.array([[1.0, 1, 1], [-1, -1, -1]]))
    stage, frame = state.derived(stage_of), state.derived(curve_of).frame
    places = stage.at(frame.position)
    ends = [places + stage.length * axis for axis in (frame.tangent, frame.normal, frame.binormal)]
    return np.concatenate([places, *ends])


PANEL = Panel((SpaceCurve, Timeline, Notation, RobotPart), build, rebuilds=(Notation,), around=_around)
