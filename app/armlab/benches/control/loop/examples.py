"""Examples of the velocity loop, each with a sentence on what to look at."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.control.loop.state import Loop
from armlab.session.bench import Bench
from armlab.session.examples import PartExample, part_examples
from armlab.session.fields import put
from armlab.session.state import Command, State

EXAMPLES = part_examples(
    PartExample(
        "omega_2",
        "Sine, ω = 2 rad/s, K/M = 10",
        Loop(),
        "The amplitude is nearly that of v_d, but v comes 99 ms later, and so the error does not die out: its "
        "amplitude stays at 0.196 m/s.⟦ The notes call this perfect; it is not.⟧",
    ),
    PartExample(
        "omega_20",
        "Sine, ω = 20 rad/s, K/M = 10",
        Loop(omega=20.0, end=1.5),
        "Twice the cutoff frequency: v reaches 45 % of the amplitude and lags by 63°, and the error is nearly as "
        "large as v_d itself.",
    ),
    PartExample(
        "cutoff",
        "Sine at the cutoff, ω = K/M = 10 rad/s",
        Loop(omega=10.0, end=2.5),
        "At ω = K/M the gain is 1/√2, which is −3 dB, and the phase −45°; the error is as large as v.",
    ),
    PartExample(
        "larger_gain",
        "The same ω = 20 rad/s with K/M = 100",
        Loop(gain=100.0, omega=20.0, end=1.5),
        "Ten times the gain moves the cutoff ten times up: what 20 rad/s is here, 2 rad/s was before, and the "
        "force is ten times as large for the same error.",
    ),
    PartExample(
        "step",
        "Step from 0.4 to 2 m/s, M = 1.5 kg, K = 3 N s/m",
        Loop(1.5, 3.0, 2.0, 2.0, 0.4, 3.0, "step"),
        "After M/K = 0.5 s the error has fallen to 1/e = 37 %, after five times that to less than 1 %; the force "
        "falls with it.",
    ),
)


@dataclass(frozen=True)
class ChooseLoopExample(Command):
    """Load the loop of an example, and put its film, if it is open, at its start."""

    key: str
    label: ClassVar[str] = "example of the velocity loop"

    def apply(self, state: State) -> State:
        """Return the state with the example loaded."""
        return put(state, EXAMPLES[self.key].part)


BENCH = Bench("loop", 60, EXAMPLES, ChooseLoopExample)
