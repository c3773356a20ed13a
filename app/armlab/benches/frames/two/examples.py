"""Examples of two robots, each with a sentence on what to look at."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

from armlab.benches.frames.two.state import BASE_A, BASE_B, Q_A, TURN_B, TwoRobots
from armlab.registry import Registry
from armlab.session.bench import Bench
from armlab.session.fields import put
from armlab.session.state import Command, State

ONLY_LINK = 1.6183813111921197
"""Length of two equal links, metres, with which a 2R robot B has the whole pose of the exercise."""


@dataclass(frozen=True)
class TwoExample:
    """Robot B, its base, and what is asked of it.

    Attributes
    ----------
    key, title : str
    version : str
    link : float
        Metres.
    says : str
        Sentence on what to look at.
    """

    key: str
    title: str
    version: str
    link: float
    says: str

    def values(self) -> dict[str, Any]:
        """Return the fields of the part: both bases and the joints of A are those of the exercise."""
        return {
            "q_a": Q_A,
            "base_a": BASE_A,
            "turn_a": 0.0,
            "base_b": BASE_B,
            "turn_b": TURN_B,
            "between": math.pi,
            "version": self.version,
            "link": self.link,
            "selected": "B",
            "example": self.key,
        }


EXAMPLES = Registry(
    "example",
    (
        TwoExample(
            "three",
            "B has three links of 1 m",
            "three_links",
            1.0,
            "Position and angle of the tool are three numbers, and B has three joints: it has two solutions.",
        ),
        TwoExample(
            "two",
            "B has two links of 1 m⟦ (3.132)⟧",
            "two_links",
            1.0,
            "The tools would meet 2.226 m from the base of B, and two links of 1 m end at 2 m⟦. The notes announce two "
            "solutions of 3.132; with two joints there is none⟧.",
        ),
        TwoExample(
            "position",
            "B has two links of 1.2 m and no angle to keep",
            "two_links_position",
            1.2,
            "Only the position is asked for: two solutions, and in both the tool of B points elsewhere.",
        ),
        TwoExample(
            "one",
            "B has two links of just the right length",
            "two_links",
            ONLY_LINK,
            "Two equal links have position and angle at once only if they are 1.618 m long, and then in one way.",
        ),
    ),
)


@dataclass(frozen=True)
class ChooseTwoExample(Command):
    """Put both robots of an example in place."""

    key: str
    label: ClassVar[str] = "example of two robots"

    def apply(self, state: State) -> State:
        """Return the state with the robots of the example."""
        return put(state, state[TwoRobots].with_values(EXAMPLES[self.key].values()))


BENCH = Bench("two_robots", 16, EXAMPLES, ChooseTwoExample)
