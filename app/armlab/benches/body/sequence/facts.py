"""Facts of three turns about moving and about fixed axes that lessons can check."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from armlab.benches.body.forms.state import Body
from armlab.benches.body.sequence.film import apart, difference, turns_of
from armlab.benches.body.sequence.state import ORDERS, Sequence
from armlab.session.facts import Fact, Facts
from armlab.session.state import State

BODIES = ("moving", "fixed")


def _after(body: int, made: int) -> Callable[[State], np.ndarray]:
    return lambda state: turns_of(state)[body].after(made).ravel()


def _ends(state: State) -> tuple[np.ndarray, np.ndarray]:
    one, other = turns_of(state)
    return one.after(3), other.after(3)


FACTS = Facts(
    __name__,
    (Body, Sequence),
    {
        **{
            f"{name}_{made}": Fact(
                f"R after {made} turn{'s' if made > 1 else ''} about {name} axes, row by row",
                _after(body, made),
                kind="numbers",
            )
            for body, name in enumerate(BODIES)
            for made in (1, 2, 3)
        },
        "difference": Fact("the largest difference of an entry of both ends", lambda s: difference(*_ends(s))),
        "apart": Fact("the angle between both ends", lambda s: apart(*_ends(s)), "rad"),
        "order": Fact("the order of the other body", lambda s: s[Sequence].order, kind="text", names=ORDERS),
    },
)
