"""A plot that compares runs: a curve for each, for any number of them."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import partial
from html import unescape
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from armlab.session.state import Post
from armlab.ui.colours import RUN_COLOURS
from armlab.ui.columns import csv_of
from armlab.ui.html import Inside, Markup, joined, tag
from armlab.ui.plot import NOTHING, Curve, Plot
from armlab.ui.widgets import Gui

HEIGHT = 104

ROOM = 0.08
"""Room above and below the curves, relative to their extent."""

Array = NDArray[np.float64]

Values = Callable[[Any], Array | None]
"""Function that returns the curve of a run, or None if it has none."""


def in_words(markup: Inside) -> str:
    """Return the words of markup, without its formulas.

    >>> in_words(tag("span", "Smallest ", tag("math", "s"), ", m"))
    'Smallest, m'
    """
    text = re.sub(r"(?s)<math.*?</math>", "", joined(markup))
    return re.sub(r"\s+(?=,|$)", "", unescape(re.sub(r"<[^>]+>", "", text)))


class _Noted:
    """A maker of controls that remembers them, so that a whole plot can be hidden."""

    def __init__(self, gui: Gui) -> None:
        self._gui, self._made, self.hidden = gui, list[Callable[[bool], None]](), False

    def form(self, post: Post) -> Any:
        form = self._gui.form(post)
        self._made.append(form.visible)
        return form

    def uplot(self, *arguments: Any) -> Any:
        handle = self._gui.uplot(*arguments)
        self._made.append(partial(setattr, handle, "visible"))
        return handle

    def html(self, *inside: Inside) -> Any:
        element = self._gui.html(*inside)
        self._made.append(element.visible)
        return element

    def save(self, name: str, text: str) -> None:
        self._gui.save(name, text)

    def enlarges(self, plot: Plot) -> Callable[[], None]:
        return self._gui.enlarges(plot)

    def visible(self, on: bool) -> None:
        if self.hidden == on:
            self.hidden = not on
            for show in self._made:
                show(on)


class RunPlot(Plot):
    """A plot with a curve for each present run, for any number of them."""

    def __init__(
        self, gui: Gui, title: Inside, file: str, values: Values, from_zero: bool = False, clip: str = ""
    ) -> None:
        self.values, self._zero = values, from_zero
        self._noted = _Noted(gui)
        self._there: tuple[int, ...] = ()
        curves = [Curve(f"run {i + 1}", colour) for i, colour in enumerate(RUN_COLOURS)]
        # The list of runs above is the legend; the plot's own would name runs that are not there.
        self._title, self._unit = title, ""
        super().__init__(cast(Gui, self._noted), self._heading(""), "", curves, file, height=HEIGHT, clip=clip)

    def _heading(self, unit: str) -> Markup:
        return tag("span.kit-plot", self._title, f", {unit}" if unit else None)

    def name_unit(self, unit: str) -> None:
        """Set the unit of the quantity; none for a pure number."""
        self._unit = unit
        self.name(self._heading(unit))

    def visible(self, on: bool) -> None:
        """Show or hide the whole plot."""
        self.on = on
        self._noted.visible(on)

    def show_runs(self, x: Array, curves: Sequence[Array | None]) -> None:
        """Show a curve for each run, by their places in the list; None for a run without one."""
        self._there = tuple(i for i, curve in enumerate(curves) if curve is not None)
        nothing = np.full(len(x), np.nan)
        every: list[Array] = [nothing] * len(RUN_COLOURS)
        for i in self._there:
            every[i] = cast(Array, curves[i])
        self._scale(x, every)
        self.show(x, every)

    def _scale(self, x: Array, curves: Sequence[Array]) -> None:
        """Choose the ranges, which the page cannot do for curves that end."""
        values = np.concatenate(curves)
        values = values[np.isfinite(values)]
        low, high = (float(values.min()), float(values.max())) if len(values) else (0.0, 1.0)
        if self._zero:
            low = 0.0
        room = ROOM * (high - low) if high - low > NOTHING * max(1.0, abs(high)) else 0.5
        y = {"range": (low if self._zero else low - room, high + room)}
        scales = {"x": {"time": False, "range": (float(x[0]), float(x[-1]))}, "y": y}
        if self._handle.scales != scales:
            self._handle.scales = scales

    def csv(self) -> str:
        """Return the curves of the present runs, each with the number of the run, the quantity and its unit."""
        quantity = in_words(self._heading(self._unit))
        columns = [self._table[k] for k in (0, *(1 + i for i in self._there))] if self._table else []
        return csv_of([self._x, *(f"run {i + 1}: {quantity}" for i in self._there)], columns)
