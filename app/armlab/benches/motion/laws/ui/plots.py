"""The plots of timing laws: s and three derivatives over t, red above a limit; and the race of the laws."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.laws.clip import present_time
from armlab.benches.motion.laws.state import CLIP_KEY, Laws
from armlab.benches.motion.laws.ui.form import LAW_COLOURS, STRETCHED_NAME, names
from armlab.kin.motion import Law
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.colours import VERDICT, css
from armlab.ui.columns import csv_of
from armlab.ui.format import mathml
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.plot import NOTHING, TIME, Curve, Plot
from armlab.ui.speech import speech_in
from armlab.ui.svg import drawing, shape
from armlab.ui.widgets import Gui

Array = NDArray[np.float64]

SAMPLES = 90
"""Number of samples of the curve of each law."""

STEPS = 200
"""Number of equal steps of time in a saved table."""

_TIME_DIGITS = 12
"""Decimals of the times of a saved table, without the rounding of their steps."""

BESIDE = 1e-9
"""Time between the two samples of a jump, relative to the whole time."""

ROOM = 0.08
"""Room above and below the curves, relative to their extent."""

NUMBER = 0.32
"""Height of a number beside the axis, relative to that of the plot."""

SEEN = 1.6
"""Ratio to the peaks up to which a limit is drawn; a higher one would flatten the curves."""

SLACK = 1e-6
"""Relative excess up to which a limit is drawn as kept."""

TITLES: tuple[tuple[Inside, str, str, str], ...] = (
    (mathml("s"), "s", "s", ""),
    (mathml(r"\dot s"), "ṡ", "ds", "1/s"),
    (mathml(r"\ddot s"), "s\u0308", "dds", "1/s²"),
    ("Jerk", "jerk", "ddds", "1/s³"),
)
"""Title, name of a curve, name of files and unit of each derivative."""

DOT = 3.5
"""Diameter of the red dots above a limit, pixels."""


class LawPlot(Plot):
    """The plot of one derivative of all laws."""

    def __init__(self, gui: Gui, order: int) -> None:
        title, self._name, file, self._unit = TITLES[order]
        self.order = order
        self._part: Laws | None = None
        heading = tag("span", title, f", {self._unit}" if self._unit else None)
        # The page wants curves from the start; the laws take their place.
        first = [Curve(self._named(law), LAW_COLOURS[0]) for law in ("1", f"1{STRETCHED_NAME}")]
        super().__init__(gui, heading, "t, s", first, f"law_{file}", 2 if order else 0, legend=False, clip=CLIP_KEY)

    def show_laws(self, part: Laws, t: Array) -> None:
        """Show all laws of the bench on a grid of times."""
        ends = [entry.moving_ends for entry in part.entries]
        ends += [] if part.stretched is None else [ends[part.scaled]]
        curves = [Curve(self._named(name), colour) for name, colour in names(part)]
        every = [_curve(law, t, self.order, not moves) for law, moves in zip(part.every, ends, strict=True)]
        limit = part.timing.limit(self.order) if self.order else np.inf
        above = [np.where(np.abs(each) > limit * (1.0 + SLACK), each, np.nan) for each in every]
        above = [each for each in above if np.isfinite(each).any()]
        self._part = part
        self.announce([*curves, *[Curve("above the limit", VERDICT["no"], DOT, dots=True)] * len(above)])
        self.show(t, [*every, *above], self._scaled(t, every, float(limit)))

    def _scaled(self, t: Array, curves: list[Array], limit: float) -> tuple[float, ...]:
        """Choose the ranges, which the page cannot do for curves that end; return the visible limit lines."""
        values = np.concatenate(curves)
        values = values[np.isfinite(values)]
        low, high = float(values.min(initial=0.0)), float(values.max(initial=0.0))
        lines: list[float] = []
        if np.isfinite(limit) and limit <= SEEN * max(high, -low):
            lines = [limit] if low > -NOTHING - 0.01 * high else [limit, -limit]
            low, high = min(low, *lines), max(high, *lines)
        room = ROOM * (high - low) if high - low > NOTHING else 0.5
        y = with_numbers(low - room, high + room)
        scales = {"x": {"time": False, "range": (0.0, float(t[-1]))}, "y": {"range": y}}
        if self._handle.scales != scales:
            self._handle.scales = scales
        return tuple(lines)

    def _named(self, law: str) -> str:
        return f"{self._name} of law {law}{f', {self._unit}' if self._unit else ''}"

    def csv(self) -> str:
        """Return the laws at equal steps of time, by which differences can be divided; empty after the end of a law."""
        if self._part is None:
            return ""
        say = speech_in(self._gui.language).text
        end = self._part.end
        t = np.minimum(np.round(np.linspace(0.0, end, STEPS + 1), _TIME_DIGITS), end)  # no time rounded beyond the end
        columns = [_curve(law, t, self.order, False) for law in self._part.every]
        return csv_of([self._x, *(say(self._named(name)) for name, _ in names(self._part))], [t, *columns])


class Plots:
    """All plots over time, with the cursor of the timeline."""

    def __init__(self, gui: Gui) -> None:
        self._plots = [LawPlot(gui, order) for order in (0, 1)]
        with gui.fold("Acceleration and jerk"):
            self._plots += [LawPlot(gui, order) for order in range(2, len(TITLES))]
        self._shown: object = None

    def show(self, state: State) -> None:
        """Show the curves if they have changed, and the cursor while the film is open."""
        part = state[Laws]
        drawn = (part.entries, part.timing, part.scaled if part.k != 1.0 else 0, part.k)
        if drawn != self._shown:
            self._shown = drawn
            t = grid(part)
            for plot in self._plots:
                plot.show_laws(part, t)
        on = state[Timeline].clip == CLIP_KEY
        for plot in self._plots:
            plot.cursor(TIME if on else None)


def grid(part: Laws) -> Array:
    """Return times for the curves of all laws: dense enough for each, with both sides of every jump."""
    beside = BESIDE * part.end
    found = [np.linspace(0.0, law.duration, SAMPLES) for law in part.every]
    found += [law.edges + side for law in part.every for side in (-beside, beside)]
    times = np.unique(np.concatenate(found))
    return times[times >= 0.0]


def with_numbers(low: float, high: float) -> tuple[float, float]:
    """Return a range, widened if fewer than two round numbers would fit beside the axis.

    Examples
    --------
    >>> with_numbers(-0.4, 0.4), with_numbers(-0.1, 1.1)
    ((-0.5, 0.5), (-0.1, 1.1))
    """
    least = NUMBER * (high - low)
    power = 10.0 ** np.floor(np.log10(least))
    step = next(float(power * digit) for digit in (1.0, 2.0, 2.5, 5.0, 10.0) if power * digit >= least)
    if np.floor(high / step) - np.ceil(low / step) >= 1.0:
        return low, high
    return float(np.floor(low / step) * step), float(np.ceil(high / step) * step)


def _curve(law: Law, t: Array, order: int, rests: bool) -> Array:
    """Return a derivative, NaN after the end of the law except for the jump to rest."""
    last = law.duration
    if rests and t[-1] > last:
        last = float(t[np.searchsorted(t, last, side="right")])
    return np.where(t <= last, law.at(t, order), np.nan)


# -- the race --------------------------------------------------------------------------------------------------------

WIDTH, LANE, MARGIN = 320, 18, 10
FLASHES = 24
"""Number of pictures of each law, at equal intervals of the whole time."""


def race_markup(state: State) -> Markup:
    """Return a line for each law with its places at equal intervals of time, and the place at the present time."""
    part, t = state[Laws], present_time(state)
    spans = np.array([law.span for law in part.every])
    low, high = float(spans[:, 0].min()), float(spans[:, 1].max())
    # Laws that stand still all stand at the beginning.
    extent = (high - low) or 1.0
    step = part.end / FLASHES

    def x(law: Law, times: Array) -> list[float]:
        place = (law.at(times) - low) / extent
        places: list[float] = (MARGIN + (WIDTH - 2 * MARGIN) * np.clip(place, 0.0, 1.0)).tolist()
        return places

    lanes = []
    for i, (law, (_, colour)) in enumerate(zip(part.every, names(part), strict=True)):
        y, fill = LANE * i + LANE // 2, css(colour)
        times = np.append(np.arange(0.0, law.duration, step), law.duration)
        marks = [shape("circle", cx=at, cy=y, r=2) for at in x(law, times)]
        (now,) = x(law, np.array([t]))
        lanes.append(shape("line", x1=MARGIN, x2=WIDTH - MARGIN, y1=y, y2=y))
        lanes.append(tag("g", marks, shape("circle.now", cx=now, cy=y, r=5.5), fill=fill))
    label = f"Places of the laws each {step:.3g} s"
    return drawing("law-race", WIDTH, LANE * len(part.every), label, tag("title", label), lanes)
