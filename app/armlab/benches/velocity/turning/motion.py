"""Rotation of a body by three angles and their rates, two time laws of omega, and the commutation of rotations."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.speeds.motion import speeds_of
from armlab.benches.velocity.turning.state import CLIP_KEY, Turning
from armlab.kin.euler import SINGULAR_SINE, euler_angles
from armlab.kin.rotations import axis_angle, rotation_about, rotation_from_sequence, skew
from armlab.kin.velocity.jacobians import analytic_jacobian
from armlab.kin.velocity.rates import lost_axis, rate_determinant, rate_matrix
from armlab.kin.velocity.rigid import angular_velocity, turned_by
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Timeline
from armlab.session.state import State

Floats = NDArray[np.float64]

QUARTER = math.radians(90.0)

LAWS: tuple[tuple[tuple[float, float, float], ...], ...] = (
    ((0.0, 0.0, QUARTER), (QUARTER, 0.0, 0.0)),
    ((QUARTER, 0.0, 0.0), (0.0, 0.0, QUARTER)),
)
"""Time laws of notes 5.19: omega in the first and in the second second, rad/s."""

DURATION = {"angles": 4.0, "laws": 2.0}
"""Duration of the film, seconds."""

INSTANT = 1e-5
"""Time before and after, seconds, between which R is compared."""

SIZES = (0.1, 0.01, 0.001)
"""Angles of the turns whose order is changed, radians."""


@dataclass(frozen=True, eq=False)
class Turned:
    """A body whose orientation is given by three angles.

    Attributes
    ----------
    angles : ndarray, shape (3,)
        At present, radians.
    R, T : ndarray, shape (3, 3)
        Its orientation, and the matrix with ``omega = T phidot``.
    omega : ndarray, shape (3,)
        In the fixed axes, rad/s.
    determinant : float
        Of T.
    lost : ndarray, shape (3,)
        Across the first two axes of the turns: where det T is 0, what no rates turn the body about.
    measured : ndarray, shape (3,)
        omega from R shortly before and after.
    """

    angles: Floats
    R: Floats
    T: Floats
    omega: Floats
    determinant: float
    lost: Floats
    measured: Floats


def film_time(state: State) -> float:
    """Return the time of the film, seconds; 0 while it is closed."""
    timeline = state[Timeline]
    return timeline.time if timeline.clip == CLIP_KEY else 0.0


def turned_of(state: State) -> Turned:
    """Return the body at the time of the film, with the angles growing with their rates."""
    part = state[Turning]
    rates = np.array(part.rates)
    angles = np.array(part.angles) + film_time(state) * rates
    R = _rotation(part, angles)
    T = rate_matrix(angles, part.axes, part.fixed)
    before, after = (_rotation(part, angles + step * rates) for step in (-INSTANT, INSTANT))
    return Turned(
        angles,
        R,
        T,
        T @ rates,
        float(rate_determinant(angles, part.axes, part.fixed)),
        lost_axis(angles, part.axes, part.fixed),
        angular_velocity(R, (after - before) / (2.0 * INSTANT)),
    )


def _rotation(part: Turning, angles: Floats) -> Floats:
    return np.asarray(rotation_from_sequence(part.axes, angles, fixed=part.fixed), dtype=np.float64)


def law_rotation(law: int, time: float) -> Floats:
    """Return the orientation at a time (0 to 2 s) of one of the `LAWS`, 0-based."""
    return turned_by(LAWS[law], [min(time, 1.0), max(time - 1.0, 0.0)])


def laws_time(state: State) -> float:
    """Return the time at which the two laws are shown: that of their film, or its end."""
    return film_time(state) if state[Timeline].clip == CLIP_KEY else DURATION["laws"]


def law_integral(time: float, law: int = 0) -> Floats:
    """Return the integral of omega up to a time, radians."""
    first, second = np.array(LAWS[law])
    return np.asarray(min(time, 1.0) * first + max(time - 1.0, 0.0) * second)


def between(A: Floats, B: Floats) -> float:
    """Return the angle of the single rotation from one orientation to another, radians."""
    return float(axis_angle(A.T @ B)[1])


@dataclass(frozen=True)
class Commuting:
    """Small turns about x, y and z by equal angles, in all orders.

    Attributes
    ----------
    size : float
        Radians.
    apart : float
        Largest difference of an entry between two of the six products.
    from_sum : float
        Largest difference of an entry from ``I + S(dphi)``.
    """

    size: float
    apart: float
    from_sum: float


@dataclass(frozen=True, eq=False)
class ToolAngles:
    """The angles of the tool in the chosen sequence, and their rates.

    Attributes
    ----------
    angles : ndarray, shape (3,)
        The principal ones, radians.
    J : ndarray, shape (3, n), or None
        The angular half of the analytic Jacobian; None where the orientation is singular for these angles.
    rates : ndarray, shape (3,), or None
        ``phidot = J qdot`` with the joint speeds that are chosen, rad/s.
    omega : ndarray, shape (3,)
        Of the tool, rad/s.
    """

    angles: Floats
    J: Floats | None
    rates: Floats | None
    omega: Floats


def tool_angles_of(state: State) -> ToolAngles:
    """Return the angles of the tool and their rates (notes 5.47-5.51)."""
    part, joints, speeds = state[Turning], state[Joints], state.derived(speeds_of)
    angles = euler_angles(joints.tool_pose[:3, :3], part.axes, fixed=part.fixed).solutions[0]
    omega = np.asarray(joints.arm.jacobian(joints.q)[3:] @ speeds)
    if abs(float(rate_determinant(angles, part.axes, part.fixed))) < SINGULAR_SINE:
        return ToolAngles(angles, None, None, omega)
    J = analytic_jacobian(joints.arm, joints.q, part.axes, part.fixed)[3:]
    return ToolAngles(angles, J, np.asarray(J @ speeds), omega)


@cache
def commuting() -> tuple[Commuting, ...]:
    """Return the differences between the six orders, for turns of each of `SIZES` (notes 5.22-5.27)."""
    found = []
    for size in SIZES:
        turns = {axis: rotation_about(axis, size) for axis in "xyz"}
        products = [turns[a] @ turns[b] @ turns[c] for a, b, c in itertools.permutations("xyz")]
        apart = max(float(np.abs(one - other).max()) for one, other in itertools.combinations(products, 2))
        first_order = np.eye(3) + skew([size] * 3)
        found.append(Commuting(size, apart, max(float(np.abs(each - first_order).max()) for each in products)))
    return tuple(found)
