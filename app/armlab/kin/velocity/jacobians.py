"""Jacobians in any axes and at any point, of any link, their derivatives, and the motion of the tool.

``J`` is the geometric Jacobian of `armlab.kin.arm.Arm.jacobian`: rows ``(v; omega)`` in world axes at the tool point.
Everything about its derivatives follows from two facts: turning joint k carries along the axes of the joints after it,
and every velocity of the tool that they give; so the derivatives are cross products of its
columns.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import as_floats, finite_floats, together, whole_number
from armlab.kin.euler import euler_angles
from armlab.kin.velocity.rates import angle_rates
from armlab.registry import known_name

Floats = NDArray[np.float64]
Axes = Literal["world", "base", "tool"]

AXES: tuple[Axes, ...] = ("world", "base", "tool")
"""Axes in which the rows of a Jacobian can be given: the world's, those of frame 0, or the tool's."""


@dataclass(frozen=True, eq=False)
class ToolMotion:
    """Velocity, acceleration and jerk of the tool, in world axes at the tool point.

    Attributes
    ----------
    twist : ndarray, shape (..., 6)
        ``(v; omega)``, m/s and rad/s.
    acceleration : ndarray, shape (..., 6)
        Acceleration of the tool point, m/s², and derivative of omega, rad/s².
    jerk : ndarray, shape (..., 6)
        m/s³ and rad/s³.
    """

    twist: Floats
    acceleration: Floats
    jerk: Floats


def jacobian_at(arm: Arm, q: ArrayLike, axes: str = "world", point: ArrayLike | None = None) -> Floats:
    """Return the geometric Jacobian with its rows in chosen axes, at a chosen point of the tool.

    Parameters
    ----------
    arm : Arm
    q : array_like, shape (..., n)
        Radians and metres.
    axes : "world", "base" or "tool"
        The axes of both blocks of rows.
    point : array_like, shape (3,), optional
        The point in the axes of the tool's frame, metres; its origin by default.

    Returns
    -------
    ndarray, shape (..., 6, n)
        Linear, then angular rows.

    Raises
    ------
    UnknownName
        There are no such axes.
    InputError
        q or the point does not fit.

    References
    ----------
    Notes 5.52-5.65 with 5.9.
    """
    known_name("axes", axes, AXES)
    J: Floats = np.array(arm.jacobian(q), dtype=np.float64)
    R = np.asarray(arm.fk(q), dtype=np.float64)[..., :3, :3] if axes == "tool" or point is not None else None
    if point is not None and R is not None:
        lever = R @ finite_floats(point, "point", (3,), "three numbers of metres")
        J[..., :3, :] += _cross(J[..., 3:, :], lever[..., :, None])
    if axes == "world":
        return J
    turned = arm.base[:3, :3] if axes == "base" or R is None else R
    back = np.swapaxes(turned, -1, -2)
    return np.concatenate([back @ J[..., :3, :], back @ J[..., 3:, :]], axis=-2)


def link_jacobian(arm: Arm, q: ArrayLike, link: int, point: ArrayLike = (0.0, 0.0, 0.0)) -> Floats:
    """Return the geometric Jacobian of a point of a link, in world axes.

    Parameters
    ----------
    arm : Arm
    q : array_like, shape (..., n)
    link : int
        0 is the base, link i moves with joints 1 to i.
    point : array_like, shape (3,)
        The point in the axes of frame ``link``, metres; its origin by default.

    Returns
    -------
    ndarray, shape (..., 6, n)
        The columns of joints after the link are zero.

    Raises
    ------
    InputError
        There is no such link, or q or the point does not fit.

    References
    ----------
    Notes 5.56-5.65; p_{i-1,E} of the text before 5.59 is in the axes of frame 0, and not zero for the last joint.
    """
    if whole_number(link, "link", 0) > arm.n:
        raise InputError(f"link: expected 0 to {arm.n}, got {link}")
    frames = np.asarray(arm.frames(q), dtype=np.float64)
    at = finite_floats(point, "point", (3,), "three numbers of metres")
    p = frames[..., link, :3, :3] @ at + frames[..., link, :3, 3]
    on_axis = frames[..., :-1, :, :] if arm.convention == "standard" else frames[..., 1:, :, :]
    z = np.swapaxes(on_axis[..., :3, 2], -1, -2)
    lever = p[..., :, None] - np.swapaxes(on_axis[..., :3, 3], -1, -2)
    moving = np.arange(arm.n) < link
    turning = np.where(arm.revolute & moving, z, 0.0)
    linear = np.where(arm.revolute, _cross(turning, lever), np.where(moving, z, 0.0))
    return np.concatenate([linear, turning], axis=-2)


def analytic_jacobian(arm: Arm, q: ArrayLike, axes: str = "zyx", fixed: bool = False) -> Floats:
    """Return the Jacobian of position and angles of the tool: ``(pdot; phidot) = J_r qdot``.

    Parameters
    ----------
    arm : Arm
    q : array_like, shape (..., n)
    axes : str
        One of `armlab.kin.euler.SEQUENCES`.
    fixed : bool
        Whether the axes stay where they were before the first turn.

    Returns
    -------
    ndarray, shape (..., 6, n)
        Rows are p in the world, then the rates of the principal angles in the order of the sequence.

    Raises
    ------
    InputError
        The orientation is singular for these angles, as `armlab.kin.velocity.rates.angle_rates` says.

    References
    ----------
    Notes 5.47-5.51. In 5.51 J_r (3 x 2) is multiplied by three rates: phidot = q1dot + q2dot is what comes out.
    """
    J = np.asarray(arm.jacobian(q), dtype=np.float64)
    phi = euler_angles(np.asarray(arm.fk(q))[..., :3, :3], axes, fixed=fixed).solutions[..., 0, :]
    columns = np.swapaxes(J[..., 3:, :], -1, -2)
    rates = angle_rates(columns, np.broadcast_to(phi[..., None, :], columns.shape), axes, fixed)
    return np.concatenate([J[..., :3, :], np.swapaxes(rates, -1, -2)], axis=-2)


def jacobian_derivative(arm: Arm, q: ArrayLike) -> Floats:
    """Return the partial derivatives of the geometric Jacobian.

    With j and k the joints, ``dv_j/dq_k = omega_min(j,k) x v_max(j,k)``, which is symmetric, and
    ``domega_j/dq_k = omega_k x omega_j`` for k before j, else 0.

    Parameters
    ----------
    arm : Arm
    q : array_like, shape (..., n)

    Returns
    -------
    ndarray, shape (..., 6, n, n)
        Entry ``[..., i, j, k]`` is the derivative of J_ij by q_k; world axes, at the tool point.

    References
    ----------
    Notes 5.71, where the dot of J is missing. Bruyninckx and De Schutter, *Symbolic differentiation of the velocity
    mapping for a serial kinematic chain*, Mechanism and Machine Theory 31, 1996.
    """
    J = np.asarray(arm.jacobian(q), dtype=np.float64)
    linear, angular = J[..., :3, :], J[..., 3:, :]
    moved, turned = _cross_each(angular, linear), _cross_each(angular, angular)
    upper = np.triu(np.ones((arm.n, arm.n), dtype=bool))
    before_or_same = np.where(upper, moved, np.swapaxes(moved, -1, -2))
    # A product, and no choice: what is no number stays none.
    before = np.swapaxes(np.triu(upper, 1) * turned, -1, -2)
    return np.concatenate([before_or_same, before], axis=-3)


def jacobian_rate(arm: Arm, q: ArrayLike, qdot: ArrayLike) -> Floats:
    """Return Jdot (..., 6, n), the sum of dJ/dq_k qdot_k.

    Parameters
    ----------
    arm : Arm
    q, qdot : array_like, shape (..., n)
        Radians and metres; rad/s and m/s.

    Raises
    ------
    InputError
        Shapes that do not fit.

    References
    ----------
    Notes 5.71, where the dot of J is missing.
    """
    J, speeds = _given(arm, q, qdot=qdot)
    return _rate(J, speeds).rate


def jacobian_acceleration(arm: Arm, q: ArrayLike, qdot: ArrayLike, qddot: ArrayLike) -> Floats:
    """Return the second derivative of J by time, shape (..., 6, n).

    Parameters
    ----------
    arm : Arm
    q, qdot, qddot : array_like, shape (..., n)

    Raises
    ------
    InputError
        Shapes that do not fit.
    """
    J, speeds, second = _given(arm, q, qdot=qdot, qddot=qddot)
    return _second(J, _rate(J, speeds), speeds, second)


def tool_motion(
    arm: Arm, q: ArrayLike, qdot: ArrayLike, qddot: ArrayLike | None = None, qdddot: ArrayLike | None = None
) -> ToolMotion:
    """Return velocity, acceleration and jerk of the tool.

    ``J qdot``, ``J qddot + Jdot qdot`` and ``J qdddot + 2 Jdot qddot + Jddot qdot``.

    Parameters
    ----------
    arm : Arm
    q, qdot : array_like, shape (..., n)
    qddot, qdddot : array_like, shape (..., n), optional
        Zero when left out: joints of constant speed still accelerate the tool.

    Raises
    ------
    InputError
        Shapes that do not fit.

    References
    ----------
    Notes 5.67-5.70; the jerk is printed as ``J qddot + 2 Jdot qdot + Jddot q`` (5.69), one derivative short each.
    """
    none = np.zeros(arm.n)
    higher = {"qddot": none if qddot is None else qddot, "qdddot": none if qdddot is None else qdddot}
    J, speeds, second, third = _given(arm, q, qdot=qdot, **higher)
    found = _rate(J, speeds)
    Jdd = _second(J, found, speeds, second)
    acceleration = _times(J, second) + _times(found.rate, speeds)
    jerk = _times(J, third) + 2.0 * _times(found.rate, second) + _times(Jdd, speeds)
    return ToolMotion(_times(J, speeds), acceleration, jerk)


@dataclass(frozen=True, eq=False)
class _Rate:
    """Jdot and its partial sums: angular velocity up to each joint, and linear velocity of the later ones."""

    rate: Floats
    carried: Floats
    own: Floats
    later: Floats


def _rate(J: Floats, speeds: Floats) -> _Rate:
    """Return Jdot by running sums over the joints.

    v_j turns with the links up to joint j, and is moved by the joints after it across omega_j.
    """
    linear, angular = J[..., :3, :], J[..., 3:, :]
    turning = angular * speeds[..., None, :]
    own = np.cumsum(turning, axis=-1)
    carried = own - turning
    later = _after(linear * speeds[..., None, :])
    moved = _cross(own, linear) + _cross(angular, later)
    return _Rate(np.concatenate([moved, _cross(carried, angular)], axis=-2), carried, own, later)


def _second(J: Floats, found: _Rate, speeds: Floats, second: Floats) -> Floats:
    """Return Jddot, the derivative of the sums in `_rate`."""
    linear, angular = J[..., :3, :], J[..., 3:, :]
    linear_rate, angular_rate = found.rate[..., :3, :], found.rate[..., 3:, :]
    fast, faster = speeds[..., None, :], second[..., None, :]
    turning = angular_rate * fast + angular * faster
    own = np.cumsum(turning, axis=-1)
    later = _after(linear_rate * fast + linear * faster)
    moved = (
        _cross(own, linear)
        + _cross(found.own, linear_rate)
        + _cross(angular_rate, found.later)
        + _cross(angular, later)
    )
    turned = _cross(own - turning, angular) + _cross(found.carried, angular_rate)
    return np.concatenate([moved, turned], axis=-2)


def _after(columns: Floats) -> Floats:
    """Return for each column the sum of those after it."""
    return np.asarray(columns.sum(axis=-1, keepdims=True) - np.cumsum(columns, axis=-1))


def _cross(a: Floats, b: Floats) -> Floats:
    """Return cross products of columns, shapes (..., 3, n); several times as fast as NumPy's."""
    x, y, z = a[..., 0, :], a[..., 1, :], a[..., 2, :]
    u, v, w = b[..., 0, :], b[..., 1, :], b[..., 2, :]
    return np.stack([y * w - z * v, z * u - x * w, x * v - y * u], axis=-2)


def _cross_each(a: Floats, b: Floats) -> Floats:
    """Return the cross product of each column of a with each of b, shape (..., 3, n, n), from shapes (..., 3, n)."""
    x, y, z = a[..., 0, :, None], a[..., 1, :, None], a[..., 2, :, None]
    u, v, w = b[..., 0, None, :], b[..., 1, None, :], b[..., 2, None, :]
    return np.stack([y * w - z * v, z * u - x * w, x * v - y * u], axis=-3)


def _times(J: Floats, speeds: Floats) -> Floats:
    return np.asarray((J @ speeds[..., None])[..., 0])


def _given(arm: Arm, q: ArrayLike, **rates: ArrayLike) -> list[Floats]:
    """Return the Jacobian and the joint rates by name, each (..., n), in batches that fit."""
    J = np.asarray(arm.jacobian(q), dtype=np.float64)
    found = {name: _speeds(values, arm, name) for name, values in rates.items()}
    together(q=J.shape[:-2], **{name: values.shape[:-1] for name, values in found.items()})
    return [J, *found.values()]


def _speeds(values: ArrayLike, arm: Arm, where: str) -> Floats:
    found = as_floats(values, where, f"numbers of shape (..., {arm.n})")
    if found.shape[-1:] != (arm.n,):
        raise InputError(f"{where}: expected shape (..., {arm.n}), got {found.shape}")
    return found
