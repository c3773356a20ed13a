"""Facts of the first timing law that lessons can check: its peaks, and whether it is inside its limits."""

from __future__ import annotations

from collections.abc import Callable

from armlab.benches.motion.laws.state import Laws
from armlab.benches.motion.laws.timing import Phases, excesses, largest, phases
from armlab.kin.motion.law import Law
from armlab.kin.motion.law_types import free_law_types
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _law(state: State) -> Law:
    return state[Laws].laws[0]


def _of_phases(value: Callable[[Phases], float]) -> Callable[[State], float | None]:
    def found(state: State) -> float | None:
        seen = phases(_law(state))
        return None if seen is None else value(seen)

    return found


def _kept(state: State) -> bool:
    part = state[Laws]
    return not excesses(part.entries[0], part.timing)


FACTS = Facts(
    __name__,
    (Laws,),
    {
        "law": Fact(
            "the first law",
            lambda s: s[Laws].entries[0].chosen.key,
            kind="text",
            names={key: each.title for key, each in free_law_types().items()},
        ),
        "laws": Fact("the number of laws", lambda s: len(s[Laws].entries), kind="count"),
        "duration": Fact("the duration of the first law", lambda s: _law(s).duration, "s"),
        "peak_speed": Fact("the largest speed of the first law", lambda s: _law(s).peak_speed, "1/s"),
        "peak_acceleration": Fact("the largest acceleration of the first law", lambda s: largest(_law(s), 2), "1/s²"),
        "peak_jerk": Fact("the largest jerk of the first law", lambda s: largest(_law(s), 3), "1/s³"),
        "limits_kept": Fact("the first law keeps the limits", _kept, kind="truth"),
        "triangle": Fact(
            "the first law is a triangle of speed", _of_phases(lambda found: found.triangle), kind="truth"
        ),
        "coasting": Fact("how long the first law has a constant speed", _of_phases(lambda found: found.coast), "s"),
        "undetermined": Fact(
            "the share of the time at which the intervals of the signs say no acceleration",
            lambda s: s[Laws].signs.undetermined,
        ),
        "signs_end": Fact(
            "speed and place at the end of the acceleration of signs", lambda s: s[Laws].signs.ends, kind="numbers"
        ),
        "scaling": Fact("the factor k of the time", lambda s: s[Laws].k),
    },
)
