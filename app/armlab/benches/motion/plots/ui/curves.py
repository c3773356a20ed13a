"""One plot of a planned motion: its curves, those for comparison, limits, violations, and the legs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.plan.state import CLIP_KEY
from armlab.ui.colours import GREY, VERDICT, Rgb
from armlab.ui.columns import csv_of
from armlab.ui.html import Inside
from armlab.ui.plot import NOTHING, TIME, Curve, Plot
from armlab.ui.tray_picture import Drawn, Level, Picture
from armlab.ui.widgets import Gui

HEIGHT = 124

POINTS = 401
"""Number of points of a curve in the plot; the file has all samples."""

ROOM = 0.08
"""Room above and below the curves, relative to their extent."""

IN_SIGHT = 0.6
"""Distance from the curves, relative to their extent, up to which a limit of a rate is drawn; a farther one would
flatten them. A limit of joint positions, whose curves lie apart, would do so from `NEAR` on."""

NEAR = 0.1

ORDINATE = {"size": 52, "space": 16, "gap": 3, "ticks": {"size": 4}}
"""Settings of the axis: room for accelerations in mm/s², and marks close to each other in low plots."""

OTHER, OTHER_DASHED, LIMIT = (2, 3), (2, 3, 2, 9), (7, 4)
"""Dashes of the curves for comparison, of those beside curves that are dashed themselves, and of limits."""

MET = 1e-3
"""Share of a limit that may be left when it counts as met."""

Array = NDArray[np.float64]
Spans = Sequence[tuple[float, float]]


@dataclass(frozen=True, eq=False)
class Line:
    """One curve of a plot.

    Attributes
    ----------
    name : str
        With its unit.
    colour : (int, int, int)
    values : ndarray, shape (k,)
        In the unit of the plot, at the samples of the motion.
    other : ndarray, shape (m,), or None
        The same of the motion it is compared with, at the samples of that.
    limits : tuple of float
    beyond : sequence of (float, float)
        When it is beyond its limits, seconds.
    both : bool
        Whether the limits are one limit in both directions, drawn as two lines or not at all.
    dash : tuple of int
        As of `Curve`: of a joint whose colour is that of another one, too.
    """

    name: str
    colour: Rgb
    values: Array
    other: Array | None = None
    limits: tuple[float, ...] = ()
    beyond: Spans = ()
    both: bool = False
    dash: tuple[int, ...] = ()

    def in_sight(self, low: float, high: float, sight: float) -> tuple[float, ...]:
        """Return the visible limits.

        Parameters
        ----------
        low, high : float
            Ends of all curves of the plot.
        sight : float
            How far beyond them a limit may be, in parts of what they span; a limit in both directions, at each end.
        """
        span = high - low
        if not self.both:
            return tuple(level for level in self.limits if low - sight * span <= level <= high + sight * span)
        least, most = min(self.limits, default=0.0), max(self.limits, default=0.0)
        met = low <= (1.0 - MET) * least or high >= (1.0 - MET) * most
        return self.limits if met or max(high, most) - min(low, least) <= (1.0 + 2.0 * sight) * span else ()


@dataclass(frozen=True, eq=False)
class Times:
    """The times of a plot.

    Attributes
    ----------
    own : ndarray, shape (k,)
        Samples of the motion, seconds.
    other : ndarray, shape (m,), or None
        Samples of the one it is compared with.
    legs : tuple of float
        When one leg ends and the next begins.
    """

    own: Array
    other: Array | None = None
    legs: tuple[float, ...] = ()

    @property
    def end(self) -> float:
        """The end of the longer motion, seconds."""
        return float(max(self.own[-1], -np.inf if self.other is None else self.other[-1]))

    def grid(self, count: int) -> Array:
        """Return evenly spaced times, shape (count,)."""
        return np.linspace(0.0, self.end, count)


class MotionPlot(Plot):
    """The plot of one quantity of a motion."""

    def __init__(self, gui: Gui, title: str, file: str, from_zero: bool = False, sight: float = IN_SIGHT) -> None:
        self._zero, self._sight, self._end = from_zero, sight, 0.0
        self._large: Callable[[], Picture] | None = None
        self._columns_saved: list[Array] = []
        self._names: list[str] = []
        super().__init__(gui, title, "t, s", [Curve(title, GREY)], file, height=HEIGHT, legend=False, clip=CLIP_KEY)
        x, y = self._handle.axes
        self._handle.axes = (x, {**y, **ORDINATE})

    def draw(self, times: Times, lines: Sequence[Line], most: float | None = None) -> None:
        """Show new curves.

        Parameters
        ----------
        times : Times
        lines : sequence of Line
        most : float, optional
            Where the ordinate ends although curves go on.
        """
        t, marks = _with_marks(times.grid(POINTS), times.legs)
        own = [_on(t, times.own, line.values) for line in lines]
        low, high = self._range_of(lines, most)
        drawn: list[tuple[Curve, Array]] = []
        if len(marks):
            drawn.append((Curve("legs", GREY, 1.0, opacity=0.5), _uprights(t, marks, low, high)))
        levels = _levels(lines, low, high)
        drawn += [(Curve("limit", colour, 1.0, dash=LIMIT), np.full(len(t), level)) for level, colour in levels.items()]
        for line in lines:
            if line.other is not None and times.other is not None:
                dash = OTHER_DASHED if line.dash else OTHER
                curve = Curve(line.name, line.colour, dash=dash, opacity=0.75)
                drawn.append((curve, _on(t, times.other, line.other)))
        # Red behind a curve, so that its colour still tells which joint it is.
        for line, values in zip(lines, own, strict=True):
            if line.beyond:
                drawn.append((Curve("beyond the limit", VERDICT["no"], 6.0), _within(t, values, line.beyond)))
        drawn += [
            (Curve(line.name, line.colour, dash=line.dash), values) for line, values in zip(lines, own, strict=True)
        ]
        self._note(times, lines)
        self._end = times.end
        scales = {"x": {"time": False, "range": (0.0, times.end)}, "y": {"range": (low, high)}}
        self._large = partial(large_picture, self.title, times, lines, (low, high))
        self.announce([curve for curve, _ in drawn])
        self.show(t, [values for _, values in drawn])
        if self._handle.scales != scales:
            self._handle.scales = scales

    def picture(self) -> Picture | None:
        """Return the motion at its own samples, with a name for each limit."""
        return None if self._large is None else self._large()

    def _range_of(self, lines: Sequence[Line], most: float | None) -> tuple[float, float]:
        """Return the ends of the ordinate, which the page cannot choose for curves with gaps."""
        every = [line.values for line in lines] + [line.other for line in lines if line.other is not None]
        values = np.concatenate(every) if every else np.zeros(1)
        values = values[np.isfinite(values)]
        low, high = (float(values.min()), float(values.max())) if len(values) else (0.0, 0.0)
        high = high if most is None else min(high, most)
        low = 0.0 if self._zero else low
        levels = [level for line in lines for level in line.in_sight(low, high, self._sight)]
        low, high = min([low, *levels]), max([high, *levels])
        flat = high - low <= NOTHING * max(1.0, abs(high))
        room = 0.5 if flat else ROOM * (high - low)
        return (0.0 if self._zero else low - room), high + room

    def _note(self, times: Times, lines: Sequence[Line]) -> None:
        """Keep the content of the file: all samples, with the motion for comparison beside them."""
        t = times.own if times.other is None else times.grid(len(times.own))
        columns = [t]
        self._names = [self._x]
        for line in lines:
            self._names.append(line.name)
            columns.append(_on(t, times.own, line.values))
        for line in lines:
            if line.other is not None and times.other is not None:
                self._names.append(f"{line.name}, compared")
                columns.append(_on(t, times.other, line.other))
        self._columns_saved = columns

    def csv(self) -> str:
        """Return the curves with a name for each, empty after the end of a motion."""
        return csv_of(self._names, self._columns_saved)

    def at_time(self, time: float | None, end: float) -> None:
        """Put the cursor at a time of a clip that lasts until ``end``, or remove it."""
        # Where the clip is as long as the axis, the page moves the cursor by its own clock.
        self.cursor(TIME if time is not None and abs(end - self._end) <= NOTHING * max(1.0, end) else time)


def large_picture(title: Inside, times: Times, lines: Sequence[Line], up: tuple[float, float]) -> Picture:
    """Return the plot for the tray; what it is compared with is thinner and paler.

    Parameters
    ----------
    title : str or markup
    times : Times
    lines : sequence of Line
    up : (float, float)
        Ends of the ordinate.
    """
    drawn = []
    for line in lines:
        if line.other is not None and times.other is not None:
            curve = Curve(_compared(line.name), line.colour, 1.1, dash=line.dash, opacity=0.7)
            drawn.append(Drawn(curve, times.other, line.other))
    for line in lines:
        if line.beyond:
            red = Curve("beyond the limit", VERDICT["no"], 6.0, opacity=0.6)
            drawn.append(Drawn(red, times.own, _within(times.own, line.values, line.beyond)))
    drawn += [Drawn(Curve(line.name, line.colour, 2.0, dash=line.dash), times.own, line.values) for line in lines]
    ends = [("", end) for end in times.legs]  # the words of the page name the legs
    return Picture(title, "t, s", drawn, _named_limits(lines, *up), ends, (0.0, times.end), up)


def _compared(name: str) -> str:
    """Return the name of a curve for comparison, before its unit.

    >>> _compared("q₁, °")
    'q₁ compared, °'
    """
    symbol, *unit = name.split(", ")
    return ", ".join([f"{symbol} compared", *unit])


def _named_limits(lines: Sequence[Line], low: float, high: float) -> list[Level]:
    """Return the visible limits, each with the names of the curves for which it holds."""
    found = _levels(lines, low, high)
    return [
        Level(f"limit {' '.join(names)}" if len(names := _limited_by(lines, at)) < len(lines) else "limit", at, colour)
        for at, colour in found.items()
    ]


def _limited_by(lines: Sequence[Line], level: float) -> list[str]:
    """Return the symbols of the curves that have a limit."""
    return [
        line.name.split(", ")[0]
        for line in lines
        if any(abs(level - each) <= 1e-9 * max(1.0, abs(level)) for each in line.limits)
    ]


def _with_marks(t: Array, legs: Sequence[float]) -> tuple[Array, Array]:
    """Return times in which those nearest to ends of legs appear twice, and the index of the first of each two."""
    nearest = np.unique(np.abs(t[:, None] - np.array(legs)[None, :]).argmin(axis=0)) if legs else np.zeros(0, dtype=int)
    # Two uprights side by side would be joined by a line.
    apart = nearest[np.diff(nearest, prepend=-2) > 1]
    return np.insert(t, apart, t[apart]), apart + np.arange(len(apart))


def _uprights(t: Array, marks: Array, low: float, high: float) -> Array:
    """Return the column that draws vertical lines: two values at one time."""
    found = np.full(len(t), np.nan)
    found[marks], found[marks + 1] = low, high
    return found


def _levels(lines: Sequence[Line], low: float, high: float) -> dict[float, Rgb]:
    """Return the visible limits with their colours, grey if several joints share one."""
    found: dict[float, Rgb] = {}
    for line in lines:
        within = [level for level in line.limits if low <= level <= high]
        for level in within:
            if not line.both or len(within) == len(line.limits):
                key = next((known for known in found if abs(known - level) <= 1e-9 * max(1.0, abs(level))), level)
                found[key] = GREY if key in found else line.colour
    return found


def _on(t: Array, known: Array, values: Array) -> Array:
    """Return values at other times, NaN after the end."""
    return np.interp(t, known, values, right=np.nan)


def _within(t: Array, values: Array, inside: Spans) -> Array:
    """Return values inside intervals, and NaN elsewhere."""
    found = np.full(len(t), np.nan)
    step = float(t[-1] - t[0]) / POINTS
    for start, end in inside:
        # A moment that lies between two samples is seen, too.
        found = np.where((t >= start - step) & (t <= end + step), values, found)
    return found
