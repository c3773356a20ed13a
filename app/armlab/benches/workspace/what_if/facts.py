"""Facts of a supposed arm that lessons can check; sizes are known once both workspaces are found."""

from __future__ import annotations

from collections.abc import Callable

from armlab.benches.workspace.what_if.found import Figures
from armlab.benches.workspace.what_if.job import JOB
from armlab.benches.workspace.what_if.state import WhatIf
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _figures(which: int, value: Callable[[Figures], float | None]) -> Callable[[State], float | None]:
    """Return a figure of the arm before (0) or after (1) the changes, at the end of the work."""

    def known(state: State) -> float | None:
        part = state[WhatIf]
        found = part.found
        there = found is not None and found.finished and found.before is part.arm and found.after is part.other
        return value(found.figures[which]) if found is not None and there else None

    return known


def _size(figures: Figures) -> float | None:
    return None if figures.size is None else figures.size.value


def _outer(which: int) -> Callable[[State], float | None]:
    """Return the outer reach before (0) or after (1); across a joint 1 that slides there is none."""
    known = _figures(which, lambda figures: figures.reach.outer)
    return lambda state: known(state) if state[WhatIf].arm.revolute[0] else None


FACTS = Facts(
    __name__,
    (WhatIf,),
    {
        "changes": Fact("the number of changes", lambda s: len(s[WhatIf].changes), kind="count"),
        "size_before": Fact("the size of the workspace before, in m² or m³", _figures(0, _size)),
        "size_after": Fact("the size of the workspace after, in m² or m³", _figures(1, _size)),
        "outer_before": Fact("the outer reach before", _outer(0), "m", only="where joint 1 turns"),
        "outer_after": Fact("the outer reach after", _outer(1), "m", only="where joint 1 turns"),
    },
    JOB,
)
