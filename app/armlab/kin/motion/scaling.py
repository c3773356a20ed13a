"""Uniform time scaling: as fast as the limits allow, on the same path (section 6.3.4 of the notes)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.motion.limits import NAMES, Limits, limits_of
from armlab.kin.motion.peaks import peaks
from armlab.kin.motion.sequence import Slowed
from armlab.kin.motion.trajectory import Motion, Trajectory

Floats = NDArray[np.float64]

Moving = tuple[bool, bool]
"""Whether a motion is meant to begin and to end with a speed, so that no jump counts there."""

AT_REST: Moving = (False, False)


@dataclass(frozen=True)
class Scaling:
    """The factor that makes a motion as fast as its limits allow.

    Attributes
    ----------
    k : float
        The new time is k times the old: more than 1 slows down, less speeds up.
    joint : int
        The joint (1-based) that meets its limit then.
    quantity : str
        ``"velocity"``, ``"acceleration"`` or ``"jerk"``.
    """

    k: float
    joint: int
    quantity: str

    @property
    def explanation(self) -> str:
        """Sentence on which limit determines the factor."""
        change = "slower" if self.k > 1.0 else "faster" if self.k < 1.0 else "as fast"
        return f"{change}: k = {self.k:.4g}, and joint {self.joint} meets its limit of {self.quantity}"


def optimal_scaling(
    limits: Limits, velocity: ArrayLike, acceleration: ArrayLike = 0.0, jerk: ArrayLike = 0.0
) -> Scaling:
    """Return the k at which one limit is met and none exceeded.

    Parameters
    ----------
    limits : Limits
    velocity, acceleration, jerk : array_like, shape (m,) or ()
        Largest absolute values of each joint.

    Raises
    ------
    InputError
        Limits of another number of joints, or nothing that holds the motion back.

    References
    ----------
    Notes 6.161-6.163, with the cube root for the jerk.

    Examples
    --------
    >>> limits = Limits(velocity=2.0, acceleration=8.0)
    >>> optimal_scaling(limits, [3.75, 1.875], [11.547, 5.774]).k
    1.875
    """
    peak = np.broadcast_arrays(*(np.atleast_1d(np.asarray(each, float)) for each in (velocity, acceleration, jerk)))
    high = limits.for_joints(len(peak[0])).each
    table = np.array([(p / h) ** (1.0 / order) for order, (p, h) in enumerate(zip(peak, high, strict=True), start=1)])
    kind, joint = np.unravel_index(int(np.argmax(table)), table.shape)
    if table[kind, joint] == 0.0:
        raise InputError("limits: none of them holds this motion back")
    return Scaling(float(table[kind, joint]), int(joint) + 1, NAMES[kind])


def scaled(motion: Motion, k: float) -> Motion:
    """Return the motion slowed down by k on the same path. A trajectory remains one, with its law stretched."""
    if isinstance(motion, Trajectory):
        return Trajectory(motion.path, motion.law.stretched(k))
    return Slowed(motion, k)


def as_fast_as_allowed(
    motion: Motion, limits: Limits | Arm, *, jumps: bool = False, moving: Moving = AT_REST
) -> tuple[Motion, Scaling]:
    """Return the motion at its uniform scaling that meets one limit, and the scaling.

    Parameters
    ----------
    motion : Motion
    limits : Limits or Arm
        An arm stands for its own limits.
    jumps : bool
        Where a velocity jumps no limit of acceleration can be kept at any speed, and where an acceleration jumps none
        of jerk, which is refused. True: it is let through; accelerations then count between the jumps only, and the
        jerk of a joint whose acceleration jumps not at all.
    moving : (bool, bool)
        Whether the motion begins and ends with a speed; what jumps at such an end does not count.

    Raises
    ------
    InputError
        Nothing that holds the motion back, or a limit that cannot be kept.
    """
    held = limits_of(limits, motion.m)
    if not jumps:
        refuse_jumps(motion, held, moving)
    jerk = _smooth_jerks(motion, moving) if held.bounded[2] else 0.0
    scaling = optimal_scaling(held, peaks(motion, 1).peak, peaks(motion, 2).peak, jerk)
    return scaled(motion, scaling.k), scaling


def refuse_jumps(motion: Motion, limits: Limits, moving: Moving = AT_REST) -> None:
    """Raise `InputError` where a jump prevents a limit of the next derivative from being kept at any speed."""
    for order, what in ((1, "velocity"), (2, "acceleration")):
        for joint, time in _jumps(motion, order, moving):
            for name, values in zip(NAMES[order:], limits.each[order:], strict=True):
                if np.isfinite(values[joint - 1]):
                    raise InputError(
                        f"limit of {name}: the {what} of joint {joint} jumps at {time:.4g} s, so no time keeps it"
                    )


def _smooth_jerks(motion: Motion, moving: Moving) -> Floats:
    """Return the largest jerk of each joint, (m,); 0 for those whose velocity or acceleration jumps."""
    found = np.array(peaks(motion, 3).peak)
    found[[joint - 1 for order in (1, 2) for joint, _ in _jumps(motion, order, moving)]] = 0.0
    return found


def _jumps(motion: Motion, order: int, moving: Moving) -> list[tuple[int, float]]:
    """Return the joints (from 1) of which a derivative jumps, and when, without the ends at which it moves."""
    free = {time for time, moves in zip((0.0, motion.duration), moving, strict=True) if moves}
    return [(joint, time) for joint, time in motion.jumps(order) if time not in free]
