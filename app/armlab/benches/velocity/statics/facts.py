"""Facts of statics that lessons can check: the torques that balance the wrench."""

from __future__ import annotations

import numpy as np

from armlab.benches.velocity.statics.state import Statics, balance, free_forces_at, work
from armlab.session.facts import Fact, Facts
from armlab.session.parts.joints import Joints
from armlab.session.state import State


def _largest(state: State) -> float | None:
    """Return the largest torque, N m, or None for an arm with sliding joints, which need forces."""
    revolute = state[Joints].arm.revolute
    return float(np.abs(state.derived(balance).torques).max()) if revolute.all() else None


def _free(state: State) -> int:
    return len(free_forces_at(state[Joints].arm, state[Joints].q).T)


FACTS = Facts(
    __name__,
    (Statics,),
    {
        "torques": Fact(
            "torques (N m) or forces (N) of the joints",
            lambda state: state.derived(balance).torques,
            kind="numbers",
        ),
        "largest_torque": Fact("the largest torque of a joint", _largest, "N m", only="arms of turning joints only"),
        "force": Fact("the force, in world axes", lambda state: state.derived(balance).wrench[:3], "N", "numbers"),
        "force_size": Fact(
            "the size of the force", lambda state: np.linalg.norm(state.derived(balance).wrench[:3]), "N"
        ),
        "moment_size": Fact(
            "the size of the moment", lambda state: np.linalg.norm(state.derived(balance).wrench[3:]), "N m"
        ),
        "needs_nothing": Fact(
            "no joint does anything for the wrench", lambda state: state.derived(balance).nothing, kind="truth"
        ),
        "free_forces": Fact("the number of independent forces that need no torque", _free, kind="count"),
        "virtual_work": Fact("the virtual work of the tool", lambda state: state.derived(work).tool, "J"),
    },
)
