"""Trials of chapter 5, inverse velocity: lines, damping, the pseudo-inverse, singular values, ellipsoids."""

from __future__ import annotations

import math

import numpy as np

from armlab.kin.errata.arms import jacobian_2r, point_2r
from armlab.kin.errata.draws import Floats, Generator, direction, matrix, orthogonal, signed, two_links
from armlab.kin.errata.trial import Forms, Quiet, Trial

SPEED, DURATION = 0.6, 6.0
"""Speed along the line of the notes, m/s, and how long it lasts, s."""

REACH = 2.0
"""Reach of the arm of the notes, m."""

STEPS = 40
"""Number of Runge-Kutta steps of the simulated line."""

EXACT = 1e-12
"""Reciprocal condition below which a matrix has no inverse."""


def _left_to_right(x: float, angle: float) -> Forms:
    """5.dir: by how much the end of the line from the left is out of reach."""

    def beyond(direction_of: float) -> float:
        way = SPEED * DURATION
        return max(0.0, math.hypot(-x + way * math.cos(direction_of), way * math.sin(direction_of)) - REACH)

    return Forms(beyond(angle), beyond(angle - math.pi), 0.0)


def _final_error(q2: float, angle: float, speed: float) -> Forms:
    """5.fin: the error at the end of a line that a 2R of unit links follows with J^-1 v."""
    q = np.array([0.3, q2])
    start, v = point_2r(1.0, 1.0, q), speed * np.array([math.cos(angle), math.sin(angle)])
    h = 1.0 / STEPS

    def rate(at: Floats) -> Floats:
        return np.asarray(np.linalg.solve(jacobian_2r(1.0, 1.0, at), v))

    for _ in range(STEPS):
        k1 = rate(q)
        k2 = rate(q + h / 2.0 * k1)
        k3 = rate(q + h / 2.0 * k2)
        q = q + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + rate(q + h * k3))
    end = point_2r(1.0, 1.0, q)
    return Forms(float(np.linalg.norm(end - start)), float(np.linalg.norm(end - start - v)), 0.0)


def _damped(J: Floats, damping: float) -> Forms:
    """5.113: the damped inverse of a 2 x 3 matrix; the printed sum of a 3 x 3 and a 2 x 2 matrix does not exist."""
    m, n = J.shape
    right = J.T @ np.linalg.inv(damping * np.eye(m) + J @ J.T)
    stacked = np.vstack([J, math.sqrt(damping) * np.eye(n)])
    judge = np.linalg.lstsq(stacked, np.vstack([np.eye(m), np.zeros((n, m))]), rcond=None)[0]
    return Forms(right if m == n else None, right, judge)


def _lagrangian(J: Floats, v: Floats) -> Forms:
    """5.120: the velocity of the tool at the stationary point of each Lagrangian."""
    m, n = J.shape
    system = np.block([[np.eye(n), J.T], [J, np.zeros((m, m))]])

    def made(right: Floats) -> Floats:
        return np.asarray(J @ np.linalg.solve(system, np.concatenate([np.zeros(n), right]))[:n])

    return Forms(made(-v), made(v), J @ np.linalg.pinv(J) @ v)


def _out_of_range(J: Floats, v: Floats) -> Forms:
    """5.123: the joint speeds of the least error for a velocity."""
    inner = J @ J.T
    printed = None if 1.0 / np.linalg.cond(inner) < EXACT else J.T @ np.linalg.solve(inner, v)
    return Forms(printed, np.linalg.pinv(J) @ v, np.linalg.lstsq(J, v, rcond=None)[0])


def _stretched(rng: Generator) -> tuple[Floats, Floats]:
    l1, l2, q1, _ = two_links(rng)
    return jacobian_2r(l1, l2, [q1, 0.0]), signed(rng, 0.3, 1.0, 2)


def _factors(A: Floats) -> Forms:
    """Definition 11: A from its three factors, with the sizes as printed and as they are."""
    U, sigma, Vt = np.linalg.svd(A)
    Sigma = np.zeros(A.shape)
    np.fill_diagonal(Sigma, sigma)
    product = U @ Sigma @ Vt
    return Forms(product if A.shape[0] == A.shape[1] else None, product, A)


def _rank_one(u: Floats, v: Floats, size: float) -> Forms:
    """5.126: the pseudo-inverse of a matrix of rank 1, with every singular value inverted, and without the smallest."""
    A = size * np.outer(u, v)
    U, sigma, Vt = np.linalg.svd(A, full_matrices=False)
    every = Vt.T / sigma @ U.T
    return Forms(every if np.isfinite(every).all() else None, np.linalg.pinv(A), np.outer(v, u) / size)


def _ellipsoid(J: Floats, rates: Floats) -> Forms:
    """5.141: the quadratic form at the velocity of some joint speeds of length 1."""
    v, inverse = J @ rates, np.linalg.pinv(J)
    return Forms(float(v @ inverse @ inverse @ v), float(v @ inverse.T @ inverse @ v), float(rates @ rates))


def _manipulability(J: Floats) -> Forms:
    """5.144: the product of the singular values from a determinant."""
    smaller = J @ J.T if J.shape[0] <= J.shape[1] else J.T @ J
    printed = math.sqrt(max(0.0, float(np.linalg.det(J @ J.T))))
    sizes = np.linalg.svd(J, compute_uv=False)
    return Forms(printed, math.sqrt(float(np.linalg.det(smaller))), float(np.prod(sizes)))


def _eigenvalues(J: Floats) -> Forms:
    """5.152: the eigenvalues of J J^T from the singular values, the largest first."""
    sigma = np.linalg.svd(J, compute_uv=False)
    return Forms(sigma, sigma**2, np.linalg.eigvalsh(J @ J.T)[::-1])


TRIALS = (
    Trial(
        "5.dir",
        "a start at the left end and an angle near that of the notes",
        lambda rng: (float(rng.uniform(1.7, 1.95)), math.radians(rng.uniform(165.0, 179.0))),
        _left_to_right,
        "distance of the end from the workspace",
        "the reach of the arm, 2 m",
        unit="m",
    ),
    Trial(
        "5.fin",
        "a configuration of a 2R, a direction and a speed for one second",
        lambda rng: (float(rng.uniform(1.2, 1.9)), float(rng.uniform(-3.0, 3.0)), float(rng.uniform(0.1, 0.3))),
        _final_error,
        "error at the end",
        "the exact joint speeds, with which it is 0",
        1e-7,
        "m",
    ),
    Trial(
        "5.113",
        "a well-conditioned 2 × 3 matrix and a damping",
        lambda rng: (matrix(rng, 2, 3), float(rng.uniform(0.05, 1.0))),
        _damped,
        "largest difference of an entry",
        "least squares of the stacked system",
        quiet=Quiet(
            lambda rng: (matrix(rng, 2, 2), float(rng.uniform(0.05, 1.0))),
            "for a square matrix, for which both I are one",
        ),
    ),
    Trial(
        "5.120",
        "a well-conditioned 2 × 3 matrix and a velocity",
        lambda rng: (matrix(rng, 2, 3), signed(rng, 0.3, 1.5, 2)),
        _lagrangian,
        "largest difference of a component of the velocity",
        "numpy.linalg.pinv",
        unit="m/s",
    ),
    Trial(
        "5.123",
        "a stretched 2R and a velocity",
        _stretched,
        _out_of_range,
        "largest difference of a joint speed",
        "numpy.linalg.lstsq",
        unit="rad/s",
        quiet=Quiet(lambda rng: (matrix(rng, 2, 3), signed(rng, 0.3, 1.0, 2)), "where J has rank m"),
    ),
    Trial(
        "5.125",
        "a 2 × 3 matrix",
        lambda rng: (matrix(rng, 2, 3),),
        _factors,
        "largest difference of an entry of the product",
        "the matrix itself",
        quiet=Quiet(lambda rng: (matrix(rng, 3, 3),), "for a square matrix"),
    ),
    Trial(
        "5.126",
        "two directions and a size, of which a matrix of rank 1 is made",
        lambda rng: (direction(rng, 3), direction(rng, 3), float(rng.uniform(0.5, 2.0))),
        _rank_one,
        "largest difference of an entry of the pseudo-inverse",
        "the same two directions over the size",
    ),
    Trial(
        "5.141",
        "a well-conditioned 2 × 2 matrix and joint speeds of length 1",
        lambda rng: (matrix(rng, 2, 2), direction(rng, 2)),
        _ellipsoid,
        "value of the quadratic form",
        "the squared length of the joint speeds",
        quiet=Quiet(
            lambda rng: ((Q := orthogonal(rng, 2)) * rng.uniform(0.5, 2.0, 2) @ Q.T, direction(rng, 2)),
            "for a symmetric J",
        ),
    ),
    Trial(
        "5.144",
        "a well-conditioned 3 × 2 matrix",
        lambda rng: (matrix(rng, 3, 2),),
        _manipulability,
        "manipulability",
        "the product of the singular values",
        1e-7,
        quiet=Quiet(lambda rng: (matrix(rng, 2, 3),), "for m ≤ n"),
    ),
    Trial(
        "5.152",
        "a 2 × 3 matrix whose singular values are not 1",
        lambda rng: (matrix(rng, 2, 3, 1.2, 2.5),),
        _eigenvalues,
        "largest difference of an eigenvalue",
        "numpy.linalg.eigvalsh",
        quiet=Quiet(lambda rng: (orthogonal(rng, 3)[:2],), "where all singular values are 1"),
    ),
)
"""The trials of inverse velocity."""
