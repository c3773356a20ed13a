"""A DC motor: its constants, voltage and load over time, the start, and what is shown."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

from armlab.benches.drive.motor.profile import KINDS, Profile, Rows, pieces_of, read_rows
from armlab.errors import InputError
from armlab.kin.drive.motor import DcMotor
from armlab.kin.drive.motor_run import MotorRun, Piece, check_pieces, run
from armlab.session.fields import FieldPart, choice, number, own, text
from armlab.session.parts.timeline import Timeline
from armlab.session.state import PartType, State

CLIP_KEY = "motor"

SHOWN = {"run": "Run", "blocks": "Blocks", "poles": "Poles", "power": "Power", "state": "State"}

TURN = 2.0 * math.pi


@dataclass(frozen=True)
class Motor(FieldPart):
    """Numbers of the page, which do not depend on the arm.

    Attributes
    ----------
    R, L, k, J, F : float
        As of `DcMotor`: ohm, H, N m/A = V s/rad, kg m², N m s/rad.
    end : float
        How long the motor is looked at, seconds.
    v_kind, v, v_start, v_stop, v_rows
        The voltage over time, as of `Profile`: V and s.
    load_kind, load, load_start, load_stop, load_rows
        The torque of the load over time: N m and s.
    i0, omega0, theta0 : float
        The start: A, rad/s, rad.
    twin : float
        By how much a second, equal motor is turned on at the start, rad.
    shown : str
        Key of `SHOWN`.
    example : str
        Key of the example it still is; empty when something has been changed.
    """

    key: ClassVar[str] = "motor"
    clip: ClassVar[str] = CLIP_KEY
    looks: ClassVar[tuple[str, ...]] = ("shown",)

    R: float = number("R_a", "resistance of the winding", 1.2, 0.0, 1e5, "Ω", above=True)
    L: float = number("L_a", "inductance of the winding, 0: left out", 0.002, 0.0, 1e3, "H")
    k: float = number("k", "constant of torque and voltage", 0.05, 0.0, 1e3, "N m/A", above=True)
    J: float = number("I_m", "moment of inertia", 1e-4, 0.0, 1e6, "kg m²", above=True)
    F: float = number("F_m", "viscous friction", 2e-5, 0.0, 1e4, "N m s/rad")
    end: float = number("T", "how long it is looked at", 0.2, 1e-5, 600.0, "s")
    v_kind: str = choice("voltage over time", "step", KINDS)
    v: float = number("v_a", "voltage", 12.0, -1e5, 1e5, "V")
    v_start: float = number("from", "start of the voltage", 0.0, 0.0, 600.0, "s")
    v_stop: float = number("to", "end of the voltage", 0.1, 0.0, 600.0, "s")
    v_rows: Rows = own("typed voltage", ((0.0, 12.0), (0.1, 6.0)), read_rows)
    load_kind: str = choice("load over time", "step", KINDS)
    load: float = number("τ_load", "torque of the load", 0.1, -1e6, 1e6, "N m")
    load_start: float = number("from", "start of the load", 0.0, 0.0, 600.0, "s")
    load_stop: float = number("to", "end of the load", 0.15, 0.0, 600.0, "s")
    load_rows: Rows = own("typed load", ((0.0, 0.0), (0.1, 0.1)), read_rows)
    i0: float = number("i(0)", "current at the start", 0.0, -1e5, 1e5, "A")
    omega0: float = number("ω(0)", "speed at the start", 0.0, -1e6, 1e6, "rad/s")
    theta0: float = number("θ(0)", "angle at the start", 0.0, -1e6, 1e6, "rad")
    twin: float = number("Δθ(0)", "how far the second motor is turned on", 1.0, -1e3, 1e3, "rad")
    shown: str = choice("what is shown of the motor", "run", SHOWN)
    example: str = text("example", "course")

    @cached_property
    def motor(self) -> DcMotor:
        """The motor."""
        return DcMotor(self.R, self.L, self.k, self.J, self.F)

    @property
    def voltage(self) -> Profile:
        """The voltage over time."""
        return Profile(self.v_kind, self.v, self.v_start, self.v_stop, self.v_rows)

    @property
    def torque(self) -> Profile:
        """The load over time."""
        return Profile(self.load_kind, self.load, self.load_start, self.load_stop, self.load_rows)

    @cached_property
    def pieces(self) -> tuple[Piece, ...]:
        """The whiles in which voltage and load are constant."""
        return pieces_of(self.voltage, self.torque, self.end)

    @cached_property
    def run(self) -> MotorRun:
        """The motor over time."""
        return run(self.motor, self.pieces, (self.i0, self.omega0, self.theta0))

    @cached_property
    def second(self) -> MotorRun:
        """An equal motor that starts turned on."""
        return run(self.motor, self.pieces, (self.i0, self.omega0, self.theta0 + self.twin))

    def check(self) -> None:
        """Refuse a run that cannot be worked out."""
        self.voltage.check("voltage")
        self.torque.check("load")
        if self.J < 1e-15 or self.k < 1e-9 or self.R < 1e-9:
            raise InputError(
                "motor: expected a resistance of at least 1e-9 Ω, a constant of 1e-9 N m/A and a moment of inertia of "
                "1e-15 kg m²; without any of them it is no motor"
            )
        check_pieces(self.motor, self.pieces)


PART = PartType(Motor, order=132)


def present_time(state: State) -> float:
    """Return the seconds since the run began; its end while the film is closed."""
    timeline = state[Timeline]
    return timeline.time if timeline.clip == CLIP_KEY else state[Motor].end
