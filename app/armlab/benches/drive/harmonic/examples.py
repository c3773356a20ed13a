"""Examples of harmonic drives, each with a sentence on what to look at."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.drive.harmonic.state import Harmonic
from armlab.session.bench import Bench
from armlab.session.examples import PartExample, part_examples
from armlab.session.fields import put
from armlab.session.state import Command, State

EXAMPLES = part_examples(
    PartExample(
        "sixty",
        "60 and 62 teeth: teeth to be followed",
        Harmonic(),
        "Follow the marked tooth of the flexspline: while the wave generator goes round once, it falls back by two "
        "teeth.",
    ),
    PartExample(
        "notes",
        "200 and 202 teeth: n = −100⟦ (2.29)⟧",
        Harmonic(200),
        "A hundred turns of the wave generator are one of the flexspline, in the opposite sense.",
    ),
    PartExample(
        "flexible",
        "Flexspline fixed: n = +101",
        Harmonic(200, fixed="flexible"),
        "Now the circular spline goes along with the wave generator, by two of its 202 teeth in each turn.",
    ),
    PartExample(
        "generator",
        "Wave generator fixed: hardly a gear",
        Harmonic(60, fixed="generator"),
        "Both splines turn the same way and almost equally fast: one has two teeth more to make in a turn.",
    ),
    PartExample(
        "three",
        "Three lobes, three teeth more",
        Harmonic(60, 3),
        "The teeth mesh at three places, and three of them are lost in a turn.",
    ),
    PartExample(
        "four",
        "Two lobes, four teeth more",
        Harmonic(60, 4),
        "The flexspline is bent twice as far, and falls back by four teeth in a turn: half the ratio.",
    ),
)
"""Examples by key, in the order of the list."""


@dataclass(frozen=True)
class ChooseHarmonicExample(Command):
    """Put the numbers of teeth of an example in place, and the part that it fixes."""

    key: str
    label: ClassVar[str] = "example of harmonic drives"

    def apply(self, state: State) -> State:
        """Return the state with the example in place."""
        return put(state, EXAMPLES[self.key].part)


BENCH = Bench("harmonic", 84, EXAMPLES, ChooseHarmonicExample)
