"""Power through a gear: speeds, torques and losses on the side of the motor and on that of the load."""

from __future__ import annotations

from typing import NamedTuple


class Transfer(NamedTuple):
    """Speeds, torques and powers on both sides of a gear.

    Attributes
    ----------
    motor_speed, load_speed : float
        rad/s.
    motor_torque, load_torque : float
        N m: by the motor on the gear, and by the gear on the load.
    motor_power, load_power, lost : float
        W; ``load_power = motor_power - lost`` (notes 2.32), and what is lost is never negative.
    """

    motor_speed: float
    load_speed: float
    motor_torque: float
    load_torque: float
    motor_power: float
    load_power: float
    lost: float


def transfer(ratio: float, speed: float, torque: float, efficiency: float = 1.0) -> Transfer:
    """Return speeds, torques and powers of a gear.

    ``theta_m' = n theta_u'`` and, without losses, ``tau_u = n tau_m``. With the efficiency eta the side that drives has
    to give more: ``tau_u = eta n tau_m`` while the motor drives, ``tau_u = n tau_m/eta`` while the load does, that is,
    while the motor brakes.

    Parameters
    ----------
    ratio : float
        n, not zero; negative if both sides turn against each other.
    speed, torque : float
        Of the motor, rad/s and N m.
    efficiency : float
        Above 0, at most 1.

    References
    ----------
    Notes 2.30-2.35, which are those of an ideal gear in (2.33) and (2.35).

    Examples
    --------
    >>> found = transfer(100.0, 300.0, 0.2)
    >>> found.load_speed, found.load_torque, found.motor_power, found.load_power
    (3.0, 20.0, 60.0, 60.0)
    """
    power = torque * speed
    share = efficiency if power >= 0.0 else 1.0 / efficiency
    out = share * power
    return Transfer(speed, speed / ratio, torque, share * ratio * torque, power, out, power - out)
