"""Facts of the microscope that lessons can check: the nearest singularity, and the answer of each method."""

from __future__ import annotations

import numpy as np

from armlab.benches.velocity.microscope.look import Look
from armlab.benches.velocity.microscope.looked import looked, near
from armlab.benches.velocity.microscope.state import Microscope
from armlab.session.facts import Fact, Facts
from armlab.session.state import State


def _look(state: State) -> Look:
    return state.derived(looked)


def _inverse_condition(state: State) -> float:
    """Return the ratio of all singular values, also of those that are 0 in every configuration."""
    sigma = _look(state).sigma
    return float(sigma[-1] / sigma[0]) if sigma[0] > 0.0 else 0.0


def _joint_speed(state: State) -> float | None:
    """Return the size of the scaled joint speeds of the watched method, or None if it has no answer."""
    look = _look(state)
    qdot = look.answer(look.part.method).qdot
    return None if qdot is None else float(np.linalg.norm(qdot))


def _away(state: State) -> float | None:
    """Return the distance, rad or m, by which the joint would move to the nearest singular configuration."""
    found = state.derived(near)
    return None if found is None else abs(float(found.pose.away))


FACTS = Facts(
    __name__,
    (Microscope,),
    {
        "singular_values": Fact("the singular values of the scaled Jacobian", lambda s: _look(s).sigma, kind="numbers"),
        "inverse_condition": Fact("the smallest singular value over the largest", _inverse_condition),
        "singular": Fact("the arm is singular", lambda s: _look(s).singular, kind="truth"),
        "away": Fact("how far one joint is from the nearest singular configuration, in rad or m", _away),
        "wish": Fact("the size of the wanted velocity, scaled", lambda s: np.linalg.norm(_look(s).wish)),
        "joint_speed": Fact(
            "the size of the joint speeds of the method that is watched, scaled",
            _joint_speed,
        ),
    },
)
