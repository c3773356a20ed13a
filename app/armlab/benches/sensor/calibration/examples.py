"""Examples of calibration, each with a sentence on what to look at."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from armlab.benches.sensor.calibration.state import Curve
from armlab.session.bench import Bench
from armlab.session.examples import PartExample, part_examples
from armlab.session.fields import put
from armlab.session.state import Command, State

EXAMPLES = part_examples(
    PartExample(
        "usual",
        "A sensor with a little of everything, a line",
        Curve(),
        "A line takes offset and gain away. The arch is left: raise the degree. Then hysteresis and steps of the "
        "resolution are left, and no polynomial takes those away.",
    ),
    PartExample(
        "straight",
        "Offset and gain alone",
        Curve(bend=0.0, hysteresis=0.0, resolution=0.0, noise=0.0),
        "Two numbers describe the whole error, and two points would be enough: after the calibration nothing is left.",
    ),
    PartExample(
        "bent",
        "An S-shaped curve, degree 3",
        Curve(offset=0.0, gain=0.0, bend=3.0, shape="wave", hysteresis=0.0, resolution=0.0, noise=0.02, degree=3),
        "The linearity error is what a line leaves. A polynomial of degree 3 is S-shaped as well, and leaves a "
        "tenth of that; degree 5 leaves little more than noise.",
    ),
    PartExample(
        "play",
        "Play of a gear before the sensor",
        Curve(offset=0.0, gain=0.0, bend=0.0, hysteresis=3.0, resolution=0.0, noise=0.0, degree=3),
        "Up and down the same input gives two outputs, 3 % apart. A function of the output cannot know from which side "
        "it was reached.",
    ),
    PartExample(
        "too_high",
        "Too high a degree",
        Curve(bend=1.0, hysteresis=0.0, resolution=0.0, noise=1.5, points=5, degree=4, seed=4),
        "The polynomial goes nearly through its points, noise included, and is farther off between them: look at the "
        "errors at other inputs.",
    ),
    PartExample(
        "drift",
        "A year after the calibration",
        Curve(hysteresis=0.1, resolution=0.1, degree=3, drift=0.15, age=12.0),
        "The calibration was good. The offset has drifted by 0.15 % each month since, and what is left is again nearly "
        "2 %: the sensor is not stable.",
    ),
)


@dataclass(frozen=True)
class ChooseCalibrationExample(Command):
    """Load the sensor and the calibration of an example."""

    key: str
    label: ClassVar[str] = "example of calibration"

    def apply(self, state: State) -> State:
        """Return the state with the example loaded."""
        return put(state, EXAMPLES[self.key].part)


BENCH = Bench("calibration", 74, EXAMPLES, ChooseCalibrationExample)
