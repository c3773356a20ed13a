"""Examples of points, each with a sentence on what to look at."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

from armlab.benches.frames.coordinates.state import Coordinates, Triple, placed
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.fields import put
from armlab.session.state import Command, State


@dataclass(frozen=True)
class PointExample:
    """A point.

    Attributes
    ----------
    key, title : str
    p : (float, float, float)
        Metres.
    shown : str
        What is drawn.
    says : str
        Sentence on what to look at.
    """

    key: str
    title: str
    p: Triple
    shown: str
    says: str


EXAMPLES = Registry(
    "example",
    (
        PointExample(
            "behind",
            "Behind the z axis",
            (-1.0, -2.0, 0.5),
            "cylindrical",
            "Both x and y are negative. Their quotient is the same as that of (1, 2), so atan(y / x) finds the "
            "opposite direction; atan2(y, x) looks at both signs.",
        ),
        PointExample(
            "left",
            "Beside the x axis, at the back",
            (-1.0, 0.05, 0.8),
            "cylindrical",
            "Drag the point across the x axis: θ jumps from 180° to −180°, though the point hardly moves.",
        ),
        PointExample(
            "axis",
            "On the z axis",
            (0.0, 0.0, 1.0),
            "cylindrical",
            "Here r = 0, and every θ names this point. A tiny step aside gives θ any value.",
        ),
        PointExample(
            "globe",
            "On a globe",
            (0.6, 0.6, 0.7),
            "spherical",
            "On a globe θ is the longitude, and φ is 90° minus the latitude.",
        ),
        PointExample(
            "origin",
            "At the origin",
            (0.0, 0.0, 0.0),
            "spherical",
            "The origin has r = 0 and nothing else: neither θ nor φ is defined.",
        ),
    ),
)


@dataclass(frozen=True)
class ChoosePointExample(Command):
    """Put the point of an example in place."""

    key: str
    label: ClassVar[str] = "example of coordinates"

    def apply(self, state: State) -> State:
        """Return the state with the point of the example."""
        example = EXAMPLES[self.key]
        part = placed(state[Coordinates], example.p)
        return put(state, replace(part, shown=example.shown, example=example.key))


BENCH = Bench("coordinates", 18, EXAMPLES, ChoosePointExample)
