"""The errors of the tool that the drives leave open: the worst case by J, and a cloud by forward kinematics."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.benches.drive.joint.state import Drives
from armlab.kin.arm import Arm
from armlab.kin.drive.tool_error import Worst, by_jacobian, by_kinematics, corners, inside, shares, worst
from armlab.session.parts.joints import Joints
from armlab.session.round_numbers import round_below
from armlab.session.state import State

Floats = NDArray[np.float64]

INSIDE, SEED = 400, 2
"""Number of points inside the box of joint errors, and the seed of their random numbers."""

DRAWN = 0.4
"""Size of the largest error that any configuration can have, as it is drawn, in reaches of the arm."""


class ToolErrors(NamedTuple):
    """Errors of the tool at a configuration.

    Attributes
    ----------
    J : ndarray, shape (6, n)
    half : ndarray, shape (n,)
        Half width of the interval of each joint, rad or m.
    position, orientation : Worst
        m and rad.
    position_shares, orientation_shares : ndarray, shape (n,)
        What each joint causes by itself, m and rad.
    """

    J: Floats
    half: Floats
    position: Worst
    orientation: Worst
    position_shares: Floats
    orientation_shares: Floats

    @property
    def generators(self) -> Floats:
        """Errors of the position that each joint causes, as columns (3, n), m."""
        return np.asarray(self.J[:3] * self.half)


class Compared(NamedTuple):
    """Both ways to the error of the tool over the corners of the box and points inside it.

    Attributes
    ----------
    corners, inside : int
        How many points of each kind.
    positions : ndarray, shape (k, 3)
        Errors of the position by forward kinematics, the corners first, m.
    largest_position, largest_orientation : float
        The largest errors by forward kinematics: the true largest ones are at least as large, m and rad.
    position_apart, orientation_apart : float
        Largest differences between J and forward kinematics, m and rad.
    """

    corners: int
    inside: int
    positions: Floats
    largest_position: float
    largest_orientation: float
    position_apart: float
    orientation_apart: float


def errors_at(part: Drives, q: Floats) -> ToolErrors:
    """Return the errors at any configuration."""
    J, half = np.asarray(part.arm.jacobian(q), dtype=np.float64), part.drives.half_width
    return ToolErrors(J, half, worst(J[:3], half), worst(J[3:], half), shares(J[:3], half), shares(J[3:], half))


def errors_of(state: State) -> ToolErrors:
    """Return the errors at the present configuration."""
    return errors_at(state[Drives], state[Joints].q)


def cloud_at(part: Drives, q: Floats) -> Floats:
    """Return errors of the position by forward kinematics, the corners first, m, shape (k, 3)."""
    return by_kinematics(part.arm, q, box(part.arm) * part.drives.half_width)[0]


def compared(state: State) -> Compared:
    """Return both ways side by side at the present configuration."""
    part, q, found = state[Drives], state[Joints].q, state.derived(errors_of)
    dq = box(part.arm) * found.half
    positions, turned = by_kinematics(part.arm, q, dq)
    linear_positions, linear_turned = by_jacobian(found.J, dq)
    return Compared(
        2**part.arm.n,
        INSIDE,
        positions,
        _longest(positions),
        _longest(turned),
        _longest(positions - linear_positions),
        _longest(turned - linear_turned),
    )


def box(arm: Arm) -> Floats:
    """Return all corners of the box from -1 to 1, and points inside, shape (2^n + `INSIDE`, n)."""
    return np.concatenate([corners(arm.n), inside(arm.n, INSIDE, SEED)])


def magnified(part: Drives) -> float:
    """Return how many times as large errors are drawn: a round number, the same in every configuration; 0 for none."""
    arm = part.arm
    most = float(levers(arm) @ part.drives.half_width)
    return round_below(DRAWN * 2.0 * arm.length_scale / most) if most > 0.0 else 0.0


def levers(arm: Arm) -> Floats:
    """Return by how much the tool moves for a unit of each joint, at most: m for rad, 1 for m, shape (n,).

    For a joint that turns it is the sum of all lengths from it to the tool.
    """
    slides = np.where(arm.revolute, 0.0, np.abs(arm.limits).max(axis=1))
    lengths = np.array([abs(row.a) + abs(row.d) for row in arm.rows]) + slides
    beyond = np.cumsum(lengths[::-1])[::-1] + float(np.linalg.norm(arm.tool[:3, 3]))
    return np.where(arm.revolute, beyond, 1.0)


def _longest(vectors: Floats) -> float:
    return float(np.sqrt(np.einsum("ki,ki->k", vectors, vectors).max()))
