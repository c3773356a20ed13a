"""Judge of a single solution: reached inside the limits, or what others find where it is not."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares

from armlab.kin import ik
from armlab.kin.arm import Arm
from judging.arms import inside
from judging.charges import REACHED
from judging.probe import Probe

STARTS = 20
"""Of the bounded least squares of SciPy."""


class One(NamedTuple):
    """What became of one pose.

    Attributes
    ----------
    solved : bool
        A solution inside the limits, confirmed by the judge's own forward kinematics.
    wrong : str
        What is wrong with what was said, empty where nothing is: a pose that is reached is not, or the other way round.
    """

    solved: bool
    wrong: str


def judged(arm: Arm, q: np.ndarray, found: ik.IkResult) -> One:
    """Return what became of the pose of joint values that are inside the limits."""
    probe = Probe(arm)
    G = probe.target(np.asarray(arm.fk(q)))
    place, turn = (float(error[0]) for error in probe.errors(found.q[None], G))
    low, high = arm.limits.T
    reached = place <= REACHED and turn <= REACHED and bool(((found.q >= low - 1e-9) & (found.q <= high + 1e-9)).all())
    wrong = ""
    if found.success and not reached:
        wrong = f"said to be reached, but {place:.1e} m, {turn:.1e} rad off or outside the limits"
    elif found.proven:
        wrong = f"said to be proven not to be: {found.reason}"
    return One(reached and found.success, wrong)


def by_least_squares(arm: Arm, T: np.ndarray, rng: np.random.Generator) -> int | None:
    """Return how many starts SciPy's bounded least squares needs for a pose, None where `STARTS` are not enough."""
    probe = Probe(arm)
    G = probe.target(T)
    low, high = arm.limits.T

    def errors(q: np.ndarray) -> np.ndarray:
        return np.asarray(probe.linearised(q[:, None], G)[1][:, 0])

    def slopes(q: np.ndarray) -> np.ndarray:
        return np.asarray(-probe.linearised(q[:, None], G)[0][:, :, 0].T / probe.scales)

    for k in range(STARTS):
        q = least_squares(errors, inside(arm, rng), slopes, bounds=(low, high), xtol=1e-15, ftol=1e-15, gtol=1e-15).x
        place, turn = probe.errors(q[None], G)
        if place[0] <= REACHED and turn[0] <= REACHED:
            return k + 1
    return None
