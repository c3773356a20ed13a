"""Examples of the bench of statics, each with a sentence on what to look at."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.velocity.statics.state import ZERO, Axes, Statics, Triple
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.examples import on_arm, with_clip_closed
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Command, State


@dataclass(frozen=True)
class Example:
    """One example.

    Attributes
    ----------
    key, title : str
    robot : str
        Key of the arm.
    q : tuple of float
        Where it stands, rad and m; empty for its home pose.
    says : str
        What to look at, in one sentence.
    force, moment : (float, float, float)
        N and N m, by the robot on the environment.
    axes : "world" or "tool"
    """

    key: str
    title: str
    robot: str
    q: tuple[float, ...]
    says: str
    force: Triple = ZERO
    moment: Triple = ZERO
    axes: Axes = "world"

    def part(self) -> Statics:
        """Return the bench with this example loaded."""
        part = Statics(self.force, self.moment, self.axes, example=self.key)
        return part.fitted()


def _degrees(*angles: float) -> tuple[float, ...]:
    return tuple(math.radians(angle) for angle in angles)


def _along(angle: float, size: float) -> Triple:
    return size * math.cos(math.radians(angle)), size * math.sin(math.radians(angle)), 0.0


EXAMPLES: Registry[Example] = Registry(
    "example",
    (
        Example(
            "torques_2r",
            "2R: the torques of a force⟦ (5.163)⟧",
            "planar_2r_unequal",
            (0.4, 0.9),
            "τ = JᵀF with l₁ = 1 m, l₂ = 0.5 m and F = (3, −2) N: −4.723 N m and −1.713 N m; each is the force times "
            "its distance from the axis.",
            force=(3.0, -2.0, 0.0),
        ),
        Example(
            "along",
            "Stretched 2R: push along the arm",
            "planar_2r",
            _degrees(30.0, 0.0),
            "The line of the force meets both axes, so it has no lever arm: the links carry 20 N and the motors "
            "nothing. The arm is singular here.",
            force=_along(30.0, 20.0),
        ),
        Example(
            "across",
            "Stretched 2R: push across the arm",
            "planar_2r",
            _degrees(30.0, 0.0),
            "Across the stretched arm the lever arms are as long as they can be, 2 m and 1 m: 40 N m and 20 N m.",
            force=_along(120.0, 20.0),
        ),
        Example(
            "toggle",
            "Almost stretched: a toggle press",
            "planar_2r",
            _degrees(-5.0, 10.0),
            "Near the singularity little torque makes much force along the arm: 100 N with 8.7 N m in joint 2. The "
            "tool hardly moves that way: slow is strong.",
            force=(100.0, 0.0, 0.0),
        ),
        Example(
            "weight",
            "Puma 560: hold a weight",
            "puma560",
            (),
            "The robot pushes up with 20 N to hold what weighs 20 N. Joint 1 turns about the vertical and has nothing "
            "to do with it.",
            force=(0.0, 0.0, 20.0),
        ),
        Example(
            "screwdriver",
            "Puma 560: drive a screw",
            "puma560",
            (),
            "A moment about the tool's own axis: joint 6 has that axis and needs all of it; the others need what their "
            "axes share with it.",
            moment=(0.0, 0.0, 2.0),
            axes="tool",
        ),
        Example(
            "press",
            "SCARA: press downwards",
            "scara",
            (),
            "Only the prismatic joint points along the force. The others would be free to move: a force along their "
            "axes needs no torque.",
            force=(0.0, 0.0, -30.0),
        ),
        Example(
            "slide",
            "Polar arm: a prismatic joint gives a force",
            "polar_rrp",
            (),
            "Joints 1 and 2 answer with torques in N m, the sliding one with the part of the force along it, in N.",
            force=(12.0, 0.0, 16.0),
        ),
    ),
)
"""Examples by key, in the order of the list."""


@dataclass(frozen=True)
class ChooseExample(Command):
    """Load the arm, the configuration and the wrench of an example."""

    key: str
    label: ClassVar[str] = "example of statics"

    def apply(self, state: State) -> State:
        """Return the state with the example loaded."""
        example = EXAMPLES[self.key]
        state = on_arm(with_clip_closed(state), example.robot)
        q = example.q or state[RobotPart].robot.home
        return state.replace(state[Joints].freed_at(q), example.part())


BENCH = Bench("statics", 70, EXAMPLES, ChooseExample)
