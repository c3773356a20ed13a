"""What a configuration is worth for a target, in numbers and in a sentence: derived, never remembered."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from armlab.kin.arm import Arm
from armlab.kin.ik.problem import TaskError

REACHED_M = 1e-6
REACHED_RAD = 1e-6
"""Within these a target counts as reached: far below anything a picture or a classroom robot resolves."""

PUSH = 1e-6
"""Scaled slope of the error above which a joint at its limit is said to push against it."""

REST = 1e-3
"""Slope, relative to the scaled error, below which a configuration counts as the closest: near a boundary the error is
flat, and a descent stops when a step gains less than a billionth."""

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
        0-based joints at a limit that the error pushes outwards.
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
            "beyond": "out of reach: farther than all links in a line",
            "closest": "closest possible from here",
            "moving": "not there yet",
        }[self.status]


def judge(arm: Arm, T: ArrayLike, q: ArrayLike, locked: Sequence[bool] | None = None) -> Verdict:
    """Say how a configuration stands to a target.

    Parameters
    ----------
    arm : Arm
    T : array_like, shape (4, 4)
        Target in the world.
    q : array_like, shape (n,)
    locked : sequence of bool, optional
        Joints that may not move.
    """
    pose, values = np.asarray(T, dtype=float), np.asarray(q, dtype=float)
    free = free_joints(locked) or [1.0] * arm.n
    task = task_error_of(arm)
    slope, errors = task.slope(values.tolist(), task.target(pose), free)
    if errors.position < REACHED_M and errors.rotation < REACHED_RAD and arm.within_limits(values):
        return Verdict("reached", errors.position, errors.rotation, ())
    low, high = arm.limits[:, 0] + 1e-9, arm.limits[:, 1] - 1e-9
    pushing = ((values <= low) & (slope < -PUSH)) | ((values >= high) & (slope > PUSH))
    limits = tuple(int(i) for i in np.flatnonzero(pushing))
    at_rest = bool(np.all(np.abs(slope[~pushing]) < REST * max(1.0, math.sqrt(errors.cost))))
    status: Status = "moving"
    if at_rest:
        distance = float(np.linalg.norm(pose[:3, 3] - arm.base[:3, 3]))
        far = bool(arm.task.position) and distance > arm.reach
        status = "beyond" if far else "limit" if limits else "closest"
    return Verdict(status, errors.position, errors.rotation, limits)


def free_joints(locked: Sequence[bool] | None) -> list[float] | None:
    """Return 1 for joints that may move and 0 for locked ones; None when none is locked."""
    return [0.0 if held else 1.0 for held in locked] if locked is not None and any(locked) else None


@lru_cache(maxsize=64)
def task_error_of(arm: Arm) -> TaskError:
    """Return the compiled task error of an arm (arms are compared by identity)."""
    return TaskError(arm)
