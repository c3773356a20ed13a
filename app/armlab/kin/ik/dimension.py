"""The dimension of the set of solutions around a solution.

Where the task Jacobian has full rank they are n - m, by the implicit function theorem. At a singular solution they may
be more, or fewer than its null space has: an arm may be stretched, and what seems free to the first order is not. There
small steps are tried in many directions of the null space; where the steps that lead back to the task end, seen from
the solution, tells the dimension. Two curves may cross there, so the same is asked at neighbours, and the least counts.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.ik.many_at_once import damped_steps, many_at_once
from armlab.kin.transforms import inverse

Vector = NDArray[np.float64]

LOOSE = 1e-4
"""Singular value of the scaled task Jacobian, relative to the largest, below which it may be zero: where roots merge, a
singular solution is known only to the square root of the rounding."""

AHEAD = 0.05
"""Length of a step, in radians or length scales."""

MOVED = (0.3, 3.0)
"""Least and largest distance of the solution at the end of a step, as factors of the length of the step."""

STEPS, NEAR = 40, 1e-10
"""Largest number of Newton steps back to the task (they halve the error where roots merge), and their final scaled
error."""

FLAT = 0.25
"""Singular value of the end points of the steps, relative to the largest, below which it comes from curvature."""

NEIGHBOURS = 3


def local_dimension(arm: Arm, q: Vector, T: NDArray[np.floating]) -> int:
    """Return the dimension of the solutions around one, q (n,), for a target T (4, 4) in the world; 0 for a point."""
    G = np.asarray(inverse(arm.base) @ T, dtype=np.float64)
    least, around = _dimension(arm, q, G)
    for neighbour in around[:NEIGHBOURS]:
        if least > 1:
            least = min(least, _dimension(arm, neighbour, G)[0])
    return least


def null_dimension(arm: Arm, q: Vector, T: NDArray[np.floating]) -> int:
    """Return the dimension of the null space of the task Jacobian at q (n,), an upper bound of that of a family."""
    return int(_null_space(arm, q, np.asarray(inverse(arm.base) @ T, dtype=np.float64)).shape[1])


def _dimension(arm: Arm, q: Vector, G: Vector) -> tuple[int, Vector]:
    """Return the number of independent directions in which there are solutions, and solutions there (k, n)."""
    null = _null_space(arm, q, G)
    n, m, d = arm.n, arm.task.m, null.shape[1]
    if d <= n - m:
        return n - m, np.empty((0, n))
    scales = np.where(arm.revolute, 1.0, arm.length_scale)
    ways = np.random.default_rng(0).normal(size=(6 * d, d)) @ null.T
    ways = AHEAD * ways / np.linalg.norm(ways, axis=1, keepdims=True)
    there, arrived = _back(arm, q + ways * scales, G)
    moved = (there - q) / scales
    sizes = np.linalg.norm(moved, axis=1)
    good = arrived & (sizes > MOVED[0] * AHEAD) & (sizes < MOVED[1] * AHEAD)
    if not good.any():
        return 0, np.empty((0, n))
    spread = np.linalg.svd(moved[good] / sizes[good, None], compute_uv=False)
    return int(np.sum(spread > FLAT * spread[0])), there[good]


def _null_space(arm: Arm, q: Vector, G: Vector) -> Vector:
    J = many_at_once(arm).linearised(q[None], G)[0][0]
    _, sizes, vectors = np.linalg.svd(J)
    return np.asarray(vectors[int(np.sum(sizes > LOOSE * max(1.0, float(sizes.max(initial=0.0))))) :].T)


def _back(arm: Arm, q: Vector, G: Vector) -> tuple[Vector, NDArray[np.bool_]]:
    """Return the solutions reached by Newton steps from q (k, n), and whether each arrived."""
    scales = np.where(arm.revolute, 1.0, arm.length_scale)
    for _ in range(STEPS):
        J, e = many_at_once(arm).linearised(q, G)
        square = np.einsum("ki,ki->k", e, e)
        if bool(np.all(square <= NEAR**2)):
            break
        # Along what is singular no farther than the error asks for.
        step = damped_steps(J, e, 1e-2 * square + 1e-15)
        q = q + np.clip(step, -AHEAD, AHEAD) * scales
    return q, square <= NEAR**2
