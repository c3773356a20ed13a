"""The runs of the iterations in the scene: paths of the tool, arms of the other runs, target, present error."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.iterate.runs.clip import alongside, configuration, place_of
from armlab.benches.iterate.runs.films import Film
from armlab.benches.iterate.runs.state import CLIP_KEY, Iterations, arms_found, vector_of
from armlab.benches.iterate.runs.ui.marks import ErrorArrow, Way
from armlab.benches.iterate.runs.ui.words import errors
from armlab.benches.iterate.runs.worked import MOST_RUNS
from armlab.session.arm_on_clip import standing
from armlab.session.parts.joints import Joints
from armlab.session.parts.notation import Notation
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.colours import GREY, RUN_COLOURS, VERDICT
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._nodes import add_triad, move, put, seen, write
from armlab.ui.scene._sticks import Stick
from armlab.ui.scene._strokes import add_name
from armlab.ui.units import units_of

MOST_ARMS = 4
"""Largest number of drawn solutions of a task vector with joints in it."""

OUTSIDE = 1e-6
"""Distance of an iterate beyond a limit, rad or m, from which on the arm cannot take it."""

PALE = 0.0045
"""Thickness of the arms at the solutions, in sizes of the arm."""

Floats = NDArray[np.float64]


class _Runs:
    """All nodes of the layer."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._arm = canvas.drawn.figure.anatomy.arm
        self._ways = [Way(canvas, f"iterations/way{k}", colour) for k, colour in enumerate(RUN_COLOURS)]
        self._sticks = [Stick(canvas, f"iterations/arm{k}", colour) for k, colour in enumerate(RUN_COLOURS)]
        self._start = Stick(canvas, "iterations/start", GREY, PALE)
        self._solutions = [Stick(canvas, f"iterations/solution{k}", GREY, PALE) for k in range(MOST_ARMS)]
        self._target = add_triad(canvas.scene, canvas.path("iterations/target"), 0.8 * canvas.size)
        self._name = add_name(canvas.scene, canvas.path("iterations/target/name"), "target", np.zeros(3), "top-left")
        self._error = ErrorArrow(canvas, VERDICT["no"])
        self._count = add_name(canvas.scene, canvas.path("iterations/count"), "", np.zeros(3), "bottom-right")

    def show(self, state: State) -> None:
        """Show a state."""
        part, on = state[Iterations], state[Timeline].clip == CLIP_KEY
        there = {run.colour: part.films.get(run.colour) for run in part.runs}
        for colour, way in enumerate(self._ways):
            way.show(there.get(colour))
        put(self._target, part.target)
        found = arms_found(state)
        for k, solution in enumerate(self._solutions):
            solution.show(found[k] if k < len(found) else None)
        self._start.show(None if on else np.array(part.start))
        self._show_arms(state, there if on else {})
        self._show_present(state, part.film if on else None)

    def _show_arms(self, state: State, there: dict[int, Film | None]) -> None:
        """Show the arms of runs that the arm itself does not show, or cannot because of its limits."""
        part, place = state[Iterations], place_of(state)
        played = part.film
        for colour in range(MOST_RUNS):
            film = there.get(colour)
            q: Floats | None = None
            if film is not None and played is not None:
                q = configuration(film, alongside(played, place, film))
                if film is played and self._stands(q):
                    q = None
            self._sticks[colour].show(q)

    def _stands(self, q: Floats) -> bool:
        """Return whether the arm can take a configuration."""
        apart = standing(self._arm, q) - q
        turned = np.where(self._arm.revolute, np.abs(2.0 * np.sin(0.5 * apart)), np.abs(apart))
        return bool(turned.max() <= OUTSIDE)

    def _show_present(self, state: State, film: Film | None) -> None:
        """Show the number of the iterate, and its error."""
        seen(self._count, film is not None)
        if film is None:
            self._error.show(None, np.zeros(3))
            write(self._name, "target")
            return
        i, _ = place = place_of(state)
        tool = np.asarray(self._arm.position(configuration(film, place)), dtype=float)
        goal = state[Iterations].target[:3, 3]
        self._error.show(tool if vector_of(state).task.position else None, goal)
        # The length stands at the target: beside a short arrow it would cover the number of the iterate.
        write(self._name, f"target, error {errors(film, i, units_of(state))}")
        write(self._count, f"t = {film.t[i]:.2f} s" if film.t is not None else f"iterate {i} of {film.last}")
        move(self._count, tool)


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the runs while their page is open."""
    return _Runs(canvas).show


LAYER = Layer("iterations", order=86, watches=(Iterations, Timeline, Joints, Notation), build=build, panel="iterations")
