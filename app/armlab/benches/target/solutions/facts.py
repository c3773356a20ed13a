"""Facts of all solutions of the target that lessons can check, known once the solutions have been searched for."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from armlab.benches.target.solutions.found import Found
from armlab.benches.target.solutions.job import JOB
from armlab.benches.target.solutions.state import Solutions, fresh, present_row
from armlab.session.facts import Fact, Facts
from armlab.session.parts.joints import Joints
from armlab.session.state import State


def _of_list(value: Callable[[Found], Any]) -> Callable[[State], Any]:
    def known(state: State) -> Any:
        found = state.derived(fresh)
        return None if found is None else value(found)

    return known


def _at(state: State) -> str | None:
    """Return the name of the solution at which the arm is, or None."""
    row = state.derived(present_row) if state.derived(fresh) is not None else None
    return None if row is None else row.name


KNOWN = {
    "none": "there is no solution",
    "complete": "these are all",
    "at least": "there may be more",
    "infinite": "there are infinitely many",
}
"""Words for what is known of the list."""

FACTS = Facts(
    __name__,
    (Solutions, Joints),
    {
        "count": Fact("the number of solutions that are listed", _of_list(lambda found: len(found.rows)), kind="count"),
        "within": Fact(
            "the number of them inside the limits",
            _of_list(lambda found: sum(row.within for row in found.rows)),
            kind="count",
        ),
        "infinite": Fact(
            "there are infinitely many",
            _of_list(lambda found: found.solutions.completeness == "infinite"),
            kind="truth",
        ),
        "known": Fact(
            "what is known of the list", _of_list(lambda found: found.solutions.completeness), kind="text", names=KNOWN
        ),
        "at": Fact("the name of the solution the arm is at", _at, kind="text"),
    },
    JOB,
)
