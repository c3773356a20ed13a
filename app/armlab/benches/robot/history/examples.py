"""Examples of the page of history, each with a sentence on what to look at."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar

from armlab.benches.robot.history.state import History
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.state import Command, State


@dataclass(frozen=True)
class HistoryExample:
    """A place of the page.

    Attributes
    ----------
    key, title : str
    sets : mapping
        Fields of `History`.
    says : str
        What to look at.
    """

    key: str
    title: str
    sets: Mapping[str, Any]
    says: str = field(compare=False)


EXAMPLES = Registry(
    "example",
    (
        HistoryExample(
            "first",
            "The first industrial robot",
            {"shown": "timeline", "lane": "factory", "event": "unimate"},
            "Five joints that turn and one that slides, driven by oil. Put the model on the table: the second and the "
            "third joint move its boom as polar coordinates.",
        ),
        HistoryExample(
            "electric",
            "From oil to electric motors",
            {"shown": "timeline", "lane": "factory", "event": "irb6"},
            "Until 1973 the robots of factories are hydraulic, later nearly all are electric. Hydraulics stay where "
            "loads are heavy.",
        ),
        HistoryExample(
            "space",
            "Arms without weight",
            {"shown": "timeline", "lane": "space", "event": "canadarm"},
            "In orbit an arm may be fifteen metres long and thin, since it carries no weight, only mass: it moves a "
            "few degrees a second.",
        ),
        HistoryExample(
            "axes",
            "Two axes or three?",
            {"shown": "things", "definition": "iso"},
            "Answer for each thing. What the standard asks for stands above: one lacking feature is enough for a no.",
        ),
        HistoryExample(
            "loop",
            "Who closes the loop?",
            {"shown": "things", "definition": "loop"},
            "A washing machine that weighs its load does, and a welding arm that repeats what it was taught does not.",
        ),
        HistoryExample(
            "cobot",
            "A cobot is ordered on, and a hand is in its way",
            {"shown": "laws", "holds": frozenset({"harms", "ordered"})},
            "An order and a harm: the first law comes before the second. Arms that work beside people stop at a touch.",
        ),
        HistoryExample(
            "runaround",
            "An order into danger",
            {"shown": "laws", "holds": frozenset({"ordered", "risks"})},
            "An order and a danger for the robot itself: the second law comes before the third.",
        ),
    ),
)


@dataclass(frozen=True)
class ChooseHistoryExample(Command):
    """Show a place of the history, and what to look at there."""

    key: str
    label: ClassVar[str] = "example of the history"

    def apply(self, state: State) -> State:
        """Return the state with the example."""
        return state.replace(state[History].with_values({**EXAMPLES[self.key].sets, "example": self.key}))


BENCH = Bench("history", 3, EXAMPLES, ChooseHistoryExample)
