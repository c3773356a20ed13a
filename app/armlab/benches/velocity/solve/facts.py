"""Facts of the equation for joint speeds that lessons can check: its rank, its solutions, the shortest one."""

from __future__ import annotations

import numpy as np

from armlab.benches.velocity.solve.found import Found, found
from armlab.benches.velocity.solve.state import Solve
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _found(state: State) -> Found:
    return state.derived(found)


def _determinant(state: State) -> float | None:
    """Return det J in metres and radians, or None if J is not square."""
    J = _found(state).J
    return float(np.linalg.det(J)) if J.shape[0] == J.shape[1] else None


VERDICTS = {"none": "no solution", "one": "one solution", "many": "infinitely many solutions"}
"""Numbers of joint speeds that give the velocity, in words."""

FACTS = Facts(
    __name__,
    (Solve,),
    {
        "rank": Fact("the rank of J", lambda s: _found(s).spaces.rank, kind="count"),
        "kernel": Fact("the dimension of the null space of J", lambda s: _found(s).answer.free.shape[1], kind="count"),
        "solutions": Fact(
            "how many joint speeds give the velocity", lambda s: _found(s).answer.verdict, kind="text", names=VERDICTS
        ),
        "wanted": Fact("the wanted velocity, in m/s and rad/s", lambda s: _found(s).v, kind="numbers"),
        "qdot": Fact("the shortest joint speeds, in rad/s and m/s", lambda s: _found(s).answer.qdot, kind="numbers"),
        "reached": Fact("the velocity they give, in m/s and rad/s", lambda s: _found(s).answer.reached, kind="numbers"),
        "lost": Fact("what they leave of the wanted velocity", lambda s: _found(s).answer.lost, kind="numbers"),
        "singular": Fact("the arm is singular", lambda s: _found(s).singular, kind="truth"),
        "determinant": Fact("the determinant of J, in metres and radians", _determinant),
    },
)
