"""Kinematic control: from a wanted velocity of the tool to joint speeds and the resulting motion (notes 5.2 and 7).

The arm is a plant that does what joint speeds it is told (notes 7.2). A `Reference` says where the tool or the joints
are wanted, a control law what to command, a rate inverse how a velocity of the tool becomes joint speeds, and
`simulate` runs them together.

>>> from armlab.kin.arm import Arm
>>> from armlab.kin.control import LineReference, simulate
>>> arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)] * 2)
>>> run = simulate(arm, "cartesian_tracking", LineReference(arm.fk([0.3, 1.0]), [-0.2, 0.0, 0.0], 1.0), [0.35, 1.0])
>>> bool(run.error_position[0] > 0.05), bool(run.error_position[-1] < 0.001)
(True, True)
"""

from armlab.kin.control.control_law import ControlLaw, control_law, control_laws
from armlab.kin.control.encoder import Encoder, encoder
from armlab.kin.control.error_laws import error_decay, predicted_error, space_error_rate
from armlab.kin.control.plant import Plant, Push, believed, plant
from armlab.kin.control.rate_inverse import RateInverse, RateStep, rate_inverse, rate_inverses, rate_step
from armlab.kin.control.record import Run
from armlab.kin.control.reference import (
    CircleReference,
    FixedJoints,
    FixedPose,
    JointReference,
    LineReference,
    Reference,
    ToolReference,
)
from armlab.kin.control.run import INTEGRATORS, Settings, simulate, simulating
from armlab.kin.control.saturation import SATURATIONS, saturate

__all__ = [
    "INTEGRATORS",
    "SATURATIONS",
    "CircleReference",
    "ControlLaw",
    "Encoder",
    "FixedJoints",
    "FixedPose",
    "JointReference",
    "LineReference",
    "Plant",
    "Push",
    "RateInverse",
    "RateStep",
    "Reference",
    "Run",
    "Settings",
    "ToolReference",
    "believed",
    "control_law",
    "control_laws",
    "encoder",
    "error_decay",
    "plant",
    "predicted_error",
    "rate_inverse",
    "rate_inverses",
    "rate_step",
    "saturate",
    "simulate",
    "simulating",
    "space_error_rate",
]
