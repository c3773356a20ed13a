"""Power along a chain of converters, and what it takes to hold a load still (notes 2.0, figure 2.2, 2.1)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats
from armlab.kin.field import positive

Array = NDArray[np.float64]

COPPER = 0.00393
"""Temperature coefficient of the resistance of copper at 20 degrees Celsius, 1/K (IEC 60028)."""

MELTING = 1065.0
"""Rise of temperature, K, at which copper melts in air of 20 degrees Celsius: at 1085."""


@dataclass(frozen=True)
class Domain:
    """A form of power as the product of two quantities.

    Attributes
    ----------
    key, title : str
    effort, flow : str
        Symbols of the two.
    effort_name, flow_name : str
        Their names in words.
    effort_unit, flow_unit : str
        SI; their product is the watt.
    """

    key: str
    title: str
    effort: str
    flow: str
    effort_name: str
    flow_name: str
    effort_unit: str
    flow_unit: str


DOMAINS: dict[str, Domain] = {
    each.key: each
    for each in (
        Domain("electrical", "electrical", "V", "I", "voltage", "current", "V", "A"),
        Domain("hydraulic", "hydraulic", "p", "Q", "pressure", "flow rate", "Pa", "m³/s"),
        Domain("linear", "linear mechanical", "F", "v", "force", "speed", "N", "m/s"),
        Domain("rotational", "rotational mechanical", "τ", "ω", "torque", "angular speed", "N m", "rad/s"),
    )
}
"""The four products of power of the notes, by key."""


def powers_along(supplied: float, efficiencies: Sequence[float]) -> Array:
    """Return the power before the first converter and after each, watts, shape (n + 1,): P_u = eta P_c (2.1).

    Parameters
    ----------
    supplied : float
        Watts, positive.
    efficiencies : sequence of float
        In (0, 1], one for each converter.

    Raises
    ------
    InputError
        Power or efficiency out of range.

    Examples
    --------
    >>> powers_along(100.0, [0.9, 0.5]).tolist()
    [100.0, 90.0, 45.0]
    """
    return np.asarray(positive(supplied, "power") * np.cumprod([1.0, *checked_efficiencies(efficiencies)]))


def power_needed(useful: float, efficiencies: Sequence[float]) -> float:
    """Return the power that has to be supplied for a useful one behind some converters, watts; see `powers_along`."""
    return positive(useful, "power") / math.prod(checked_efficiencies(efficiencies))


def checked_efficiencies(values: Sequence[float]) -> list[float]:
    """Return efficiencies; `InputError` for one that is not above 0, or above 1: it would make power from nothing."""
    found = as_floats(values, "efficiency", "numbers above 0 and up to 1").ravel()
    for k, value in enumerate(found.tolist()):
        if not 0.0 < value <= 1.0:
            raise InputError(f"efficiency of converter {k + 1}: expected more than 0 and at most 1, got {value:g}")
    return [float(value) for value in found]


@dataclass(frozen=True)
class Held:
    """A motor that holds a torque at standstill.

    Attributes
    ----------
    torque : float
        Of the motor, N m.
    current : float
        A.
    heat : float
        R i² with the winding cold, watts: all of the power supplied, since tau omega is 0.
    rise : float
        Of the temperature of the winding in the long run, K; infinite where the copper melts on the way, or the
        growing resistance lets it run away.
    """

    torque: float
    current: float
    heat: float
    rise: float


def holding(load: float, ratio: float, k: float, R: float, thermal: float = 0.0) -> Held:
    """Return what an electric motor needs to hold a load at standstill through an ideal gear.

    The winding gets warmer by Theta = R_th P and has then the resistance R (1 + alpha Theta), which makes more heat:
    Theta = R_th R i² / (1 - alpha R_th R i²). The winding stands no such temperature where the denominator is not
    positive, or where copper melts before.

    Parameters
    ----------
    load : float
        Torque at the load, N m.
    ratio : float
        Of the gear: turns of the motor per turn of the load, positive.
    k : float
        Torque constant, N m/A, positive.
    R : float
        Resistance of the cold winding, ohm, positive.
    thermal : float
        Thermal resistance from the winding to the air, K/W.

    Raises
    ------
    InputError
        A value that has to be positive is not.
    """
    torque = load / positive(ratio, "n")
    current = torque / positive(k, "k")
    heat = positive(R, "R") * current**2
    left = 1.0 - COPPER * thermal * heat
    stands = thermal * heat < MELTING * left
    return Held(torque, current, heat, thermal * heat / left if stands else math.inf)


def sinking(load: float, pressure: float, leak: float) -> float:
    """Return the angular speed, rad/s, at which a load sinks on a shut valve: p Q = tau omega, paid by the load.

    The pressure is the one that this load makes, so that the cylinder gives way by tau / p for each radian. In the same
    cylinder a heavier load makes more pressure, and the speed depends on the leakage alone.

    Parameters
    ----------
    load : float
        Torque, N m, positive.
    pressure : float
        Of the oil that carries it, Pa.
    leak : float
        Flow rate that passes the seals, m³/s.
    """
    return pressure * leak / positive(load, "load")
