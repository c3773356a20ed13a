"""Two joints of a planar arm: two equations in two unknowns, their determinant over the square of joint values."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.solve.state import Solve
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.velocity.answer import Answer, answer
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, State

Array = NDArray[np.float64]

CELLS = 72
"""Number of cells along each side of the square in which the singular set is looked for."""

POINTS = 181
"""Number of points of the curve of joint speeds over the second joint."""

NEVER = 1e-9
"""Determinant, over the square of the length scale, below which it is zero."""


@dataclass(frozen=True, eq=False)
class Flat:
    """Two equations J qdot = v in the speeds of two joints, with the others held still.

    Attributes
    ----------
    J : ndarray, shape (2, 2)
        Rows: the two coordinates of the plane, m/s; columns: the two joints.
    v : ndarray, shape (2,)
    letters : str
        Names of the coordinates.
    answer : Answer
    """

    J: Array
    v: Array
    letters: str
    answer: Answer

    @property
    def determinant(self) -> float:
        """Return det J."""
        return float(np.linalg.det(self.J))


def refusal(state: State) -> str:
    """Return why the pictures cannot be drawn for this arm; empty if they can."""
    arm = state[Joints].arm
    if arm.n < 2:
        return "The pictures need two joints; this arm has one."
    if not suits(arm):
        return (
            "This page draws the speeds of two joints as points of a plane. It needs parallel axes, along z of frame "
            "0, that move the tool in a plane."
        )
    first, second = state[Solve].pair
    for k in (first, second):
        if not arm.revolute[k] and not _moves_in_plane(arm, k):
            return f"Joint {k + 1} slides out of the plane of the others: choose another."
    return ""


def suits(arm: Arm) -> bool:
    """Return whether some two joints of an arm can be in the pictures: its axes are parallel to z of frame 0."""
    return arm.n >= 2 and arm.description.axes_parallel and len(arm.task.position) >= 2


def suited() -> dict[str, str]:
    """Return key and name of the arms of the lab that can be in the pictures, those with the fewest joints first."""
    robots = catalogue().robots.values()
    return {each.key: each.name for each in sorted(robots, key=lambda each: each.arm.n) if suits(each.arm)}


def _moves_in_plane(arm: Arm, k: int) -> bool:
    J = _rows(arm, np.zeros((1, arm.n)))[0]
    return bool(np.abs(J[:, k]).max() > NEVER)


def letters_of(arm: Arm) -> str:
    """Return the two coordinates of the plane."""
    return arm.task.position[:2]


def flat(state: State) -> Flat:
    """Return the two equations of a state; see `refusal`."""
    joints, part = state[Joints], state[Solve]
    arm = joints.arm
    J = _rows(arm, joints.q[None])[0][:, list(part.pair)]
    v = np.array(part.twist[:2])
    return Flat(J, v, letters_of(arm), answer(J, v))


@dataclass(frozen=True, eq=False)
class Square:
    """The square of the values of two joints, a torus cut open where both turn.

    Attributes
    ----------
    low, high : ndarray, shape (2,)
        rad or m: a whole turn of a joint that turns, the stroke of one that slides.
    singular : ndarray, shape (k, 2, 2)
        Pieces of the curves where det J = 0: ends, then the two joint values.
    always : bool
        Whether det J is zero everywhere.
    """

    low: Array
    high: Array
    singular: Array
    always: bool


Key = tuple[Arm, tuple[int, int], bytes]
"""Arguments of the square: the arm, the two joints, and the values of all joints, with the two at zero."""


def key_of(state: State) -> Key:
    """Return the arguments of the square in a state."""
    part, joints = state[Solve], state[Joints]
    others = np.array(joints.q)
    others[list(part.pair)] = 0.0
    return joints.arm, part.pair, others.tobytes()


def square(state: State) -> Square:
    """Return the square of a state."""
    return _square(key_of(state))


@lru_cache(maxsize=64)
def _square(key: Key) -> Square:
    arm, pair, _ = key
    low = np.array([-math.pi if arm.revolute[k] else arm.limits[k, 0] for k in pair])
    high = np.array([math.pi if arm.revolute[k] else arm.limits[k, 1] for k in pair])
    # Half a cell off the ends: the notes' singular sets, 0 and 180 degrees, must not lie on the corners.
    ends = [
        np.linspace(a - (b - a) / CELLS / 2, b + (b - a) / CELLS / 2, CELLS + 2) for a, b in zip(low, high, strict=True)
    ]
    across, up = np.meshgrid(*ends, indexing="ij")
    values = _determinants(key, np.stack([across.ravel(), up.ravel()], axis=1)).reshape(across.shape)
    if float(np.abs(values).max()) <= NEVER * arm.length_scale**2:
        return Square(low, high, np.zeros((0, 2, 2)), True)
    return Square(low, high, contour(ends[0], ends[1], values), False)


def _determinants(key: Key, values: Array) -> Array:
    """Return det J for values (N, 2) of the two joints."""
    arm, pair, others = key
    q = np.repeat(np.frombuffer(others)[None], len(values), axis=0)
    q[:, list(pair)] = values
    J = _rows(arm, q)[:, :, list(pair)]
    return np.asarray(J[:, 0, 0] * J[:, 1, 1] - J[:, 0, 1] * J[:, 1, 0])


def _rows(arm: Arm, q: Array) -> Array:
    """Return the rows of the two coordinates of the plane, (N, 2, n), in the axes of frame 0."""
    turned = arm.base[:3, :3].T @ np.asarray(arm.jacobian(q), dtype=np.float64)[:, :3]
    return np.asarray(turned[:, ["xyz".index(letter) for letter in letters_of(arm)]])


def contour(x: Array, y: Array, values: Array) -> Array:
    """Return the pieces (k, 2, 2) of the zero set of values (len(x), len(y)) on a grid, as straight lines in each cell.

    A cell whose corners change sign four times gets both pairs of neighbouring edges joined.
    """
    pieces = []
    positive = values > 0.0
    mixed = positive[:-1, :-1].astype(int) + positive[1:, :-1] + positive[1:, 1:] + positive[:-1, 1:]
    for i, j in np.argwhere((mixed > 0) & (mixed < 4)).tolist():
        corners = ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))
        found = []
        for (a, b), (c, d) in zip(corners, (*corners[1:], corners[0]), strict=True):
            one, other = values[a, b], values[c, d]
            if (one > 0.0) != (other > 0.0):
                s = one / (one - other)
                found.append((x[a] + s * (x[c] - x[a]), y[b] + s * (y[d] - y[b])))
        pieces += [found[k : k + 2] for k in range(0, len(found), 2)]
    return np.array(pieces).reshape(-1, 2, 2)


@dataclass(frozen=True, eq=False)
class NormCurve:
    """Size of the joint speeds against det J for all values of the second joint.

    Attributes
    ----------
    determinant, norm : ndarray, shape (N,)
        m² (or m) and rad/s (or as the joints have it); the norm is infinite where no joint speeds give v.
    """

    determinant: Array
    norm: Array


def norm_curve(state: State) -> NormCurve:
    """Return the curve of a state."""
    part, joints = state[Solve], state[Joints]
    arm, (first, second) = joints.arm, part.pair
    low, high = (-math.pi, math.pi) if arm.revolute[second] else arm.limits[second]
    q = np.repeat(np.array(joints.q)[None], POINTS, axis=0)
    q[:, second] = np.linspace(low, high, POINTS)
    J = _rows(arm, q)[:, :, [first, second]]
    determinant = J[:, 0, 0] * J[:, 1, 1] - J[:, 0, 1] * J[:, 1, 0]
    v = np.array(part.twist[:2])
    times = np.stack([J[:, 1, 1] * v[0] - J[:, 0, 1] * v[1], J[:, 0, 0] * v[1] - J[:, 1, 0] * v[0]], axis=1)
    size = np.linalg.norm(times, axis=1)
    some = np.abs(determinant) > NEVER * arm.length_scale**2
    return NormCurve(determinant, np.where(some, size / np.where(some, np.abs(determinant), 1.0), np.inf))


@dataclass(frozen=True)
class StandAt(Command):
    """Move the two joints to a place in their square.

    Parameters
    ----------
    across, up : float
        Parts of the square, 0 to 1, from the lower left corner.
    """

    across: float
    up: float
    label: ClassVar[str] = "move in the square"

    def apply(self, state: State) -> State:
        """Return the state with the joints at that place, or at their limits."""
        why = refusal(state)
        if why:
            raise InputError(why)
        parts = np.array([self.across, self.up])
        if not np.isfinite(parts).all():
            raise InputError(f"place in the square: expected two numbers from 0 to 1, got {parts.tolist()}")
        found, joints = square(state), state[Joints]
        q = np.array(joints.q)
        q[list(state[Solve].pair)] = found.low + np.clip(parts, 0.0, 1.0) * (found.high - found.low)
        moved = joints.moved_to(q)
        return state if moved is joints else state.replace(moved)


@dataclass(frozen=True)
class DragTo(StandAt):
    """Drag the two joints through their square; this is one event of a drag.

    Parameters
    ----------
    drag : int
        Which drag it belongs to: one drag is one step of undo.
    """

    drag: int = 0
    snapshot: ClassVar[bool] = True

    @property
    def stroke(self) -> object:
        """Make one step of history of one drag."""
        return DragTo, self.drag
