"""The plots of the curves: position, rate, acceleration and jerk, with knots, limits and violations."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.curves.made import Made, grid
from armlab.benches.motion.curves.state import MOST_CURVES, Curves
from armlab.benches.motion.curves.ui.words import COLOURS, SYMBOLS, unit
from armlab.kin.motion.peaks import Violation
from armlab.session.state import State
from armlab.ui.colours import GREY, VERDICT
from armlab.ui.columns import csv_of
from armlab.ui.plot import NOTHING, Curve, Plot
from armlab.ui.tray_picture import Picture
from armlab.ui.widgets import Gui

HEIGHT = 124

ROOM = 0.08
"""Room above and below the curves, relative to their extent."""

IN_SIGHT = 2.5
"""Ratio to the largest value up to which a limit is drawn; a higher one would flatten the curves."""

QUANTITIES = (None, "velocity", "acceleration", None)
FILES = ("q", "q_dot", "q_ddot", "q_dddot")

Array = NDArray[np.float64]


class CurvePlot(Plot):
    """The plot of one derivative: curves, red where they exceed a limit, and knots as dots."""

    def __init__(self, gui: Gui, order: int, of: str) -> None:
        self.order = order
        self._titles, self._quantity = tuple[str, ...](), self._heading(of)
        curves = [Curve(f"curve {i + 1}", colour) for i, colour in enumerate(COLOURS)]
        red = [Curve("beyond the limit", VERDICT["no"], 3.5, dots=True) for _ in COLOURS] if QUANTITIES[order] else []
        dots = [Curve("knots", GREY, 6.0, dots=True)] if order == 0 else []
        super().__init__(
            gui,
            self._heading(of),
            "t, s",
            (*curves, *red, *dots),
            FILES[order],
            limits=2 if red else 0,
            height=HEIGHT,
            legend=False,
        )

    def _heading(self, of: str) -> str:
        return f"{SYMBOLS[self.order]}, {unit(self.order, of)}"

    def show_curves(self, part: Curves, t: Array, every: Sequence[tuple[Made, Array, Sequence[Violation]]]) -> None:
        """Show the computed curves.

        Parameters
        ----------
        part : Curves
        t : ndarray, shape (N,)
        every : sequence of (Made, ndarray, violations)
            Each with its values of this derivative, (N,).
        """
        self._quantity = self._heading(part.unit)
        self.name(self._quantity)
        nothing = np.full(len(t), np.nan)
        curves: list[Array] = [nothing] * MOST_CURVES
        red: list[Array] = [nothing] * MOST_CURVES
        for made, values, violations in every:
            curves[made.drawn.colour] = values
            inside = [(v.start, v.end) for v in violations if v.quantity == QUANTITIES[self.order]]
            red[made.drawn.colour] = _within(t - made.start, values, inside)
        limit = {1: part.v_max, 2: part.a_max}.get(self.order)
        limits = () if limit is None else (limit, -limit)
        shown = [*curves, *(red if QUANTITIES[self.order] else ()), *([_knots(part, t)] if self.order == 0 else ())]
        self._titles = tuple(made.title for made, _, _ in every)
        self._columns = tuple(made.drawn.colour for made, _, _ in every)
        self._scale(t, shown, limits)
        self.show(t, shown, limits)

    def _scale(self, t: Array, shown: Sequence[Array], limits: Sequence[float]) -> None:
        """Choose the ranges, which the page cannot do for curves with gaps."""
        values = np.concatenate(shown)
        values = values[np.isfinite(values)]
        low, high = (float(values.min()), float(values.max())) if len(values) else (0.0, 1.0)
        size = max(abs(low), abs(high))
        for limit in limits:
            if abs(limit) <= IN_SIGHT * size:
                low, high = min(low, limit), max(high, limit)
        room = ROOM * (high - low) if high - low > NOTHING * max(1.0, abs(high)) else 0.5
        scales = {"x": {"time": False, "range": (float(t[0]), float(t[-1]))}, "y": {"range": (low - room, high + room)}}
        if self._handle.scales != scales:
            self._handle.scales = scales

    def picture(self) -> Picture | None:
        """Return the plot with the names of the curves."""
        found = super().picture()
        titles = (f"{i}: {title}" for i, title in enumerate(self._titles, 1))  # two curves may be of one kind
        names = dict(zip((self._curves[i].name for i in self._columns), titles, strict=True))
        return found and found.with_names(names)

    def csv(self) -> str:
        """Return the computed curves, with their names, the quantity and its unit."""
        columns = [self._table[0], *(self._table[1 + i] for i in self._columns)]
        return csv_of([self._x, *(f"{title}: {self._quantity}" for title in self._titles)], columns)

    _columns: tuple[int, ...] = ()


class Plots:
    """All four plots: that of q is there at once, those of its derivatives where `derivatives` is called."""

    def __init__(self, gui: Gui, state: State) -> None:
        self._gui, self._of = gui, state[Curves].unit
        self._plots = [CurvePlot(gui, 0, self._of)]
        self._shown: object = None

    def derivatives(self) -> None:
        """Add the plots of the derivatives."""
        with self._gui.fold("Rate, acceleration and jerk"):
            self._plots += [CurvePlot(self._gui, order, self._of) for order in (1, 2, 3)]

    def show(self, part: Curves) -> None:
        """Show the curves if they have changed."""
        drawn = (part.knots, part.curves, part.v_max, part.a_max, part.unit)
        if drawn == self._shown:
            return
        self._shown = drawn
        t = grid(part.knots)
        every = [(made, made.at(t), made.beyond(part.v_max, part.a_max)) for made in part.made]
        for order, plot in enumerate(self._plots):
            plot.show_curves(part, t, [(made, values[order], found) for made, values, found in every])


def _within(t: Array, values: Array, inside: Sequence[tuple[float, float]]) -> Array:
    """Return values inside intervals, and NaN elsewhere."""
    found = np.full(len(t), np.nan)
    step = float(t[-1] - t[0]) / len(t)
    for start, end in inside:
        # A moment that lies between two samples is seen, too.
        found = np.where((t >= start - step) & (t <= end + step), values, found)
    return found


def _knots(part: Curves, t: Array) -> Array:
    found = np.full(len(t), np.nan)
    times, q = np.array(part.knots).T
    found[np.abs(t[:, None] - times).argmin(axis=0)] = q
    return found
