"""Trials of chapter 5, velocities: rigid bodies, angle rates, the Jacobian and its derivatives, mobility."""

from __future__ import annotations

import math
from itertools import permutations

import numpy as np
from scipy.spatial.transform import Rotation  # type: ignore[import-untyped]

from armlab.kin.errata.arms import differences, jacobian_2r, point_2r
from armlab.kin.errata.draws import Floats, Generator, matrix, orthogonal, signed, two_links
from armlab.kin.errata.trial import Forms, Quiet, Trial
from armlab.kin.rotations import rotation_about, skew

COARSE = 2e-3
"""Step of third differences in time, s: a smaller one loses more to rounding than it gains."""

RANK = 1e-9
"""Singular value below which one counts as zero."""


def _from_points(omega: Floats, r: Floats, s: Floats) -> Forms:
    """5.8: the angular velocity from the velocities of points of a body: from one difference r, and from r and s."""
    seen_r, seen_s = np.cross(omega, r), np.cross(omega, s)
    from_one = np.cross(r, seen_r) / (r @ r)
    both = -np.vstack([skew(r), skew(s)])
    return Forms(from_one, np.linalg.lstsq(both, np.concatenate([seen_r, seen_s]), rcond=None)[0], omega)


def _orders(angles: Floats) -> Forms:
    """5.27: how many different products three small rotations have."""
    turns = [np.asarray(rotation_about(axis, angle)) for axis, angle in zip("xyz", angles, strict=True)]
    products = [np.round(a @ b @ c, 12).tobytes() for a, b, c in permutations(turns)]
    return Forms(12.0, float(math.factorial(3)), float(len(set(products))))


def _rates(angles: Floats, rates: Floats) -> Forms:
    """5.43: the angular velocity from the rates of three angles about fixed axes."""
    Rz, Ry = rotation_about("z", angles[2]), rotation_about("y", angles[1])
    T = np.column_stack([(Rz @ Ry)[:, 0], Rz[:, 1], [0.0, 0.0, 1.0]])
    h = 1e-6
    R = [Rotation.from_euler("xyz", angles + sign * h * rates).as_matrix() for sign in (-1.0, 0.0, 1.0)]
    S = (R[2] - R[0]) / (2.0 * h) @ R[1].T
    return Forms(R[1] @ rates, T @ rates, [S[2, 1], S[0, 2], S[1, 0]])


def _with_angle(l1: float, l2: float, q1: float, q2: float, rates: Floats) -> Forms:
    """5.51: the velocity of the tool of a 2R with its angle; two columns cannot take three speeds."""
    J = np.vstack([jacobian_2r(l1, l2, [q1, q2]), [1.0, 1.0]])
    by_differences = differences(lambda q: np.array([*point_2r(l1, l2, q), q.sum()]), [q1, q2])
    return Forms(None, J @ rates, by_differences @ rates)


def _last_vector(l1: float, l2: float, q1: float, q2: float) -> Forms:
    """5.58: the linear part of the Jacobian of a 2R from the vectors to the tool."""
    p, elbow = point_2r(l1, l2, [q1, q2]), l1 * np.array([math.cos(q1), math.sin(q1)])

    def columns(last: Floats) -> Floats:
        return np.column_stack([[-p[1], p[0]], [-last[1], last[0]]])

    by_differences = differences(lambda q: point_2r(l1, l2, q), [q1, q2])
    return Forms(columns(np.zeros(2)), columns(p - elbow), by_differences)


def _stored(l1: float, l2: float, q1: float, q2: float) -> Forms:
    """5.64: the contributions of the joints of a 2R, stored as rows and as columns."""
    p, elbow = point_2r(l1, l2, [q1, q2]), l1 * np.array([math.cos(q1), math.sin(q1)])
    given = [[-v[1], v[0]] for v in (p, p - elbow)]
    return Forms(given, np.column_stack(given), differences(lambda q: point_2r(l1, l2, q), [q1, q2]))


def _course(coefficients: Floats, t: float, order: int = 0) -> Floats:
    """Return a derivative of the joint values of a 2R along a cubic in time, shape (2,)."""
    return np.array([np.polynomial.Polynomial(each).deriv(order)(t) for each in coefficients])


def _rate_of_jacobian(q: Floats, v: Floats, a: Floats) -> tuple[Floats, Floats, Floats]:
    """Return J, J' and J'' of a 2R of unit links along a course, each (2, 2)."""
    angles, first, second = np.cumsum(q), np.cumsum(v), np.cumsum(a)
    c, s = np.cos(angles), np.sin(angles)
    rows = np.array([[-s, c], [-c * first, -s * first], [s * first**2 - c * second, -c * first**2 - s * second]])
    J, J1, J2 = (np.column_stack([each[:, 0] + each[:, 1], each[:, 1]]) for each in rows)
    return J, J1, J2


def _jerk(coefficients: Floats, t: float) -> Forms:
    """5.69: the jerk of the tool of a 2R of unit links along a course."""
    q, v, a, j = (_course(coefficients, t, order) for order in range(4))
    J, J1, J2 = _rate_of_jacobian(q, v, a)

    def third(h: float) -> Floats:
        p = [point_2r(1.0, 1.0, _course(coefficients, t + k * h)) for k in (-2, -1, 1, 2)]
        return np.asarray((p[3] - 2.0 * p[2] + 2.0 * p[1] - p[0]) / (2.0 * h**3))

    by_differences = (4.0 * third(COARSE) - third(2.0 * COARSE)) / 3.0
    return Forms(J @ a + 2.0 * J1 @ v + J2 @ q, J @ j + 2.0 * J1 @ a + J2 @ v, by_differences)


def _entry_rates(coefficients: Floats, t: float) -> Forms:
    """5.71: the sum of the derivatives of the entries of J times the speeds, against J and against its rate."""
    q, v = _course(coefficients, t), _course(coefficients, t, 1)
    gradients = differences(lambda each: jacobian_2r(1.0, 1.0, each).ravel(), q)
    h = 1e-6
    moved = [jacobian_2r(1.0, 1.0, _course(coefficients, t + k * h)).ravel() for k in (-1, 1)]
    rate = (moved[1] - moved[0]) / (2.0 * h)
    return Forms(jacobian_2r(1.0, 1.0, q).ravel(), rate, gradients @ v)


def _moving(rng: Generator) -> tuple[Floats, float]:
    return np.column_stack(
        [rng.uniform(0.3, 1.2, 2), signed(rng, 0.3, 0.8, 2), signed(rng, 0.1, 0.4, 2), signed(rng, 0.05, 0.2, 2)]
    ), float(rng.uniform(0.1, 0.6))


def _complement(J: Floats) -> Forms:
    """5.77: the dimension of N(J): as that of a dual space of R(J^T), and as that of its complement."""
    rank = int(np.linalg.matrix_rank(J))
    sigma = np.linalg.eigvalsh(J.T @ J)
    return Forms(float(rank), float(J.shape[1] - rank), float((sigma < RANK).sum()))


def _forbidden(J: Floats, v: Floats) -> Forms:
    """5.78: the part of a velocity that cannot be made; as printed there is none outside of N(J^T)."""
    in_null_space = np.linalg.norm(J.T @ v) < RANK
    left = float(np.linalg.norm(v - J @ np.linalg.lstsq(J, v, rcond=None)[0]))
    lost = np.linalg.svd(J)[0][:, -1]
    return Forms(float(np.linalg.norm(v)) if in_null_space else 0.0, abs(float(lost @ v)), left)


def _half_lost(rng: Generator) -> tuple[Floats, Floats]:
    one, other = orthogonal(rng, 2).T
    J = np.outer(one, matrix(rng, 1, 3)[0])
    return J, float(signed(rng, 0.3, 1.5)) * one + float(signed(rng, 0.3, 1.5)) * other


def _rank(first: Floats, second: Floats) -> Forms:
    """5.82: the rank of a 2 x 3 matrix whose outer columns are opposite."""
    J = np.column_stack([first, second, -first])
    said = 1.0 if np.linalg.norm(second) < RANK else 2.0
    return Forms(1.0, said, float(np.linalg.matrix_rank(J)))


def _square_of_sizes(J: Floats) -> Forms:
    """5.84: the determinant that tells singularity, of a matrix with more rows than columns."""
    tall = J.shape[0] > J.shape[1]
    smaller = J.T @ J if tall else J @ J.T
    sigma = np.linalg.svd(J, compute_uv=False)
    return Forms(float(np.linalg.det(J @ J.T)), float(np.linalg.det(smaller)), float(np.prod(sigma**2)))


TRIALS = (
    Trial(
        "5.8",
        "an angular velocity and two differences of points",
        lambda rng: (signed(rng, 0.3, 1.5, 3), *(orthogonal(rng, 3)[:2] + 0.2 * rng.normal(size=(2, 3)))),
        _from_points,
        "largest difference of a component of ω",
        "the ω with which the points were moved",
        unit="rad/s",
    ),
    Trial(
        "5.27",
        "three angles of some hundredths of a radian",
        lambda rng: (rng.uniform(0.01, 0.09, 3),),
        _orders,
        "number of orders of three rotations",
        "the products that differ from each other",
    ),
    Trial(
        "5.43",
        "three angles about fixed axes and their rates",
        lambda rng: (
            np.array([*signed(rng, 0.3, 2.5, 1), *signed(rng, 0.3, 1.2, 1), *signed(rng, 0.3, 2.5, 1)]),
            signed(rng, 0.2, 1.0, 3),
        ),
        _rates,
        "length of the difference of ω",
        "central differences of the rotation matrix",
        1e-7,
        "rad/s",
        "length",
        quiet=Quiet(
            lambda rng: (np.array([0.0, 0.0, rng.uniform(-3.0, 3.0)]), np.array([0.0, 0.0, rng.uniform(0.2, 1.0)])),
            "where only γ differs from 0 and changes",
        ),
    ),
    Trial(
        "5.51",
        "a planar 2R and its joint speeds",
        lambda rng: (*two_links(rng), signed(rng, 0.3, 2.0, 2)),
        _with_angle,
        "largest difference of a component, in m/s and rad/s",
        "central differences of the direct kinematics",
        1e-7,
    ),
    Trial(
        "5.58",
        "a planar 2R",
        two_links,
        _last_vector,
        "largest difference of an entry of J",
        "central differences of the direct kinematics",
        1e-7,
        "m",
    ),
    Trial(
        "5.64",
        "a planar 2R",
        two_links,
        _stored,
        "largest difference of an entry of J",
        "central differences of the direct kinematics",
        1e-7,
        "m",
    ),
    Trial(
        "5.69",
        "a 2R of unit links along cubics in time",
        _moving,
        _jerk,
        "length of the difference of the jerk",
        "third differences of the position in time, extrapolated",
        1e-5,
        "m/s³",
        "length",
    ),
    Trial(
        "5.71",
        "a 2R of unit links along cubics in time",
        _moving,
        _entry_rates,
        "largest difference between the left side and the sum",
        "the sum, by central differences in q; the rate of J by those in time",
        1e-7,
        "m/s",
    ),
    Trial(
        "5.77",
        "a 2 × 3 matrix of full rank",
        lambda rng: (matrix(rng, 2, 3),),
        _complement,
        "dimension of the null space",
        "eigenvalues of JᵀJ",
        quiet=Quiet(lambda rng: (np.vstack([matrix(rng, 2, 4)]),), "where both have the same dimension"),
    ),
    Trial(
        "5.78",
        "a 2 × 3 matrix of rank 1, and a velocity with parts along both directions",
        _half_lost,
        _forbidden,
        "part of the velocity that cannot be made",
        "the smallest error, by least squares",
        unit="m/s",
    ),
    Trial(
        "5.82",
        "two columns",
        lambda rng: tuple(orthogonal(rng, 2)),
        _rank,
        "rank of J",
        "numpy.linalg.matrix_rank",
        quiet=Quiet(lambda rng: (orthogonal(rng, 2)[0], np.zeros(2)), "where the middle column is 0 as well"),
    ),
    Trial(
        "5.84",
        "a well-conditioned 3 × 2 matrix",
        lambda rng: (matrix(rng, 3, 2),),
        _square_of_sizes,
        "determinant, which is 0 of a singular J",
        "the product of the squared singular values",
        quiet=Quiet(lambda rng: (matrix(rng, 2, 3),), "for more columns than rows"),
    ),
)
"""The trials of velocities."""
