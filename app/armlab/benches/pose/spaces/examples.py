"""Examples of spaces and representations, each with a sentence on what to look at."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from armlab.benches.pose.spaces.state import Spaces
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.examples import on_arm, with_clip_closed
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, State


@dataclass(frozen=True)
class SpacesExample:
    """A place of the page, perhaps with an arm.

    Attributes
    ----------
    key, title : str
    sets : mapping
        Fields of `Spaces`.
    says : str
    robot : str
        Key of its file; empty for the arm that is there.
    q : tuple of float
        Joint values of that arm, rad and m.
    """

    key: str
    title: str
    sets: Mapping[str, Any]
    says: str
    robot: str = ""
    q: tuple[float, ...] = ()


def _degrees(*values: float) -> tuple[float, ...]:
    return tuple(math.radians(value) for value in values)


EXAMPLES = Registry(
    "example",
    (
        SpacesExample(
            "square",
            "2R: two joints, two numbers",
            {"shown": "maps", "task": "own"},
            "As many numbers in r as joints: to a point within reach belong two arms, and at the edge one.",
            "planar_2r",
            _degrees(30.0, 60.0),
        ),
        SpacesExample(
            "redundant",
            "3R: a joint more than the point needs",
            {"shown": "maps", "task": "xy"},
            "Three joints for two numbers: whole curves of joint values belong to one point. Let r describe φ as well, "
            "and it is square.",
            "planar_3r",
            _degrees(20.0, 50.0, 40.0),
        ),
        SpacesExample(
            "more",
            "2R: position and angle asked for",
            {"shown": "maps", "task": "xy phi"},
            "Three numbers and two joints: φ = q₁ + q₂ follows from the rest, and most r belong to no arm at all.",
            "planar_2r",
            _degrees(30.0, 60.0),
        ),
        SpacesExample(
            "off",
            "A stick that would have to stretch",
            {"shown": "stick", "by": "xy", "x": 0.9, "y": -0.9, "length": 1.0},
            "Two numbers may be chosen freely, and most pairs are no configuration: the residual tells by how much.",
        ),
        SpacesExample(
            "on",
            "The same stick by its angle",
            {"shown": "stick", "by": "theta", "x": 0.6, "y": -0.8, "length": 1.0},
            "Every θ is a configuration: one number, no constraint, and no residual to watch.",
        ),
        SpacesExample(
            "two_arms",
            "3R by joint 3: two arms, two tools",
            {"shown": "arms", "described": "joint3"},
            "Both arms have the same r, and their tools are far apart: these numbers do not say where the tool is.",
            "planar_3r",
            _degrees(20.0, 70.0, 30.0),
        ),
        SpacesExample(
            "one_tool",
            "3R by its tool: two arms, one tool",
            {"shown": "arms", "described": "tool"},
            "Two arms again, but one pose of the tool: r describes the task, and the arm is left to the inverse "
            "kinematics.",
            "planar_3r",
            _degrees(20.0, 70.0, 30.0),
        ),
    ),
)


@dataclass(frozen=True)
class ChooseSpacesExample(Command):
    """Show a place of the page, with its arm if it has one."""

    key: str
    label: ClassVar[str] = "example of spaces"

    def apply(self, state: State) -> State:
        """Return the state with the example."""
        example = EXAMPLES[self.key]
        if example.robot:
            state = on_arm(with_clip_closed(state), example.robot)
            state = state.replace(state[Joints].freed_at(example.q))
        return state.replace(state[Spaces].with_values({**example.sets, "example": self.key}))


BENCH = Bench("spaces", 8, EXAMPLES, ChooseSpacesExample)
