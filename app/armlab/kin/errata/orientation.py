"""Trials of chapter 3: rotation matrices, axis and angle, quaternions, Euler and RPY angles, homogeneous matrices."""

from __future__ import annotations

import math

import numpy as np
from scipy.spatial.transform import Rotation  # type: ignore[import-untyped]

from armlab.kin.axis_angle import angle_by_atan2
from armlab.kin.errata.arms import point_2r
from armlab.kin.errata.draws import Floats, Generator, direction, either, matrix, orthogonal, rotation, signed
from armlab.kin.errata.quaternion_signs import by_signs, matrix_of
from armlab.kin.errata.trial import Forms, Quiet, Trial
from armlab.kin.rotations import quaternion_from_rotation, rotation_about, rotation_from_axis_angle, skew

SCIPY = "scipy.spatial.transform.Rotation"
CLEAR = ((0.3, 1.3), (1.8, 2.8))
"""Angles of a rotation away from 0, a quarter and a half of a turn, radians."""


def _cosine(R: Floats) -> Forms:
    """3.5: the angle between the x axes of two frames, from the entry in row 1 and column 1."""
    x, moved = np.eye(3)[0], R[:, 0]
    between = math.atan2(float(np.linalg.norm(np.cross(x, moved))), float(x @ moved))
    return Forms(R[0, 0], math.acos(R[0, 0]), between)


def _turned(alpha: float, theta: float, length: float) -> Forms:
    """Between 3.15 and 3.16: a vector at the angle alpha, turned by theta about z."""
    x, y = length * math.cos(alpha), length * math.sin(alpha)

    def with_angle(other: float) -> list[float]:
        return [
            x * math.cos(theta) - y * math.sin(other),
            x * math.sin(theta) + y * math.cos(other),
            0.0,
        ]

    judge = Rotation.from_euler("z", theta).apply([x, y, 0.0])
    return Forms(with_angle(alpha), with_angle(theta), judge)


def _quadrant(x: float, y: float) -> Forms:
    """Before 3.15: atan2 in the range from 0 to 2 pi, and by the branches of 3.15."""
    by_branches = math.atan(y / x)
    if x < 0.0:
        by_branches += math.pi if y >= 0.0 else -math.pi
    return Forms(math.atan2(y, x) % (2.0 * math.pi), by_branches, math.atan2(y, x))


def _outer(C: Floats) -> Forms:
    """3.35: the product of a matrix and its transpose, as a sum over its columns."""
    return Forms(C.T @ C, C @ C.T, sum(np.outer(column, column) for column in C.T))


def _skewed(v: Floats, u: Floats) -> Forms:
    """3.41 to 3.44: S(v) u; the printed dot product is one number."""
    return Forms(float(v @ u), skew(v) @ u, np.cross(v, u))


def _characteristic(R: Floats) -> Forms:
    """3.60: the polynomial at a complex eigenvalue of R."""
    root = max(np.linalg.eigvals(R), key=lambda each: abs(each.imag))
    cosine = (np.trace(R) - 1.0) / 2.0
    return Forms(abs(root**2 + 2.0 * cosine * root + 1.0), abs(root**2 - 2.0 * cosine * root + 1.0), 0.0)


def _angle(R: Floats) -> Forms:
    """3.66: the angle of a rotation, with the positive sign."""
    return Forms(float(angle_by_atan2(R, 0.5)), float(angle_by_atan2(R)), Rotation.from_matrix(R).magnitude())


def _no_turn(axis: Floats) -> Forms:
    """3.67: whether an axis is a solution for R = I, 1 if it is."""
    away = np.abs(Rotation.from_rotvec(0.0 * axis).as_matrix() - np.eye(3)).max()
    found = np.abs(np.asarray(rotation_from_axis_angle(axis, 0.0)) - np.eye(3)).max()
    return Forms(0.0, float(found < 1e-12), float(away < 1e-12))


def _second_sign(R: Floats) -> Forms:
    """3.78: R from its own quaternion."""
    return Forms(matrix_of(by_signs(R, (2, 1))), matrix_of(by_signs(R, (2, 0))), R)


def _half_turn(R: Floats) -> Forms:
    """3.77 to 3.79: R from its own quaternion, by signs and by the largest component."""
    return Forms(matrix_of(by_signs(R, (2, 0))), matrix_of(np.asarray(quaternion_from_rotation(R))), R)


def _about(rng: Generator, angle: float) -> tuple[Floats]:
    axis = direction(rng)
    if angle == math.pi:
        return (2.0 * np.outer(axis, axis) - np.eye(3),)
    return (np.asarray(rotation_from_axis_angle(axis, angle)),)


def _angles(rng: Generator) -> tuple[float, float, float]:
    """Return three angles, radians, the middle one away from every singularity."""
    first, last = rng.uniform(-3.0, 3.0, 2).tolist()
    return first, float(signed(rng, 0.3, 1.2)), last


def _zxz_entry(phi: float, theta: float, psi: float) -> Forms:
    """3.82: row 2, column 1 of R_z(phi) R_x(theta) R_z(psi)."""
    rest = math.cos(phi) * math.cos(theta) * math.sin(psi)
    judge = Rotation.from_euler("ZXZ", [phi, theta, psi]).as_matrix()[1, 0]
    return Forms(math.sin(phi) * math.sin(psi) + rest, math.sin(phi) * math.cos(psi) + rest, judge)


def _singular(phi: float, theta: float, psi: float) -> Forms:
    """After 3.94: the matrix where sin(theta) is 0."""
    over = math.cos(theta) < 0.0
    known = rotation_about("z", phi - psi if over else phi + psi) @ rotation_about("x", math.pi if over else 0.0)
    judge = Rotation.from_euler("ZXZ", [phi, theta, psi]).as_matrix()
    return Forms(rotation_about("z", phi + psi), known, judge)


def _rpy(psi: float, theta: float, phi: float) -> Floats:
    return np.asarray(Rotation.from_euler("xyz", [psi, theta, phi]).as_matrix())


def _rpy_12(psi: float, theta: float, phi: float) -> Forms:
    """3.103: row 1, column 2 of R_z(phi) R_y(theta) R_x(psi)."""
    rest = -math.sin(phi) * math.cos(psi)
    first = math.cos(phi) * math.sin(psi)
    return Forms(first + rest, first * math.sin(theta) + rest, _rpy(psi, theta, phi)[0, 1])


def _rpy_23(psi: float, theta: float, phi: float) -> Forms:
    """3.103: row 2, column 3 of R_z(phi) R_y(theta) R_x(psi)."""
    rest = -math.cos(phi) * math.sin(psi)
    first = math.sin(phi) * math.sin(theta)
    return Forms(first * math.cos(phi) + rest, first * math.cos(psi) + rest, _rpy(psi, theta, phi)[1, 2])


def _coordinates(R: Floats, p: Floats) -> Forms:
    """Before 3.109: the coordinates in A of a vector that is known in B; the axes of B are the columns of R."""
    along = sum(component * axis for component, axis in zip(p, R.T, strict=True))
    return Forms(R.T @ p, R @ p, along)


def _homogeneous(R: Floats, origin: Floats, p: Floats) -> Forms:
    """3.112: the change of coordinates as one product; the blocks as they are printed do not fit together."""
    T = np.vstack([np.column_stack([R, origin]), [0.0, 0.0, 0.0, 1.0]])
    return Forms(None, T @ [*p, 1.0], [*(origin + R @ p), 1.0])


def _second_robot(distance: float, bearing: float, phi: float) -> Forms:
    """3.132: how far the tool of robot B stays from its pose, with two and with three unit links."""
    p = distance * np.array([math.cos(bearing), math.sin(bearing)])
    wrist = p - [math.cos(phi), math.sin(phi)]
    q2 = math.acos((wrist @ wrist - 2.0) / 2.0)
    q1 = math.atan2(wrist[1], wrist[0]) - q2 / 2.0
    tool = point_2r(1.0, 1.0, [q1, q2]) + np.array([math.cos(phi), math.sin(phi)])
    nearest = point_2r(1.0, 1.0, [bearing, 0.0])
    return Forms(float(np.linalg.norm(nearest - p)), float(np.linalg.norm(tool - p)), 0.0)


def _out_of_two(rng: Generator) -> tuple[float, float, float]:
    distance, bearing = float(rng.uniform(2.05, 2.8)), float(rng.uniform(-3.0, 3.0))
    return distance, bearing, bearing + float(rng.uniform(-0.3, 0.3))


TRIALS = (
    Trial(
        "3.5",
        "a rotation about any axis",
        lambda rng: (rotation(rng, 0.3, 2.8),),
        _cosine,
        "angle between both x axes",
        "the length of their cross product and their scalar product",
        1e-7,
        "rad",
    ),
    Trial(
        "3.15b",
        "the angle of a vector, the angle of its turn, and its length",
        lambda rng: (float(rng.uniform(0.2, 1.3)), float(rng.uniform(1.6, 2.9)), float(rng.uniform(0.5, 2.0))),
        _turned,
        "length of the difference of the vectors",
        SCIPY,
        unit="m",
        norm="length",
    ),
    Trial(
        "3.15t",
        "a point below the x axis",
        lambda rng: (float(signed(rng, 0.2, 2.0)), -float(rng.uniform(0.2, 2.0))),
        _quadrant,
        "value of atan2",
        "the function atan2 of the computer",
        unit="rad",
        quiet=Quiet(
            lambda rng: (float(signed(rng, 0.2, 2.0)), float(rng.uniform(0.2, 2.0))), "for a point above the x axis"
        ),
    ),
    Trial(
        "3.35",
        "any 3 × 3 matrix",
        lambda rng: (matrix(rng, 3, 3),),
        _outer,
        "largest difference of an entry",
        "the sum of the outer products of its columns",
        quiet=Quiet(lambda rng: (orthogonal(rng, 3),), "for an orthogonal matrix, for which both products are I"),
    ),
    Trial(
        "3.41",
        "two vectors",
        lambda rng: (signed(rng, 0.3, 2.0, 3), signed(rng, 0.3, 2.0, 3)),
        _skewed,
        "largest difference of a component",
        "numpy.cross",
    ),
    Trial(
        "3.60",
        "a rotation about any axis",
        lambda rng: _about(rng, either(rng, *CLEAR)),
        _characteristic,
        "value of the polynomial at an eigenvalue, which is to be 0",
        "the eigenvalues of the matrix by numpy.linalg.eigvals",
    ),
    Trial(
        "3.66",
        "a rotation about any axis",
        lambda rng: _about(rng, either(rng, *CLEAR)),
        _angle,
        "angle of the rotation",
        SCIPY,
        unit="rad",
        quiet=Quiet(lambda rng: _about(rng, math.pi / 2.0), "for a quarter turn, where the second argument is 0"),
    ),
    Trial(
        "3.67",
        "a unit vector",
        lambda rng: (direction(rng),),
        _no_turn,
        "whether it is an axis of R = I, 1 if it is",
        SCIPY,
    ),
    Trial(
        "3.78",
        "a rotation about any axis",
        lambda rng: (rotation(rng),),
        _second_sign,
        "largest difference of an entry of R from its own quaternion",
        "the matrix itself",
        1e-7,
        somewhere="where both differences have opposite signs",
    ),
    Trial(
        "3.77",
        "half a turn about any axis",
        lambda rng: _about(rng, math.pi),
        _half_turn,
        "largest difference of an entry of R from its own quaternion",
        "the matrix itself",
        1e-7,
        quiet=Quiet(lambda rng: (rotation(rng),), "away from half a turn"),
    ),
    Trial("3.82", "three angles", _angles, _zxz_entry, "entry in row 2, column 1", SCIPY),
    Trial(
        "3.94",
        "two angles, with θ = π",
        lambda rng: (float(rng.uniform(-3.0, 3.0)), math.pi, float(signed(rng, 0.3, 2.8))),
        _singular,
        "largest difference of an entry",
        SCIPY,
        quiet=Quiet(
            lambda rng: (float(rng.uniform(-3.0, 3.0)), 0.0, float(rng.uniform(-3.0, 3.0))), "at the other one, θ = 0"
        ),
    ),
    Trial("3.103a", "three angles", _angles, _rpy_12, "entry in row 1, column 2", SCIPY),
    Trial("3.103b", "three angles", _angles, _rpy_23, "entry in row 2, column 3", SCIPY),
    Trial(
        "3.109",
        "a frame and a vector",
        lambda rng: (rotation(rng), signed(rng, 0.3, 1.0, 3)),
        _coordinates,
        "largest difference of a coordinate",
        "adding up the axes of frame B",
        unit="m",
    ),
    Trial(
        "3.112",
        "a frame and a point",
        lambda rng: (rotation(rng), signed(rng, 0.1, 1.0, 3), signed(rng, 0.1, 1.0, 3)),
        _homogeneous,
        "largest difference of a coordinate",
        "the formula 3.109 without a matrix of four columns",
        unit="m",
    ),
    Trial(
        "3.132",
        "a pose beyond two unit links, turned outward",
        _out_of_two,
        _second_robot,
        "distance of the tool from the point that is asked for",
        "the point itself",
        unit="m",
    ),
)
"""The trials of the chapter."""
