"""Facts of the calibration that lessons can check, in percent of full scale."""

from __future__ import annotations

import numpy as np

from armlab.benches.sensor.calibration.state import PERCENT, Curve
from armlab.kin.sensors.characteristic import linearity_error
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _largest(errors: np.ndarray) -> float:
    return float(np.abs(errors).max()) / PERCENT


def _linearity_after(state: State) -> float:
    part = state[Curve]
    return linearity_error(part.cycle.inputs, part.calibration.corrected(part.cycle.outputs)) / PERCENT


FACTS = Facts(
    __name__,
    (Curve,),
    {
        "degree": Fact("the degree of the polynomial", lambda s: s[Curve].degree, kind="count"),
        "points": Fact("the points on each way", lambda s: s[Curve].points, kind="count"),
        "before": Fact("the largest error before the calibration, %", lambda s: s[Curve].cycle.largest_error / PERCENT),
        "after": Fact("the largest error left at the points, %", lambda s: _largest(s[Curve].calibration.residuals)),
        "between": Fact("the largest error left at other inputs, %", lambda s: _largest(s[Curve].checked)),
        "linearity": Fact("the linearity error before, %", lambda s: s[Curve].cycle.linearity / PERCENT),
        "linearity_after": Fact("the linearity error after, %", _linearity_after),
        "offset": Fact("the offset error, %", lambda s: s[Curve].cycle.offset / PERCENT),
        "gain": Fact("the error of the slope of the best line, %", lambda s: (s[Curve].cycle.line[1] - 1.0) / PERCENT),
        "hysteresis": Fact(
            "the difference between the ways up and down, %", lambda s: s[Curve].cycle.hysteresis / PERCENT
        ),
        "resolution": Fact("the resolution error, %", lambda s: s[Curve].dead / PERCENT),
    },
)
