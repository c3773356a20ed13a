"""The record of a simulation: arrays over time, and how it ended."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm

Floats = NDArray[np.float64]

WITHIN = 1e-9
"""Distance beyond its limit, rad or m, at which a joint still counts as within."""


@dataclass(frozen=True, eq=False)
class Run:
    """An arm under a control law, at N + 1 instants.

    Attributes
    ----------
    arm : Arm
        The true arm, not the one the controller knows.
    t : ndarray, shape (N + 1,)
        Seconds, from 0 on.
    q : ndarray, shape (N + 1, n)
        rad or m; joint limits are not kept.
    qdot, qdot_wanted : ndarray, shape (N + 1, n)
        Joint speeds as they are, and as the law wants them: they differ where the motors saturate.
    p, p_wanted : ndarray, shape (N + 1, 3)
        The tool point and its reference, world, metres.
    error : ndarray, shape (N + 1, m)
        Wanted minus present task, in metres and radians, axes of frame 0.
    error_position, error_rotation : ndarray, shape (N + 1,)
        Norms of the parts of the error, metres and radians.
    error_joint : ndarray, shape (N + 1, n), or None
        q_d - q, where the law has a q_d.
    sigma_min : ndarray, shape (N + 1,)
        Smallest singular value of the scaled task Jacobian of the arm.
    damping : ndarray, shape (N + 1,)
    saturated : ndarray of bool, shape (N + 1,)
        Instants at which the motors could not follow the command.
    step : float
        Seconds.
    stopped : str
        Why it ended before its time; empty when it did not.
    pushed : tuple of float
        Times of the pushes that fell into it.
    sigma_unit : str
        Unit of sigma_min: ``"m"`` or none.
    """

    arm: Arm
    t: Floats
    q: Floats
    qdot: Floats
    qdot_wanted: Floats
    p: Floats
    p_wanted: Floats
    error: Floats
    error_position: Floats
    error_rotation: Floats
    error_joint: Floats | None
    sigma_min: Floats
    damping: Floats
    saturated: NDArray[np.bool_]
    step: float
    stopped: str = ""
    pushed: tuple[float, ...] = ()
    sigma_unit: str = ""

    @property
    def finished(self) -> bool:
        """Whether the simulation ran to its end."""
        return not self.stopped

    @property
    def duration(self) -> float:
        """Duration of what was simulated, seconds."""
        return float(self.t[-1])

    @property
    def steps(self) -> int:
        """Number of steps."""
        return len(self.t) - 1

    @cached_property
    def peak_speeds(self) -> Floats:
        """Largest magnitude of the speed of each joint, (n,), rad/s or m/s."""
        return np.asarray(np.abs(self.qdot).max(axis=0))

    @cached_property
    def peak_times(self) -> Floats:
        """Times at which each joint has its largest speed, (n,), seconds."""
        return np.asarray(self.t[np.abs(self.qdot).argmax(axis=0)])

    def left_range(self) -> tuple[int, float] | None:
        """Return which joint is first beyond its limits, as a place in q from 0, and when, seconds; None for none.

        A turning joint is within its limits where it is so but for whole turns.
        """
        low, high = self.arm.limits.T
        turns = np.where(self.arm.revolute, 2.0 * np.pi, np.inf)
        whole = np.where(self.arm.revolute, np.ceil((low - WITHIN - self.q) / turns), 0.0)
        least = self.q + np.where(self.arm.revolute, 2.0 * np.pi, 0.0) * whole
        beyond = (least > high + WITHIN) | (least < low - WITHIN)
        if not beyond.any():
            return None
        k = int(np.argmax(beyond.any(axis=1)))
        return int(np.argmax(beyond[k])), float(self.t[k])

    @property
    def saturated_time(self) -> float:
        """Time in seconds during which the motors could not follow the command."""
        return float(np.count_nonzero(self.saturated[:-1]) * self.step)

    def at(self, time: float) -> Floats:
        """Return the joint values at a time, (n,), linear between instants and constant before and after the run."""
        i = min(max(int(np.searchsorted(self.t, time, side="right")) - 1, 0), self.steps)
        if i == self.steps or time <= self.t[i]:
            return np.array(self.q[i])
        share = (time - self.t[i]) / (self.t[i + 1] - self.t[i])
        return np.asarray(self.q[i] + share * (self.q[i + 1] - self.q[i]))

    def index(self, time: float) -> int:
        """Return the index of the instant nearest to a time."""
        i = min(int(np.searchsorted(self.t, time)), self.steps)
        return i - 1 if i > 0 and time - self.t[i - 1] < self.t[i] - time else i

    def thinned(self, most: int) -> Run:
        """Return the run with about ``most`` of its instants, for drawing; both ends and every extreme are kept."""
        if len(self.t) <= most:
            return self
        extremes = [np.abs(self.qdot).argmax(axis=0), np.abs(self.qdot_wanted).argmax(axis=0)]
        extremes += [[int(np.argmax(each))] for each in (self.error_position, self.error_rotation, self.damping)]
        extremes += [[int(np.argmin(self.sigma_min))], [self.index(time) for time in self.pushed]]
        even = np.linspace(0, self.steps, most).round()
        pick = np.unique(np.concatenate([even, *extremes]).astype(int))
        names = [each.name for each in fields(self) if len(np.shape(getattr(self, each.name))) > 0]
        series = {name: getattr(self, name)[pick] for name in names if name != "pushed"}
        return replace(self, **series)
