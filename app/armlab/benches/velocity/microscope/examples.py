"""Examples of the singularity microscope: an arm beside or at a singularity, and a velocity."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

from armlab.benches.velocity.microscope.state import Aim, Microscope
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.examples import on_arm
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
        Key of its file.
    degrees : dict
        Joints (1-based, turning) that are not as in the home pose.
    aim : "lost" or "across"
    method : str
        Whose answer is drawn.
    says : str
        What to look at, in one sentence.
    """

    key: str
    title: str
    robot: str
    degrees: dict[int, float]
    aim: Aim
    method: str
    says: str


EXAMPLES: Registry[Example] = Registry(
    "example",
    (
        Example(
            "near_stretched",
            "2R almost stretched, along the arm",
            "planar_2r",
            {1: 60.0, 2: 3.0},
            "lost",
            "dls_variable",
            "J⁻¹ moves the tool exactly as wanted, with joint speeds many times those of the others; damping trades "
            "them for an error along the arm.",
        ),
        Example(
            "stretched",
            "2R stretched, along the arm",
            "planar_2r",
            {1: 60.0, 2: 0.0},
            "lost",
            "dls_constant",
            "There is no inverse. Every other method leaves the joints at rest: none of them can move the tool along "
            "the arm.",
        ),
        Example(
            "stretched_across",
            "2R stretched, across the arm",
            "planar_2r",
            {1: 60.0, 2: 0.0},
            "across",
            "pinv",
            "Across the arm nothing is lost: pseudo-inverse and transpose reach the wanted velocity, damping falls "
            "a little "
            "short of it, and J⁻¹ still does not exist.",
        ),
        Example(
            "wrist",
            "PUMA 560, axes 4 and 6 almost in line",
            "puma560",
            {5: 2.0},
            "lost",
            "dls_variable",
            "Joints 4 and 6 turn against each other at high speed for a slow rotation of the tool; the arm itself "
            "stands "
            "well, which is why wrist singularities surprise.",
        ),
        Example(
            "elbow",
            "PUMA 560, almost stretched",
            "puma560",
            {3: -85.0, 5: 40.0},
            "lost",
            "dls_variable",
            "The wrist centre can hardly move along the line from the shoulder; joints 2 and 3 pay for it.",
        ),
    ),
)
"""Examples by key, in the order of the list."""


@dataclass(frozen=True)
class ChooseMicroscopeExample(Command):
    """Load the arm, the configuration and the velocity of an example."""

    key: str
    label: ClassVar[str] = "example of the microscope"

    def apply(self, state: State) -> State:
        """Return the state with the example loaded."""
        example = EXAMPLES[self.key]
        state = on_arm(state, example.robot)
        q = state[RobotPart].robot.home.copy()
        for joint, degrees in example.degrees.items():
            q[joint - 1] = math.radians(degrees)
        fresh = Microscope.initial(state[RobotPart].robot)
        part = replace(fresh, aim=example.aim, method=example.method, example=example.key)
        return state.replace(state[Joints].freed_at(q), part)


BENCH = Bench("microscope", 70, EXAMPLES, ChooseMicroscopeExample)
