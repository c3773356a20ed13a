"""Facts of compound growth that lessons can check."""

from __future__ import annotations

from collections.abc import Callable

from armlab.benches.robot.market.state import NUMBERS, Market
from armlab.kin.growth import doubling_time
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _number(name: str) -> Callable[[State], float]:
    return lambda state: state[Market].found[name]


FACTS = Facts(
    __name__,
    (Market,),
    {
        "begin": Fact("the value at the beginning", _number("begin")),
        "end": Fact("the value at the end", _number("end")),
        "years": Fact("the number of years", _number("years")),
        "rate": Fact("the rate a year, as a fraction", _number("rate")),
        "doubling": Fact("the years in which the value doubles or halves", lambda s: doubling_time(_number("rate")(s))),
        "unknown": Fact("which number is computed", lambda s: s[Market].unknown, kind="text", names=NUMBERS),
        "log": Fact("whether the axis is logarithmic", lambda s: s[Market].log, kind="truth"),
    },
)
