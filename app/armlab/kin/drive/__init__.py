"""Models of drives: power, the torque of coils, the DC motor, gears and harmonic drives (notes 2.0 to 2.2).

They are the models of chapter 2 of the course, pure mathematics as the rest of the core, and they stand beside the
kinematics: only the drives of joints know an arm, and the masses of arms stay out of the lab. A motor sees its load as
a torque over time that somebody has given.

>>> from armlab.kin.drive import DcMotor, Piece, run
>>> motor = DcMotor(R=1.2, L=0.002, k=0.05, J=1e-4, F=2e-5)  # ohm, H, N m/A, kg m², N m s/rad
>>> current, speed = motor.steady(voltage=12.0, load=0.1)
>>> found = run(motor, [Piece(duration=0.2, voltage=12.0, load=0.1)])
>>> round(float(speed), 3), round(float(found.omega[-1]), 3)
(190.174, 187.636)
"""

from armlab.kin.drive.best_ratio import Best, Load, best_ratio, motor_torque
from armlab.kin.drive.coils import MOST_COILS, Coil, Released, let_go, ripple, torque
from armlab.kin.drive.joint_drives import JointDrives, joint_drives
from armlab.kin.drive.motor import Balance, DcMotor
from armlab.kin.drive.motor_run import Moment, MotorRun, Piece, run, transition
from armlab.kin.drive.power import DOMAINS, Domain, Held, holding, power_needed, powers_along, sinking
from armlab.kin.drive.strain_wave import StrainWave, counted_teeth, strain_wave
from armlab.kin.drive.tool_error import Worst, worst
from armlab.kin.drive.train import Train, train
from armlab.kin.drive.transfer import Transfer, transfer

__all__ = [
    "DOMAINS",
    "MOST_COILS",
    "Balance",
    "Best",
    "Coil",
    "DcMotor",
    "Domain",
    "Held",
    "JointDrives",
    "Load",
    "Moment",
    "MotorRun",
    "Piece",
    "Released",
    "StrainWave",
    "Train",
    "Transfer",
    "Worst",
    "best_ratio",
    "counted_teeth",
    "holding",
    "joint_drives",
    "let_go",
    "motor_torque",
    "power_needed",
    "powers_along",
    "ripple",
    "run",
    "sinking",
    "strain_wave",
    "torque",
    "train",
    "transfer",
    "transition",
    "worst",
]
