"""Tracking of the joints: qdot = qdot_d + K (q_d - q), so that e_i = e_i(0) exp(-k_i t), each with its own k_i.

It needs q_d and its derivative, from the inverse kinematics of the reference where that is one of the tool; no inverse
of the Jacobian at the present configuration.

References
----------
Notes 7.13-7.18; 7.11-7.12 print p_d where q_d is needed, 7.18 one k for all joints.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from armlab.kin.control.control_law import JOINT_GAINS, ControlLaw, joint_gains
from armlab.kin.control.controller import Aim, Controller, Told
from armlab.kin.control.scaled_task import Floats


def command(controller: Controller, q: Floats, aim: Aim, options: Mapping[str, Any]) -> Told:
    """Return the joint speeds of the reference plus the gains times the errors."""
    return Told(aim.qdot + options["K"] * (aim.q - q))


LAW = ControlLaw(
    "joint_tracking",
    "Tracking, error of the joints",
    4,
    command,
    "joints",
    JOINT_GAINS,
    inverts=False,
    formula=r"\dot q=\dot q_d+K(q_d-q)",
    prepare=joint_gains,
)
