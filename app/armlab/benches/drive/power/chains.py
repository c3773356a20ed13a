"""Chains of converters from the supply to the load: which they are, and what is typed of the power between them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

from armlab.kin.drive.power import DOMAINS, Domain, power_needed, powers_along
from armlab.registry import Registry

MEGA = 1e6
"""Pascal in a megapascal, the unit in which pressures are typed."""

CONVERTERS = 3
"""Number of converters of every chain."""


@dataclass(frozen=True)
class Place:
    """Place along a chain where power passes in one form.

    Attributes
    ----------
    title : str
    domain : str
        Key of `DOMAINS`.
    field : str
        Field of the part with the factor that is typed there.
    other : str
        Field with the other factor, where that is typed, too; empty where it always follows from the power.
    """

    title: str
    domain: str
    field: str
    other: str = ""


@dataclass(frozen=True)
class ChainKind:
    """A kind of chain.

    Attributes
    ----------
    key, title : str
    converters : tuple of (str, str)
        Title of each, and the field of its efficiency.
    places : tuple of Place
        Supply, behind the first and the second converter, and load.
    """

    key: str
    title: str
    converters: tuple[tuple[str, str], ...]
    places: tuple[Place, ...]


_SUPPLY = Place("Supply", "electrical", "voltage", "current")
_SHAFT = Place("Motor shaft", "rotational", "motor_speed")
_TERMINALS = Place("Motor terminals", "electrical", "motor_voltage")
_PUSHED = Place("Load", "linear", "feed", "force")

CHAINS = Registry(
    "chain",
    (
        ChainKind(
            "rotary",
            "Electric, joint",
            (("Amplifier", "eta_amplifier"), ("Motor", "eta_motor"), ("Gear", "eta_gear")),
            (_SUPPLY, _TERMINALS, _SHAFT, Place("Load", "rotational", "joint_speed", "joint_torque")),
        ),
        ChainKind(
            "linear",
            "Electric, slide",
            (("Amplifier", "eta_amplifier"), ("Motor", "eta_motor"), ("Screw", "eta_screw")),
            (_SUPPLY, _TERMINALS, _SHAFT, _PUSHED),
        ),
        ChainKind(
            "hydraulic",
            "Hydraulic",
            (("Motor", "eta_motor"), ("Pump", "eta_pump"), ("Cylinder", "eta_cylinder")),
            (_SUPPLY, _SHAFT, Place("Pressure line", "hydraulic", "pressure"), _PUSHED),
        ),
    ),
)


@dataclass(frozen=True)
class Passed:
    """Power at one place of a chain.

    Attributes
    ----------
    place : Place
    power : float
        Watts.
    effort, flow : float
        The two factors, SI.
    """

    place: Place
    power: float
    effort: float
    flow: float

    @property
    def domain(self) -> Domain:
        """The form of the power."""
        return DOMAINS[self.place.domain]


@dataclass(frozen=True)
class Chain:
    """A chain with its numbers.

    Attributes
    ----------
    kind : ChainKind
    efficiencies : tuple of float
    passed : tuple of Passed
        One for each place.
    """

    kind: ChainKind
    efficiencies: tuple[float, ...]
    passed: tuple[Passed, ...]

    @property
    def supplied(self) -> float:
        """The power P_c that is supplied, watts."""
        return self.passed[0].power

    @property
    def useful(self) -> float:
        """The power P_u at the load, watts."""
        return self.passed[-1].power

    @property
    def efficiency(self) -> float:
        """P_u / P_c of the whole chain (2.1)."""
        return self.useful / self.supplied

    @property
    def losses(self) -> tuple[float, ...]:
        """The heat of each converter, watts."""
        powers = [each.power for each in self.passed]
        return tuple(before - after for before, after in pairwise(powers))


def effort_typed(domain: str) -> bool:
    """Return whether the effort of a form of power is typed, as voltage and pressure are, and not its speed."""
    return domain in ("electrical", "hydraulic")


def chain_of(kind: ChainKind, typed: Mapping[str, float], from_load: bool) -> Chain:
    """Return a chain with its numbers.

    Parameters
    ----------
    kind : ChainKind
    typed : mapping of str to float
        Fields of the part by name, pressures in MPa.
    from_load : bool
        Whether the power at the load is given and that of the supply follows; else the other way round.
    """
    efficiencies = tuple(typed[field] for _, field in kind.converters)
    last = kind.places[-1]
    if from_load:
        supplied = power_needed(typed[last.field] * typed[last.other], efficiencies)
    else:
        supplied = typed["voltage"] * typed["current"]
    powers = powers_along(supplied, efficiencies).tolist()
    passed = tuple(_at(place, power, typed) for place, power in zip(kind.places, powers, strict=True))
    return Chain(kind, efficiencies, passed)


def _at(place: Place, power: float, typed: Mapping[str, float]) -> Passed:
    given = typed[place.field] * (MEGA if place.domain == "hydraulic" else 1.0)
    if effort_typed(place.domain):
        return Passed(place, power, given, power / given)
    return Passed(place, power, power / given, given)
