"""Examples of sampled workspaces: an arm, the measure that colours them, and the cut."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

from armlab.benches.workspace.cloud.state import Workspace, question_of
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.examples import on_arm
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Command, State


@dataclass(frozen=True)
class Example:
    """One example, which is sampled at once.

    Attributes
    ----------
    key, title : str
    robot : str
        Key of its file.
    measure, draw, cut : str
        As in `armlab.benches.workspace.cloud.state.Workspace`.
    says : str
        What to look at, in one sentence.
    """

    key: str
    title: str
    robot: str
    measure: str
    draw: str
    cut: str
    says: str


EXAMPLES: Registry[Example] = Registry(
    "example",
    (
        Example(
            "annulus",
            "2R with unequal links: a ring",
            "planar_2r_unequal",
            "manipulability",
            "cloud",
            "none",
            "The hole has the radius |l₁ − l₂|; w depends on the radius alone, and is largest with a square elbow.",
        ),
        Example(
            "disc",
            "2R with equal links: a disc",
            "planar_2r",
            "manipulability",
            "cloud",
            "none",
            "The points crowd at the rim, where equal steps of q₂ are small steps of the radius, and in the middle, "
            "where a ring of equal width is small.",
        ),
        Example(
            "ball_3r",
            "3R in the plane, equal links",
            "planar_3r",
            "sigma_min",
            "cloud",
            "none",
            "Everything within 3 l is reached; the page Dexterous tells where every orientation is.",
        ),
        Example(
            "elbow",
            "Elbow arm, cut open",
            "elbow_3r",
            "manipulability",
            "cloud",
            "front",
            "A ball, with a bubble round the shoulder where the links differ; dark along the first axis, where joint 1 "
            "moves nothing.",
        ),
        Example(
            "box",
            "3P: a box",
            "cartesian_3p",
            "manipulability",
            "voxels",
            "none",
            "The strokes are the sides of the box, and w is the same everywhere.",
        ),
        Example(
            "puma",
            "PUMA 560, smallest singular value",
            "puma560",
            "sigma_min",
            "cloud",
            "front",
            "On a logarithmic scale the bad places stand out: the rim, the first axis, and scattered points where the "
            "wrist is singular.",
        ),
    ),
)
"""Examples by key, in the order of the list."""


@dataclass(frozen=True)
class ChooseWorkspaceExample(Command):
    """Load the arm of an example and sample its workspace."""

    key: str
    label: ClassVar[str] = "example of a workspace"

    def apply(self, state: State) -> State:
        """Return the state in which the example is being sampled."""
        example = EXAMPLES[self.key]
        state = on_arm(state, example.robot)
        robot = state[RobotPart].robot
        part = replace(
            Workspace.initial(robot),
            measure=example.measure,
            draw=example.draw,
            cut=example.cut,
            example=example.key,
        )
        state = state.replace(part)
        return state.replace(replace(part, asked=question_of(state)))


BENCH = Bench("workspace", 80, EXAMPLES, ChooseWorkspaceExample)
