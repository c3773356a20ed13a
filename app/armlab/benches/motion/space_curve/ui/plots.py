"""Plots of a curve over its parameter, and of a turn over time."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.space_curve.laid import Laid
from armlab.benches.motion.space_curve.state import CLIP_KEY, SpaceCurve, curve_of, moment_of, turn_of
from armlab.benches.motion.space_curve.turn import Turned
from armlab.session.state import State
from armlab.ui.colours import BLUE, GREEN, ORANGE, PURPLE, Rgb
from armlab.ui.plot import NOTHING, TIME, Curve, Plot
from armlab.ui.units import Units
from armlab.ui.widgets import Gui

HEIGHT, WIDE = 96, 60
"""Height of a plot, and room beside it for large numbers, pixels."""

ROOM = 0.08
"""Room above and below a curve, relative to its extent."""

BEYOND = 30.0
"""Multiple of its median above which a curvature is left out as a pole at a point where the curve stands still."""

SAMPLES = 301

Floats = NDArray[np.float64]


class SignedPlot(Plot):
    """A plot whose ordinate may be negative; a constant is drawn in the middle."""

    def show(
        self,
        x: NDArray[np.floating],
        curves: Sequence[NDArray[np.floating]],
        limits: Sequence[float] = (),
    ) -> None:
        """Show new curves; zero is always visible."""
        values = np.concatenate([curve[np.isfinite(curve)] for curve in curves])
        low, high = (float(values.min()), float(values.max())) if len(values) else (0.0, 0.0)
        low, high = min(low, 0.0), max(high, 0.0)
        room = ROOM * (high - low) if high - low > NOTHING else 1.0
        scales = {"x": {"time": False}, "y": {"range": (low - room, high + room)}}
        if self._handle.scales != scales:
            self._handle.scales = scales
        super().show(x, curves, limits)


class LengthPlot(Plot):
    """A plot from 0 with room for numbers of five digits."""

    def __init__(self, gui: Gui, title: str, name: str, colour: Rgb, file: str) -> None:
        super().__init__(gui, title, "s", [Curve(name, colour)], file, 0, HEIGHT, True)
        abscissa, ordinate = self._handle.axes
        self._handle.axes = (abscissa, {**ordinate, "size": WIDE})


class CurvePlots:
    """Plots of curvature, torsion, length and |p'| over the parameter."""

    def __init__(self, gui: Gui, units: Units) -> None:
        self._units, unit = units, units.length_unit
        with gui.fold("Curvature, torsion, distance, |p′|") as self._fold:
            self._plots = {
                "kappa": Plot(
                    gui, "Curvature κ, 1/m", "s", [Curve("kappa, 1/m", PURPLE)], "curvature", 0, HEIGHT, True
                ),
                "tau": SignedPlot(gui, "Torsion τ, 1/m", "s", [Curve("tau, 1/m", BLUE)], "torsion", 0, HEIGHT),
                "sigma": LengthPlot(gui, f"Arc length σ, {unit}", f"sigma, {unit}", GREEN, "distance"),
                "speed": LengthPlot(gui, f"|p′|, {unit}", "|p'|", ORANGE, "derivative"),
            }
        self._drawn: Laid | None = None

    def show(self, state: State) -> None:
        """Show the curves if they have changed, and the place of the film."""
        on = state[SpaceCurve].shown == "curve"
        self._fold.visible(on)
        for plot in self._plots.values():
            plot.visible(on)
        if not on:
            return
        found, now = state.derived(curve_of), state.derived(moment_of)
        if found is not self._drawn:
            self._drawn = found
            self._draw(found)
        at = now.sigma / self._units.factor(False) if found.by_length else now.s
        for plot in self._plots.values():
            plot.cursor(at)

    def _draw(self, found: Laid) -> None:
        factor, frame = self._units.factor(False), found.frame
        x = found.sigma / factor if found.by_length else found.s
        shown = {
            "kappa": without_poles(np.where(frame.moves, frame.curvature, np.nan)),
            "tau": without_poles(np.where(frame.bends, frame.torsion, np.nan)),
            "sigma": found.sigma / factor,
            "speed": np.ones_like(x) if found.by_length else found.speed / factor,
        }
        unit = self._units.length_unit
        self._plots["speed"].name("|p′|, with p′ = dp/dσ" if found.by_length else f"|p′|, {unit}")
        for key, plot in self._plots.items():
            plot.name_x(f"σ, {unit}" if found.by_length else "s")
            plot.show(x, [shown[key]])


class TurnPlots:
    """Plots of the angle between both turns, and of their speeds, over time."""

    def __init__(self, gui: Gui, units: Units) -> None:
        self._units, unit = units, units.angle_unit
        both = (f"one axis, {unit}/s", f"three angles, {unit}/s")
        self._apart = Plot(
            gui,
            f"Angle between both, {unit}",
            "t, s",
            [Curve(f"apart, {unit}", PURPLE)],
            "apart",
            0,
            HEIGHT,
            True,
            clip=CLIP_KEY,
        )
        curves = [Curve(name, colour) for name, colour in zip(both, (BLUE, ORANGE), strict=True)]
        self._rates = Plot(
            gui, f"Angular speed |ω|, {unit}/s", "t, s", curves, "turning", 0, HEIGHT, True, clip=CLIP_KEY
        )
        self._drawn: tuple[Turned, Laid] | None = None

    def show(self, state: State) -> None:
        """Show the curves if they have changed."""
        on = state[SpaceCurve].shown == "turn"
        for plot in (self._apart, self._rates):
            plot.visible(on)
        if not on:
            return
        found, law = state.derived(turn_of), state.derived(curve_of)
        if self._drawn is None or found is not self._drawn[0] or law is not self._drawn[1]:
            self._drawn = found, law
            t = np.linspace(0.0, law.law.duration, SAMPLES)
            s, rate = law.law.derivatives(t, (0, 1))
            factor = self._units.factor(True)
            self._apart.show(t, [np.interp(s, found.s, found.apart) / factor])
            self._rates.show(t, [np.interp(s, found.s, each) * np.abs(rate) / factor for each in found.rates])
        for plot in (self._apart, self._rates):
            plot.cursor(TIME)


def without_poles(values: Floats) -> Floats:
    """Return values without those that would flatten all others."""
    finite = np.abs(values[np.isfinite(values)])
    usual = float(np.median(finite)) if len(finite) else 0.0
    return np.where(np.abs(values) > BEYOND * usual, np.nan, values) if usual > NOTHING else values
