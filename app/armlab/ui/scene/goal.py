"""Goals of a lesson for the tool that are marked: balls as large as the tolerance."""

from __future__ import annotations

import viser

from armlab.content.check import Goal
from armlab.session.state import State
from armlab.teaching.parts.lesson import LessonPart
from armlab.ui.colours import VERDICT
from armlab.ui.drawing import LayerCanvas
from armlab.ui.plugin import Layer, Show

LEAST = 0.015
"""Smallest radius that is drawn, in sizes of the arm."""

OPACITY = 0.4


def build(canvas: LayerCanvas, state: State) -> Show:
    """Draw the balls again with every step, in the colour of an open or a finished task."""
    nodes: list[viser.IcosphereHandle | viser.LabelHandle] = []
    drawn: tuple[tuple[Goal, ...], bool] = ((), False)

    def show(state: State) -> None:
        nonlocal drawn
        lesson = state[LessonPart]
        check = lesson.step.check if lesson.step is not None else None
        wanted = (() if check is None else check.goals, lesson.name in lesson.progress.met and not lesson.silent)
        if wanted == drawn:
            return
        while nodes:
            nodes.pop().remove()
        drawn = wanted
        goals, met = wanted
        for i, goal in enumerate(goals):
            path, colour = canvas.path(f"goal_{i}"), VERDICT["ok" if met else "warn"]
            x, y, z = goal.position.tolist()
            radius = max(goal.within, LEAST * canvas.size)
            ball = canvas.scene.add_icosphere(
                path, radius, colour, opacity=OPACITY, position=(x, y, z), cast_shadow=False, receive_shadow=False
            )
            text = "goal ✓" if met else "goal"
            label = canvas.scene.add_label(
                f"{path}_label", text, position=(x, y, z - radius), anchor="top-center", depth_test=False
            )
            nodes.extend((ball, label))

    return show


LAYER = Layer("goal", order=62, watches=(LessonPart,), build=build, silent=True)
