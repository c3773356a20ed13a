"""Examples of pose accuracy and repeatability, each with a sentence on what to look at."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.sensor.pose.state import Repeats
from armlab.session.bench import Bench
from armlab.session.examples import PartExample, part_examples
from armlab.session.fields import put
from armlab.session.state import Command, State

DEG = math.radians(1.0)

EXAMPLES = part_examples(
    PartExample(
        "usual",
        "An industrial arm",
        Repeats(),
        "It comes back to within a fraction of a millimetre, and to a place that is farther off: the zeros of its "
        "joints are a little wrong, every time alike.",
    ),
    PartExample(
        "same_side",
        "Backlash, from the same side",
        Repeats(backlash=0.1 * DEG, play=1e-4, zero=0.0, zero_slide=0.0, approach="same"),
        "Every joint comes from below and stops half its backlash short, every time: an error of accuracy, and a cloud "
        "as small as the counts.",
    ),
    PartExample(
        "either_side",
        "The same backlash, from either side",
        Repeats(backlash=0.1 * DEG, play=1e-4, zero=0.0, zero_slide=0.0, approach="either"),
        "Now each joint stops short on one side or the other. The mean is right, and the repeatability is bad: of the "
        "same gears, another figure tells.",
    ),
    PartExample(
        "link_encoder",
        "A coarse encoder on the link",
        Repeats(counts=4096, shaft="link", backlash=0.0, play=0.0, zero=0.0, zero_slide=0.0),
        "0.0879° of a count at the joint. On the motor, before the gears, the same encoder is a hundred times as fine.",
    ),
    PartExample(
        "zeros",
        "Wrong zeros alone",
        Repeats(counts=10_000_000, backlash=0.0, play=0.0, zero=0.1 * DEG, zero_slide=2e-4),
        "A robot that repeats perfectly and is wrong: taught by hand it works, programmed by numbers it does not. "
        "Calibration finds the zeros.",
    ),
)


@dataclass(frozen=True)
class ChoosePoseExample(Command):
    """Load the errors of the joints and the attempts of an example, for the arm that is there."""

    key: str
    label: ClassVar[str] = "example of pose accuracy"

    def apply(self, state: State) -> State:
        """Return the state with the example loaded."""
        return put(state, EXAMPLES[self.key].part)


BENCH = Bench("pose_accuracy", 75, EXAMPLES, ChoosePoseExample)
