"""Examples of the table task, each with a sentence on what to look at."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

from armlab.benches.frames.table.commands import followed
from armlab.benches.frames.table.place import rounded_length
from armlab.benches.frames.table.state import SHARES, TableTask
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.fields import put
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Command, State


@dataclass(frozen=True)
class TableExample:
    """A table, an object and the tool above it, for an arm of any size.

    Attributes
    ----------
    key, title : str
    shares : (float, float, float)
        Place of the object on the table and height of the tool, in length scales of the arm.
    turn, spin : float
        Angles of the table and of the tool, degrees.
    says : str
        Sentence on what to look at.
    """

    key: str
    title: str
    shares: tuple[float, float, float]
    turn: float
    spin: float
    says: str

    def values(self, scale: float) -> dict[str, Any]:
        """Return the fields of the part for an arm with a length scale, metres."""
        x, y, h = (rounded_length(share * scale) for share in self.shares)
        return {
            "corner": None,
            "turn": math.radians(self.turn),
            "place": (x, y),
            "height": h,
            "spin": math.radians(self.spin),
            "example": self.key,
        }


EXAMPLES = Registry(
    "example",
    (
        TableExample(
            "above",
            "Above the object⟦ (3.121)⟧",
            SHARES,
            0.0,
            0.0,
            "The tool looks down: its z axis is opposite to that of the table, and its y axis as well. In the frame of "
            "the table it stands above the object, at height h.",
        ),
        TableExample(
            "turned",
            "The table is turned",
            SHARES,
            25.0,
            0.0,
            "In the frame of the table nothing has changed. Only the pose of the table in the world has changed, and "
            "with it the pose that the arm has to reach.",
        ),
        TableExample(
            "touch",
            "The tool at the object",
            (SHARES[0], SHARES[1], 0.0),
            0.0,
            90.0,
            "With h = 0 the tool is at the object. A turn about its own z axis moves it nowhere: the object stays on "
            "that axis.",
        ),
        TableExample(
            "far",
            "An object out of reach",
            (3.2, SHARES[1], SHARES[2]),
            0.0,
            0.0,
            "The frames are as right as before, but the arm is too short. Press the button: the tool comes as near as "
            "it can, and the lab says how much is missing.",
        ),
    ),
)


@dataclass(frozen=True)
class ChooseTableExample(Command):
    """Put the table and the object of an example in place."""

    key: str
    label: ClassVar[str] = "example of the table task"

    def apply(self, state: State) -> State:
        """Return the state with table and object of the example."""
        scale = state[RobotPart].robot.arm.length_scale
        state = put(state, state[TableTask].with_values(EXAMPLES[self.key].values(scale)))
        return followed(state) if state[TableTask].follows else state


BENCH = Bench("table_task", 17, EXAMPLES, ChooseTableExample)
