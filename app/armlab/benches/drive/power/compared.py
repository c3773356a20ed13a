"""Kinds of actuators and motors compared by numbers, each with its source."""

from __future__ import annotations

from dataclasses import dataclass

from armlab.benches.drive.quantities import RPM, prefixed
from armlab.kin.drive.coils import ripple
from armlab.session.amounts import amount

TYPICAL = 0
"""Source of a number that is common in the trade, right in its order of magnitude."""

COMPUTED = -1
"""Source of a number that follows from others or from a closed form."""

BY_KIND = -2
"""Source of what follows from the kind of actuator alone, and is no measured number."""

SOURCES: dict[int, str] = {
    1: "maxon, data sheet of the motor RE 40, 150 W, 24 V, order number 148867",
    2: "US Department of Energy, Improving Compressed Air System Performance, 2003: 7 to 8 W of electricity for 1 W at "
    "the shaft of an air motor",
    3: "Love, Lanke, Alles, Oak Ridge National Laboratory, TM-2011/14, 2012: mean of installed systems",
    4: "Universal Robots, data sheet of the UR10e (ISO 9283)",
}
"""Sources of numbers, by the mark in the tables."""


@dataclass(frozen=True)
class Number:
    """A number of a table.

    Attributes
    ----------
    text : str
        With its unit.
    source : int
        Key of `SOURCES`, `TYPICAL` or `COMPUTED`.
    """

    text: str
    source: int = TYPICAL


@dataclass(frozen=True)
class Comparison:
    """A table of kinds side by side.

    Attributes
    ----------
    kinds : tuple of str
    rows : tuple of (str, tuple of Number)
        Quantity, and a number for each kind.
    says : str
        What follows from them.
    """

    kinds: tuple[str, ...]
    rows: tuple[tuple[str, tuple[Number, ...]], ...]
    says: str


RATED, MASS, TORQUE, INERTIA = 150.0, 0.48, 0.177, 142e-7
"""Power in W, mass in kg, nominal torque in N m and inertia of the rotor in kg m² of the motor RE 40 (source 1)."""

FREE, MOST = 7580.0, 12000.0
"""Its speeds without load at 24 V and at most, rpm (source 1)."""

SEGMENTS = 13
"""Its segments of the commutator (source 1), each the end of one coil and the start of the next."""

GEAR = 100.0
"""Ratio of a gear that is usual behind such a motor."""

AIR, OIL = 0.7e6, 1.4e9
"""Absolute pressure of compressed air, and bulk modulus of mineral oil, Pa."""

ADIABATIC = 1.4
"""Ratio of the heat capacities of air; times the pressure it is the bulk modulus of a quick change."""


def _actuators() -> Comparison:
    return Comparison(
        ("electric", "pneumatic", "hydraulic"),
        (
            ("usual supply", (Number("24–600 V"), Number("0.6–0.8 MPa"), Number("10–35 MPa"))),
            ("supply to shaft", (Number("70–90 %"), Number("13 %", 2), Number("21 %", 3))),
            (
                "power per mass",
                (
                    Number(f"{RATED / MASS / 1e3:.2f} kW/kg", 1),
                    Number("0.3–1 kW/kg"),
                    Number("3–10 kW/kg"),
                ),
            ),
            ("positions to", (Number("±0.05 mm", 4), Number("±0.2–1 mm"), Number("±0.1–1 mm"))),
            (
                "bulk modulus",
                (
                    Number("no medium", BY_KIND),
                    Number(prefixed(ADIABATIC * AIR, "Pa"), COMPUTED),
                    Number("1.4 GPa"),
                ),
            ),
            ("holds still with", (Number("R i²", BY_KIND), Number("0 W", BY_KIND), Number("0 W", BY_KIND))),
        ),
        f"Oil yields {OIL / (ADIABATIC * AIR):.0f} times less than air, and a hydraulic actuator gives ten times the "
        "power of a motor of its mass; but it needs a pump beside the robot. The electric one wastes least and needs "
        "only a socket, and pays with heat where it holds a load.",
    )


def _motors() -> Comparison:
    return Comparison(
        ("brushed", "brushless"),
        (
            ("windings on", (Number("the rotor", BY_KIND), Number("the stator", BY_KIND))),
            ("wires", (Number("2", BY_KIND), Number("3, and 5 of Hall sensors"))),
            ("switches of the amplifier", (Number("4", BY_KIND), Number("6", BY_KIND))),
            ("life", (Number("1000–3000 h, brushes"), Number("20 000 h, bearings"))),
            ("efficiency", (Number("75–90 %"), Number("85–92 %"))),
            ("highest speed", (Number(f"{MOST / 1e3:.0f} 000 rpm", 1), Number("25 000–60 000 rpm"))),
            (
                "torque ripple",
                (
                    Number(f"{amount(100.0 * ripple(SEGMENTS))} %, {SEGMENTS} coils", COMPUTED),
                    Number(f"{amount(100.0 * ripple(3))} %, block of 3 phases", COMPUTED),
                ),
            ),
        ),
        "The heat of a brushless motor is made in the stator, whose outside is cooled, and nothing wears but the "
        "bearings. It cannot turn without electronics, which switch by its angle; with sinusoidal currents in place of "
        "blocks the ripple of the currents is gone.",
    )


def _servo() -> Comparison:
    return Comparison(
        ("wanted", "RE 40 alone", f"gear {GEAR:.0f}"),
        (
            ("power", (Number("10 W–10 kW"), Number(prefixed(RATED, "W"), 1), Number("at most that", BY_KIND))),
            (
                "speed",
                (
                    Number("1–2000 rpm"),
                    Number(f"0–{FREE:.0f} rpm", 1),
                    Number(f"0–{FREE / GEAR:.1f} rpm", COMPUTED),
                ),
            ),
            (
                "torque for ever",
                (
                    Number(prefixed(RATED / (2000.0 * RPM), "N m"), COMPUTED),
                    Number(prefixed(TORQUE, "N m"), 1),
                    Number(prefixed(TORQUE * GEAR, "N m"), COMPUTED),
                ),
            ),
            (
                "power per mass",
                (Number("> 0.1 kW/kg"), Number(f"{RATED / MASS / 1e3:.2f} kW/kg", 1), Number("0.1–0.2 kW/kg")),
            ),
            (
                "acceleration",
                (
                    Number("> 10⁴ rad/s²"),
                    Number(f"{amount(TORQUE / INERTIA)} rad/s²", COMPUTED),
                    Number(f"{amount(TORQUE / INERTIA / GEAR)} rad/s²", COMPUTED),
                ),
            ),
            (
                "torque ripple",
                (
                    Number("< 1 %"),
                    Number(f"{amount(100.0 * ripple(SEGMENTS))} %", COMPUTED),
                    Number("the same", BY_KIND),
                ),
            ),
        ),
        "A servomotor is a motor with a sensor of its angle and a controller that compares the angle with the wanted "
        "one. The torque that is wanted is that of 150 W at 2000 rpm.",
    )


COMPARISONS = {"actuators": _actuators(), "motors": _motors(), "servo": _servo()}
"""The tables, by what is compared."""
