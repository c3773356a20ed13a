"""The unit of the manipulability, when it is a power of metres."""

from __future__ import annotations

from armlab.kin.arm import Arm

POWERS = ("", "m", "m²", "m³")
"""Units by their power of metres, from 0 to 3."""


def length_power(arm: Arm) -> int | None:
    """Return the power of metres in w of the task; None where w adds squares of different units.

    w² is the sum of the squared minors of the task Jacobian, whose entries are m/rad and m/m in rows of position, 1
    and 0 in rows of rotation.
    """
    position, slides, n = len(arm.task.position), int((~arm.revolute).sum()), arm.n
    turning = arm.task.m - position
    if position == 0 or slides == n:
        return 0
    if arm.task.m == n or (arm.task.m > n and turning == 0):
        return max(min(position, n) - slides, 0)
    return position if arm.task.m < n and slides == 0 else None
