"""Facts of two time laws of omega that lessons can check, at their ends."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from armlab.benches.body.integral.film import EQUAL, apart, duration_of, integrals_apart, runs_of
from armlab.benches.body.integral.state import ABOUT, Integral
from armlab.kin.rotations import axis_angle
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _integral(law: int) -> Callable[[State], np.ndarray]:
    return lambda state: runs_of(state)[law].integral(duration_of(state))


def _end(law: int) -> Callable[[State], np.ndarray]:
    return lambda state: runs_of(state)[law].at(duration_of(state)).ravel()


def _turned(law: int) -> Callable[[State], float]:
    return lambda state: float(axis_angle(runs_of(state)[law].at(duration_of(state)))[1])


FACTS = Facts(
    __name__,
    (Integral,),
    {
        **{
            f"integral_{k + 1}": Fact(f"the integral of ω of law {k + 1}", _integral(k), "rad", "numbers")
            for k in (0, 1)
        },
        **{f"end_{k + 1}": Fact(f"R at the end of law {k + 1}, row by row", _end(k), kind="numbers") for k in (0, 1)},
        **{f"angle_{k + 1}": Fact(f"the angle of R at the end of law {k + 1}", _turned(k), "rad") for k in (0, 1)},
        "apart": Fact("the angle between the ends of both laws", lambda s: apart(s, duration_of(s)), "rad"),
        "equal": Fact(
            "whether both integrals are equal", lambda s: integrals_apart(s, duration_of(s)) < EQUAL, kind="truth"
        ),
        "pieces": Fact("the number of pieces of both laws", lambda s: sum(map(len, s[Integral].laws)), kind="count"),
        "about": Fact("the axes in which ω is given", lambda s: s[Integral].about, kind="text", names=ABOUT),
    },
)
