"""Facts of the errata that lessons can check: both residuals, and what was spotted and put right."""

from __future__ import annotations

import math
from collections.abc import Callable

from armlab.benches.lessons.errata.job import JOB
from armlab.benches.lessons.errata.state import Errata, Found
from armlab.session.facts import Fact, Facts
from armlab.session.state import State
from armlab.teaching.parts.errata_practice import Practice


def _of_run(value: Callable[[Found], float]) -> Callable[[State], float | None]:
    """Return what makes a fact of a whole run: None before its end, and for a residual of what has no value."""

    def fact(state: State) -> float | None:
        found = state[Errata].run
        if found is None or not found.complete or not math.isfinite(value(found)):
            return None
        return value(found)

    return fact


def _exists(state: State) -> bool | None:
    found = state[Errata].run
    return None if found is None or not found.complete else math.isfinite(found.worst_printed)


FACTS = Facts(
    __name__,
    (Errata, Practice),
    {
        "chosen": Fact("the id of the chosen erratum", lambda s: s[Errata].chosen, kind="text"),
        "severity": Fact("how bad it is, in words", lambda s: s[Errata].erratum.says, kind="text"),
        "residual_printed": Fact(
            "the largest residual of the printed form at the 20 points", _of_run(lambda found: found.worst_printed)
        ),
        "residual_correct": Fact(
            "the largest residual of the correct form at the 20 points", _of_run(lambda found: found.worst_correct)
        ),
        "printed_exists": Fact("whether the printed form has a value at all points", _exists, kind="truth"),
        "spotted": Fact(
            "whether the chosen erratum was spotted and put right",
            lambda s: s[Errata].chosen in s[Practice].done,
            kind="truth",
        ),
        "put_right": Fact(
            "the number of errata that were spotted and put right", lambda s: len(s[Practice].done), kind="count"
        ),
    },
    job=JOB,
)
