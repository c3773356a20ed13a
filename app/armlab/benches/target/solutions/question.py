"""The problem of all solutions: an arm, a pose of its tool, and joints that are held."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.solutions import IkSolutions
from armlab.kin.ik.solve_all import solve_all
from armlab.kin.transforms import inverse
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import target_pose
from armlab.session.state import State

Vector = NDArray[np.float64]

SAME = 1e-7
"""Difference of two targets, length scales or entries of a rotation, below which they are one."""


@dataclass(frozen=True, eq=False)
class Question:
    """One problem of inverse kinematics.

    Attributes
    ----------
    arm : Arm
    pose : ndarray, shape (4, 4)
        Where the tool is wanted, in the world.
    held : dict
        Joints that are held (1-based) and their values in rad or m.
    """

    arm: Arm
    pose: NDArray[np.floating] = field(repr=False)
    held: dict[int, float]

    @cached_property
    def aim(self) -> Vector:
        """The components of the target that the task controls, without units."""
        arm, task = self.arm, self.arm.task
        G = inverse(arm.base) @ self.pose
        parts = [G[list(task.coordinates), 3] / arm.length_scale]
        if task.rotation == "phi":
            parts.append(G[:2, 0])
        elif task.rotation == "approach":
            parts.append(G[:3, 2])
        elif task.rotation != "none":
            parts.append(G[:3, :3].ravel())
        return np.concatenate(parts)

    @property
    def key(self) -> Hashable:
        """A key that tells the question from others."""
        return self.arm, self.aim.tobytes(), tuple(self.held.items())

    def is_same(self, other: Question) -> bool:
        """Return whether another question has the same solutions."""
        return (
            self.arm is other.arm
            and self.held == other.held
            and (self.pose is other.pose or bool(np.all(np.abs(self.aim - other.aim) < SAME)))
        )

    def solve(self) -> IkSolutions:
        """Return all solutions."""
        return solve_all(self.arm, self.pose, held=self.held or None)

    def free(self) -> list[int]:
        """Return the joints (0-based) that are not held."""
        return [i for i in range(self.arm.n) if i + 1 not in self.held]


def question(state: State) -> Question:
    """Return the present question."""
    joints = state[Joints]
    held = {i + 1: float(joints.q[i]) for i, locked in enumerate(joints.locked) if locked}
    return Question(joints.arm, target_pose(state), held)
