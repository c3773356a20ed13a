"""Examples of accuracy and repeatability, each with a sentence on what to look at."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

from armlab.benches.robot.taught.state import TaughtGoal
from armlab.session.bench import Bench
from armlab.session.examples import PartExample, part_examples
from armlab.session.fields import put
from armlab.session.state import Command, State

TENTH, FINE, COARSE = math.radians(0.1), math.radians(0.003), math.radians(0.08)

EXAMPLES = part_examples(
    PartExample(
        "repeats",
        "Repeatable, not accurate",
        TaughtGoal(),
        "The usual case: the arm comes back to one place, and that is not the one its table says. AP is many times RP.",
    ),
    PartExample(
        "scatters",
        "Accurate, not repeatable",
        TaughtGoal(0.0, 0.0, 0.0, COARSE, 1e-3),
        "The mean is at the goal, and hardly any visit is: an accuracy that helps nobody.",
    ),
    PartExample(
        "both",
        "Both",
        TaughtGoal(0.0, 0.0, 0.0, FINE),
        "A calibrated arm: lengths and zeros are as the table says, and joints stop where they should.",
    ),
    PartExample(
        "neither",
        "Neither",
        TaughtGoal(5e-4, TENTH, 5e-4, COARSE, 1e-3),
        "Calibration would bring the mean to the goal; the scatter would stay.",
    ),
    PartExample(
        "taught",
        "The same arm, its goal taught",
        TaughtGoal(taught=True),
        "The goal is where the arm itself once stood: its wrong lengths and zeros cancel, and what is left is "
        "repeatability.",
    ),
    PartExample(
        "peg",
        "A peg, and a hand that yields",
        TaughtGoal(scatter=math.radians(0.01), slide_scatter=5e-5, taught=True, clearance=5e-5, yields=5e-4),
        "Few pegs would find a hole so narrow. A hand that gives way by half a millimetre gets most of them in, if the "
        "arm is not too long; set it to zero.",
    ),
)


@dataclass(frozen=True)
class ChooseGoalExample(Command):
    """Make the errors of the arm those of an example; what is seen of the positions stays."""

    key: str
    label: ClassVar[str] = "example of a goal"

    def apply(self, state: State) -> State:
        """Return the state with the example."""
        now = state[TaughtGoal]
        return put(state, replace(EXAMPLES[self.key].part, plane=now.plane, about=now.about))


BENCH = Bench("taught_goal", 5, EXAMPLES, ChooseGoalExample)
