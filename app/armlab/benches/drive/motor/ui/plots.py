"""Voltage, current, speed and angle of the motor over time."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from armlab.benches.drive.motor.state import CLIP_KEY, Motor
from armlab.kin.drive.motor import DcMotor
from armlab.kin.drive.motor_run import MOST_RATE, Piece, run
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State
from armlab.ui.colours import BLUE, GREEN, GREY, ORANGE, PURPLE, VERMILLION
from armlab.ui.plot import TIME, Curve, Plot
from armlab.ui.units import Units
from armlab.ui.widgets import Gui

HEIGHT, LOW = 96, 96
"""Heights of the plots over time, and of the responses to a step, pixels."""

SETTLED = 6.0
"""Duration of a response to a step in time constants of its slowest pole."""

MOST_PERIODS = 40.0
"""Largest number of oscillations that a response shows: more would run together."""


class Plots:
    """The plots of a run."""

    def __init__(self, gui: Gui, units: Units) -> None:
        self._factor, angle = units.factor(True), units.angle_unit

        def plot(title: str, file: str, *curves: Curve) -> Plot:
            return Plot(gui, title, "t, s", curves, file, height=HEIGHT, legend=False, clip=CLIP_KEY)

        dotted = (2, 3)
        self._seen = (
            plot(
                "Current, A (dotted: final value)",
                "current",
                Curve("i, A", VERMILLION),
                Curve("i at the end, A", GREY, 1.2, dash=dotted),
            ),
            plot(
                "Speed, rad/s (dotted: final value)",
                "speed",
                Curve("ω, rad/s", GREEN),
                Curve("ω at the end, rad/s", GREY, 1.2, dash=dotted),
            ),
        )
        with gui.fold("Voltage and angle") as self._fold:
            emf = Curve("v_emf = k ω, V", ORANGE, 1.2, dash=(5, 3))
            self._folded = (
                plot("Voltage; dashed: back-EMF k ω, V", "voltage", Curve("v_a, V", BLUE), emf),
                plot(f"Angle, {angle}", "angle", Curve(f"θ, {angle}", PURPLE)),
            )
        self._shown: Motor | None = None

    def show(self, state: State) -> None:
        """Show the curves if they have changed, and the cursors; nothing when another part of the page is looked at."""
        part = state[Motor]
        on = part.shown == "run"
        for plot in self._seen:
            plot.visible(on)
        self._fold.visible(on)
        for plot in self._folded:
            plot.on = on
        if not on:
            return
        if part != self._shown:
            self._shown = part
            self._draw(part)
        film = state[Timeline].clip == CLIP_KEY
        for plot in (*self._seen, *self._folded):
            plot.cursor(TIME if film else None)

    def _draw(self, part: Motor) -> None:
        found = part.run
        current, speed = part.motor.steady(found.v, found.load)
        (i, omega), (voltage, theta) = self._seen, self._folded
        voltage.show(found.t, [found.v, part.k * found.omega])
        i.show(found.t, [found.i, current])
        omega.show(found.t, [found.omega, speed])
        theta.show(found.t, [found.theta / self._factor])


class Responses:
    """The speed after a step of one volt, and of one newton metre of load, from rest."""

    def __init__(self, gui: Gui) -> None:
        with gui.fold("Step responses of the speed") as self._fold:
            self._plots = tuple(
                Plot(gui, title, "t, s", [Curve(name, colour)], file, height=LOW)
                for title, name, colour, file in (
                    ("After 1 V, rad/s", "ω after 1 V, rad/s", BLUE, "step_voltage"),
                    ("After 1 N m of load, rad/s", "ω after 1 N m, rad/s", VERMILLION, "step_load"),
                )
            )
        self._shown: object = None

    def show(self, state: State) -> None:
        """Show the responses of the motor, while its poles are looked at."""
        part = state[Motor]
        on = part.shown == "poles"
        self._fold.visible(on)
        for plot in self._plots:
            plot.on = on
        if not on or part.motor == self._shown:
            return
        self._shown = part.motor
        motor, duration = response_of(part.motor)
        for plot, piece in zip(self._plots, (Piece(duration, 1.0, 0.0), Piece(duration, 0.0, 1.0)), strict=True):
            found = run(motor, [piece])
            plot.show(found.t, [found.omega])


def response_of(motor: DcMotor) -> tuple[DcMotor, float]:
    """Return the motor whose responses to steps are drawn, and their duration in seconds.

    While the slow pole settles, a current that is millions of times as fast is seen as one that follows at once: then
    it is the motor without inductance. Where it is the rotor that is so fast, the beginning is drawn.
    """
    duration = SETTLED / max(float(np.abs(motor.poles.real).min()), 1e-9)
    turning = float(np.abs(motor.poles.imag).max())
    if turning > 0.0:
        return motor, min(duration, MOST_PERIODS * 2.0 * math.pi / turning)
    longest = MOST_RATE / float(np.abs(motor.poles).max())
    if duration <= longest:
        return motor, duration
    if motor.electrical_constant < motor.mechanical_constant:
        return replace(motor, L=0.0), duration
    return motor, 0.5 * longest
