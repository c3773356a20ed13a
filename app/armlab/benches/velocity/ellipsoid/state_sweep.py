"""The joint that sweeps through its range, and the manipulability on the way."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from armlab.benches.velocity.ellipsoid.state import Manipulability, VelocityBlock
from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.easing import eased
from armlab.kin.ellipsoid import SingularPlaces, measures, singular_places
from armlab.session.fields import FieldPart, number, whole
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Command, PartType, State

Array = NDArray[np.float64]

CLIP_KEY = "sweep"

SECONDS = 8.0

POINTS = 361
"""Number of points of a curve."""

UNTOUCHED = 1e-9
"""Distance, rad or m, from the value of the sweep within which the student has not moved the joint."""


@dataclass(frozen=True, eq=False)
class Sweep(FieldPart):
    """The joint that moves while the others stay.

    Attributes
    ----------
    arm : Arm
    joint : int
        0-based.
    start : float or None
        Where it stood when the clip was opened, rad or m; None while the clip is not open.
    """

    key: ClassVar[str] = "sweep"
    kept_by_undo: ClassVar[bool] = True

    arm: Arm
    joint: int = whole("joint that sweeps, 0-based", 0, 0, kept="")
    start: float | None = number("", "where it stood when the film was opened", None, kept="")

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the second joint: the first one turns the whole arm and does not change w."""
        return cls(robot.arm, min(1, robot.arm.n - 1))

    def check(self) -> None:
        """Refuse a joint that the arm does not have."""
        if self.joint >= self.arm.n:
            raise InputError(f"joint: expected 1 to {self.arm.n}, got {self.joint + 1}")

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep joint and start if the joint is still there."""
        if self.joint not in origin:
            return self.initial(robot)
        return replace(self, arm=robot.arm, joint=origin.index(self.joint))

    def after(self, before: State, now: State) -> Self:
        """Forget the start when the clip is closed, or when the joint has changed between turning and sliding."""
        if self.start is None:
            return self
        was, is_now = (state[Joints].arm.revolute[state[Sweep].joint] for state in (before, now))
        return replace(self, start=None) if now[Timeline].clip != CLIP_KEY or was != is_now else self


PART = PartType(Sweep, order=95)

Leg = tuple[float, float, float, float]
"""One leg of the sweep: its beginning and duration in seconds, and the value of the joint at either end."""


def legs(state: State) -> tuple[Leg, Leg, Leg]:
    """Return the three legs: from the start to the low limit, to the high limit, and back to the start."""
    joints, sweep = state[Joints], state[Sweep]
    low, high = (float(value) for value in joints.arm.limits[sweep.joint])
    start = float(joints.q[sweep.joint]) if sweep.start is None else min(max(sweep.start, low), high)
    second = SECONDS / (2.0 * (high - low)) if high > low else 0.0
    down, up, back = (start - low) * second, (high - low) * second, (high - start) * second
    return (0.0, down, start, low), (down, up, low, high), (down + up, back, high, start)


def value_at(way: tuple[Leg, ...], time: float) -> float:
    """Return the value of the joint at a time, rad or m."""
    begin, duration, first, last = next((leg for leg in way if time < leg[0] + leg[1]), way[-1])
    part = (time - begin) / duration if duration > 0.0 else 1.0
    return first + eased(part) * (last - first)


def put_back(state: State) -> State:
    """Return the state with the joint at its value before the sweep, unless the student has moved it meanwhile."""
    sweep, joints = state[Sweep], state[Joints]
    if sweep.start is None or abs(joints.q[sweep.joint] - value_at(legs(state), state[Timeline].time)) > UNTOUCHED:
        return state
    q = joints.q.copy()
    q[sweep.joint] = sweep.start
    moved = joints.moved_to(q)
    return state if moved is joints else state.replace(moved)


@dataclass(frozen=True)
class SweepJoint(Command):
    """Choose the joint that sweeps; an open clip begins anew with it, and the previous joint goes back."""

    joint: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the joint chosen."""
        sweep, timeline = state[Sweep], state[Timeline]
        chosen = sweep.with_values({"joint": self.joint, "start": None})
        if chosen.joint == sweep.joint:
            return state
        if timeline.clip != CLIP_KEY:
            return state.replace(chosen)
        started = replace(chosen, start=free_start(state[Joints], chosen.joint))
        return put_back(state).replace(started, replace(timeline, time=0.0, playing=False))


def free_start(joints: Joints, joint: int) -> float:
    """Return the present value of a joint that is not held, rad or m.

    Raises
    ------
    InputError
        It is held.
    """
    if joints.locked[joint]:
        raise InputError(f"joint {joint + 1} is held: release it on the page Joints, or sweep another")
    return float(joints.q[joint])


@dataclass(frozen=True, eq=False)
class Curves:
    """Measures of manipulability over the range of one joint, with the others held still.

    Attributes
    ----------
    values : ndarray, shape (N,)
        Of the joint, rising from limit to limit, rad or m.
    w, sigma_min, inverse_condition : ndarray, shape (N,)
    """

    values: Array
    w: Array
    sigma_min: Array
    inverse_condition: Array


Course = tuple[VelocityBlock, int, bytes]
"""Arguments of the curves: the block, the joint that sweeps, and the values of the other joints."""


def course(state: State) -> Course:
    """Return the arguments of the curves, which do not depend on the value of the joint that sweeps."""
    joints, joint = state[Joints], state[Sweep].joint
    others = np.array(joints.q)
    others[joint] = joints.arm.limits[joint, 0]
    return state[Manipulability].block, joint, others.tobytes()


def curves(state: State) -> Curves:
    """Return the curves of the joint that sweeps."""
    return _curves(course(state))


def singularities(state: State) -> SingularPlaces:
    """Return the values of the sweeping joint at which the rank drops; quick enough for every picture."""
    return _singularities(course(state))


@lru_cache(maxsize=64)
def _curves(swept: Course) -> Curves:
    block, joint, _ = swept
    low, high = block.arm.limits[joint]
    values = np.linspace(low, high, POINTS)
    w, inverse, smallest = measures(_scaled_rows(swept, values), size=block.size)
    return Curves(values, w, smallest, inverse)


@lru_cache(maxsize=64)
def _singularities(swept: Course) -> SingularPlaces:
    block, joint, _ = swept
    low, high = block.arm.limits[joint].tolist()
    return singular_places(_fitted(swept), low, high, block.size)


def _fitted(swept: Course) -> Callable[[Array], Array]:
    """Return `_scaled_rows` of one joint's values as a short sum, much quicker, and exact up to rounding.

    Along a prismatic joint the entries are affine; along a revolute one they are linear in its cosine and sine, and
    quadratic in the axes of the tool.
    """
    block, joint, _ = swept
    revolute = bool(block.arm.revolute[joint])

    def terms(values: Array) -> Array:
        one = np.ones_like(values)
        if not revolute:
            return np.stack([one, values], axis=-1)
        twice = 2.0 * values
        return np.stack([one, np.cos(values), np.sin(values), np.cos(twice), np.sin(twice)], axis=-1)

    nodes: Array = np.linspace(0.0, 1.6 * math.pi, 5) if revolute else np.array([0.0, 1.0])
    rows = _scaled_rows(swept, nodes)
    factors = np.linalg.solve(terms(nodes), rows.reshape(len(nodes), -1))
    return lambda values: (terms(values) @ factors).reshape(-1, *rows.shape[1:])


def _scaled_rows(swept: Course, values: Array) -> Array:
    """Return the block at values of the joint, with each column in multiples of the speed that counts as 1."""
    block, joint, others = swept
    batch = np.repeat(np.frombuffer(others)[None], len(values), axis=0)
    batch[:, joint] = values
    rows = block.rows(batch)
    return rows if block.speeds is None else rows * block.speeds
