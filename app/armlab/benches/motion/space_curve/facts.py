"""Facts of the curve in space that lessons can check."""

from __future__ import annotations

from armlab.benches.motion.space_curve.state import SpaceCurve, curve_of
from armlab.session.facts import Fact, Facts

FACTS = Facts(
    __name__,
    (SpaceCurve,),
    {
        "length": Fact("the length of the curve", lambda s: s.derived(curve_of).sigma[-1], "m"),
        "largest_curvature": Fact(
            "the largest curvature of its samples", lambda s: s.derived(curve_of).frame.curvature.max(), "1/m"
        ),
        "peak_speed": Fact("the largest speed of the motion", lambda s: s.derived(curve_of).peaks[0], "m/s"),
        "peak_acceleration": Fact(
            "the largest acceleration of the motion; infinite where the velocity jumps",
            lambda s: s.derived(curve_of).largest_acceleration,
            "m/s²",
        ),
        "duration": Fact("the duration of the motion", lambda s: s.derived(curve_of).motion.duration, "s"),
        "stands": Fact("how often p' is zero", lambda s: len(s.derived(curve_of).stands), kind="count"),
        "by_length": Fact("the curve is written by its length", lambda s: s.derived(curve_of).by_length, kind="truth"),
    },
)
