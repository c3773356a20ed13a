"""The verdict on a configuration for a target, in numbers and in a sentence; it is computed anew, never stored."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.arm import Arm
from armlab.kin.checks import finite_floats, wrong
from armlab.kin.ik.closest import closest_of
from armlab.kin.ik.problem import TaskError
from armlab.kin.ik.rest import is_flat, pushing, way_down
from armlab.kin.ik.weights import Weights, checked_weights
from armlab.kin.transforms import as_pose

Status = Literal["reached", "limit", "beyond", "closest", "moving"]


@dataclass(frozen=True)
class Verdict:
    """The state of a configuration with respect to a target.

    Attributes
    ----------
    status : str
        ``"reached"``; ``"limit"``: at rest against joint limits; ``"beyond"``: farther away than all links in a line;
        ``"closest"``: no small move comes closer; ``"moving"``: a small move would.
    position_error, rotation_error : float
        Metres and radians, in the components the task controls.
    limits : tuple of int
        Places in q, from 0, of joints at a limit that the error pushes outwards; `reason` has their numbers, from 1.
    """

    status: Status
    position_error: float
    rotation_error: float
    limits: tuple[int, ...]

    @property
    def reached(self) -> bool:
        """Whether the target is reached."""
        return self.status == "reached"

    @property
    def reason(self) -> str:
        """The status in words, without numbers."""
        if self.status == "limit":
            joints = " and ".join(str(i + 1) for i in self.limits)
            return f"limit on joint{'s' if len(self.limits) > 1 else ''} {joints}"
        return {
            "reached": "reached",
            "beyond": "out of reach: farther than the fully stretched arm",
            "closest": "closest possible from here",
            "moving": "not there yet",
        }[self.status]


def judge(
    arm: Arm,
    T: ArrayLike,
    q: ArrayLike,
    locked: Sequence[bool] | None = None,
    weights: ArrayLike | None = None,
) -> Verdict:
    """Return the verdict on a configuration for a target.

    Parameters
    ----------
    arm : Arm
    T : array_like, shape (4, 4)
        Target in the world.
    q : array_like, shape (n,)
    locked : sequence of bool, optional
        Joints that may not move.
    weights : array_like, shape (m,), optional
        Weights of the task components, which define the closest configuration; see `armlab.kin.ik.solve.solve`.

    Raises
    ------
    InputError
        ``T`` is no pose, or shapes or numbers are wrong.
    """
    pose, values = as_pose(T, "T"), joint_values(arm, q, "q")
    free = free_joints(checked_locks(arm, locked)) or [1.0] * arm.n
    factors = checked_weights(arm, weights)
    task = task_error_of(arm, factors)
    target = task.target(pose)
    slope, errors = task.slope(values.tolist(), target, free)
    if errors.reached and arm.within_limits(values):
        return Verdict("reached", errors.position, errors.rotation, ())
    low, high = arm.limits.T
    pushed = pushing(values, slope, low, high)
    limits = tuple(int(i) for i in np.flatnonzero(pushed))
    status: Status = "moving"
    closest = closest_of(arm, factors)
    if is_flat(slope, pushed, errors) and way_down(closest, values, target, free, low, high) is None:
        status = "beyond" if _is_beyond(arm, target) else "limit" if limits else "closest"
    return Verdict(status, errors.position, errors.rotation, limits)


def _is_beyond(arm: Arm, target: Sequence[float]) -> bool:
    """Return whether the controlled coordinates alone are farther away than the sum of all lengths."""
    return math.hypot(*(target[4 * k + 3] for k in arm.task.coordinates)) > arm.reach


def joint_values(arm: Arm, q: ArrayLike, where: str) -> NDArray[np.float64]:
    """Return checked joint values (n,); `InputError` when they are not n finite numbers."""
    return finite_floats(q, where, (arm.n,), f"{arm.n} finite numbers")


def checked_locks(arm: Arm, locked: Sequence[bool] | None) -> list[bool] | None:
    """Return which joints are locked, one entry for each; `InputError` when the number of entries is wrong."""
    if locked is None:
        return None
    if not isinstance(locked, (Sequence, np.ndarray)) or len(locked) != arm.n:
        raise wrong("locked", f"{arm.n} times True or False", locked)
    return [bool(held) for held in locked]


def free_joints(locked: Sequence[bool] | None) -> list[float] | None:
    """Return 1 for joints that may move and 0 for locked ones; None when all may move."""
    return [0.0 if held else 1.0 for held in locked] if locked is not None and any(locked) else None


def task_error_of(arm: Arm, weights: Weights | None = None) -> TaskError:
    """Return the compiled task error of an arm (arms are compared by identity)."""
    return _task_error_of(arm, weights)


@lru_cache(maxsize=64)
def _task_error_of(arm: Arm, weights: Weights | None) -> TaskError:
    return TaskError(arm, weights)
