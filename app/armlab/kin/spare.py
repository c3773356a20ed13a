"""The spare joints of a task, and the arms that are left when as many of them are held."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, islice, pairwise

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.dh import Row
from armlab.kin.lines import CommonNormal, Line, common_normal

SAMPLES = 8
"""Number of random configurations, with a fixed seed, that represent the generic one."""

RANK_TOLERANCE = 1e-9
"""Singular value of the task Jacobian, with lengths in length scales, below which it counts as zero."""

MOST_SETS = 28
"""Largest number of sets of joints that are tried."""

NEARLY = 1e-6
"""Sine of an angle, or length in length scales, above which axes are certainly not parallel or do not meet."""


@dataclass(frozen=True, eq=False)
class Spare:
    """The spare joints of a task.

    Attributes
    ----------
    arm : Arm
    samples : ndarray, shape (SAMPLES, n)
        Configurations.
    jacobians : ndarray, shape (SAMPLES, m, n)
        Task Jacobians, in the axes of frame 0, lengths over the length scale.
    """

    arm: Arm
    samples: NDArray[np.float64]
    jacobians: NDArray[np.float64]

    @property
    def free(self) -> int:
        """Number of spare freedoms: n minus the rank of the task Jacobian in a generic configuration."""
        return self.arm.n - _rank(self.jacobians)

    def with_fixed(self, special: bool = False) -> Iterator[tuple[tuple[int, ...], Arm]]:
        """Yield sets of joints (1-based) that may be fixed, the last joints first, and the axes that are left.

        With ``special``, four turns and more are left out where fewer than two pairs of neighbouring axes are parallel
        or meet: no three of them then meet in a point or are parallel.

        Such a set takes nothing from what the task can do. The arm that is left has the standard convention and the
        axes of a generic configuration; its frame 0, tool and limits are of no account.
        """
        n, free, normals = self.arm.n, self.free, _Normals(self.arm, self.samples[0])
        for fixed in islice(combinations(range(n, 0, -1), free), MOST_SETS):
            kept = [k for k in range(n) if k + 1 not in fixed]
            if special and not normals.are_special(kept):
                continue
            if kept and _rank(self.jacobians[:, :, kept]) == len(kept):
                yield tuple(sorted(fixed)), _of_axes(self.arm, normals, kept)


def spare_joints(arm: Arm) -> Spare:
    """Return the spare joints of the task of an arm."""
    # Slides go as far as the arm is long: metres would be beyond all measure for an arm of millimetres.
    units = np.where(arm.revolute, 1.0, arm.length_scale)
    samples = np.random.default_rng(0).uniform(-3.0, 3.0, (SAMPLES, arm.n)) * units
    return Spare(arm, samples, np.array([task_jacobian(arm, q) for q in samples]))


def _rank(jacobians: NDArray[np.float64]) -> int:
    return int(np.linalg.matrix_rank(jacobians, tol=RANK_TOLERANCE).max())


def task_jacobian(arm: Arm, q: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the task Jacobian in axes of frame 0, with lengths in length scales, shape (m, n)."""
    turn = arm.base[:3, :3].T
    J = arm.jacobian(q)
    linear, angular = turn @ J[:3] / arm.length_scale, turn @ J[3:]
    tool = turn @ arm.fk(q)[:3, :3]
    rotation = {"none": np.eye(3)[:0], "phi": np.eye(3)[2:], "approach": tool[:, :2].T, "full": np.eye(3)}
    return np.vstack([linear[arm.task.coordinates], rotation[arm.task.rotation] @ angular])


class _Normals:
    """The joint axes of an arm in one configuration, in world axes, and their common normals."""

    def __init__(self, arm: Arm, q: NDArray[np.float64]) -> None:
        whole = np.asarray(arm.frames(q), dtype=np.float64)
        self.frames = whole[:-1] if arm.convention == "standard" else whole[1:]
        self.scale = arm.length_scale
        self._lines = [Line(frame[:3, 3], frame[:3, 2]) for frame in self.frames]
        self._skew: dict[tuple[int, int], CommonNormal] = {}
        self._turns = arm.revolute

    def are_special(self, kept: list[int]) -> bool:
        """Return whether a prismatic axis is among these (0-based), or two pairs of neighbours are parallel or meet."""
        if len(kept) < 4 or not self._turns[kept].all():
            return True
        pairs = (self.between(j, k, self.frames[j, :3, 3]) for j, k in pairwise(kept))
        return sum(bool(min(abs(np.sin(pair.alpha)), pair.a / self.scale) < NEARLY) for pair in pairs) >= 2

    def between(self, j: int, k: int, place: NDArray[np.float64]) -> CommonNormal:
        """Return the common normal of two axes (0-based), at a place on the first when they are parallel."""
        found = self._skew.get((j, k))
        if found is None:
            first = Line(place, self._lines[j].direction)
            found = common_normal(first, self._lines[k], scale=self.scale)
            if found.kind in ("skew", "intersecting"):
                self._skew[j, k] = found
        return found


def _of_axes(arm: Arm, normals: _Normals, kept: list[int]) -> Arm:
    """Return an arm with some of the joints (0-based), its table computed from their axes in one configuration."""
    frames, rows = normals.frames, list[Row]()
    x, place = frames[kept[0], :3, 0], frames[kept[0], :3, 3]
    for j, k in pairwise(kept):
        z = frames[j, :3, 2]
        normal = normals.between(j, k, place)
        d, theta = float((normal.foot1 - place) @ z), _turn(x, normal.normal, z)
        rows.append(Row(arm.rows[j].kind, normal.a, normal.alpha, d, theta))
        x, place = normal.normal, normal.foot2
    # The tool gives a length scale of the same order; no test of axes uses it.
    rows.append(Row(arm.rows[kept[-1]].kind, arm.length_scale))
    return Arm.from_dh(rows, task=arm.task)


def _turn(x: NDArray[np.float64], to: NDArray[np.float64], z: NDArray[np.float64]) -> float:
    """Return the angle about z from one direction to another."""
    return float(np.arctan2(np.linalg.det(np.array([x, to, z])), x @ to))
