"""The task of an arm at many configurations at once: for searches whose batches are too small for the tapes.

The same error and Jacobian as `armlab.kin.ik.problem`, with one product of 4 x 4 matrices for each joint. A tape of
some thousand steps has to be bound to the size of every batch, which for a hundred rows takes longer than the products.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.dh import link_transform

Vector = NDArray[np.float64]

OPPOSITE = 1e-9
"""Smallest size that keeps the error of exactly opposite orientations finite, as in `armlab.kin.ik.problem`."""

_CROSS = np.array([np.cross(a, b) for a in np.eye(3) for b in np.eye(3)])
"""Matrix from the nine products a_i b_j to a x b."""


ROUNDING = 4.0 * float(np.finfo(float).eps)
"""Rounding of the entries of J J^T, relative to its trace."""


@dataclass(frozen=True, eq=False)
class ManyAtOnce:
    """An arm as T = E_0 M_1(q_1) E_1 M_2(q_2) ... M_n(q_n) E_n in frame 0, M a turn about or a slide along z.

    Attributes
    ----------
    arm : Arm
    links : ndarray, shape (n + 1, 4, 4)
        The constant motions E.
    """

    arm: Arm
    links: Vector

    @classmethod
    def of(cls, arm: Arm) -> ManyAtOnce:
        """Return the constant motions of an arm, in either convention."""
        at_zero = [link_transform(row.a, row.alpha, row.d, row.theta, arm.convention) for row in arm.rows]
        # A standard row moves first and then goes along its link, a modified one the other way round.
        if arm.convention == "standard":
            return cls(arm, np.array([np.eye(4), *at_zero[:-1], at_zero[-1] @ arm.tool], dtype=np.float64))
        return cls(arm, np.array([*at_zero, arm.tool], dtype=np.float64))

    def linearised(self, q: Vector, G: NDArray[np.floating]) -> tuple[Vector, Vector]:
        """Return the scaled task Jacobian (k, m, n) and error (k, m) at q (k, n) for a target (4, 4) in frame 0."""
        arm, task, L = self.arm, self.arm.task, self.arm.length_scale
        z, o, tool = self._axes(q)
        arms = tool[:, None, :3, 3] - o
        turned = (z[..., :, None] * arms[..., None, :]).reshape(len(q), arm.n, 9) @ _CROSS
        linear = np.where(arm.revolute[:, None], turned, z)
        angular = np.where(arm.revolute[:, None], z, 0.0)
        R = tool[:, :3, :3]
        # Rows of joints, which become columns in the end.
        rows = [linear[..., task.coordinates] / L]
        errors = [(G[:3, 3] - tool[:, :3, 3])[:, task.coordinates] / L]
        if task.rotation != "none":
            turn = _turn(task.rotation, R, np.asarray(G[:3, :3]))
            if task.rotation == "phi":
                rows.append(angular[..., 2:])
                errors.append(turn[:, 2:])
            elif task.rotation == "approach":
                rows.append(angular @ R[:, :, :2])
                errors.append((turn[:, None] @ R[:, :, :2])[:, 0])
            else:
                rows.append(angular)
                errors.append(turn)
        scales = np.where(arm.revolute, 1.0, L)
        J = np.concatenate(rows, axis=2) * scales[:, None]
        return np.swapaxes(J, 1, 2), np.concatenate(errors, axis=1)

    def tools(self, q: Vector) -> Vector:
        """Return the poses of the tool in frame 0, (k, 4, 4), at q (k, n)."""
        return self._axes(q)[2]

    def _axes(self, q: Vector) -> tuple[Vector, Vector, Vector]:
        """Return directions and points of the joint axes, (k, n, 3) each, and the tools (k, 4, 4), in frame 0."""
        k, n = q.shape
        moves = np.zeros((k, n, 4, 4))
        turning = np.where(self.arm.revolute, q, 0.0)
        moves[..., 0, 0] = moves[..., 1, 1] = np.cos(turning)
        moves[..., 1, 0] = np.sin(turning)
        moves[..., 0, 1] = -moves[..., 1, 0]
        moves[..., 2, 2] = moves[..., 3, 3] = 1.0
        moves[..., 2, 3] = np.where(self.arm.revolute, 0.0, q)
        moves = moves @ self.links[1:]
        frames = np.empty((k, n + 1, 4, 4))
        frames[:, 0] = self.links[0]
        for i in range(n):
            np.matmul(frames[:, i], moves[:, i], out=frames[:, i + 1])
        return frames[:, :-1, :3, 2], frames[:, :-1, :3, 3], frames[:, -1]


@lru_cache(maxsize=64)
def many_at_once(arm: Arm) -> ManyAtOnce:
    """Return the compiled arm for batches (arms are compared by identity)."""
    return ManyAtOnce.of(arm)


def damped_steps(J: Vector, e: Vector, damping: Vector | float) -> Vector:
    """Return J^T (J J^T + mu 1)^-1 e of a batch: J (k, m, n), e (k, m), mu a number or (k,); shape (k, n).

    A mu that would be lost in the rounding of J J^T is raised to it: a singular arm has steps, too.
    """
    turned = np.swapaxes(J, 1, 2)
    normal = J @ turned
    diagonal = np.arange(J.shape[1])
    least = ROUNDING * np.einsum("kii->k", normal)
    normal[:, diagonal, diagonal] += np.maximum(damping, least)[:, None]
    return np.asarray((turned @ np.linalg.solve(normal, e[..., None]))[..., 0])


def _turn(kind: str, R: Vector, wanted: Vector) -> Vector:
    """Return 2 sin(theta / 2) times the axis of the controlled turn to the wanted orientation, shape (k, 3)."""
    goal = wanted.copy()
    columns, weight = slice(0, 3), 0.5
    if kind == "approach":
        columns, weight = slice(2, 3), 1.0
    elif kind == "phi":
        goal[2] = 0.0
    # Entry (a, b) is the sum of r_a g_b over the compared axes r, g of both orientations.
    overlap = weight * (R[:, :, columns] @ goal[:, columns].T)
    turned = overlap.reshape(-1, 9) @ _CROSS
    cosine = np.trace(overlap, axis1=1, axis2=2) - (0.5 if kind == "full" else 0.0)
    return np.asarray(turned / np.sqrt(np.abs(0.5 + 0.5 * cosine + OPPOSITE))[:, None])
