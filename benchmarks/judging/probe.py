"""Forward kinematics, Jacobian and error of many configurations at once, from nothing but the numbers of the table."""

from __future__ import annotations

import numpy as np

from armlab.kin.arm import Arm

DAMPING, FLOOR = 0.1, 1e-14
"""Of the normal equations: times the squared scaled error, and at least."""

OPPOSITE = 1e-9
"""Keeps the error of a turn by 180 degrees finite."""


class Probe:
    """An arm's task as arrays whose last index counts configurations, in the axes of frame 0.

    Metres are divided by half the reach, so that errors and moves of metres and radians compare.
    """

    def __init__(self, arm: Arm) -> None:
        self.arm, self.n, self.m = arm, arm.n, arm.task.m
        self.length = float(arm.length_scale)
        self.scales = np.where(arm.revolute, 1.0, self.length)
        self.into_0 = np.linalg.inv(arm.base)

    def target(self, T: np.ndarray) -> np.ndarray:
        """Return a wanted pose (4, 4) of the world in frame 0, its rotation the nearest one."""
        U, _, V = np.linalg.svd(T[:3, :3])
        pose = T.copy()
        if np.abs(U @ V - T[:3, :3]).max() > 1e-14:
            pose[:3, :3] = U @ V
        return np.asarray(self.into_0 @ pose)

    def tool(self, q: np.ndarray) -> tuple[np.ndarray, np.ndarray, list[np.ndarray], list[np.ndarray]]:
        """Return the tool's place (3, N) and axes (3, 3, N), and each joint's axis and a point on it, at q (n, N)."""
        X, Y, Z = (np.repeat(np.eye(3)[k][:, None], q.shape[1], axis=1) for k in range(3))
        P = np.zeros((3, q.shape[1]))
        axes, points = [], []
        proximal = self.arm.convention == "modified"
        for row, value in zip(self.arm.rows, q, strict=True):
            if proximal:
                P = P + row.a * X
                Y, Z = _turned(Y, Z, np.cos(row.alpha), np.sin(row.alpha))
            axes.append(Z)
            points.append(P)
            theta, d = (value + row.theta, row.d) if row.revolute else (row.theta, value + row.d)
            X, Y = _turned(X, Y, np.cos(theta), np.sin(theta))
            P = P + d * Z
            if not proximal:
                P = P + row.a * X
                Y, Z = _turned(Y, Z, np.cos(row.alpha), np.sin(row.alpha))
        R, p = self.arm.tool[:3, :3], self.arm.tool[:3, 3]
        hand = np.stack([R[0, k] * X + R[1, k] * Y + R[2, k] * Z for k in range(3)])
        return P + p[0] * X + p[1] * Y + p[2] * Z, hand, axes, points

    def linearised(self, q: np.ndarray, G: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the scaled Jacobian (n, m, N) and error (m, N) at q (n, N) for a target in frame 0."""
        P, hand, axes, points = self.tool(q)
        wanted = self.arm.task.coordinates
        e = np.concatenate([(G[wanted, 3][:, None] - P[wanted]) / self.length, self._turn(hand, G)])
        J = np.empty((self.n, self.m, q.shape[1]))
        for i, (axis, point, turns) in enumerate(zip(axes, points, self.arm.revolute, strict=True)):
            linear = _cross(axis, P - point) / self.length if turns else axis
            angular = axis if turns else np.zeros_like(axis)
            J[i] = np.concatenate([linear[wanted], self._controlled(angular, hand)])
        return J, e

    def errors(self, q: np.ndarray, G: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the errors in m and rad of the components the task controls, for q (N, n), shape (N,) each."""
        P, hand, _, _ = self.tool(np.ascontiguousarray(q.T))
        wanted = self.arm.task.coordinates
        place = np.linalg.norm(P[wanted] - G[wanted, 3][:, None], axis=0)
        turn = np.linalg.norm(self._turn(hand, G), axis=0)
        return place, 2.0 * np.arcsin(np.minimum(1.0, turn / 2.0))

    def size(self, q: np.ndarray, G: np.ndarray) -> np.ndarray:
        """Return the scaled error for q (N, n), shape (N,)."""
        place, turn = self.errors(q, G)
        return np.hypot(place / self.length, turn)

    def apart(self, q: np.ndarray, other: np.ndarray) -> np.ndarray:
        """Return scaled joint differences without whole turns; the two are broadcast."""
        gap = q - other
        return np.where(self.arm.revolute, gap - 2 * np.pi * np.round(gap / (2 * np.pi)), gap / self.length)

    def step(self, J: np.ndarray, e: np.ndarray) -> np.ndarray:
        """Return damped least-squares steps (n, N), scaled."""
        damping = DAMPING * (e * e).sum(axis=0) + FLOOR
        if self.n < self.m:
            return _cholesky_solved(_gram(J.transpose(1, 0, 2)), np.einsum("imk,mk->ik", J, e), damping)
        return np.einsum("imk,mk->ik", J, _cholesky_solved(_gram(J), e, damping))

    def singular(self, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return n singular values, 0 beyond the task's rows, and right vectors (n, n) of the Jacobian at q (n,)."""
        J, _ = self.linearised(q[:, None], np.eye(4))
        _, s, V = np.linalg.svd(J[:, :, 0].T)
        return np.concatenate([s, np.zeros(self.n - len(s))]), V

    def least(self, q: np.ndarray) -> float:
        """Return the smallest singular value of the scaled Jacobian at q (n,)."""
        return float(self.singular(q)[0][min(self.n, self.m) - 1])

    def _turn(self, hand: np.ndarray, G: np.ndarray) -> np.ndarray:
        """Return the components the task controls of 2 sin(theta / 2) r, the turn from the hand to the target."""
        kind = self.arm.task.rotation
        if kind == "none":
            return np.zeros((0, hand.shape[2]))
        if kind == "phi":
            sine = hand[0, 0] * G[1, 0] - hand[0, 1] * G[0, 0] + hand[1, 0] * G[1, 1] - hand[1, 1] * G[0, 1]
            cosine = hand[0, 0] * G[0, 0] + hand[0, 1] * G[1, 0] + hand[1, 0] * G[0, 1] + hand[1, 1] * G[1, 1]
            return np.asarray(2.0 * np.sin(0.5 * np.arctan2(sine, cosine)))[None]
        used = [2] if kind == "approach" else [0, 1, 2]
        goal = np.broadcast_to(G[:3, :3].T[:, :, None], hand.shape)
        turn = np.sum([_cross(hand[k], goal[k]) for k in used], axis=0)
        cosine = np.sum([(hand[k] * goal[k]).sum(axis=0) for k in used], axis=0)
        if kind == "full":
            turn, cosine = 0.5 * turn, 0.5 * (cosine - 1.0)
        return self._controlled(turn / np.sqrt(np.maximum(0.5 + 0.5 * cosine, OPPOSITE)), hand)

    def _controlled(self, turn: np.ndarray, hand: np.ndarray) -> np.ndarray:
        kind = self.arm.task.rotation
        if kind == "phi":
            return turn[2:]
        if kind == "approach":
            return np.stack([(hand[k] * turn).sum(axis=0) for k in (0, 1)])
        return turn if kind == "full" else turn[:0]


def _turned(A: np.ndarray, B: np.ndarray, cosine: np.ndarray, sine: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return cosine * A + sine * B, cosine * B - sine * A


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def _gram(J: np.ndarray) -> np.ndarray:
    """Return sum_i J_i J_i^T (m, m, N), its lower triangle, of columns (n, m, N)."""
    A = np.zeros((J.shape[1], J.shape[1], J.shape[2]))
    for column in J:
        for j in range(len(A)):
            A[j:, j] += column[j:] * column[j]
    return A


def _cholesky_solved(A: np.ndarray, b: np.ndarray, damping: np.ndarray) -> np.ndarray:
    """Return (A + damping I)^-1 b for lower triangles A (m, m, N), which are overwritten, and b (m, N)."""
    m = len(A)
    for j in range(m):
        for k in range(j):
            A[j:, j] -= A[j:, k] * A[j, k]
        pivot = np.sqrt(np.maximum(A[j, j] + damping, 1e-300))
        A[j + 1 :, j] /= pivot
        A[j, j] = pivot
    x = b.copy()
    for j in range(m):
        x[j] = (x[j] - (A[j, :j] * x[:j]).sum(axis=0)) / A[j, j]
    for j in reversed(range(m)):
        x[j] = (x[j] - (A[j + 1 :, j] * x[j + 1 :]).sum(axis=0)) / A[j, j]
    return x
