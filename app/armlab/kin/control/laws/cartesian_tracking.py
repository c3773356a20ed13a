"""Tracking in space: qdot = J# (p_d' + K_p e), e the error of the task.

Then e' = -K_p e, but only where rank J = m, so that J J# = I: (7.27) and (7.28) say always. At a singularity
e' = -K_p e + (I - J J#)(p_d' + K_p e), and a part of the error stays. Orientations err by the rotation vector theta r.

References
----------
Notes 7.25-7.28.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from armlab.kin.control.control_law import TASK_GAINS, ControlLaw, task_gains
from armlab.kin.control.controller import Aim, Controller, Told
from armlab.kin.control.scaled_task import Floats


def command(controller: Controller, q: Floats, aim: Aim, options: Mapping[str, Any]) -> Told:
    """Return joint speeds for the velocity of the reference plus the gain times the error."""
    task, pose = controller.task, controller.task.pose(q)
    R = pose[:3, :3]
    return controller.realise(q, R, task.rows(R) @ aim.twist + options["K"] * task.error(aim.pose, pose))


LAW = ControlLaw(
    "cartesian_tracking",
    "Tracking, error in space",
    2,
    command,
    "tool",
    TASK_GAINS,
    formula=r"\dot q=J^{\#}(\dot p_d+K_p e_p)",
    prepare=task_gains,
)
