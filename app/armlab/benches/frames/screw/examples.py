"""Examples of screw motions, each with a sentence on what to look at."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

from armlab.benches.frames.chain.state import Triple
from armlab.benches.frames.screw.state import Screw
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.fields import put
from armlab.session.state import Command, State


@dataclass(frozen=True)
class ScrewExample:
    """Two poses.

    Attributes
    ----------
    key, title : str
    first, second : (position, angles)
        Metres; roll, pitch and yaw in degrees.
    says : str
        Sentence on what to look at.
    """

    key: str
    title: str
    first: tuple[Triple, Triple]
    second: tuple[Triple, Triple]
    says: str

    def values(self) -> dict[str, Any]:
        """Return the fields of the part."""
        found: dict[str, Any] = {"example": self.key}
        for which, (position, degrees) in (("1", self.first), ("2", self.second)):
            found[f"position{which}"] = position
            found[f"angles{which}"] = tuple(math.radians(angle) for angle in degrees)
        return found


STILL: Triple = (0.0, 0.0, 0.0)

EXAMPLES = Registry(
    "example",
    (
        ScrewExample(
            "general",
            "Two poses in space",
            ((0.5, 0.0, 0.1), STILL),
            ((-0.1, 0.55, 0.5), (20.0, -10.0, 120.0)),
            "Whichever two poses you choose, there is a line about which a body turns and along which it slides from "
            "one to the other. On the straight path it turns in the same way.",
        ),
        ScrewExample(
            "bolt",
            "A bolt",
            ((0.4, 0.2, 0.1), STILL),
            ((0.4, 0.2, 0.3), (0.0, 0.0, 150.0)),
            "The axis runs through the origin of the body, so the helix is a line: both ways are the same.",
        ),
        ScrewExample(
            "door",
            "A door",
            ((0.8, 0.0, 0.2), STILL),
            ((0.0, 0.8, 0.2), (0.0, 0.0, 90.0)),
            "The pitch is zero, a mere rotation: the door stays on its hinge. The straight way would tear it off.",
        ),
        ScrewExample(
            "slide",
            "A shift",
            ((0.5, -0.2, 0.1), (0.0, 0.0, 30.0)),
            ((0.1, 0.5, 0.5), (0.0, 0.0, 30.0)),
            "Nothing turns: a translation. The pitch is infinite, and any line in this direction would do as an axis.",
        ),
        ScrewExample(
            "half",
            "Half a turn",
            ((0.5, 0.1, 0.1), STILL),
            ((-0.3, 0.1, 0.3), (0.0, 0.0, 180.0)),
            "At 180° the opposite axis is as good: the body may turn either way about the same line.",
        ),
        ScrewExample(
            "same",
            "Twice the same pose",
            ((0.5, 0.1, 0.2), (0.0, 0.0, 40.0)),
            ((0.5, 0.1, 0.2), (0.0, 0.0, 40.0)),
            "Nothing moves: the identity. There is no axis to find, or any line is one.",
        ),
    ),
)


@dataclass(frozen=True)
class ChooseScrewExample(Command):
    """Put the two poses of an example in place."""

    key: str
    label: ClassVar[str] = "example of a screw motion"

    def apply(self, state: State) -> State:
        """Return the state with the poses of the example."""
        return put(state, state[Screw].with_values(EXAMPLES[self.key].values()))


BENCH = Bench("screw", 19, EXAMPLES, ChooseScrewExample)
