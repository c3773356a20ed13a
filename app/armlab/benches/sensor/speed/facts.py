"""Facts of the speed from an encoder that lessons can check."""

from __future__ import annotations

import math

from armlab.benches.sensor.speed.state import READINGS, EncoderSpeed
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _by_time(state: State) -> float | None:
    found = float(state[EncoderSpeed].by_time[0])
    return found if math.isfinite(found) else None


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


FACTS = Facts(
    __name__,
    (EncoderSpeed,),
    {
        "resolution": Fact("AR, the angle of a count", lambda s: s[EncoderSpeed].meter.resolution, "rad"),
        "speed": Fact("the true speed", lambda s: s[EncoderSpeed].speed, "rad/s"),
        "window": Fact("the window", lambda s: s[EncoderSpeed].window, "s"),
        "counts": Fact("C, the counts in a window", lambda s: s[EncoderSpeed].counts, kind="count"),
        "ticks": Fact("n, the ticks between two counts", lambda s: s[EncoderSpeed].ticks[0], kind="count"),
        "by_counts": Fact("the speed by counts", lambda s: s[EncoderSpeed].by_counts, "rad/s"),
        "by_time": Fact("the speed by the time between counts", _by_time, "rad/s"),
        "quantum": Fact("the speed of one count in a window", lambda s: s[EncoderSpeed].meter.quantum, "rad/s"),
        "error_by_counts": Fact(
            "the largest relative error by counts",
            lambda s: float(s[EncoderSpeed].meter.error_by_counts(s[EncoderSpeed].speed)),
        ),
        "error_by_time": Fact(
            "the largest relative error by the time between counts",
            lambda s: _finite(float(s[EncoderSpeed].meter.error_by_time(s[EncoderSpeed].speed))),
        ),
        "crossover": Fact("the speed at which both are as fine", lambda s: s[EncoderSpeed].meter.crossover, "rad/s"),
        "delay_by_counts": Fact(
            "by how much the speed by counts is old", lambda s: s[EncoderSpeed].meter.delay_by_counts(), "s"
        ),
        "delay_by_time": Fact(
            "by how much the speed by the time between counts is old",
            lambda s: s[EncoderSpeed].meter.delay_by_time(s[EncoderSpeed].speed),
            "s",
        ),
        "finer": Fact(
            "which of the two readings is finer", lambda s: s[EncoderSpeed].finer, kind="text", names=READINGS
        ),
    },
)
