"""Examples of accuracy and repeatability, each with a sentence on what to look at."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.sensor.measure.state import Throws
from armlab.session.bench import Bench
from armlab.session.examples import PartExample, part_examples
from armlab.session.fields import put
from armlab.session.state import Command, State

EXAMPLES = part_examples(
    PartExample(
        "biased",
        "Repeatable, not accurate",
        Throws(),
        "All throws land close together, and beside the middle. One correction of the aim moves them all: what "
        "calibration is for.",
    ),
    PartExample(
        "spread",
        "Accurate on the mean, not repeatable",
        Throws(right=0.0, up=0.0, spread=0.045),
        "The centre of the throws is the middle, as far as they can tell, and yet only four of twenty hit. No "
        "correction helps here, only a steadier hand: better components.",
    ),
    PartExample(
        "both",
        "Neither accurate nor repeatable",
        Throws(right=-0.06, up=0.05, spread=0.04),
        "After a correction the spread is left, and the aim itself is only as sure as the circle around the centre.",
    ),
    PartExample(
        "good",
        "Accurate and repeatable",
        Throws(right=0.002, up=-0.001, spread=0.006),
        "A small bias beside a small spread: twenty throws do not tell whether there is a bias at all.",
    ),
    PartExample(
        "few",
        "Three throws",
        Throws(count=3, spread=0.03),
        "From three throws the spread is known to a factor of three or so, and the circle of the bias is larger than "
        "they are apart.",
    ),
)


@dataclass(frozen=True)
class ChooseThrowsExample(Command):
    """Load the throws of an example."""

    key: str
    label: ClassVar[str] = "example of accuracy and repeatability"

    def apply(self, state: State) -> State:
        """Return the state with the example loaded."""
        return put(state, EXAMPLES[self.key].part)


BENCH = Bench("accuracy", 73, EXAMPLES, ChooseThrowsExample)
