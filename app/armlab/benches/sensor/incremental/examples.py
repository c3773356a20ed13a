"""Examples of the incremental encoder, each with a sentence on what to look at."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.sensor.incremental.state import Incremental
from armlab.kin.sensors.absolute import TURN
from armlab.session.bench import Bench
from armlab.session.examples import PartExample, part_examples
from armlab.session.fields import put
from armlab.session.state import Command, State

DEG = math.radians(1.0)

EDGE = 0.25 * TURN / 8
"""Angle of the first rising edge of A on a disk of eight periods, radians."""

EXAMPLES = part_examples(
    PartExample(
        "four",
        "Two periods, counted ×4",
        Incremental(pulses=4, moves=(180.0 * DEG,)),
        "Half a turn of four periods: 2 rising edges of A, and 8 edges of A and B together.",
    ),
    PartExample(
        "reversals",
        "There and back",
        Incremental(),
        "The moves add up to zero. Every rule that counts back over the same edges ends at 0; the rising edges of A "
        "alone do not know the direction.",
    ),
    PartExample(
        "trembling",
        "Trembling at an edge of A",
        Incremental(start=EDGE - 2.0 * DEG, moves=(), shakes=10, shake=32.0 * DEG, speed=20.0 * DEG, decoder="rising"),
        "The disk goes nowhere, and A rises ten times. A counter that adds 1 at each rising edge of A, whatever it "
        "reads of B, runs away: on the way back it must count the same edge, falling.",
    ),
    PartExample(
        "one_way",
        "A quarter of a turn and back, both called clockwise",
        Incremental(pulses=16, moves=(90.0 * DEG, -90.0 * DEG), rule="same"),
        "If A before B and B before A are the same direction, the way back counts up, too: 32 counts in place of 0."
        "⟦ The notes print clockwise for both.⟧",
    ),
    PartExample(
        "uneven",
        "×2 by the rising edges of A and of B",
        Incremental(pulses=4, moves=(360.0 * DEG,), decoder="x2_notes"),
        "Two counts in each period, one where A rises, one where B does: right on average, but not equally far apart."
        "⟦ The notes count the rising edges of A and of B for D = 2.⟧",
    ),
    PartExample(
        "index",
        "Z finds the zero",
        Incremental(start=100.0 * DEG, moves=(-130.0 * DEG, 75.0 * DEG), index=True),
        "The counter begins with 0 wherever the disk stands, here 100° from zero. When Z comes by it is set to 0, and "
        "from then on it tells the angle.",
    ),
    PartExample(
        "thousand",
        "1000 periods, a tenth of a second at 720°/s",
        Incremental(pulses=1000, moves=(72.0 * DEG,), speed=720.0 * DEG, decoder="x1"),
        "72° are 200 periods of 0.36°: 200 counts of one edge each, 800 of all edges.⟦ The example of 2.43.⟧",
    ),
)


@dataclass(frozen=True)
class ChooseIncrementalExample(Command):
    """Load the encoder and the moves of an example, and put the film, if it is open, at its start."""

    key: str
    label: ClassVar[str] = "example of the incremental encoder"

    def apply(self, state: State) -> State:
        """Return the state with the example loaded."""
        return put(state, EXAMPLES[self.key].part)


BENCH = Bench("incremental", 71, EXAMPLES, ChooseIncrementalExample)
