"""One arm, one target and one task vector: error, Jacobian and singular values, for many configurations at once.

Metres and radians are never added. Where components or free joints of both kinds meet, lengths are divided by the
arm's length scale (half its reach), so that every component of error, Jacobian and step is a pure number; where only
one kind occurs, as for the position of an arm that only turns, everything stays in metres and radians as it is, and
the iterates are those of a calculation by hand. Angles count by theta, whose half square has J^T e as its exact slope.
(`armlab.kin.ik.problem` is the compiled counterpart behind a drag: there lengths are always divided and angles count by
2 sin(theta/2), so that records of its descents are made with ``scaled`` and ``chord``.)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.iterate.misfit import (
    analytic_rows,
    approach_error,
    euler_error,
    euler_rates,
    rotation_vector,
    turn_about_z,
)
from armlab.kin.ik.iterate.task_vector import TaskVector, wrapped_angle
from armlab.kin.transforms import inverse

Floats = NDArray[np.float64]

SINGULAR = 1e-12
"""Smallest singular value, relative to the largest, at which a matrix counts as having no inverse."""

FEW = 24
"""Largest number of configurations for which scalar formulas, one by one, are faster than those for arrays."""


class Misfit(NamedTuple):
    """Errors of configurations with respect to the target, one array for each kind.

    Attributes
    ----------
    components : ndarray, shape (B, m)
        Wanted minus present value, m and rad.
    position, rotation : ndarray, shape (B,)
        Distance in metres and angle in radians, of what the task controls.
    """

    components: Floats
    position: Floats
    rotation: Floats


class Point(NamedTuple):
    """The task at configurations, as a method sees it: scaled and weighted, locked joints left out.

    Attributes
    ----------
    q : ndarray, shape (B, n)
        rad or m.
    e, J : ndarray, shapes (B, m) and (B, m, k)
        Error and Jacobian of the k free joints.
    U, sigma, Vt : ndarray, shapes (B, m, r), (B, r), (B, r, k)
        Singular value decomposition of J, sigma descending, r = min(m, k).
    misfit : Misfit
    represented : ndarray of bool, shape (B,)
        False where Euler angles are singular: J is then not that of the task.
    """

    q: Floats
    e: Floats
    J: Floats
    U: Floats
    sigma: Floats
    Vt: Floats
    misfit: Misfit
    represented: NDArray[np.bool_]

    @property
    def slope(self) -> Floats:
        """J^T e (B, k): the rate at which half the squared error falls with each free joint."""
        return np.asarray(np.einsum("bmk,bm->bk", self.J, self.e))

    @property
    def sigma_max(self) -> Floats:
        """The largest singular values (B,); 0 when there is none."""
        return self.sigma[:, 0] if self.sigma.shape[1] else np.zeros(len(self.q))

    @property
    def sigma_min(self) -> Floats:
        """The smallest of the min(m, k) singular values (B,)."""
        return self.sigma[:, -1] if self.sigma.shape[1] else np.zeros(len(self.q))

    @property
    def w(self) -> Floats:
        """The product of the singular values (B,); 0 when there is none."""
        return np.asarray(np.prod(self.sigma, axis=-1)) if self.sigma.shape[1] else np.zeros(len(self.q))

    @property
    def singular(self) -> NDArray[np.bool_]:
        """Where J has lost rank, (B,)."""
        return np.asarray(self.sigma_min <= SINGULAR * self.sigma_max)

    def take(self, rows: NDArray[np.intp]) -> Point:
        """Return the points of the given rows."""
        misfit = Misfit(*(part[rows] for part in self.misfit))
        q, e, J, U, sigma, Vt = (part[rows] for part in self[:6])
        return Point(q, e, J, U, sigma, Vt, misfit, self.represented[rows])


def joined(points: Sequence[Point]) -> Point:
    """Return several points, in order, as one."""
    misfit = Misfit(*(np.concatenate(parts) for parts in zip(*(one.misfit for one in points), strict=True)))
    q, e, J, U, sigma, Vt = (np.concatenate(parts) for parts in zip(*(one[:6] for one in points), strict=True))
    return Point(q, e, J, U, sigma, Vt, misfit, np.concatenate([one.represented for one in points]))


class Problem:
    """An inverse-kinematics problem for methods that take steps.

    Parameters
    ----------
    arm : Arm
    T : ndarray, shape (4, 4)
        Checked target pose in the world.
    vector : TaskVector
    free : sequence of int
        0-based joints that may move.
    weights : array_like, shape (m,), optional
        Positive factors of the components of the scaled error, one for all components of a rotation vector; 1 when left
        out.
    clamp : bool
        Whether steps end at the joint limits.
    chord : bool
        Whether `cost` measures angles by their chord 2 sin(theta/2) instead of theta.
    scaled : bool
        Whether lengths are divided by the length scale in any case.

    Attributes
    ----------
    length : float
        Metres that count as 1: 1, or the arm's length scale where metres and radians meet.
    mixed : bool
        Whether they meet, or lengths are divided in any case.
    """

    def __init__(
        self,
        arm: Arm,
        T: NDArray[np.float64],
        vector: TaskVector,
        free: Sequence[int],
        weights: ArrayLike | None = None,
        clamp: bool = True,
        chord: bool = False,
        scaled: bool = False,
    ) -> None:
        self.arm, self.vector, self.clamp, self.chord = arm, vector, clamp, chord
        self.free = np.array(free, dtype=np.intp)
        self.to_frame_0 = np.asarray(inverse(arm.base), dtype=np.float64)
        self.target = self.to_frame_0 @ T
        kinds = vector.kinds(arm)
        joint_kinds = {bool(arm.revolute[i]) for i in free}
        self.mixed = scaled or len(set(kinds)) > 1 or len(joint_kinds) > 1
        self.length = arm.length_scale if self.mixed else 1.0
        self.units = np.where(arm.revolute, 1.0, self.length)[self.free]
        given = np.ones(vector.m) if weights is None else vector.factors(weights, "weights")
        self.row_units = given / np.where(np.array(kinds) == "m", self.length, 1.0)
        self.angles = np.array(kinds) == "rad"
        self.kinds = kinds
        bounds = arm.limits if clamp else np.tile([-np.inf, np.inf], (arm.n, 1))
        self.low, self.high = bounds[:, 0], bounds[:, 1]

    @property
    def sigma_unit(self) -> str:
        """Unit of singular values: ``"m"`` for a position task of revolute joints in metres, else empty."""
        return "m" if not self.mixed and "m" in self.kinds and bool(self.arm.revolute[self.free].any()) else ""

    @property
    def beyond(self) -> bool:
        """Whether the wanted coordinates alone are farther from frame 0 than the sum of all lengths.

        Slides have no greatest length where limits are not kept: then nothing is known of an arm that has some.
        """
        if not self.clamp and not bool(self.arm.revolute[self.free].all()):
            return False
        return math.hypot(*self.target[self.vector.task.coordinates, 3]) > self.arm.reach * (1.0 + 1e-12)

    def at(self, q: Floats) -> Point:
        """Return the task at configurations (B, n).

        A value too large for a number is infinite, without a warning: such an iteration has diverged.
        """
        with np.errstate(all="ignore"):
            return self._at(q)

    def _at(self, q: Floats) -> Point:
        tool = self._tool(q)
        misfit, angles = self._misfit(q, tool)
        J, represented = self._jacobian(q, tool, angles)
        J = J[:, :, self.free] * self.row_units[:, None] * self.units
        k = len(self.free)
        if not np.isfinite(J).all():
            # An overflow of weights or lengths: such a row has no singular values, and its error says that it diverged.
            J = np.where(np.isfinite(J).all(axis=(1, 2), keepdims=True), J, 0.0)
        if k:
            U, sigma, Vt = np.linalg.svd(J, full_matrices=False)
        else:
            U, sigma, Vt = np.zeros((len(q), self.vector.m, 0)), np.zeros((len(q), 0)), np.zeros((len(q), 0, 0))
        return Point(q, misfit.components * self.row_units, J, U, sigma, Vt, misfit, represented)

    def error(self, q: Floats) -> Floats:
        """Return the scaled and weighted error (B, m) at configurations (B, n)."""
        return self._misfit(q, self._tool(q))[0].components * self.row_units

    def half_square(self, e: Floats) -> Floats:
        """Return the cost (B,) of scaled errors (B, m): half their square, with angles by theta or by their chord."""
        if self.chord:
            turns = e / self.row_units
            theta = np.abs(turns)
            if self.vector.euler is None:
                own = slice(len(self.vector.task.position), self.vector.task.m)
                theta[..., own] = np.linalg.norm(turns[..., own], axis=-1, keepdims=True)
            # The rotation vector shortened from theta to 2 sin(theta/2); np.sinc(x) is sin(pi x) / (pi x).
            e = np.where(self.angles, e * np.sinc(theta / (2.0 * math.pi)), e)
        return np.asarray(0.5 * np.einsum("...m,...m->...", e, e))

    def cost(self, q: Floats) -> Floats:
        """Return the cost (B,) at configurations (B, n)."""
        return self.half_square(self.error(q))

    def manipulability(self, q: Floats) -> Floats:
        """Return w (B,) at configurations (B, n)."""
        return self.at(q).w

    def land(self, q: Floats, dq: Floats) -> Floats:
        """Return the ends of steps (B, k) in scaled free joints from (B, n), inside the limits when these are kept."""
        after = q.copy()
        after[:, self.free] = np.clip(q[:, self.free] + dq * self.units, self.low[self.free], self.high[self.free])
        return after

    def travelled(self, before: Floats, after: Floats) -> Floats:
        """Return the steps (B, k) in scaled free joints between configurations (B, n)."""
        return np.asarray((after - before)[:, self.free] / self.units)

    def _tool(self, q: Floats) -> Floats:
        """Return the tool poses in frame 0, (B, 4, 4)."""
        return np.asarray(self.to_frame_0 @ _evaluated(self.arm.fk, q), dtype=np.float64)

    def _misfit(self, q: Floats, tool: Floats) -> tuple[Misfit, Floats | None]:
        """Return the misfit, and the Euler angles (B, 3) when the error is in these."""
        task, R, wanted = self.vector.task, tool[:, :3, :3], self.target[:3, :3]
        far = (self.target[:3, 3] - tool[:, :3, 3])[:, task.coordinates]
        turn, angles = np.zeros((len(q), 0)), None
        if task.rotation == "phi":
            turn = turn_about_z(wanted @ np.swapaxes(R, -1, -2))[:, None]
        elif task.rotation == "approach":
            turn = approach_error(R, np.broadcast_to(wanted, R.shape))
        elif task.rotation == "full":
            turn = rotation_vector(wanted @ np.swapaxes(R, -1, -2))
        rotation = np.linalg.norm(turn, axis=-1)
        if self.vector.euler is not None:
            turn, angles = euler_error(R, np.broadcast_to(wanted, R.shape), self.vector.euler, self.vector.fixed)
        own = [self._joint_error(q, joint - 1, value) for joint, value in self.vector.joints]
        components = np.concatenate([far, turn, *own], axis=-1)
        return Misfit(components, np.linalg.norm(far, axis=-1), rotation), angles

    def _joint_error(self, q: Floats, joint: int, value: float) -> Floats:
        difference = value - q[:, [joint]]
        return wrapped_angle(difference) if self.arm.revolute[joint] else difference

    def _jacobian(self, q: Floats, tool: Floats, angles: Floats | None) -> tuple[Floats, NDArray[np.bool_]]:
        """Return the task Jacobian (B, m, n) in natural units, and where its representation is regular."""
        task, B = self.vector.task, len(q)
        whole = _evaluated(self.arm.jacobian, q)
        turn_back = self.arm.base[:3, :3].T
        linear, omega = turn_back @ whole[:, :3], turn_back @ whole[:, 3:]
        rows, represented = [linear[:, task.coordinates]], np.ones(B, dtype=np.bool_)
        if task.rotation == "phi":
            rows.append(omega[:, 2:])
        elif task.rotation == "approach":
            rows.append(np.swapaxes(tool[:, :3, :2], -1, -2) @ omega)
        elif angles is not None and self.vector.euler is not None:
            turned, represented = analytic_rows(euler_rates(angles, self.vector.euler, self.vector.fixed), omega)
            rows.append(turned)
        elif task.rotation == "full":
            rows.append(omega)
        rows += [
            np.broadcast_to(np.eye(self.arm.n)[[joint - 1]], (B, 1, self.arm.n)) for joint, _ in self.vector.joints
        ]
        return np.concatenate(rows, axis=1), represented


def _evaluated(formula: Callable[[Floats], NDArray[np.floating]], q: Floats) -> NDArray[np.floating]:
    """Return a formula of the arm at configurations (B, n), one by one where that is faster."""
    if 0 < len(q) <= FEW and np.isfinite(q).all():
        return np.array([formula(row) for row in q])
    return formula(q)
