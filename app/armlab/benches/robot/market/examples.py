"""Examples of compound growth, each with a sentence on what to look at."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

from armlab.benches.robot.market.numbers import BEFORE, SALES, SALES_GROWTH, STOCK
from armlab.benches.robot.market.state import Market
from armlab.session.bench import Bench
from armlab.session.examples import PartExample, part_examples
from armlab.session.fields import put
from armlab.session.state import Command, State

EXAMPLES = part_examples(
    PartExample(
        "whole",
        "Half a century of robots",
        Market(),
        "On the logarithmic axis a constant rate is a straight line. The counts do not lie on it: growth was fast at "
        "first, almost stood still from 1993 to 2003, and came back.",
    ),
    PartExample(
        "pause",
        "The pause from 1993 to 2003",
        Market(begin=STOCK[2].robots, end=STOCK[3].robots, years=10.0, start=float(STOCK[2].year)),
        "3.4 % a year: at this rate the stock needs some twenty years to double.",
    ),
    PartExample(
        "sales",
        "New robots of 2019",
        Market("begin", 1e5, SALES, BEFORE, SALES_GROWTH, 2019.0),
        "The rate and the end give the beginning: 7 % a year for five years are 40 % in all, not 35 %.",
    ),
    PartExample(
        "ten_million",
        "When will it be ten million?",
        Market("years", STOCK[-1].robots, 1e7, 10.0, 0.09, float(STOCK[-1].year)),
        "If it went on at 9 % a year: nobody knows that it does.",
    ),
    PartExample(
        "falling",
        "A stock that halves",
        Market("rate", STOCK[-1].robots, 0.5 * STOCK[-1].robots, 10.0, 0.1, float(STOCK[-1].year)),
        "A falling value has a negative rate, and a time in which it halves.",
    ),
)


@dataclass(frozen=True)
class ChooseMarketExample(Command):
    """Put the numbers of an example into the calculator; the axis of the chart stays."""

    key: str
    label: ClassVar[str] = "example of growth"

    def apply(self, state: State) -> State:
        """Return the state with the example."""
        return put(state, replace(EXAMPLES[self.key].part, log=state[Market].log))


BENCH = Bench("market", 4, EXAMPLES, ChooseMarketExample)
