"""Examples of sections 1.2 and 5.1 of the notes: an arm, a pose and joint speeds."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

from armlab.benches.velocity.speeds.state import Velocity, within
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
        Key of its file.
    q, qdot : tuple of float
        rad and m, rad/s and m/s.
    says : str
        What to look at, in one or two sentences.
    sets : dict
        Further fields of `armlab.benches.velocity.speeds.state.Velocity`.
    """

    key: str
    title: str
    robot: str
    q: tuple[float, ...]
    qdot: tuple[float, ...]
    says: str
    sets: dict[str, Any] = field(default_factory=dict)


def _degrees(*values: float) -> tuple[float, ...]:
    return tuple(math.radians(value) for value in values)


EXAMPLES: Registry[Example] = Registry(
    "example",
    (
        Example(
            "planar",
            "2R: parts and sum⟦ (1.9–1.11)⟧",
            "planar_2r",
            _degrees(10.0, 100.0),
            _degrees(40.0, 50.0),
            "Each joint moves the tool perpendicular to the line from its axis to the tool; put tip to tail, both "
            "parts are v. ⟦The columns of J are the j₁, j₂ of the notes, which 1.18 writes as rows.⟧",
        ),
        Example(
            "kernel",
            "3R: tool on the axis z₀⟦ (1.25)⟧",
            "elbow_3r",
            (math.radians(20.0), math.atan2(0.8, -0.5), math.radians(-90.0)),
            _degrees(60.0, 0.0, 0.0),
            "Joint 1 turns and the tool point stays: the linear half of column 1 is 0, so (1, 0, 0) is in the kernel "
            "of the linear J. Only ω is not 0: the tool turns on the spot.",
        ),
        Example(
            "sliding",
            "RRP: a prismatic joint⟦ (5.57)⟧",
            "polar_rrp",
            (math.radians(20.0), math.radians(30.0), 0.7),
            (0.0, math.radians(30.0), 0.2),
            "The column of joint 3 is (z₂; 0): it moves every point of its link alike and turns nothing. Joint 2 gives "
            "z₁ × p and turns the tool.",
        ),
        Example(
            "two_points",
            "Two points of a link⟦ (1.8, 5.9)⟧",
            "planar_2r",
            _degrees(30.0, 70.0),
            _degrees(30.0, -60.0),
            "The points of link 2 have different velocities and one ω; their difference ω × r₁₂ is perpendicular "
            "to the line between them, so that they stay as far apart as they are.",
            {
                "marks": frozenset(("points",)),
                "unfolded": frozenset(("points",)),
                "link": 2,
                "points": ((-1.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
            },
        ),
        Example(
            "wrist",
            "PUMA: joint 4 against joint 6",
            "puma560",
            _degrees(0.0, 45.0, -180.0, 0.0, 0.0, 0.0),
            _degrees(0.0, 0.0, 0.0, 40.0, 0.0, -40.0),
            "With q₅ = 0 the axes of joints 4 and 6 are one line: columns 4 and 6 of J are the same, and opposite "
            "speeds leave the tool at rest, v = 0 and ω = 0.",
            {"marks": frozenset(("v", "omega"))},
        ),
        Example(
            "curving",
            "Constant joint speeds, accelerated tool⟦ (5.68)⟧",
            "planar_2r",
            _degrees(20.0, 90.0),
            _degrees(60.0, 0.0),
            "q̈ = 0, but J changes along the way: J̇q̇ points from the tool to the axis of joint 1, with |v|²/r.",
            {"unfolded": frozenset(("higher",))},
        ),
    ),
)
"""Examples by key, in the order of the list."""


@dataclass(frozen=True)
class ChooseVelocityExample(Command):
    """Load the arm, the pose and the joint speeds of an example."""

    key: str
    label: ClassVar[str] = "example of velocities"

    def apply(self, state: State) -> State:
        """Return the state with the example loaded."""
        example = EXAMPLES[self.key]
        state = on_arm(with_clip_closed(state), example.robot)
        robot = state[RobotPart].robot
        qdot = tuple(within(robot.arm, i, speed) for i, speed in enumerate(example.qdot))
        start = {"marks": frozenset(("v",)), **example.sets}
        part = replace(Velocity.initial(robot), **start, qdot=qdot, example=self.key)
        return state.replace(state[Joints].freed_at(example.q), part)


BENCH = Bench("velocity", 60, EXAMPLES, ChooseVelocityExample)
