"""The ratio with which a motor needs the least torque to accelerate a load."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

STEP = 1e-5
"""Step of the central difference of the torque, as a share of the ratio."""

ROUNDING = 1e-12
"""Relative difference of two torques below which they are equal."""


class Load(NamedTuple):
    """A motor and what it accelerates, with an ideal gear between them.

    Attributes
    ----------
    motor_inertia, load_inertia : float
        J_m and J_u, kg m², positive.
    acceleration : float
        Of the load, rad/s².
    torque : float
        Constant torque tau_L by which the load resists, such as that of a weight, N m.
    """

    motor_inertia: float
    load_inertia: float
    acceleration: float
    torque: float = 0.0

    @property
    def resistance(self) -> float:
        """Torque that the load needs at its own shaft, ``J_u a + tau_L``, N m."""
        inertial = self.load_inertia * self.acceleration
        # A load that moves by itself needs nothing, and not what rounding leaves of two equal torques.
        return 0.0 if math.isclose(inertial, -self.torque, rel_tol=ROUNDING) else inertial + self.torque


class Best(NamedTuple):
    """The best ratio and the torque of the motor at it, N m.

    The ratio is 0 or infinite when the torque falls all the way there.
    """

    ratio: float
    torque: float


def motor_torque(load: Load, ratio: ArrayLike) -> Floats:
    """Return the torque of the motor, ``tau_m = J_m n a + (J_u a + tau_L)/n``, N m, shape (...).

    Notes 2.36, and with it a constant torque of the load.

    Examples
    --------
    >>> motor_torque(Load(0.01, 4.0, 3.0), [10.0, 20.0]).round(9).tolist()
    [1.5, 1.2]
    """
    n = np.asarray(ratio, dtype=np.float64)
    return np.asarray(load.motor_inertia * load.acceleration * n + load.resistance / n)


def slope(load: Load, ratio: float) -> float:
    """Return the derivative of the torque by the ratio, ``J_m a - (J_u a + tau_L)/n²``, N m.

    Notes 2.38 with its sign put right: it prints ``(J_m + J_u/n²) a``, which has no real root.
    """
    return load.motor_inertia * load.acceleration - load.resistance / ratio**2


def printed_slope(load: Load, ratio: float) -> float:
    """Return that derivative with a plus sign, as notes 2.38 prints it without tau_L; only to be compared."""
    return load.motor_inertia * load.acceleration + load.resistance / ratio**2


def measured_slope(load: Load, ratio: float) -> float:
    """Return the derivative as a central difference of the torque itself, N m; it knows of no formula for it."""
    high, low = motor_torque(load, [ratio * (1.0 + STEP), ratio * (1.0 - STEP)]).tolist()
    return float(high - low) / (2.0 * STEP * ratio)


def best_ratio(load: Load) -> Best:
    """Return the ratio with the least size of the motor's torque.

    The derivative is zero where ``J_m a n² = J_u a + tau_L``: at ``n = sqrt(J_u/J_m + tau_L/(J_m a))``, which is
    ``sqrt(J_u/J_m)`` of notes 2.39 for a load without torque. There the motor spends as much on itself as on the load.
    If the torque of the load drives it by more than ``J_u a``, both terms have opposite signs and there is a ratio with
    which the motor needs no torque at all. If it drives it by just that, the torque falls with the ratio all the way to
    zero.

    Examples
    --------
    >>> best_ratio(Load(0.01, 4.0, 3.0))
    Best(ratio=20.0, torque=1.2)
    """
    own, other = load.motor_inertia * load.acceleration, load.resistance
    if own == 0.0:
        return Best(math.inf if other else 1.0, 0.0)
    ratio = math.sqrt(abs(other / own))
    if other * own <= 0.0:
        return Best(ratio, 0.0)
    return Best(ratio, math.copysign(2.0 * math.sqrt(own * other), own))


def reflected(load: Load, ratio: float) -> tuple[float, float]:
    """Return the whole inertia as the motor feels it, ``J_m + J_u/n²``, and as the load does, ``n² J_m + J_u``."""
    square = ratio**2
    return load.motor_inertia + load.load_inertia / square, square * load.motor_inertia + load.load_inertia
