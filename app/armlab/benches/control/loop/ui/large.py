"""The frequency response of the velocity loop, large."""

from __future__ import annotations

from functools import partial

import numpy as np

from armlab.benches.control.loop.state import Loop
from armlab.benches.control.loop.ui.pictures import frequencies
from armlab.session.amounts import amount
from armlab.ui.colours import BLUE, GREY, PURPLE
from armlab.ui.curve import Curve
from armlab.ui.form import Form
from armlab.ui.html import Markup
from armlab.ui.large import LargeChart
from armlab.ui.tray_picture import Drawn, Picture
from armlab.ui.units import Units
from armlab.ui.widgets import Gui

POINTS = 801
"""Number of points of a curve."""


class Responses:
    """Gain and phase over the frequency, as the tray shows them."""

    def __init__(self, gui: Gui, units: Units) -> None:
        self._units = units
        self._gain = LargeChart(gui, "Gain |W(jω)|, dB", "gain")
        self._phase = LargeChart(gui, f"Phase of W(jω), {units.angle_unit}", "phase")

    def show(self, part: Loop) -> None:
        """Set the loop whose response is drawn; the frequency of a sine is marked."""
        at = part.omega if part.kind == "sine" else None
        self._gain.show(part, partial(self._drawn_gain, part), at)
        self._phase.show(part, partial(self._drawn_phase, part), at)

    def button(self, form: Form) -> Markup:
        """Return the button that shows both."""
        return self._gain.button(form)

    def _drawn_gain(self, part: Loop) -> Picture:
        across, cutoff = frequencies(part), part.loop.cutoff
        omega = np.geomspace(*across, POINTS)
        lines = np.where(omega < cutoff, 0.0, -20.0 * np.log10(omega / cutoff))
        drawn = (
            Drawn(Curve("asymptotes, dB", GREY, 1.2, dash=(4, 3)), omega, lines),
            Drawn(Curve("|W(jω)|, dB", BLUE, 2.0), omega, 20.0 * np.log10(part.loop.closed_gain(omega))),
        )
        return Picture(self._gain.title, "ω, rad/s", drawn, marks=(_cutoff(part),), across=across, log=True)

    def _drawn_phase(self, part: Loop) -> Picture:
        across, unit = frequencies(part), self._units.angle_unit
        omega = np.geomspace(*across, POINTS)
        phase = part.loop.phase(omega) / self._units.factor(True)
        drawn = (Drawn(Curve(f"phase, {unit}", PURPLE, 2.0), omega, phase),)
        return Picture(self._phase.title, "ω, rad/s", drawn, marks=(_cutoff(part),), across=across, log=True)


def _cutoff(part: Loop) -> tuple[str, float]:
    """Return the name of the line at the cutoff frequency, and the frequency."""
    return f"cutoff {amount(part.loop.cutoff, 'rad/s')}", part.loop.cutoff
