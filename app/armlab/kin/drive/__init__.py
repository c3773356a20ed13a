"""Models of drives: power, the torque of coils, and the DC motor (notes 2.0 and 2.1).

They are the models of chapter 2 of the course, pure mathematics as the rest of the core, and they stand beside the
kinematics: no model here knows an arm, and the masses of arms stay out of the lab. A motor sees its load as a torque
over time that somebody has given.

>>> from armlab.kin.drive import DcMotor, Piece, run
>>> motor = DcMotor(R=1.2, L=0.002, k=0.05, J=1e-4, F=2e-5)  # ohm, H, N m/A, kg m², N m s/rad
>>> current, speed = motor.steady(voltage=12.0, load=0.1)
>>> found = run(motor, [Piece(duration=0.2, voltage=12.0, load=0.1)])
>>> round(float(speed), 3), round(float(found.omega[-1]), 3)
(190.174, 187.636)
"""

from armlab.kin.drive.coils import MOST_COILS, Coil, Released, let_go, ripple, torque
from armlab.kin.drive.motor import Balance, DcMotor
from armlab.kin.drive.motor_run import Moment, MotorRun, Piece, run, transition
from armlab.kin.drive.power import DOMAINS, Domain, Held, holding, power_needed, powers_along, sinking

__all__ = [
    "DOMAINS",
    "MOST_COILS",
    "Balance",
    "Coil",
    "DcMotor",
    "Domain",
    "Held",
    "Moment",
    "MotorRun",
    "Piece",
    "Released",
    "holding",
    "let_go",
    "power_needed",
    "powers_along",
    "ripple",
    "run",
    "sinking",
    "torque",
    "transition",
]
