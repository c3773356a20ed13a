"""Feed-forward alone: qdot = J^-1 v, or another inverse. Errors are never corrected.

References
----------
Notes 5.99 and section 6.3.1, execution.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from armlab.kin.control.control_law import ControlLaw
from armlab.kin.control.controller import Aim, Controller, Told
from armlab.kin.control.scaled_task import Floats


def command(controller: Controller, q: Floats, aim: Aim, options: Mapping[str, Any]) -> Told:
    """Return joint speeds for the velocity of the reference."""
    R = controller.task.orientation(q)
    return controller.realise(q, R, controller.task.rows(R) @ aim.twist)


LAW = ControlLaw(
    "open_loop", "Open loop: velocity alone", 1, command, "tool", feedback=False, formula=r"\dot q=J^{\#}\dot p_d"
)
