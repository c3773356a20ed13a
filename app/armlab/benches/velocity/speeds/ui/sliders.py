"""The sliders of joint speeds, each in the colour of its joint."""

from __future__ import annotations

from armlab.benches.velocity.speeds.commands import SetSpeed
from armlab.benches.velocity.speeds.state import Velocity, fastest
from armlab.kin.arm import Arm
from armlab.session.parts.joints import Joints
from armlab.session.state import Post, State
from armlab.ui.adapter import gui_id
from armlab.ui.colours import css, joint_colour
from armlab.ui.html import Markup, styles
from armlab.ui.units import Units
from armlab.ui.widgets import Control, Gui

DOT = "\u0307"
"""Combining dot above the preceding letter."""


def dotted(arm: Arm, i: int, units: Units) -> str:
    """Return the symbol of the speed of joint i (0-based), such as q̇₁."""
    name = units.variable(i, bool(arm.revolute[i]))
    return f"{name[0]}{DOT}{name[1:]}"


class SpeedSliders:
    """One slider for each joint, from its largest speed in one direction to that in the other."""

    def __init__(self, gui: Gui, state: State, post: Post, units: Units) -> None:
        self._arm, self._units, self._post = state[Joints].arm, units, post
        self._sliders = [self._slider(gui, state, i) for i in range(self._arm.n)]
        gui.html(self._colours())

    def _slider(self, gui: Gui, state: State, i: int) -> Control:
        revolute = bool(self._arm.revolute[i])
        decimals, factor = self._units.decimals(revolute), self._units.factor(revolute)
        most = round(fastest(self._arm, i) / factor, decimals)
        return gui.slider(
            f"{dotted(self._arm, i, self._units)} {self._units.unit(revolute)}/s",
            -most,
            most,
            10.0**-decimals,
            self._shown(state, i),
            lambda value: self._post(SetSpeed(i, value * factor)),
            None,
        )

    def _shown(self, state: State, i: int) -> float:
        return self._units.value(state[Velocity].qdot[i], bool(self._arm.revolute[i]))

    def show(self, state: State) -> None:
        """Show the speeds; the sliders of held joints are disabled."""
        for i, slider in enumerate(self._sliders):
            slider.show(self._shown(state, i))
            slider.enable(not state[Joints].locked[i])

    def _colours(self) -> Markup:
        """Return the style that gives each slider the colour of its joint, and its label room for the unit."""
        rules = []
        for i, slider in enumerate(self._sliders):
            key, colour = gui_id(slider.handle), css(joint_colour(i))
            rules.append(
                f"[id='{key}'] .mantine-Slider-bar{{background:transparent!important}}"
                f"[id='{key}'] .mantine-Slider-thumb{{background:{colour}!important;border-color:{colour}!important}}"
                f"label[for='{key}']::before{{content:'';display:inline-block;width:9px;height:9px;border-radius:50%;"
                f"margin-right:7px;background:{colour}}}div:has(>p>label[for='{key}']){{width:5.6em!important}}"
            )
        return styles(rules)
