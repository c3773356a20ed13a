"""Facts of accuracy and repeatability that lessons can check."""

from __future__ import annotations

from armlab.benches.robot.taught.state import TaughtGoal
from armlab.benches.robot.taught.visits import visits_of
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _ratio(state: State) -> float | None:
    scatter = visits_of(state).scatter
    return scatter.accuracy / scatter.repeatability if scatter.repeatability else None


def _entered(state: State) -> int:
    part = state[TaughtGoal]
    return visits_of(state).entered(part.clearance, part.yields)


FACTS = Facts(
    __name__,
    (TaughtGoal,),
    {
        "accuracy": Fact("the accuracy AP", lambda s: visits_of(s).scatter.accuracy, "m"),
        "repeatability": Fact("the repeatability RP", lambda s: visits_of(s).scatter.repeatability, "m"),
        "ratio": Fact("how many times the repeatability the accuracy is", _ratio),
        "taught": Fact("whether the goal was taught", lambda s: s[TaughtGoal].taught, kind="truth"),
        "entered": Fact("the number of pegs that find their hole", _entered, kind="count"),
        "clearance": Fact("the clearance of the hole", lambda s: s[TaughtGoal].clearance, "m"),
        "visits": Fact("the number of visits", lambda s: s[TaughtGoal].visits, kind="count"),
    },
)
