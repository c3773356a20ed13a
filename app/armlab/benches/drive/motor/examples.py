"""Examples of DC motors, each with a sentence on what to look at."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

from armlab.benches.drive.motor.state import Motor
from armlab.session.bench import Bench
from armlab.session.examples import PartExample, part_examples
from armlab.session.fields import put
from armlab.session.state import Command, State

MAXON: dict[str, Any] = {"R": 0.299, "L": 8.2e-5, "k": 0.0302, "J": 1.42e-5, "F": 5.2e-6}
"""The motor RE 40, 150 W, 24 V of maxon by its data sheet (order number 148867); F follows from the 137 mA that it
takes at 7580 rpm without load."""

EXAMPLES = part_examples(
    PartExample(
        "course",
        "A motor with 0.1 N m of load, 12 V",
        Motor(),
        "The current jumps up in milliseconds, before the rotor has begun to turn, and falls as the back-EMF k ω "
        "grows. The speed needs a tenth of a second.",
    ),
    PartExample(
        "maxon",
        "maxon RE 40, 150 W, without load",
        Motor(**MAXON, v=24.0, load=0.0, end=0.03),
        "Constants of the data sheet (148867), friction from its no-load current. Its 7580 rpm and 137 mA without load "
        "come out, and a peak of 70 A at the start.",
    ),
    PartExample(
        "rated",
        "maxon RE 40 at its rated torque",
        Motor(**MAXON, v=24.0, load=0.177, load_start=0.02, end=0.05),
        "Run up without load, then 0.177 N m: the speed gives way by 7 % and the current rises to 6 A, which the "
        "winding stands for ever.",
    ),
    PartExample(
        "heavy",
        "Large inertia: a flywheel on the shaft",
        Motor(J=0.01, load=0.0, end=20.0),
        "A hundred times the inertia, a hundred times the mechanical time constant. The electrical one has not "
        "changed, and two separate time constants are now right to 0.04 %.",
    ),
    PartExample(
        "swinging",
        "Oscillating, and stable all the same",
        Motor(R=0.2, L=0.02, J=5e-5, F=1e-5, load=0.0, end=1.2),
        "The speed overshoots and even the current changes its sign: a complex pair of poles. Both lie left of the "
        "imaginary axis, and with positive constants they always do.",
    ),
    PartExample(
        "ramp",
        "Voltage as a ramp of 25 steps",
        Motor(v_kind="ramp", v_start=0.02, v_stop=0.22, load=0.0, end=0.4),
        "The voltage rises slowly, and the current stays small: it only has to accelerate the rotor. Compare its peak "
        "with that of a step.",
    ),
    PartExample(
        "pulse",
        "A pulse, and then a short circuit",
        Motor(v_kind="pulse", v_stop=0.15, load=0.0, end=0.4),
        "At 0 V the terminals are joined: the turning rotor drives a current the other way round, which brakes it.",
    ),
    PartExample(
        "stalled",
        "Stalled: a load as large as the motor's torque",
        Motor(load=0.5, end=0.2),
        "At 12 V the rotor gives 0.5 N m at most, and that is the load: it stands, takes 10 A, and all 120 W heat the "
        "winding.",
    ),
    PartExample(
        "generator",
        "Generator: the load drives the motor",
        Motor(load=-0.3, end=0.4),
        "The load pushes the rotor faster than 12 V would turn it. The back-EMF is above 12 V, the current flows back "
        "into the supply, and v i is negative.",
    ),
    PartExample(
        "no_inductance",
        "Without inductance: first order",
        Motor(L=0.0),
        "The current follows the voltage at once and starts at v/R = 10 A. One pole is left, and the speed is nearly "
        "the same as with 2 mH.",
    ),
    PartExample(
        "own",
        "There and back, with a push",
        Motor(
            v_kind="own",
            v_rows=((0.0, 12.0), (0.2, -12.0), (0.4, 0.0)),
            load_kind="pulse",
            load=0.2,
            load_start=0.1,
            load_stop=0.15,
            end=0.6,
        ),
        "Voltage line by line, and a load for a twentieth of a second. Reversing costs twice the current of a start, "
        "because the back-EMF now adds to the voltage.",
    ),
    PartExample(
        "twins",
        "Two motors, one turned on by 1 rad",
        Motor(shown="state", load=0.0),
        "Both have the same current and speed for ever, and never the same position. Look at which vector tells them "
        "apart.",
    ),
)


@dataclass(frozen=True)
class ChooseMotorExample(Command):
    """Put the motor of an example in place, and the film, if it is open, at its start."""

    key: str
    label: ClassVar[str] = "example of the DC motor"

    def apply(self, state: State) -> State:
        """Return the state with the example in place."""
        return put(state, EXAMPLES[self.key].part)


BENCH = Bench("motor", 82, EXAMPLES, ChooseMotorExample)

SHEET = {"speed": 7580.0 * math.pi / 30.0, "current": 0.137, "stall_current": 80.2, "stall_torque": 2.42}
"""Behaviour of the maxon motor by its data sheet at 24 V: rad/s and A without load, A and N m with the rotor held."""
