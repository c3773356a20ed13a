"""Facts of the chain of frames that lessons can check: of the chosen pair of frames, and of the point."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from armlab.benches.frames.chain.state import Chain
from armlab.benches.frames.chain.tree import counts_of, pair_of, points_of, poses_of
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _point_in(which: str) -> Callable[[State], np.ndarray]:
    return lambda state: state.derived(points_of)[getattr(state[Chain], which)]


def _way(state: State) -> str:
    """Return the names from the reference to the frame, with blanks between."""
    steps = state.derived(pair_of).steps
    return " ".join([state[Chain].reference, *(step.frame for step in steps)])


def _counted(when: str, kind: str, what: str) -> Callable[[State], int | None]:
    def value(state: State) -> int | None:
        found = state.derived(counts_of)
        return None if found is None else getattr(getattr(found, when)[kind], what)

    return value


def _counts() -> dict[str, Fact]:
    """Return the facts of operations, for rotations and for whole transforms."""
    ways = {"first": "multiplied first", "each": "applied one after the other"}
    kinds = {"rotation": "rotations", "transform": "transforms"}
    return {
        f"{what}_{when}_{kind}": Fact(
            f"the number of {what} for {kinds[kind]} {ways[when]}", _counted(when, kind, what), kind="count"
        )
        for kind in kinds
        for when in ways
        for what in ("products", "sums")
    }


def _placed(state: State) -> np.ndarray:
    """Return the pose in the world of the frame of the pair."""
    return state.derived(poses_of)[state[Chain].frame].ravel()


FACTS = Facts(
    __name__,
    (Chain,),
    {
        "frames": Fact("the number of frames besides the world", lambda s: len(s[Chain].frames), kind="count"),
        "reference": Fact("the reference of the chosen transform", lambda s: s[Chain].reference, kind="text"),
        "frame": Fact("the frame of the chosen transform", lambda s: s[Chain].frame, kind="text"),
        "way": Fact("the names from the reference to the frame", _way, kind="text"),
        "steps": Fact("the number of factors", lambda s: len(s.derived(pair_of).steps), kind="count"),
        "relative": Fact("the chosen transform, row by row, m", lambda s: s.derived(pair_of).T.ravel(), kind="numbers"),
        "position": Fact(
            "the origin of the frame in the reference", lambda s: s.derived(pair_of).T[:3, 3], "m", "numbers"
        ),
        "inverse": Fact(
            "the inverse of it, row by row, m", lambda s: s.derived(pair_of).inverse.ravel(), kind="numbers"
        ),
        "in_world": Fact("the pose of the frame in the world, row by row, m", _placed, kind="numbers"),
        "given": Fact("the frame in which the point is given", lambda s: s[Chain].given, kind="text"),
        "point_in": Fact("the coordinates of the point in the reference", _point_in("reference"), "m", "numbers"),
        "point_in_frame": Fact("the coordinates of the point in the frame", _point_in("frame"), "m", "numbers"),
        "points": Fact("the number of points whose operations are counted", lambda s: s[Chain].count, kind="count"),
        **_counts(),
    },
)
