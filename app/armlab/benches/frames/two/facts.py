"""Facts of the meeting of two robots that lessons can check."""

from __future__ import annotations

from typing import Any

from armlab.benches.frames.two.reach import Meeting, Way, meeting_of, shown_way
from armlab.benches.frames.two.state import VERSIONS, TwoRobots
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _found(state: State) -> Meeting:
    return state.derived(meeting_of)


def _way(name: str, state: State) -> Any:
    way: Way | None = state.derived(shown_way)
    return None if way is None else getattr(way, name)


FACTS = Facts(
    __name__,
    (TwoRobots,),
    {
        "solutions": Fact("the number of solutions of robot B", lambda s: len(_found(s).solutions), kind="count"),
        "pose": Fact(
            "the tool of B in the base of B, row by row, m", lambda s: _found(s).T_b_eb.ravel(), kind="numbers"
        ),
        "tool_of_a": Fact(
            "the tool of A in the base of A, row by row, m", lambda s: _found(s).T_a_ea.ravel(), kind="numbers"
        ),
        "in_world": Fact(
            "the tool of B in the world, row by row, m", lambda s: _found(s).T_w_eb.ravel(), kind="numbers"
        ),
        "position": Fact(
            "the place where the tools meet in the base of B", lambda s: _found(s).T_b_eb[:3, 3], "m", "numbers"
        ),
        "angle": Fact("the angle of the tool of B in its base", lambda s: _found(s).angle, "rad"),
        "distance": Fact("the distance of that place from the base of B", lambda s: _found(s).distance, "m"),
        "asked": Fact("the distance that two links of B have to bridge", lambda s: _found(s).asked, "m"),
        "reach": Fact("the distance that two links of B bridge at most", lambda s: _found(s).reach, "m"),
        "joints": Fact("the joint values of robot B as drawn", lambda s: _way("q", s), "rad", "numbers"),
        "name": Fact("the solution in which robot B is drawn", lambda s: _way("name", s), kind="text"),
        "turned_off": Fact("the angle by which the tool of B misses", lambda s: _way("turned_off", s), "rad"),
        "version": Fact("the kind of robot B", lambda s: s[TwoRobots].version, kind="text", names=VERSIONS),
        "base_of_b": Fact("the base of B in the world", lambda s: s[TwoRobots].base_b, "m", "numbers"),
        "turn_of_b": Fact("the angle of the base of B", lambda s: s[TwoRobots].turn_b, "rad"),
        "link": Fact("the length of the links of robot B", lambda s: s[TwoRobots].link, "m"),
    },
)
