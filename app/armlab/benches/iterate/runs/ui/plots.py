"""The plots of the runs over the steps, or over time for continuous ones, with a cursor at the present iterate."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from armlab.benches.iterate.runs.clip import place_of
from armlab.benches.iterate.runs.films import Film
from armlab.benches.iterate.runs.state import Iterations, vector_of
from armlab.benches.iterate.runs.ui.words import sigma_unit
from armlab.benches.iterate.runs.worked import MOST_RUNS
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.format import mathml
from armlab.ui.run_plot import Array, RunPlot, Values
from armlab.ui.units import Units, units_of
from armlab.ui.widgets import Fold, Gui

FLOOR = 1e-16
"""Smallest error that is drawn as it is, because 0 has no logarithm."""

POINTS = 201
"""Number of points of a curve over time."""


class Plots:
    """All plots, of which those with curves are visible."""

    def __init__(self, gui: Gui, state: State) -> None:
        self._plots, self._more = _plots(gui, state)
        self._shown: object = None

    def show(self, state: State) -> None:
        """Show the curves of a state if they have changed, and the place in the film."""
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
        self._more.visible(not flow or vector.task.rotation != "none")
        grid, metres = _grid(alike, flow), sigma_unit(state) == "m"
        for key, unit in UNITS.items():
            self._plots[key].name_unit(unit if metres else "")
        for key, unit in lyapunov_units(state).items():
            self._plots[key].name_unit(unit)
        for key, plot in self._plots.items():
            plot.visible(wanted[key])
            if wanted[key]:
                plot.name_x("t, s" if flow else "iterate")
                plot.show_runs(
                    grid, [None if each is None else _on(grid, each, plot.values) for each in _by_colour(alike, state)]
                )


def _by_colour(films: Sequence[Film | None], state: State) -> list[Film | None]:
    """Return films at the places of their colours, in which their curves are drawn."""
    found: list[Film | None] = [None] * MOST_RUNS
    for run, film in zip(state[Iterations].runs, films, strict=True):
        found[run.colour] = film
    return found


def _grid(films: Sequence[Film | None], flow: bool) -> Array:
    """Return the abscissa that all runs share: iterates from 0 on, or times."""
    there = [film for film in films if film is not None]
    if flow:
        end = max((float(film.t[-1]) for film in there if film.t is not None), default=0.0)
        return np.linspace(0.0, end or 1.0, POINTS)
    return np.arange(1.0 + max(1, *(film.last for film in there)))


def _on(grid: Array, film: Film, values: Values) -> Array | None:
    """Return a curve of a run on the shared abscissa, NaN after the end of the run."""
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
"""Units of plots if the task vector is a position in metres; for others it is without unit."""


def lyapunov_units(state: State) -> dict[str, str]:
    """Return the units of V and of its derivative: V has those of e, of slides alone metres, and J none."""
    joints = state[Joints]
    free = [row for row, held in zip(joints.arm.rows, joints.locked, strict=True) if not held]
    slides = bool(free) and not any(row.revolute for row in free)
    metres = slides and set(vector_of(state).kinds(joints.arm)) == {"m"}
    return {"V": "m²/s", "V_dot": "m²/s²"} if metres else {"V": "1/s", "V_dot": "1/s²"}


def _plots(gui: Gui, state: State) -> tuple[dict[str, RunPlot], Fold]:
    """Return the plots by their keys, and the fold that holds most of them."""
    arm, units = state[Joints].arm, units_of(state)
    plots = {
        "position": RunPlot(gui, "log₁₀ of the position error in m", "position_error", lambda f: _log(f.position_error))
    }
    plots["V"] = RunPlot(gui, ("Lyapunov function ", mathml(LYAPUNOV)), "V", lambda f: f.V, True)
    plots["V_dot"] = RunPlot(gui, ("Its derivative ", mathml(ITS_RATE)), "V_dot", lambda f: f.V_dot)
    with gui.fold("Orientation, steps, singular values, damping") as more:
        if arm.task.rotation != "none":
            plots["rotation"] = RunPlot(
                gui, "log₁₀ of the orientation error in rad", "orientation_error", lambda f: _log(f.rotation_error)
            )
        for turns in (True, False):
            if bool(np.any(arm.revolute == turns)):
                plots["turn" if turns else "slide"] = _steps_plot(gui, turns, units)
        plots["sigma"] = RunPlot(gui, ("Smallest singular value ", mathml(SIGMA)), "sigma_min", _sigma, True)
        plots["damping"] = RunPlot(gui, "Damping added to J Jᵀ", "damping", lambda f: f.damping, True)
    return plots, more


def _steps_plot(gui: Gui, turns: bool, units: Units) -> RunPlot:
    """Return the plot of the steps of revolute or of prismatic joints, whose lengths have no common unit."""

    def lengths(film: Film) -> Array:
        return film.step_lengths[0 if turns else 1] / units.factor(turns)

    title = f"Length of the step of {'revolute' if turns else 'prismatic'} joints, {units.unit(turns)}"
    return RunPlot(gui, title, f"step_{'turning' if turns else 'sliding'}", lengths, True)


def _sigma(film: Film) -> Array | None:
    return film.sigma_min


def _log(values: Array) -> Array:
    return np.where(np.isfinite(values), np.log10(np.maximum(values, FLOOR)), np.nan)
