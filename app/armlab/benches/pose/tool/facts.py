"""Facts of the chosen transform that lessons can check."""

from __future__ import annotations

import numpy as np

from armlab.benches.pose.tool.state import PoseView, pair_of
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _transform(state: State) -> np.ndarray:
    return np.asarray(state.derived(pair_of).transform)


FACTS = Facts(
    __name__,
    (PoseView,),
    {
        "reference": Fact("the frame in which is looked", lambda s: s[PoseView].reference, kind="text"),
        "frame": Fact("the frame that is looked at", lambda s: s[PoseView].frame, kind="text"),
        "position": Fact("the position of the frame", lambda s: _transform(s)[:3, 3], "m", "numbers"),
        "distance": Fact("the distance of the frames", lambda s: s.derived(pair_of).distance, "m"),
        "rotation": Fact("the entries of R, row by row", lambda s: _transform(s)[:3, :3], kind="numbers"),
    },
)
