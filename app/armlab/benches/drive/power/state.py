"""The page of power: a chain from the supply to the load, a load that is held still, and what is shown."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from functools import cached_property
from typing import ClassVar

from armlab.benches.drive.power.chains import CHAINS, MEGA, Chain, chain_of
from armlab.kin.drive.power import Held, holding, sinking
from armlab.session.fields import FieldPart, choice, number, text
from armlab.session.state import PartType

SHOWN = {"system": "Robot", "chain": "Chain", "hold": "Holding", "compare": "Compare"}

GIVEN = {"supply": "at the supply", "load": "at the load"}

COMPARED = {"actuators": "Electric, air, oil", "motors": "Brushed, brushless", "servo": "Servomotor"}

GRAVITY = 9.80665
"""Standard gravity, m/s²."""

CUBIC_CENTIMETRES = 1e-6
"""Cubic metres in a cubic centimetre."""


@dataclass(frozen=True)
class Power(FieldPart):
    """Numbers of the page, which do not depend on the arm.

    Attributes
    ----------
    kind : str
        Key of `CHAINS`.
    given : "supply" or "load"
        Where the power of the chain is typed.
    pressure : float
        MPa, of the oil in the chain, and of the oil in the cylinder that holds a load, where the load makes it.
    eta_amplifier, eta_motor, ... : float
        Efficiencies.
    mass, arm : float
        Of a load at the end of a level arm that is held still: kg, m.
    ratio, k, R, thermal, limit : float
        Of the motor that holds it: ratio of its gear, N m/A, ohm, K/W, and the rise of temperature it stands, K.
    brake : float
        Watts with which a brake is kept open while the arm moves.
    leak : float
        cm³/s that pass the shut valve of a hydraulic one.
    shown, compared : str
        What the page shows.
    example : str
        Key of the example it still is; empty when something has been changed.
    """

    key: ClassVar[str] = "power"
    looks: ClassVar[tuple[str, ...]] = ("shown", "compared")

    kind: str = choice("kind of the chain", "rotary", {key: kind.title for key, kind in CHAINS.items()})
    given: str = choice("where the power is given", "supply", GIVEN)
    voltage: float = number("V", "voltage of the supply", 48.0, 0.1, 1e5, "V")
    current: float = number("I", "current of the supply", 3.5, 1e-3, 1e5, "A")
    motor_voltage: float = number("V", "voltage at the motor", 24.0, 0.1, 1e5, "V")
    motor_speed: float = number("ω", "angular speed of the motor", 700.0, 1e-3, 1e5, "rad/s")
    joint_speed: float = number("ω", "angular speed of the load", 7.0, 1e-4, 1e4, "rad/s")
    joint_torque: float = number("τ", "torque of the load", 15.0, 1e-4, 1e6, "N m")
    feed: float = number("v", "speed of the load", 0.1, 1e-5, 1e3, "m/s")
    force: float = number("F", "force of the load", 1000.0, 1e-3, 1e8, "N")
    pressure: float = number("p", "pressure of the oil", 10.0, 0.01, 1e3, "MPa")
    eta_amplifier: float = number("η", "efficiency of the amplifier", 0.95, 0.0, 1.0, above=True)
    eta_motor: float = number("η", "efficiency of the motor", 0.85, 0.0, 1.0, above=True)
    eta_gear: float = number("η", "efficiency of the gear", 0.75, 0.0, 1.0, above=True)
    eta_screw: float = number("η", "efficiency of the screw", 0.9, 0.0, 1.0, above=True)
    eta_pump: float = number("η", "efficiency of the pump", 0.85, 0.0, 1.0, above=True)
    eta_cylinder: float = number("η", "efficiency of valve and cylinder", 0.55, 0.0, 1.0, above=True)
    mass: float = number("m", "mass of the load", 2.0, 1e-3, 1e4, "kg")
    arm: float = number("l", "length of the level arm", 0.5, 1e-3, 100.0, "m")
    ratio: float = number("n", "ratio of the gear", 50.0, 1e-2, 1e5)
    k: float = number("k", "torque constant", 0.0302, 1e-5, 100.0, "N m/A")
    R: float = number("R", "resistance of the winding", 0.299, 1e-4, 1e4, "Ω")
    thermal: float = number("R_th", "thermal resistance from winding to air", 6.58, 1e-3, 1e3, "K/W")
    limit: float = number("ΔT", "rise of temperature the winding stands", 130.0, 1.0, 400.0, "K")
    brake: float = number("P_b", "power that keeps the brake open", 8.0, 0.0, 1e4, "W")
    leak: float = number("Q", "leakage of the shut valve", 0.02, 0.0, 1e3, "cm³/s")
    shown: str = choice("what is shown of power", "chain", SHOWN)
    compared: str = choice("what is compared", "actuators", COMPARED)
    example: str = text("example", "rotary")

    @cached_property
    def chain(self) -> Chain:
        """The chain with its numbers."""
        return chain_of(CHAINS[self.kind], asdict(self), self.given == "load")

    @property
    def load(self) -> float:
        """The torque of gravity about the end of the level arm, N m."""
        return self.mass * GRAVITY * self.arm

    @cached_property
    def held(self) -> Held:
        """The electric motor that holds the load."""
        return holding(self.load, self.ratio, self.k, self.R, self.thermal)

    @property
    def sinks(self) -> float:
        """How fast the load sinks on a shut valve, rad/s, in a cylinder of the size in which it makes the pressure."""
        return sinking(self.load, MEGA * self.pressure, CUBIC_CENTIMETRES * self.leak)

    @property
    def endures(self) -> bool:
        """Whether the winding may hold the load for ever."""
        return self.held.rise <= self.limit and math.isfinite(self.held.rise)


PART = PartType(Power, order=130)
