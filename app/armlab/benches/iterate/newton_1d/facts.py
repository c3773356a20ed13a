"""Facts of Newton's method for one equation that lessons can check: its end, and the number of steps."""

from __future__ import annotations

from armlab.benches.iterate.newton_1d.state import Newton1D, solution
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _root(state: State) -> float | None:
    """Return the root that was found, or None."""
    found = state.derived(solution)
    return float(found.iterates[-1].x) if found.status == "converged" else None


ENDS = {
    "converged": "converged to a root",
    "level": "a horizontal tangent",
    "round": "a cycle",
    "away": "diverged",
    "undefined": "f has no value there",
    "most": "no root after the most steps",
}
"""Words for how it ends."""

FACTS = Facts(
    __name__,
    (Newton1D,),
    {
        "start": Fact("the start", lambda s: s[Newton1D].x0),
        "root": Fact("the root that was found", _root),
        "steps": Fact("the number of steps", lambda s: s.derived(solution).last, kind="count"),
        "converged": Fact("a root was found", lambda s: s.derived(solution).status == "converged", kind="truth"),
        "status": Fact(
            "how it ends",
            lambda s: s.derived(solution).status,
            kind="text",
            names=ENDS,
        ),
        "first_step": Fact(
            "the first step, x₁ − x₀",
            lambda s: s.derived(solution).iterates[1].x - s[Newton1D].x0 if s.derived(solution).last else None,
        ),
    },
)
