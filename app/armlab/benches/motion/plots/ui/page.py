"""Plots of the planned motion over time, its peaks, the exceeded limits, and the other kind of moves beside it."""

from __future__ import annotations

from armlab.benches.motion.plan.limits import CompareMoves
from armlab.benches.motion.plan.question import Planned
from armlab.benches.motion.plan.state import CLIP_KEY, Plan, last_planned
from armlab.benches.motion.plan.ui.around import in_the_way, way_around
from armlab.benches.motion.plots.drawn import (
    can_compare,
    compared,
    kind_of,
)
from armlab.benches.motion.plots.state import MotionPlots, Quantity, ShowMotionPlot
from armlab.benches.motion.plots.ui.curves import IN_SIGHT, NEAR, MotionPlot, Times
from armlab.benches.motion.plots.ui.lines import DOTS, Slot, from_zero, lines_of, most_of, slots
from armlab.benches.motion.plots.ui.words import OTHERS, comparison, legend, peaks_table, status
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Post, State
from armlab.ui.markup import row
from armlab.ui.plugin import Panel, Show
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

CHIPS: dict[Quantity, tuple[str, str]] = {
    "q": ("q", "Joint positions"),
    "q_dot": (f"q{DOTS[1]}", "Joint velocities"),
    "q_ddot": (f"q{DOTS[2]}", "Joint accelerations"),
    "jerk": ("jerk", "Rate of change of the accelerations"),
    "s": ("s", "Path parameter, from 0 to 1 in each move"),
    "speed": ("tool speed", "Speed of the tool point"),
    "curvature": ("curvature", "Curvature of the path of the tool point"),
    "load": ("load", "Velocities and accelerations as shares of their limits"),
}


class _Answer:
    """The planned motion on screen, and the one for comparison."""

    def __init__(self) -> None:
        self.planned: Planned | None = None
        self.other: Planned | None = None

    def of(self, planned: Planned | None, other: Planned | None) -> bool:
        """Set these motions; return whether they have changed."""
        same = planned is self.planned and other is self.other
        self.planned, self.other = planned, other
        return not same


def _plot(gui: Gui, slot: Slot) -> MotionPlot:
    return MotionPlot(gui, slot.title, slot.file, from_zero(slot), NEAR if slot.quantity == "q" else IN_SIGHT)


class _Page:
    """The controls of the page."""

    def __init__(self, gui: Gui, state: State, post: Post) -> None:
        self._choice = gui.form(post)
        self._status, self._beside, self._legend = gui.html(), gui.html(), gui.html()
        units = units_of(state)
        self._slots = slots(state[Joints].arm, units)
        self._plots = [_plot(gui, slot) for slot in self._slots]
        self._peaks = gui.html()
        self._answer = _Answer()
        self._drawn: object = None

    def show(self, state: State) -> None:
        """Show a state; curves are sent only if they have changed."""
        planned = last_planned(state)
        other = None if planned is None else compared(state, planned)
        new = self._answer.of(planned, other)
        drawn = (state[MotionPlots], state[Plan].compared, can_compare(state))
        changed, self._drawn = new or drawn != self._drawn, drawn
        if changed or self._choice.stale:
            self._choose(state)
        if changed:
            self._tell(state)
            self._draw(state)
        self._place_cursors(state)

    def _choose(self, state: State) -> None:
        form, shown, planned = self._choice, state[MotionPlots].shown, self._answer.planned
        chips = [
            form.chip(key, text, ShowMotionPlot(key, key not in shown), hint, key in shown)
            for key, (text, hint) in CHIPS.items()
        ]
        name = OTHERS["mixed" if planned is None else kind_of(planned.question)]
        can = can_compare(state)
        hint = "Plan the same waypoints by these moves as well" if can else "A motion read from a file has no moves"
        on = state[Plan].compared
        compare = form.chip("compare", name, CompareMoves(not on), hint, on and can, off=not can)
        form.show(row("Show", chips), row("Compare", compare))

    def _tell(self, state: State) -> None:
        planned, other, units = self._answer.planned, self._answer.other, units_of(state)
        on = state[Plan].compared and can_compare(state)
        own, theirs = None if planned is None else planned.figures, None if other is None else other.figures
        self._status.show(status(planned, own, () if planned is None else planned.overruns))
        self._legend.show(None if planned is None or own is None else legend(planned, units, on))
        self._peaks.show(None if planned is None or own is None else peaks_table(planned, own, units))
        self._beside.show(None if planned is None or not on else comparison(planned, own, other, theirs, units))

    def _draw(self, state: State) -> None:
        planned, other, units = self._answer.planned, self._answer.other, units_of(state)
        samples, shown = None if planned is None else planned.samples, state[MotionPlots].shown
        beside = None if other is None else other.samples
        for slot, plot in zip(self._slots, self._plots, strict=True):
            there = planned is not None and samples is not None and slot.quantity in shown
            if there and slot.quantity == "s" and planned is not None:
                # A motion read from a file runs along no path with a parameter.
                there = planned.question.recorded is None
            plot.visible(there)
            if planned is None or samples is None or not there:
                continue
            times = Times(samples.t, None if beside is None else beside.t, planned.boundaries)
            lines = lines_of(slot, planned, samples, other, planned.overruns, units)
            plot.draw(times, lines, most_of(slot, planned.question.arm, lines))

    def _place_cursors(self, state: State) -> None:
        timeline, planned = state[Timeline], self._answer.planned
        on = timeline.clip == CLIP_KEY and planned is not None
        shown = state[MotionPlots].shown
        for slot, plot in zip(self._slots, self._plots, strict=True):
            if slot.quantity in shown:
                plot.at_time(timeline.time if on else None, 0.0 if planned is None else planned.duration)


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the choice, the plots and the tables."""
    return _Page(gui, state, post).show


PANEL = Panel((Plan, MotionPlots, Joints, Timeline), build, hides_then=in_the_way, around=way_around)
