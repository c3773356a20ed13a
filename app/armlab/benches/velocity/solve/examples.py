"""Examples of the bench that solves for joint speeds, each with a sentence on what to look at."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

from armlab.benches.velocity.solve.state import Solve
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
    key, title, robot : str
    q : tuple of float
        Degrees and metres.
    twist : tuple of float
        m/s and rad/s, of the arm's task.
    says : str
        What to look at, in one sentence.
    rows : "task" or "position"
    """

    key: str
    title: str
    robot: str
    q: tuple[float, ...]
    twist: tuple[float, ...]
    says: str
    rows: str = "task"


EXAMPLES: Registry[Example] = Registry(
    "example",
    (
        Example(
            "one",
            "2R, regular: one answer⟦ (1.14)⟧",
            "planar_2r",
            (40.0, 55.0),
            (-0.5, 0.0),
            "det J = sin q₂ is not zero: the two lines of the page Joint space meet in one point.",
        ),
        Example(
            "stretched_30",
            "2R stretched at 30°: none⟦ (5.129)⟧",
            "planar_2r",
            (30.0, 0.0),
            (-0.5, 0.0),
            "v is outside the range: q̇ = (0.1, 0.05) rad/s reaches only its projection (−1/8, √3/8) m/s.",
        ),
        Example(
            "stretched_90",
            "2R stretched at 90°: infinitely many⟦ (5.131)⟧",
            "planar_2r",
            (90.0, 0.0),
            (-0.5, 0.0),
            "The same v is inside the range here: q̇ = (0.2, 0.1) rad/s is the shortest of infinitely many.",
        ),
        Example(
            "redundant_3r",
            "3R, position alone: minimum norm⟦ (5.116–5.123)⟧",
            "planar_3r",
            (17.188733853924695, -22.918311805232929, 51.566201561774087),
            (0.2, -0.3, 0.0),
            "Three joints for two components: J# v is the shortest answer, and the slider moves the arm while its tool "
            "stays.",
            "position",
        ),
        Example(
            "singular_3r",
            "3R folded: rank 1⟦ (5.82)⟧",
            "planar_3r",
            (90.0, 0.0, 180.0),
            (0.0, 0.3, 0.0),
            "J₂ = 0 and J₁ + J₃ = 0: the tool moves along x only, and two directions of joint speeds do nothing.",
            "position",
        ),
        Example(
            "on_the_axis",
            "Elbow 3R with its tool on axis 1⟦ (fig. 1.5)⟧",
            "elbow_3r",
            (20.0, 122.0053832080835, -90.0),
            (0.0, 0.0, 0.2),
            "Shoulder singularity: joint 1 turns and the tool stays, so no v perpendicular to the plane of the arm is "
            "reached.",
        ),
        Example(
            "elbow_stretched",
            "Elbow 3R stretched",
            "elbow_3r",
            (20.0, 35.0, 0.0),
            (0.2, 0.0, 0.0),
            "Elbow singularity on the boundary of the workspace: the velocity along the arm is lost.",
        ),
        Example(
            "rrp_upright",
            "RRP straight up: rank 2⟦ (5.91)⟧",
            "polar_rrp",
            (45.0, 90.0, 1.0),
            (0.2, 0.2, 0.1),
            "q₂ = 90°: the tool is on axis 1 and moves only in the plane that is drawn.",
        ),
        Example(
            "wrist",
            "Puma 560 with axes 4 and 6 in line",
            "puma560",
            (30.0, 45.0, -60.0, 0.0, 0.0, 0.0),
            (0.0, 0.1, 0.0, 0.0, 0.0, 0.0),
            "Wrist singularity: joints 4 and 6 turn the hand the same way, one against the other they do nothing.",
        ),
        Example(
            "seven",
            "iiwa 7: seven joints for six components",
            "iiwa7",
            (20.0, 40.0, 0.0, -80.0, 0.0, 60.0, 0.0),
            (0.0, 0.1, 0.0, 0.0, 0.0, 0.0),
            "There is always one joint speed more: the elbow turns about the line from shoulder to wrist.",
        ),
    ),
)
"""Examples by key, in the order of the list."""


@dataclass(frozen=True)
class ChooseSolveExample(Command):
    """Load the arm, the pose and the velocity of an example."""

    key: str
    label: ClassVar[str] = "example of joint speeds"

    def apply(self, state: State) -> State:
        """Return the state with the example loaded."""
        example = EXAMPLES[self.key]
        state = on_arm(state, example.robot)
        arm = state[RobotPart].robot.arm
        q = [math.radians(value) if arm.revolute[i] else value for i, value in enumerate(example.q)]
        part = replace(state[Solve], arm=arm, twist=example.twist, rows=example.rows, start=None, example=example.key)
        return state.replace(state[Joints].freed_at(q), part)


BENCH = Bench("solve", 62, EXAMPLES, ChooseSolveExample)
