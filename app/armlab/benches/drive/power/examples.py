"""Examples of power, each with a sentence on what to look at."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.drive.power.state import Power
from armlab.session.bench import Bench
from armlab.session.examples import PartExample, part_examples
from armlab.session.fields import put
from armlab.session.state import Command, State

EXAMPLES = part_examples(
    PartExample(
        "rotary",
        "A joint of a small arm",
        Power(),
        "Look at the widths, which are to scale: of 168 W from the supply 102 W arrive at the joint. The gear takes "
        "the largest share of what is lost.",
    ),
    PartExample(
        "worm",
        "The same joint with a worm gear",
        Power(eta_gear=0.35),
        "A worm gear that holds its load by itself has an efficiency below one half. Most of the power now becomes "
        "heat in the gear.",
    ),
    PartExample(
        "slide",
        "A slide on a ball screw",
        Power(kind="linear", given="load", force=800.0),
        "The load is given here, and the supply follows from it. The product changes on the way from V I to τ ω to F "
        "v, and its unit stays the watt.",
    ),
    PartExample(
        "hydraulic",
        "A hydraulic cylinder",
        Power(
            kind="hydraulic",
            given="load",
            voltage=400.0,
            eta_motor=0.9,
            motor_speed=155.0,
            pressure=16.0,
            feed=0.2,
            force=20000.0,
        ),
        "All four products in one chain. A valve that throttles the oil makes heat, so that less than half of the "
        "power arrives; but the cylinder pushes with 20 kN.",
    ),
    PartExample(
        "hold",
        "Two kilograms held at half a metre",
        Power(shown="hold"),
        "The motor turns nothing, so it gives no power, and yet it draws some: all of R i² heats its winding. A brake "
        "or a shut valve needs none.",
    ),
    PartExample(
        "hold_100",
        "The same load with a gear of 100",
        Power(shown="hold", ratio=100.0),
        "Twice the ratio is half the current and a quarter of the heat.",
    ),
    PartExample(
        "overheat",
        "Four kilograms: the winding burns",
        Power(shown="hold", mass=4.0),
        "Twice the torque is four times the heat. Warm copper has more resistance, which makes still more heat: here "
        "the temperature has no end.",
    ),
    PartExample(
        "compare",
        "Electric, pneumatic, hydraulic in numbers",
        Power(shown="compare"),
        "Look at the compressibility: oil yields a thousand times less than air, which is why air positions badly.",
    ),
)


@dataclass(frozen=True)
class ChoosePowerExample(Command):
    """Put the numbers of an example in place."""

    key: str
    label: ClassVar[str] = "example of power"

    def apply(self, state: State) -> State:
        """Return the state with the example in place."""
        return put(state, EXAMPLES[self.key].part)


BENCH = Bench("power", 80, EXAMPLES, ChoosePowerExample)
