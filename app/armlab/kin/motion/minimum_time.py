"""The intervals of a spline that make it as fast as bounds on velocity and acceleration allow."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.motion.knots import checked_knots
from armlab.kin.motion.law_types import law_type
from armlab.kin.motion.limits import Limits, limits_of
from armlab.kin.motion.path import Path
from armlab.kin.motion.path_types import path_type
from armlab.kin.motion.scaling import as_fast_as_allowed
from armlab.kin.motion.trajectory import Trajectory

Floats = NDArray[np.float64]

MOST_KNOTS = 40
"""Largest number of waypoints for which intervals are optimised: each costs one spline per step."""

STEPS = 80
"""Largest number of steps of sequential quadratic programming."""

SHORTEST = 1e-3
"""Shortest interval, relative to the mean."""

INSIDE = np.array([0.25, 0.5, 0.75])
"""Fractions of an interval at which the velocity is examined besides its ends while optimising; the result is then
scaled by the exact peaks."""


@dataclass(frozen=True, eq=False)
class MinimumTime:
    """A spline with optimised intervals, and the same knots with intervals by distance for comparison.

    Attributes
    ----------
    trajectory : Trajectory
        The trajectory with constant s', so that the time of its path is time; one limit is met, none is exceeded.
    intervals : ndarray, shape (N-1,)
        h_k, seconds.
    by_distance : float
        Seconds of the spline with intervals in proportion to distance, as fast as allowed.
    """

    trajectory: Trajectory
    intervals: Floats
    by_distance: float

    @property
    def duration(self) -> float:
        """The sum of the intervals, seconds."""
        return self.trajectory.duration


def minimum_time_spline(knots: ArrayLike, limits: Limits | Arm, **ends: Any) -> MinimumTime:
    """Return the spline through waypoints whose intervals take the least time.

    Parameters
    ----------
    knots : array_like, shape (N, m)
        2 to `MOST_KNOTS`.
    limits : Limits or Arm
        Finite ones of velocity and acceleration; an arm stands for its own.
    **ends
        Options of the spline that are zero or choices (``ends="natural"``): rest to rest when left out.

    Raises
    ------
    InputError
        Wrong waypoints (the text names one) or limits; an end velocity that is not zero, which scaling would change.

    Notes
    -----
    A local optimum by sequential quadratic programming, from the best of three simple choices of intervals, and scaled
    exactly. The same call gives the same answer.

    References
    ----------
    Notes, properties of splines in section 6.2.2: "the time intervals h_k can be chosen to minimize T under some
    bounds".
    """
    points = checked_knots(knots, "a spline of least time", 2, MOST_KNOTS, True)
    m = points.shape[1]
    held = limits_of(limits, m)
    v, a = held.velocity, held.acceleration
    if not (np.isfinite(v).all() and np.isfinite(a).all()):
        raise InputError("limits: expected finite ones of velocity and acceleration, for all joints")
    if held.bounded[2]:
        raise InputError("limit of jerk: the acceleration of a spline jumps at its ends, so no time keeps it")
    for key in ("v_start", "v_end", "a_start", "a_end"):
        if ends.get(key) is not None and np.any(np.asarray(ends[key], dtype=float)):
            raise InputError(f"{key}: expected zero, as the time is not known beforehand")
    way = np.abs(np.diff(points, axis=0))
    starts = [np.linalg.norm(way, axis=1), np.maximum((way / v).max(axis=1), np.sqrt(way / a).max(axis=1))]
    starts.append(np.ones(len(way)))
    at_once = [_fastest(points, h, v, a, ends) for h in starts]
    best = min(at_once, key=lambda trajectory: trajectory.duration)
    if len(way) > 1:
        better = _fastest(points, _optimised(points, _intervals(best), v, a, ends), v, a, ends)
        best = min(best, better, key=lambda trajectory: trajectory.duration)
    return MinimumTime(best, _intervals(best), at_once[0].duration)


def _intervals(trajectory: Trajectory) -> Floats:
    """Return h_k between waypoints (virtual knots removed), in the time of the trajectory."""
    path: Any = trajectory.path
    inner = np.delete(path.curve.knots, [k - 1 for k in path.virtual])
    return np.diff(inner) * trajectory.duration


def _spline(points: Floats, h: Floats, ends: dict[str, Any]) -> Path:
    return path_type("spline").path(points, times=np.concatenate([[0.0], np.cumsum(h)]), **ends)


def _fastest(points: Floats, h: Floats, v: Floats, a: Floats, ends: dict[str, Any]) -> Trajectory:
    path = _spline(points, h, ends)
    at_first = Trajectory(path, law_type("constant").law(float(np.sum(h))))
    # With natural ends it begins and ends with a speed.
    found, _ = as_fast_as_allowed(at_first, Limits(v, a), jumps=True)
    if not isinstance(found, Trajectory):
        raise TypeError("scaling a trajectory gives a trajectory")
    return found


def _optimised(points: Floats, h: Floats, v: Floats, a: Floats, ends: dict[str, Any]) -> Floats:
    # Only here: a fifth of a second at the start of the lab.
    from scipy.optimize import minimize  # type: ignore[import-untyped]

    unit = float(np.mean(h))

    def room(shares: Floats) -> Floats:
        """Return the relative margin to each limit: of velocities in each interval, of accelerations at knots."""
        curve: Any = _spline(points, shares * unit, ends)
        cubics = curve.in_time
        lengths = np.diff(cubics.knots)
        at = np.concatenate([cubics.knots, (cubics.knots[:-1, None] + lengths[:, None] * INSIDE).ravel()])
        (speed,) = cubics.at(at, (1,))
        (bend,) = cubics.at(cubics.knots, (2,))
        left = [1.0 - speed / v, 1.0 + speed / v, 1.0 - bend / a, 1.0 + bend / a]
        return np.concatenate([each.ravel() for each in left])

    found = minimize(
        lambda shares: float(shares.sum()),
        h / unit,
        jac=lambda shares: np.ones_like(shares),
        bounds=[(SHORTEST, None)] * len(h),
        constraints=[{"type": "ineq", "fun": room}],
        method="SLSQP",
        options={"maxiter": STEPS, "ftol": 1e-8},
    )
    return np.asarray(np.maximum(found.x, SHORTEST) * unit)
