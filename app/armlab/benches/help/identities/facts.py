"""Facts of two compared formulas that lessons can check."""

from __future__ import annotations

import re

from armlab.benches.help.identities.state import Identities, comparison_of, formulas_of
from armlab.content.symbols import plain_symbols
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _alike(state: State) -> bool:
    """Return whether both sides are typed with the same letters."""
    left, right = (re.sub(r"\s", "", plain_symbols(side)) for side in (state[Identities].left, state[Identities].right))
    return left == right


def _largest(state: State) -> float | None:
    found = comparison_of(state)
    return float(found.difference.max()) if len(found.left) else None


def _names(state: State) -> str:
    left, right = formulas_of(state)
    return " ".join(sorted(left.names | right.names))


def _proved(state: State) -> bool:
    return comparison_of(state).agrees and not _alike(state)


FACTS = Facts(
    __name__,
    (Identities,),
    {
        "agrees": Fact("whether both sides agree at all points", lambda s: comparison_of(s).agrees, kind="truth"),
        "holds": Fact("whether both sides agree, and are typed differently", _proved, kind="truth"),
        "left": Fact("the left side, as it was typed", lambda s: s[Identities].left, kind="text"),
        "right": Fact("the right side, as it was typed", lambda s: s[Identities].right, kind="text"),
        "names": Fact("the letters of both sides, in alphabetical order", _names, kind="text"),
        "largest": Fact("the largest difference of both sides", _largest),
        "close": Fact(
            "the number of points at which they agree", lambda s: int(comparison_of(s).close.sum()), "", "count"
        ),
        "points": Fact("the number of points that were compared", lambda s: len(comparison_of(s).left), "", "count"),
    },
)
