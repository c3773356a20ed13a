"""Incremental inverse kinematics: at each sample Newton's method from where the arm is to the next wanted pose.

    q^ = f^-1(r + dr), started at q;   qdot = (q^ - q) / T_s

A few iterations, because the start is near. An error left by the previous sample is corrected: unlike J^-1 v it does
not drift.

References
----------
Notes 5.100-5.105.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from armlab.kin.control.control_law import ControlLaw
from armlab.kin.control.controller import Aim, Controller, Told
from armlab.kin.control.scaled_task import Floats
from armlab.kin.field import Field

CLOSE = 1e-12
"""Scaled error below which the target counts as reached."""


def command(controller: Controller, q: Floats, aim: Aim, options: Mapping[str, Any]) -> Told:
    """Return the joint speeds that lead to the wanted pose by the next command, or by the end."""
    task, found, damping = controller.task, q, 0.0
    for _ in range(options["most"]):
        pose = task.pose(found)
        error = task.error(aim.next_pose, pose)
        if np.abs(error * task.row_units).max() < CLOSE:
            break
        step = controller.realise(found, pose[:3, :3], error, free=False)
        if step.qdot is None:
            return step
        found, damping = found + step.qdot, max(damping, step.damping)
    return Told((found - q) / aim.ahead, damping)


LAW = ControlLaw(
    "newton",
    "Newton at each sample",
    6,
    command,
    "tool",
    (Field("most", "k", "Newton iterations a sample, at most", "whole", 5, 1, 50),),
    held=True,
    formula=r"\dot q=(\hat q-q)/T_s,\ f(\hat q)=p_d(t+T_s)",
)
