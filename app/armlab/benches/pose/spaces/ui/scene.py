"""The other arm of the same r, as sticks beside the arm, with what both are described by."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.benches.pose.spaces.arms import SYMBOLS, GoToTwin, misfit, twins_of
from armlab.benches.pose.spaces.state import Spaces
from armlab.kin.arm import Arm
from armlab.kin.transforms import inverse
from armlab.session.parts.joints import Joints
from armlab.session.state import State
from armlab.ui.colours import ORANGE, PURPLE
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show
from armlab.ui.scene._nodes import move, seen, write
from armlab.ui.scene._sticks import Sticks, corners_of

Floats = NDArray[np.floating]

BALL = 0.02
"""Radius of the ball at the point that r names, in sizes of the arm."""


def point_of(arm: Arm, r: Floats, tool_pose: Floats) -> Floats:
    """Return the point in the world, (3,), that the first two components of r name, in the plane of the tool."""
    height = float((inverse(arm.base) @ tool_pose)[2, 3])
    return np.asarray((arm.base @ np.array([*r[:2], height, 1.0]))[:3])


class Other:
    """The sticks of the other arm, their name, and a ball at the point that both have in common."""

    def __init__(self, canvas: LayerCanvas) -> None:
        self._canvas = canvas
        path, scene = canvas.path("spaces"), canvas.scene
        scene.add_frame(path, show_axes=False)
        self._sticks = Sticks(canvas, f"{path}/sticks", lambda _: canvas.post(GoToTwin()))
        self._ball = scene.add_icosphere(
            f"{path}/point", BALL * canvas.size, PURPLE, cast_shadow=False, receive_shadow=False
        )
        self._point = scene.add_label(f"{path}/point_name", "", font_screen_scale=0.9, anchor="top-left")
        self._name = scene.add_label(f"{path}/name", "the other arm", font_screen_scale=0.9, anchor="bottom-center")

    def show(self, state: State) -> None:
        """Show the other arm, or nothing."""
        on = state[Spaces].shown == "arms" and not misfit(state)
        twins = state.derived(twins_of) if on else None
        others = np.zeros((0, 3)) if twins is None else twins.others[:1]
        for handle, there in ((self._ball, on), (self._point, on), (self._name, len(others) > 0)):
            seen(handle, there)
        arm = state[Joints].arm
        corners = corners_of(arm, others) if len(others) else np.zeros((0, 0, 3))
        self._sticks.show(corners, [ORANGE] * len(others))
        if twins is None:
            return
        point = point_of(arm, twins.r, state[Joints].tool_pose)
        move(self._ball, point)
        move(self._point, point)
        first, second, third = (symbol.replace("_", "") for symbol in SYMBOLS[state[Spaces].described])
        write(self._point, f"({first}, {second}), same {third}")
        if len(others):
            move(self._name, corners[0][2 if arm.convention == "standard" else 4])


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the other arm."""
    del state
    return Other(canvas).show


LAYER = Layer("spaces", order=74, watches=(Spaces, Joints), build=build, panel="spaces")
