"""Facts of pose accuracy and repeatability that lessons can check."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from armlab.benches.sensor.pose.state import Attained, Repeats, found
from armlab.kin.sensors.pose_accuracy import APPROACHES, expected_spread, shares
from armlab.session.facts import Fact, Facts
from armlab.session.parts.joints import Joints
from armlab.session.state import State


def _of(value: Callable[[Attained], Any]) -> Callable[[State], Any]:
    return lambda state: value(state.derived(found))


def _shares(state: State) -> np.ndarray:
    errors = state.derived(found).errors
    return shares(state[Joints].arm, state[Joints].q, errors, state[Repeats].approach)


def _expected(state: State) -> float:
    errors = state.derived(found).errors
    return expected_spread(state[Joints].arm, state[Joints].q, errors, state[Repeats].approach)


FACTS = Facts(
    __name__,
    (Repeats,),
    {
        "times": Fact("how often the arm is sent there", lambda s: s[Repeats].times, kind="count"),
        "approach": Fact("from which side it comes", lambda s: s[Repeats].approach, kind="text", names=APPROACHES),
        "accuracy": Fact("AP of the position", _of(lambda a: a.figures.position.accuracy), "m"),
        "repeatability": Fact("RP of the position", _of(lambda a: a.figures.position.repeatability), "m"),
        "mean_distance": Fact(
            "the mean distance from the barycentre", _of(lambda a: a.figures.position.mean_distance), "m"
        ),
        "deviation": Fact(
            "the standard deviation of these distances", _of(lambda a: a.figures.position.deviation), "m"
        ),
        "turn_accuracy": Fact(
            "AP of the angles about x, y, z", _of(lambda a: a.figures.turn_accuracy), "rad", "numbers"
        ),
        "turn_repeatability": Fact(
            "RP of the angles about x, y, z", _of(lambda a: a.figures.turn_repeatability), "rad", "numbers"
        ),
        "count": Fact("a count of the first joint, rad or m", _of(lambda a: a.errors.count[0])),
        "shares": Fact("how far each joint spreads the tool", _shares, "m", "numbers"),
        "largest_share": Fact(
            "the joint that contributes most to the spread of the tool, counted from 1",
            lambda s: int(np.argmax(_shares(s))) + 1,
            kind="count",
        ),
        "expected_spread": Fact("the root mean square distance to first order", _expected, "m"),
    },
)
