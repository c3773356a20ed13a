"""A configuration under the microscope: singular directions, the wanted velocity, and the methods' answers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.microscope.state import Microscope
from armlab.kin.arm import Arm
from armlab.kin.conditioning import SINGULAR
from armlab.kin.control.rate_inverse import RateStep, rate_step
from armlab.kin.control.scaled_task import ScaledTask
from armlab.kin.control.side_by_side import Compared, side_by_side
from armlab.kin.control.singular_poses import SingularPose, nearest_singular_pose, singular_poses
from armlab.kin.velocity.singular import Singularity, singularities

Array = NDArray[np.float64]

EQUAL = 1e-9
"""Difference up to which components of a unit vector count as equal, so that the first of them decides its sign."""

ALPHAS = (1e-6, 1e6)
"""Smallest and largest step size of the transpose method."""

MOST_PLACES = 8
"""Largest number of singular configurations that are offered."""


@dataclass(frozen=True, eq=False)
class Look:
    """One configuration under the microscope; all quantities are scaled as in `ScaledTask`.

    Attributes
    ----------
    part : Microscope
    q : ndarray, shape (n,)
    J : ndarray, shape (m, n)
    U, sigma, V : ndarray, shapes (m, r), (r,), (n, r), r = min(m, n)
        Singular directions of the tool and of the joints; the largest component of each u is positive.
    rows : ndarray, shape (m, 6)
        What takes a twist in world axes to the task.
    """

    part: Microscope
    q: Array
    J: Array
    U: Array
    sigma: Array
    V: Array
    rows: Array

    @property
    def task(self) -> ScaledTask:
        """The scaled task of the arm."""
        return self.part.task

    @property
    def usual(self) -> int:
        """The rank of J in configurations that are not singular."""
        return self.task.usual_rank

    @property
    def smallest(self) -> float:
        """The smallest of the singular values that are not 0 in every configuration; 0 where all are."""
        return float(self.sigma[self.usual - 1]) if self.usual else 0.0

    @property
    def inverse_condition(self) -> float:
        """Ratio of the smallest singular value to sigma_max: 0 at singularities, and where J = 0 everywhere."""
        return self.smallest / float(self.sigma[0]) if self.sigma[0] > 0.0 else 0.0

    @property
    def singular(self) -> bool:
        """Whether a direction is lost that is not lost everywhere, up to rounding."""
        return self.usual > 0 and self.inverse_condition <= SINGULAR

    @property
    def lost(self) -> Array:
        """Unit vector (m,) of the task along which the tool is slowest: u of the smallest singular value."""
        return np.asarray(self.U[:, -1])

    @property
    def options(self) -> Mapping[str, Mapping[str, Any]]:
        """Options of each method, by the method's key.

        The step size of the transpose is 1/sigma_max^2, exact where the tool is fastest. The one that serves a wish
        best would be 1/sigma_min^2 for a wish along the lost direction, and so an inverse in disguise.
        """
        alpha = min(max(float(self.sigma[0]) ** -2, ALPHAS[0]), ALPHAS[1]) if self.sigma[0] > 0.0 else 1.0
        return {**self.part.options, "transpose": {"alpha": alpha}}

    @cached_property
    def wish(self) -> Array:
        """The wanted velocity, (m,)."""
        part = self.part
        if part.aim == "own":
            return np.asarray(np.array(part.own) * self.task.row_units)
        return np.asarray(part.speed * (self.lost if part.aim == "lost" else self.U[:, 0]))

    @cached_property
    def answers(self) -> tuple[Compared, ...]:
        """The answers of all methods to the wanted velocity."""
        return side_by_side(self.J, self.wish, self.options)

    def answer(self, method: str) -> RateStep:
        """Return the answer of one method."""
        return rate_step(method, self.J, self.wish, self.options.get(method))

    def natural(self, components: Array) -> Array:
        """Return the velocity in m/s and rad/s of a scaled task velocity (m,)."""
        return np.asarray(components / self.task.row_units)

    def twist(self, components: Array) -> Array:
        """Return a scaled task velocity as a twist in world axes, (6,), scaled if the task mixes metres and radians."""
        return np.asarray(self.rows.T @ components)


def look_at(part: Microscope, q: Array) -> Look:
    """Return the view of the microscope at a configuration."""
    task = part.task
    R = np.asarray(task.pose(q))[:3, :3]
    J = task.scaled(task.jacobian(q, R))
    U, sigma, V_T = np.linalg.svd(J, full_matrices=False)
    size = np.abs(U)
    first = np.argmax(size >= size.max(axis=0) - EQUAL, axis=0)
    signs = np.where(U[first, np.arange(U.shape[1])] < 0.0, -1.0, 1.0)
    return Look(part, q, J, U * signs + 0.0, sigma, V_T.T * signs + 0.0, task.rows(R).copy())


class Near(NamedTuple):
    """The singular configuration that is nearest by moving one joint, and why it is singular.

    Attributes
    ----------
    pose : SingularPose
    why : tuple of Singularity
    """

    pose: SingularPose
    why: tuple[Singularity, ...]


def near_at(part: Microscope, q: Array) -> Near | None:
    """Return the singularity near the configuration or at it, or None if there is none."""
    found = nearest_singular_pose(part.task, q)
    return None if found is None else Near(found, singularities(part.arm, found.q))


class Place(NamedTuple):
    """A singular configuration to which the arm can be brought near.

    Attributes
    ----------
    name : str
        Such as ``"Elbow"``.
    pose : SingularPose
    says : str
    """

    name: str
    pose: SingularPose
    says: str


@lru_cache(maxsize=64)
def places(arm: Arm, home: tuple[float, ...]) -> tuple[Place, ...]:
    """Return the singular configurations that one joint reaches from the home pose: the nearest of each kind."""
    task, found = ScaledTask(arm), dict[tuple[str, bool, str, int], Place]()
    poses = sorted(singular_poses(task, np.array(home)), key=lambda pose: abs(pose.away / task.joint_units[pose.place]))
    for pose in poses:
        why = singularities(arm, pose.q)
        if not why:
            continue
        first = why[0]
        shape = next((word for word in ("stretched", "folded") if word in first.says), "")
        name = f"{first.kind.capitalize()}, {shape}" if shape else first.kind.capitalize()
        if first.kind == "dependent":
            name = "Dependent joints"
        key = (first.kind, first.boundary, shape, pose.place if first.kind == "dependent" else -1)
        found.setdefault(key, Place(name, pose, " ".join(each.says for each in why)))
    return tuple(sorted(found.values(), key=lambda place: place.pose.place))[:MOST_PLACES]
