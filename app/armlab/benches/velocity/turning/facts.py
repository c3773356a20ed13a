"""Facts of three angles and their rates at the start of the film that lessons can check."""

from __future__ import annotations

import numpy as np

from armlab.benches.velocity.turning.state import Turning
from armlab.kin.velocity.rates import rate_determinant, rate_matrix
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _omega(state: State) -> np.ndarray:
    part = state[Turning]
    return np.asarray(rate_matrix(np.array(part.angles), part.axes, part.fixed) @ part.rates)


def _determinant(state: State) -> float:
    part = state[Turning]
    return float(rate_determinant(np.array(part.angles), part.axes, part.fixed))


FACTS = Facts(
    __name__,
    (Turning,),
    {
        "angles": Fact("the three angles", lambda s: s[Turning].angles, "rad", "numbers"),
        "rates": Fact("the rates of the angles", lambda s: s[Turning].rates, "rad/s", "numbers"),
        "omega": Fact("the angular velocity, in the fixed axes", _omega, "rad/s", "numbers"),
        "turning_speed": Fact("the size of the angular velocity", lambda s: np.linalg.norm(_omega(s)), "rad/s"),
        "determinant": Fact("the determinant of T", _determinant),
    },
)
