"""The controller of a simulated arm: the arm as it knows it, and joint speeds for a task velocity."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.kin.control.null_term import self_motion
from armlab.kin.control.rate_inverse import RateInverse
from armlab.kin.control.scaled_task import ScaledTask

Floats = NDArray[np.float64]


class Aim(NamedTuple):
    """A reference at one instant.

    Attributes
    ----------
    pose, twist : ndarray, shapes (4, 4) and (6,)
        Wanted pose and twist of the tool, in the world.
    q, qdot : ndarray, shape (n,)
        Wanted joint values and rates; only where the law asks for them.
    next_pose : ndarray, shape (4, 4)
        Wanted pose at the next command, or at the end where that is earlier.
    ahead : float
        Seconds until then; at the end itself those of a whole period.
    """

    pose: Floats
    twist: Floats
    q: Floats
    qdot: Floats
    next_pose: Floats
    ahead: float


class Told(NamedTuple):
    """The command of a control law.

    Attributes
    ----------
    qdot : ndarray, shape (n,), or None
        rad/s or m/s; None where the law has no answer.
    damping : float
        Damping, as in `RateStep`.
    says : str
        Why there is no answer.
    """

    qdot: Floats | None
    damping: float = 0.0
    says: str = ""


class Controller:
    """The quantities and functions that a control law uses.

    Parameters
    ----------
    task : ScaledTask
        The task of the arm as the controller knows it.
    method : RateInverse
    options : mapping
        Options of the method, complete and checked.
    wish : str
        Key of the null-space term.
    gain : float
        Its gain, 1/s.

    Attributes
    ----------
    task : ScaledTask
    """

    def __init__(
        self, task: ScaledTask, method: RateInverse, options: Mapping[str, Any], wish: str, gain: float
    ) -> None:
        self.task = task
        self._speeds, self._options = method.speeds, options
        self._wish, self._gain = wish, gain

    def realise(self, q: Floats, R: Floats, v: Floats, free: bool = True) -> Told:
        """Return joint speeds for a task velocity, or joint changes for a task error.

        Parameters
        ----------
        q : ndarray, shape (n,)
            Measured joint values.
        R : ndarray, shape (3, 3)
            Orientation of the tool there; see `ScaledTask.orientation`.
        v : ndarray, shape (m,)
            m/s and rad/s.
        free : bool
            Whether the null-space term is added, a speed.
        """
        task = self.task
        J = task.scaled(task.jacobian(q, R))
        step = self._speeds(J, v * task.row_units, self._options)
        if step.qdot is None:
            return Told(None, step.damping, step.says)
        speeds = step.qdot
        if free and self._wish != "none":
            speeds = speeds + self._gain * self_motion(self._wish, task, q, J)
        return Told(task.speeds(speeds), step.damping)
