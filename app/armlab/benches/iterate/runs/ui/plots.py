"""The plots of the runs: over the steps, or over the time of continuous ones; the cursor is the present iterate."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Sequence
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from armlab.benches.iterate.runs.clip import place_of
from armlab.benches.iterate.runs.films import Film
from armlab.benches.iterate.runs.state import Iterations, vector_of
from armlab.benches.iterate.runs.ui.colours import RUN_COLOURS
from armlab.benches.iterate.runs.ui.words import sigma_unit
from armlab.benches.iterate.runs.worked import MOST_RUNS
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.format import mathml
from armlab.ui.plot import NOTHING, Curve, Plot
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Gui

HEIGHT = 104

FLOOR = 1e-16
"""Errors that are smaller are drawn here: the logarithm of 0 is not a number."""

ROOM = 0.08
"""Above and below the curves, in parts of what they span."""

POINTS = 201
"""Of a curve over time."""

Array = NDArray[np.float64]
Values = Callable[[Film], Array | None]


class _Noted:
    """A maker of controls that remembers what it has made, so that a whole plot can be hidden."""

    def __init__(self, gui: Gui) -> None:
        self._gui, self.made = gui, list[Any]()

    def fields(self, on_input: Callable[[str, str], None]) -> Any:
        fields = self._gui.fields(on_input)
        self.made.append(fields.html)
        return fields

    def uplot(self, *arguments: Any) -> Any:
        handle = self._gui.uplot(*arguments)
        self.made.append(handle)
        return handle

    def html(self, content: str = "") -> Any:
        element = self._gui.html(content)
        self.made.append(element.handle)
        return element

    def save(self, name: str, text: str) -> None:
        self._gui.save(name, text)


class RunPlot(Plot):
    """A plot with a curve for each run there is, whatever their number."""

    def __init__(self, gui: Gui, title: str, file: str, values: Values, from_zero: bool = False) -> None:
        self.values, self._zero = values, from_zero
        self._noted = _Noted(gui)
        self._there: tuple[int, ...] = ()
        curves = [Curve(f"run {i + 1}", colour) for i, colour in enumerate(RUN_COLOURS)]
        # The list of runs above is the legend; the plot's own would name runs that are not there.
        self._title = title
        super().__init__(cast(Gui, self._noted), self._heading(""), "", curves, file, height=HEIGHT)

    def _heading(self, unit: str) -> str:
        return f'<span class="it-plot">{self._title}{f", {unit}" if unit else ""}</span>'

    def name_unit(self, unit: str) -> None:
        """Give the quantity a unit; none for a pure number."""
        self.name(self._heading(unit))

    def visible(self, on: bool) -> None:
        """Show or hide all of it."""
        for handle in self._noted.made:
            if handle.visible != on:
                handle.visible = on

    def show_runs(self, x: Array, curves: Sequence[Array | None]) -> None:
        """Show a curve for each run, by their places in the list; None for one that has none."""
        self._there = tuple(i for i, curve in enumerate(curves) if curve is not None)
        nothing = np.full(len(x), np.nan)
        every: list[Array] = [nothing] * MOST_RUNS
        for i in self._there:
            every[i] = cast(Array, curves[i])
        self._scale(x, every)
        self.show(x, every)

    def _scale(self, x: Array, curves: Sequence[Array]) -> None:
        """Choose the ranges: the page cannot, where curves have ends."""
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
        """Return the curves of the runs there are, with a name for each."""
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow([self._x, *(f"run {i + 1}" for i in self._there)])
        columns = [self._table[0].tolist(), *(self._table[1 + i].tolist() for i in self._there)]
        writer.writerows(zip(*columns, strict=True))
        return text.getvalue()


class Plots:
    """All plots; those that have something to show are seen."""

    def __init__(self, gui: Gui, state: State) -> None:
        self._plots = _plots(gui, state)
        self._shown: object = None

    def show(self, state: State) -> None:
        """Show the curves of a state when they are others, and where the film stands."""
        part = state[Iterations]
        film = part.film
        films = [part.films.get(run.colour) for run in part.runs]
        if film is None:
            return
        drawn = (tuple(films), part.run)
        if drawn != self._shown:
            self._shown = drawn
            self._draw(state, film, films)
        i, share = place_of(state)
        at = i + share
        if film.t is not None:
            at = float(np.interp(at, np.arange(len(film.t)), film.t))
        for plot in self._plots.values():
            plot.cursor(at)

    def _draw(self, state: State, film: Film, films: Sequence[Film | None]) -> None:
        flow = film.t is not None
        alike: list[Film | None] = [
            each if each is not None and (each.t is not None) == flow else None for each in films
        ]
        vector, arm = vector_of(state), state[Joints].arm
        wanted = {
            "position": bool(vector.task.position),
            "rotation": vector.task.rotation != "none",
            "turn": not flow and bool(arm.revolute.any()),
            "slide": not flow and not bool(arm.revolute.all()),
            "sigma": not flow,
            "damping": not flow and any(each is not None and each.damping is not None for each in alike),
            "V": flow,
            "V_dot": flow,
        }
        grid, metres = _grid(alike, flow), sigma_unit(state) == "m"
        for key, unit in UNITS.items():
            self._plots[key].name_unit(unit if metres else "")
        for key, plot in self._plots.items():
            plot.visible(wanted[key])
            if wanted[key]:
                plot.name_x("t, s" if flow else "iterate")
                plot.show_runs(
                    grid, [None if each is None else _on(grid, each, plot.values) for each in _by_colour(alike, state)]
                )


def _by_colour(films: Sequence[Film | None], state: State) -> list[Film | None]:
    """Return films by their colours, in which their curves are drawn."""
    found: list[Film | None] = [None] * MOST_RUNS
    for run, film in zip(state[Iterations].runs, films, strict=True):
        found[run.colour] = film
    return found


def _grid(films: Sequence[Film | None], flow: bool) -> Array:
    """Return the abscissa all runs share: iterates from 0 on, or times."""
    there = [film for film in films if film is not None]
    if flow:
        end = max((float(film.t[-1]) for film in there if film.t is not None), default=0.0)
        return np.linspace(0.0, end or 1.0, POINTS)
    return np.arange(1.0 + max(1, *(film.last for film in there)))


def _on(grid: Array, film: Film, values: Values) -> Array | None:
    """Return a curve of a run on the shared abscissa; nothing where the run has ended."""
    curve = values(film)
    if curve is None:
        return None
    if film.t is not None:
        return np.interp(grid, film.t, curve, right=np.nan)
    found = np.full(len(grid), np.nan)
    found[: len(curve)] = curve
    return found


LYAPUNOV, ITS_RATE, SIGMA = r"V=\frac12e^TKe", r"\dot V=-|J^TKe|^2", r"\sigma_{min}"


UNITS = {"sigma": "m", "damping": "m²"}
"""Of plots where the task vector is a position in metres; elsewhere it is made of pure numbers."""


def _plots(gui: Gui, state: State) -> dict[str, RunPlot]:
    arm, units = state[Joints].arm, units_of(state)
    plots = {
        "position": RunPlot(gui, "log₁₀ of the position error in m", "position_error", lambda f: _log(f.position_error))
    }
    if arm.task.rotation != "none":
        plots["rotation"] = RunPlot(
            gui, "log₁₀ of the orientation error in rad", "orientation_error", lambda f: _log(f.rotation_error)
        )
    plots["V"] = RunPlot(gui, f"Lyapunov function {mathml(LYAPUNOV)}, 1/s", "V", lambda f: f.V, True)
    plots["V_dot"] = RunPlot(gui, f"Its derivative {mathml(ITS_RATE)}, 1/s²", "V_dot", lambda f: f.V_dot)
    for turns in (True, False):
        if bool(np.any(arm.revolute == turns)):
            plots["turn" if turns else "slide"] = _steps_plot(gui, turns, units)
    plots["sigma"] = RunPlot(gui, f"Smallest singular value {mathml(SIGMA)}", "sigma_min", _sigma, True)
    plots["damping"] = RunPlot(gui, "Damping added to J Jᵀ", "damping", lambda f: f.damping, True)
    return plots


def _steps_plot(gui: Gui, turns: bool, units: Units) -> RunPlot:
    """Return the plot of the steps of turning or of sliding joints: their lengths are never one number."""

    def lengths(film: Film) -> Array:
        return film.step_lengths[0 if turns else 1] / units.factor(turns)

    title = f"Length of the step of {'turning' if turns else 'sliding'} joints, {units.unit(turns)}"
    return RunPlot(gui, title, f"step_{'turning' if turns else 'sliding'}", lengths, True)


def _sigma(film: Film) -> Array | None:
    return film.sigma_min


def _log(values: Array) -> Array:
    return np.where(np.isfinite(values), np.log10(np.maximum(values, FLOOR)), np.nan)
