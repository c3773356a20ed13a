"""Examples of coils, each with a sentence on what to look at."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.drive.torque.state import Torque
from armlab.session.bench import Bench
from armlab.session.examples import PartExample, part_examples
from armlab.session.fields import put
from armlab.session.state import Command, State

EXAMPLES = part_examples(
    PartExample(
        "one",
        "One coil with a commutator",
        Torque(),
        "The forces never change their size, and the torque does: it is zero twice a turn, where force and lever arm "
        "lie on one line, at every multiple of π.",
    ),
    PartExample(
        "unswitched",
        "The same coil without a commutator",
        Torque(switched=False),
        "The forces keep their directions, so that the torque is negative in the second half of the turn, and its "
        "mean is zero.",
    ),
    PartExample(
        "swings",
        "Let go without a commutator",
        Torque(switched=False, motion="free"),
        "The rotor swings about θ = π, where the forces pull the coil apart, until friction has stopped it. It is no "
        "motor.",
    ),
    PartExample(
        "runs",
        "Let go with a commutator",
        Torque(motion="free"),
        "The torque always has the same sign: the rotor runs up until friction takes the mean torque. Its speed goes "
        "up and down with the ripple.",
    ),
    PartExample(
        "two",
        "Two coils at a right angle",
        Torque(coils=2),
        "Where one coil has no torque the other one has its largest. The ripple falls from 157 % to 33 %.",
    ),
    PartExample(
        "three",
        "Three coils",
        Torque(coils=3),
        "Most small motors have three coils. Two would start from every angle as well, but with more than twice the "
        "ripple, which is 14 % here.",
    ),
    PartExample(
        "twelve",
        "Twelve coils",
        Torque(coils=12),
        "The ripple is 0.86 %: it falls with the square of the number of coils.",
    ),
    PartExample(
        "dead",
        "Let go at a dead point",
        Torque(motion="free", start=0.0, duration=4.0),
        "At θ = 0 a single coil has no torque, and the rotor stays where it is, whatever the current is.",
    ),
    PartExample(
        "level",
        "At the largest torque",
        Torque(start=0.5 * math.pi),
        "Force and lever arm are at a right angle: here the torque is 2 r F.",
    ),
)


@dataclass(frozen=True)
class ChooseTorqueExample(Command):
    """Put the coils of an example in place, and the film, if it is open, at its start."""

    key: str
    label: ClassVar[str] = "example of coils"

    def apply(self, state: State) -> State:
        """Return the state with the example in place."""
        return put(state, EXAMPLES[self.key].part)


BENCH = Bench("torque", 81, EXAMPLES, ChooseTorqueExample)
