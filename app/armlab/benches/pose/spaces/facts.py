"""Facts of spaces and representations that lessons can check."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from armlab.benches.pose.spaces.arms import are_infinitely_many, misfit, r_apart, tools_apart, twins_of
from armlab.benches.pose.spaces.maps import KINDS, maps_of
from armlab.benches.pose.spaces.state import BY, DESCRIBED, SHOWN, Spaces
from armlab.session.facts import Fact, Facts
from armlab.session.parts.joints import Joints
from armlab.session.state import State


def _of_3r(value: Callable[[State], Any]) -> Callable[[State], Any]:
    """Return a fact that only a planar 3R has."""
    return lambda state: None if misfit(state) else value(state)


def _number(state: State) -> int | None:
    """Return the number of arms of the present r; None where there are infinitely many."""
    return None if are_infinitely_many(state) else 1 + len(twins_of(state).others)


def _residual(state: State) -> float:
    """Return the largest difference of r of the present arm and of the others."""
    return r_apart(state[Joints].arm, twins_of(state), state[Spaces].described)


def _apart(state: State) -> float | None:
    found = tools_apart(state)
    return None if found is None else found[0]


FACTS = Facts(
    __name__,
    (Spaces, Joints),
    {
        "n": Fact("the number of joints n", lambda s: maps_of(s).n, kind="count"),
        "m": Fact("the number of components m of r", lambda s: maps_of(s).m, kind="count"),
        "kind": Fact(
            "how n and m compare",
            lambda s: maps_of(s).kind,
            kind="text",
            names=KINDS,
        ),
        "spare": Fact(
            "the dimension of the joint values that belong to one r", lambda s: maps_of(s).spare, kind="count"
        ),
        "shown": Fact("what is shown of the spaces", lambda s: s[Spaces].shown, kind="text", names=SHOWN),
        "by": Fact("the representation of the stick", lambda s: s[Spaces].by, kind="text", names=BY),
        "residual": Fact("the residual of the constraint of the stick, in m²", lambda s: s[Spaces].residual),
        "theta": Fact("the angle of the stick", lambda s: s[Spaces].theta, "rad"),
        "described": Fact("the description of the arm", lambda s: s[Spaces].described, kind="text", names=DESCRIBED),
        "arms": Fact("the number of arms of the same r", _of_3r(_number), kind="count"),
        "r": Fact("r of the planar 3R, in m and rad", _of_3r(lambda s: twins_of(s).r), kind="numbers"),
        "r_residual": Fact("the largest difference of r of these arms", _of_3r(_residual)),
        "tools_apart": Fact("how far their tools are apart", _of_3r(_apart), "m"),
    },
)
