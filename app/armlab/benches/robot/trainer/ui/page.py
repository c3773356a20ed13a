"""The assignment trainer: an arm without frames; the student places the axes and fills the table, and is marked."""

from __future__ import annotations

import numpy as np

from armlab.benches.robot.trainer.commands import EndTrainer, StartTrainer, TakeTrainerPose, at_reference
from armlab.benches.robot.trainer.exercise import usable_robots
from armlab.benches.robot.trainer.state import Trainer
from armlab.benches.robot.trainer.ui.axes import axes_stage
from armlab.benches.robot.trainer.ui.table import TableStage
from armlab.content.robots import Robot
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import ChooseRobot
from armlab.session.state import Post, State
from armlab.ui.form import Form
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import verdict_box
from armlab.ui.plugin import NOTHING, Panel, Points, Show
from armlab.ui.units import units_of
from armlab.ui.widgets import Gui

INTRODUCTION = (
    "The arm is drawn without frames. First choose the directions of z and x of each frame, then fill the table that "
    "follows from them. Each step is marked, and the arm of your table is drawn over the correct one."
)
UNUSABLE = (
    "No configuration of this arm is known in which all joint axes lie along x, y or z of the world frame, so their "
    "directions cannot be chosen from six. Take one of these:"
)
END = "Restore the arm as it was before the exercise, unless you have moved it; the answers are discarded"
SIZES = (("Up to 3 joints", 1, 3), ("4 and 5 joints", 4, 5), ("6 joints", 6, 6), ("7 joints and more", 7, 99))


class TrainerPanel:
    """The panel of the trainer."""

    def __init__(self, gui: Gui, state: State, post: Post) -> None:
        self._state, self._units = state, units_of(state)
        self._form = gui.form(post)
        self._table = TableStage(gui, self._units, state[Trainer], post)
        self._after = gui.form(post)

    def show(self, state: State) -> None:
        """Show a state."""
        self._state = state
        trainer = state[Trainer]
        if not trainer.exercise.usable:
            self._form.show(self._unusable(trainer))
        elif not trainer.started:
            self._form.show(self._beginning(trainer))
        else:
            self._form.show(self._running(trainer))
        if trainer.answers.placed:
            self._table.show(trainer)
        else:
            self._table.hide()
        self._after.show(self._next(trainer))

    # -- markup --------------------------------------------------------------------------------------------------

    def _unusable(self, trainer: Trainer) -> Inside:
        card = verdict_box("warn", "Not for this arm", UNUSABLE, sign="")
        return tag("h3", trainer.exercise.robot.name), card, self._arms(trainer)

    def _beginning(self, trainer: Trainer) -> Inside:
        hint = "Move the arm to the configuration of the exercise"
        start = self._form.button("trainer-start", "Start", StartTrainer(), "main", hint)
        return (
            tag("h3", f"Exercise: {trainer.exercise.robot.name}"),
            tag("p", INTRODUCTION),
            tag("div.bar", start),
            tag("h3", "Other arms"),
            self._arms(trainer),
        )

    def _running(self, trainer: Trainer) -> Inside:
        hint = "Discard all answers and start again"
        again = self._form.button("trainer-start", "start again", StartTrainer(), "copy", hint)
        end = self._form.button("trainer-end", "end", EndTrainer(), "copy", END)
        stage = "2 Table" if trainer.answers.placed else "1 Axes"
        if trainer.answers.placed:
            body = self._table.frames(self._form, trainer)
        else:
            body = axes_stage(self._form, trainer, self._units)
        title = f"{stage}: {trainer.exercise.robot.name}"
        return tag("h3", title, tag("span.copies", again, end)), self._moved(), body

    def _moved(self) -> Markup | None:
        if at_reference(self._state):
            return None
        back = self._form.chip(
            "trainer-pose", "Return to it", TakeTrainerPose(), "Move the arm back to the configuration of the exercise"
        )
        return tag("p.warn", "The arm has left the configuration of the exercise. ", back)

    def _next(self, trainer: Trainer) -> Markup | None:
        if not trainer.done:
            return None
        robots = usable_robots()
        keys = [robot.key for robot in robots]
        after = keys.index(trainer.exercise.robot.key) + 1 if trainer.exercise.robot.key in keys else 0
        chip = _chip(self._after, robots[after % len(robots)])
        end = self._after.button("trainer-end", "End the exercise", EndTrainer(), "chip", END)
        return tag("div.bar", tag("span.dim", "Next arm"), chip, end)

    def _arms(self, trainer: Trainer) -> list[Markup]:
        lines = []
        for title, least, most in SIZES:
            robots = [robot for robot in usable_robots() if least <= robot.arm.n <= most]
            chips = [_chip(self._form, robot) for robot in robots if robot.key != trainer.exercise.robot.key]
            lines.append(tag("p.tr-arms", tag("span.dim", title), chips))
        return lines


def _chip(form: Form, robot: Robot) -> Markup:
    return form.chip(f"trainer-robot-{robot.key}", robot.name, ChooseRobot(robot.key), robot.summary)


def build(gui: Gui, state: State, post: Post) -> Show:
    """Build the page."""
    return TrainerPanel(gui, state, post).show


def _around(state: State) -> Points:
    """Return the origins of the frames of an exercise, whose pose may lie outside the picture."""
    joints = state[Joints]
    return np.array(joints.arm.frames(joints.q)[:, :3, 3]) if state[Trainer].started else NOTHING


TELLING = ("frames", "lengths", "angles", "projections")
"""Layers in which the answers of an exercise could be read."""


def telling(state: State) -> tuple[str, ...]:
    """Return the layers that would answer the exercise, until it is done."""
    trainer = state[Trainer]
    return TELLING if trainer.started and not trainer.done else ()


PANEL = Panel(
    (Trainer, Joints),
    build,
    see_through=True,
    hides=("gizmo", "gap"),
    hides_then=telling,
    around=_around,
    looks=lambda state: state[Trainer].started,
)
