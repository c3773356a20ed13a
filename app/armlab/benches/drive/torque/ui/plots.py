"""The torque over a turn, and how a rotor moves that is let go."""

from __future__ import annotations

import math

import numpy as np

from armlab.benches.drive.torque.sampled import curve, sampled_of
from armlab.benches.drive.torque.state import CLIP_KEY, Torque
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.colours import BLUE, GREEN, GREY, ORANGE, VERMILLION
from armlab.ui.plot import TIME, Curve, Plot
from armlab.ui.units import Units
from armlab.ui.widgets import Gui

POINTS = 721
HEIGHT, LOW = 120, 84
"""Heights of the plots, pixels."""


class Plots:
    """The plots of the page."""

    def __init__(self, gui: Gui, units: Units) -> None:
        self._factor = units.factor(True)
        unit = units.angle_unit
        curves = [
            Curve("one coil", ORANGE, 1.2, dash=(4, 3)),
            Curve("mean", GREY, 1.2, dash=(2, 3)),
            Curve("all coils", BLUE, 2.0),
        ]
        self._torque = Plot(gui, "Torque over a turn, N m", f"θ, {unit}", curves, "torque_of_coils", height=HEIGHT)
        self._theta = Plot(
            gui, f"Angle of the rotor, {unit}", "t, s", [Curve(f"θ, {unit}", GREEN)], "rotor", height=LOW, clip=CLIP_KEY
        )
        with gui.fold("Speed of the rotor") as self._fold:
            speed = [Curve("ω, rad/s", VERMILLION)]
            self._omega = Plot(gui, "Speed, rad/s", "t, s", speed, "rotor_speed", height=LOW, clip=CLIP_KEY)
        self._shown: Torque | None = None

    def show(self, state: State) -> None:
        """Show the curves if they have changed, and the cursors."""
        part = state[Torque]
        if part != self._shown:
            self._shown = part
            theta, every, one = curve(part, POINTS)
            self._torque.show(theta / self._factor, [one, np.full(POINTS, part.torques[2]), every])
            free = part.motion == "free"
            self._theta.visible(free)
            self._fold.visible(free)
            self._omega.on = free
            if free:
                self._theta.show(part.released.t, [part.released.theta / self._factor])
                self._omega.show(part.released.t, [part.released.omega])
        angle = math.fmod(state.derived(sampled_of).angle, 2.0 * math.pi)
        self._torque.cursor((angle + 2.0 * math.pi if angle < 0.0 else angle) / self._factor)
        on = state[Timeline].clip == CLIP_KEY
        for plot in (self._theta, self._omega):
            plot.cursor(TIME if on else None)
