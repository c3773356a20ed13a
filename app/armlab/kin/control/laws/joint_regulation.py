"""Regulation of the joints: qdot = K (q_d - q).

References
----------
Notes 7.1 and 7.15 without feed-forward.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from armlab.kin.control.control_law import JOINT_GAINS, ControlLaw, joint_gains
from armlab.kin.control.controller import Aim, Controller, Told
from armlab.kin.control.scaled_task import Floats


def command(controller: Controller, q: Floats, aim: Aim, options: Mapping[str, Any]) -> Told:
    """Return the gains times the errors of the joints."""
    return Told(options["K"] * (aim.q - q))


LAW = ControlLaw(
    "joint_regulation",
    "Regulation, error of the joints",
    5,
    command,
    "joints",
    JOINT_GAINS,
    inverts=False,
    formula=r"\dot q=K(q_d-q)",
    prepare=joint_gains,
)
