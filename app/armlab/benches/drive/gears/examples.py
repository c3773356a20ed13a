"""Examples of gears, each with a sentence on what to look at."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.drive.gears.state import Gears
from armlab.session.bench import Bench
from armlab.session.examples import PartExample, part_examples
from armlab.session.fields import put
from armlab.session.state import Command, State

EXAMPLES = part_examples(
    PartExample(
        "pair",
        "A pair: 18 and 36 teeth",
        Gears(),
        "Two turns of the small wheel are one of the large one, in the opposite sense. The torque is doubled, less the "
        "two per cent that the mesh loses.",
    ),
    PartExample(
        "idler",
        "An idler between them",
        Gears((18, 24, 36)),
        "The wheel in the middle turns the sense round and leaves the ratio as it is: its number of teeth cancels.",
    ),
    PartExample(
        "four",
        "Four wheels in a row",
        Gears((16, 30, 24, 48)),
        "Whatever stands between them, the first and the last wheel make the ratio: 48/16 = 3. Each mesh costs some "
        "power.",
    ),
    PartExample(
        "stages",
        "Two stages: 4 · 4 = 16",
        Gears((15, 60, 15, 60), "compound", 0.075, 0.075),
        "The second and the third wheel sit on one shaft, so that the ratios of both stages are multiplied: 16 with "
        "wheels that one pair would need 240 teeth for.",
    ),
    PartExample(
        "few",
        "A pinion of 8 teeth",
        Gears((8, 40), "row", 0.048),
        "With fewer than 17 teeth the rack that cuts the wheel takes away part of the flanks: look at the roots of the "
        "small wheel. They are weak there.",
    ),
    PartExample(
        "ideal",
        "An ideal gear of 100⟦ (2.33)⟧",
        Gears((18, 180, 18, 180), "compound", 0.099, 0.099, 1.0),
        "Without losses power comes out as it went in: 100 times as slow and 100 times as strong, 62.8 W on both "
        "sides.",
    ),
    PartExample(
        "best",
        "Best ratio for a load of 4 kg m²⟦ (2.39)⟧",
        Gears(shown="best"),
        "The motor needs least where it spends as much on itself as on the load: at n = √(4/0.01) = 20.",
    ),
    PartExample(
        "weight",
        "The same load against a weight",
        Gears(load_torque=36.0, shown="best"),
        "Another 36 N m, which must be held, move the best ratio up, from 20 to 40.",
    ),
    PartExample(
        "falling",
        "A weight that helps",
        Gears(load_torque=-21.0, shown="best"),
        "The weight accelerates the load by more than is wanted: with a small ratio the motor brakes, with a large one "
        "it drives, and at n = 17.3 it does nothing.",
    ),
    PartExample(
        "kinds",
        "Kinds of transmissions",
        Gears(shown="kinds"),
        "Choose a line to read what it is used for and what its trouble is.",
    ),
)
"""Examples by key, in the order of the list."""


@dataclass(frozen=True)
class ChooseGearExample(Command):
    """Put the wheels and the numbers of an example in place."""

    key: str
    label: ClassVar[str] = "example of gears"

    def apply(self, state: State) -> State:
        """Return the state with the example in place."""
        return put(state, EXAMPLES[self.key].part)


BENCH = Bench("gears", 83, EXAMPLES, ChooseGearExample)
