"""Facts of accuracy and repeatability that lessons can check."""

from __future__ import annotations

from armlab.benches.robot.accuracy.state import Accuracy
from armlab.benches.robot.accuracy.visits import visits_of
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _entered(state: State) -> int:
    part = state[Accuracy]
    return visits_of(state).entered(part.clearance, part.yields)


FACTS = Facts(
    __name__,
    (Accuracy,),
    {
        "accuracy": Fact("the accuracy AP", lambda s: visits_of(s).scatter.accuracy, "m"),
        "repeatability": Fact("the repeatability RP", lambda s: visits_of(s).scatter.repeatability, "m"),
        "ratio": Fact(
            "how many times the repeatability the accuracy is",
            lambda s: visits_of(s).scatter.accuracy / visits_of(s).scatter.repeatability,
        ),
        "taught": Fact("whether the goal was taught", lambda s: s[Accuracy].taught, kind="truth"),
        "entered": Fact("the number of pegs that find their hole", _entered, kind="count"),
        "clearance": Fact("the clearance of the hole", lambda s: s[Accuracy].clearance, "m"),
        "visits": Fact("the number of visits", lambda s: s[Accuracy].visits, kind="count"),
    },
)
