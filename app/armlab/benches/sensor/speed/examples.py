"""Examples of the speed from an encoder, each with a sentence on what to look at."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.sensor.speed.state import EncoderSpeed
from armlab.session.bench import Bench
from armlab.session.examples import PartExample, part_examples
from armlab.session.fields import put
from armlab.session.state import Command, State

DEG = math.radians(1.0)

EXAMPLES = part_examples(
    PartExample(
        "notes",
        "PPR 1000, 200 counts in 0.1 s: 720°/s",
        EncoderSpeed(),
        "200 counts of 0.36° in 0.1 s are 720°/s. One count more or less is 3.6°/s, half a percent, and the reading is "
        "50 ms old.⟦ The example of 2.43.⟧",
    ),
    PartExample(
        "slow",
        "The same encoder at 9°/s",
        EncoderSpeed(speed=9.0 * DEG),
        "2.5 counts come in a window: the speed reads 7.2°/s or 10.8°/s. The time between two counts, 40 000 ticks, "
        "tells it to 0.0025 %.",
    ),
    PartExample(
        "servo",
        "A servo loop: T = 1 ms, ×4",
        EncoderSpeed(decoder="x4", window=1e-3, clock=1e7),
        "A loop of 1 kHz cannot wait 0.1 s. In 1 ms there are 8 counts, so that one of them is 12 % of the speed; a "
        "finer clock and the time between counts keep 0.1 %.",
    ),
    PartExample(
        "coarse_clock",
        "A slow clock, a fast shaft",
        EncoderSpeed(decoder="x4", clock=1e5, speed=3600.0 * DEG),
        "Between two counts there are 2.5 ticks: the time reads 3000°/s or 4500°/s in turn, and counting is far "
        "better.",
    ),
    PartExample(
        "uneven",
        "×2 by the rising edges of A and of B",
        EncoderSpeed(decoder="x2_notes"),
        "The counts lie 90° and 270° electrical apart. In a window that hardly matters, but the time between counts "
        "reads twice the speed and two thirds of it in turn.⟦ The notes' D = 2.⟧",
    ),
)


@dataclass(frozen=True)
class ChooseSpeedExample(Command):
    """Load the encoder, the window, the clock and the speed of an example."""

    key: str
    label: ClassVar[str] = "example of the speed from an encoder"

    def apply(self, state: State) -> State:
        """Return the state with the example loaded."""
        return put(state, EXAMPLES[self.key].part)


BENCH = Bench("encoder_speed", 72, EXAMPLES, ChooseSpeedExample)
