"""Facts of the dart board that lessons can check."""

from __future__ import annotations

import numpy as np

from armlab.benches.sensor.measure.state import Throws
from armlab.session.facts import Fact, Facts

FACTS = Facts(
    __name__,
    (Throws,),
    {
        "throws": Fact("the number of throws", lambda s: s[Throws].count, kind="count"),
        "centre": Fact("the centre of the throws, to the right and up", lambda s: s[Throws].found.mean, "m", "numbers"),
        "distance": Fact("the distance of the centre from the middle", lambda s: s[Throws].found.distance, "m"),
        "radius": Fact("the radius of the circle that holds the bias in 95 %", lambda s: s[Throws].found.radius, "m"),
        "spread": Fact("the estimated spread", lambda s: s[Throws].found.spread, "m"),
        "spread_low": Fact("the lower end of the interval of the spread", lambda s: s[Throws].found.low, "m"),
        "spread_high": Fact("the upper end of the interval of the spread", lambda s: s[Throws].found.high, "m"),
        "settled": Fact("whether chance does not explain the bias", lambda s: s[Throws].found.settled, kind="truth"),
        "true_bias": Fact("the true bias", lambda s: float(np.linalg.norm(s[Throws].bias)), "m"),
        "true_spread": Fact("the true spread", lambda s: s[Throws].spread, "m"),
        "rms": Fact("the root mean square distance from the middle", lambda s: s[Throws].rms, "m"),
        "bias_share": Fact("the part of its square that the bias makes", lambda s: s[Throws].bias_share),
        "hits": Fact("the number of hits", lambda s: s[Throws].hits, kind="count"),
        "corrected": Fact(
            "whether the aim has been corrected", lambda s: bool(s[Throws].aim_right or s[Throws].aim_up), kind="truth"
        ),
    },
)
