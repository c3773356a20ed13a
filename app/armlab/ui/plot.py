"""Plots: curves over time or any other quantity, with units, limit lines, a cursor and export."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from armlab.session.state import Command
from armlab.ui.colours import VERDICT, css
from armlab.ui.columns import csv_of
from armlab.ui.curve import Curve as Curve
from armlab.ui.format import dot
from armlab.ui.html import Inside, tag
from armlab.ui.large import large_button
from armlab.ui.tray_picture import Drawn, Level, Picture

if TYPE_CHECKING:
    from armlab.ui.widgets import Gui

HEIGHT = 130
MOST_POINTS = 500
"""Largest number of points of a curve that are sent; more of them cannot be seen in a panel."""

NOTHING = 1e-9
"""Largest absolute value of a curve that is shown as zero, because it consists of rounding errors."""

TIME = "time"
"""Value for a cursor that follows the timeline."""


class Plot:
    """One plot of a panel; several curves share the axes.

    Parameters
    ----------
    gui : Gui
    title : str
        Markup of the heading: the quantity and its unit.
    x : str
        Name of the abscissa with its unit.
    curves : sequence of Curve
    limits : int
        How many limit lines there will be at most.
    file : str
        Name of the exported file, without its ending.
    height : int
        Pixels.
    from_zero : bool
        Whether the ordinate begins at 0, which the curves must not be below.
    legend : bool
        Whether several curves are named above the plot.
    clip : str
        Key of the clip whose time is the abscissa, in seconds; empty if it is another quantity.

    Attributes
    ----------
    on : bool
        Whether the plot is seen.
    file, clip : str
        As given.
    title : str or markup
        The heading.
    drawn : object
        Another one each time what is drawn has changed.
    at : float or None
        Value of x at which the cursor stands, unless it follows the timeline.
    """

    def __init__(
        self,
        gui: Gui,
        title: Inside,
        x: str,
        curves: Sequence[Curve],
        file: str,
        limits: int = 0,
        height: int = HEIGHT,
        from_zero: bool = False,
        legend: bool = True,
        clip: str = "",
    ) -> None:
        self._from_zero = from_zero
        self.on, self.file, self.clip, self.title, self.at = True, file, clip, title, cast(float | None, None)
        self._x, self._curves, self._limits = x, tuple(curves), limits
        self.drawn, self._levels = object(), tuple[float, ...]()
        self._table: tuple[NDArray[np.float64], ...] = ()
        self._gui, self._enlarge = gui, gui.enlarges(self)
        names = [tag("span", dot(css(curve.colour)), curve.name) for curve in self._curves]
        self._head = gui.form(lambda _: None)
        self._legend = tag("div.legend", names) if legend and len(self._curves) > 1 else None
        self.name(title)
        empty = np.array([0.0, 1.0])
        self._handle: Any = gui.uplot(
            tuple([empty] * (1 + len(self._curves) + limits)),
            self._series(),
            x,
            height,
        )
        self._cursor = gui.html()

    def _series(self) -> tuple[dict[str, Any], ...]:
        """Return the options with which the page draws abscissa, curves and limits."""
        limit = {"label": "limit", "stroke": css(VERDICT["no"]), "width": 1, "dash": [5, 4]}
        return ({"label": self._x}, *(curve.series for curve in self._curves), *[limit] * self._limits)

    def announce(self, curves: Sequence[Curve]) -> None:
        """Set other curves, possibly another number of them, from the next `show` on; for a plot without a legend."""
        self._curves = tuple(curves)

    def name(self, title: Inside) -> None:
        """Set the heading of the plot: the quantity and its unit."""
        self.title = title
        large = large_button(self._head, self._enlarge)
        save = self._head.button("csv", "CSV", self._saved, "copy", "Save the curves as a table")
        self._head.show(tag("h3", title, tag("span.copies", large, save)), self._legend)

    def _saved(self) -> tuple[Command, ...]:
        self.save()
        return ()

    def save(self) -> None:
        """Let the browser save the curves as a table."""
        self._gui.save(f"{self.file}.csv", self.csv())

    def name_x(self, x: str) -> None:
        """Set the name and unit of the abscissa."""
        if x == self._x:
            return
        self._x, self.drawn = x, object()
        first, *rest = self._handle.axes
        self._handle.axes = ({**first, "label": x}, *rest)

    def visible(self, on: bool) -> None:
        """Show or hide the whole plot."""
        self.on = on
        self._head.visible(on)
        self._cursor.visible(on)
        if self._handle.visible != on:
            self._handle.visible = on

    def show(
        self,
        x: NDArray[np.floating],
        curves: Sequence[NDArray[np.floating]],
        limits: Sequence[float] = (),
    ) -> None:
        """Show new curves.

        Parameters
        ----------
        x : ndarray, shape (N,)
            Rising.
        curves : sequence of ndarray, shape (N,)
            One for each `Curve`; what is not finite leaves a gap.
        limits : sequence of float
            Heights of the limit lines.

        Raises
        ------
        ValueError
            Not as many curves as were announced, or more limits.
        """
        if len(curves) != len(self._curves) or len(limits) > self._limits:
            raise ValueError(
                f"plot: expected {len(self._curves)} curves and at most {self._limits} limits, "
                f"got {len(curves)} and {len(limits)}"
            )
        self.drawn, self._levels = object(), tuple(limits)
        self._table = (np.asarray(x, dtype=float), *(np.asarray(curve, dtype=float) for curve in curves))
        pick = np.unique(np.linspace(0, len(x) - 1, min(len(x), MOST_POINTS)).round().astype(int))
        shown = [column[pick] for column in self._table]
        lines = [np.full(len(pick), level) for level in (*limits, *[np.nan] * (self._limits - len(limits)))]
        if self._from_zero:
            self._range(max((float(np.nanmax(c)) for c in (*shown[1:], *lines) if np.isfinite(c).any()), default=0.0))
        self._write(tuple(np.ascontiguousarray(column) for column in (*shown, *lines)))

    def _write(self, data: tuple[NDArray[np.float64], ...]) -> None:
        """Send the columns, so that the page never has a curve without its column."""
        series, before = self._series(), tuple(self._handle.series)
        if len(series) < len(before):
            self._handle.series = series
        # A list, in which the columns stay as they are; viser makes arrays of what it finds in a tuple.
        self._handle.data = [_with_gaps(column) for column in data]
        if series != before and len(series) >= len(before):
            self._handle.series = series

    def _range(self, most: float) -> None:
        scales = {"x": {"time": False}, "y": {"range": (0.0, 1.08 * most if most > NOTHING else 1.0)}}
        if self._handle.scales != scales:
            self._handle.scales = scales

    def cursor(self, at: float | str | None) -> None:
        """Put the cursor at a value of x, let it follow the timeline (`TIME`), or remove it (None, or outside)."""
        mark = at if isinstance(at, str) else ""
        self.at = None if isinstance(at, str) else at
        if isinstance(at, (int, float)) and self._table and len(self._table[0]):
            low, high = self._table[0][0], self._table[0][-1]
            if high > low and low <= at <= high:
                mark = f"{(at - low) / (high - low):.5f}"
        self._cursor.show(tag("i", hidden=True, data_cursor=mark))

    def picture(self) -> Picture | None:
        """Return what the tray draws of the plot, large; None while there is nothing."""
        if not self._table:
            return None
        x, *columns = self._table
        scales = self._handle.scales
        across, up = (scales.get(axis, {}).get("range") for axis in "xy")
        drawn = [
            Drawn(curve, x, column)
            for curve, column in zip(self._curves, columns, strict=True)
            if np.isfinite(column).any()
        ]
        levels = [Level("limit", value) for value in self._levels]
        return Picture(self.title, self._x, drawn, levels, across=across, up=up)

    def csv(self) -> str:
        """Return the curves as comma-separated values, with all points, and with names and units in the first line."""
        return csv_of([self._x, *(curve.name for curve in self._curves)], self._table)


def _with_gaps(column: NDArray[np.float64]) -> NDArray[np.float64] | list[float | None]:
    """Return a column so that the page leaves its gaps open.

    It would draw a line across NaN, and finds no range of a curve that begins with it.
    """
    there = np.flatnonzero(np.isfinite(column))
    if len(there) == 0 or there[-1] + 1 == len(there):
        return column
    return [value if finite else None for value, finite in zip(column.tolist(), np.isfinite(column), strict=True)]
