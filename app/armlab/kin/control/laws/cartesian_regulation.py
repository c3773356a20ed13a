"""Regulation in space: qdot = J# K_p e, towards a pose that stands still, or after one that moves.

References
----------
Notes 7.1, the list of steps of the simple law; e as in 7.2.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from armlab.kin.control.control_law import TASK_GAINS, ControlLaw, task_gains
from armlab.kin.control.controller import Aim, Controller, Told
from armlab.kin.control.scaled_task import Floats


def command(controller: Controller, q: Floats, aim: Aim, options: Mapping[str, Any]) -> Told:
    """Return joint speeds for the gain times the error."""
    task, pose = controller.task, controller.task.pose(q)
    return controller.realise(q, pose[:3, :3], options["K"] * task.error(aim.pose, pose))


LAW = ControlLaw(
    "cartesian_regulation",
    "Regulation, error in space",
    3,
    command,
    "tool",
    TASK_GAINS,
    formula=r"\dot q=J^{\#}K_p e_p",
    prepare=task_gains,
)
