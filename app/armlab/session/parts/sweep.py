"""Which joint sweeps through its range, and what the manipulability is on the way."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.ellipsoid import measures
from armlab.session.parts.ellipsoid import Manipulability, VelocityBlock
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Command, Json, Part, PartType, State

Array = NDArray[np.float64]

CLIP_KEY = "sweep"

POINTS = 361
"""Of a curve."""

ZOOMS, ZOOM_POINTS = 4, 33
"""A minimum is narrowed down so many times, each time among so many points."""

SINGULAR = 1e-4
"""Largest inverse condition at a minimum that counts as a singularity; the narrowing leaves less than 1e-6."""


SHALLOW = 0.1
"""A dip of the sampled inverse condition that stays above is none: between two points it changes by less."""


@dataclass(frozen=True)
class Sweep(Part):
    """The joint that moves while the others stay.

    Attributes
    ----------
    joint : int
        0-based.
    start : float or None
        Where it stood when the clip was opened, rad or m; None while the clip is not open.
    """

    key: ClassVar[str] = "sweep"
    kept_by_undo: ClassVar[bool] = True

    joint: int = 0
    start: float | None = None

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the joint whose motion changes w: not the first, about which everything only turns."""
        return cls(min(1, robot.arm.n - 1))

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep the joint where it is still there."""
        return type(self)(origin.index(self.joint)) if self.joint in origin else self.initial(robot)

    def after(self, before: State, now: State) -> Self:
        """Forget the start when the clip is closed."""
        return replace(self, start=None) if self.start is not None and now[Timeline].clip != CLIP_KEY else self

    def to_json(self) -> Json:
        """Write joint and start."""
        return {"joint": self.joint, "start": self.start}

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read them back."""
        joint = int(data["joint"])
        start = None if data["start"] is None else float(data["start"])
        if not 0 <= joint < robot.arm.n or (start is not None and not math.isfinite(start)):
            raise InputError(f"sweep: not usable: {data}")
        return cls(joint, start)


PART = PartType(Sweep, order=95)


@dataclass(frozen=True)
class SweepJoint(Command):
    """Choose the joint that sweeps; an open clip begins anew from where that joint stands."""

    joint: int
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the joint chosen."""
        joints, timeline = state[Joints], state[Timeline]
        if not 0 <= self.joint < joints.arm.n:
            raise InputError(f"joint: expected 1 to {joints.arm.n}, got {self.joint + 1}")
        if self.joint == state[Sweep].joint:
            return state
        if timeline.clip != CLIP_KEY:
            return state.replace(Sweep(self.joint))
        started = Sweep(self.joint, free_start(joints, self.joint))
        return state.replace(started, replace(timeline, time=0.0, playing=False))


def free_start(joints: Joints, joint: int) -> float:
    """Return where a joint stands.

    Raises
    ------
    InputError
        It is held.
    """
    if joints.locked[joint]:
        raise InputError(f"joint {joint + 1} is held: let it go in Joints, or sweep another")
    return float(joints.q[joint])


@dataclass(frozen=True, eq=False)
class Curves:
    """Measures of manipulability over one joint's range, the others as they are.

    Attributes
    ----------
    values : ndarray, shape (N,)
        Of the joint, rising from limit to limit, rad or m.
    w, sigma_min, inverse_condition : ndarray, shape (N,)
    singular : tuple of float
        Values of the joint, rising, limits included, at which speed is lost some way; empty where it always is.
    """

    values: Array
    w: Array
    sigma_min: Array
    inverse_condition: Array
    singular: tuple[float, ...]


def curves(state: State) -> Curves:
    """Return the curves of the joint that sweeps; they do not depend on where it stands."""
    joints, joint = state[Joints], state[Sweep].joint
    others = np.array(joints.q)
    others[joint] = joints.arm.limits[joint, 0]
    return _curves(state[Manipulability].block, joint, others.tobytes())


@lru_cache(maxsize=64)
def _curves(block: VelocityBlock, joint: int, others: bytes) -> Curves:
    q = np.frombuffer(others)
    low, high = block.arm.limits[joint]
    values = np.linspace(low, high, POINTS)
    w, inverse, smallest = measures(block.rows(_configurations(q, joint, values)), block.speeds)
    singular = _singular(block, q, joint, values, inverse)
    return Curves(values, w, smallest, inverse, singular)


def _configurations(q: Array, joint: int, values: Array) -> Array:
    batch = np.repeat(q[None], len(values), axis=0)
    batch[:, joint] = values
    return batch


def _singular(block: VelocityBlock, q: Array, joint: int, values: Array, inverse: Array) -> tuple[float, ...]:
    """Return where the inverse condition falls to zero."""
    if not inverse.any():
        return ()
    inside = inverse[1:-1]
    dips = np.flatnonzero((inside < inverse[:-2]) & (inside <= inverse[2:]) & (inside < SHALLOW)) + 1
    found = [float(values[i]) for i in (0, -1) if inverse[i] < SINGULAR]
    for i in dips:
        at, least = _narrowed(block, q, joint, float(values[i - 1]), float(values[i + 1]))
        if least < SINGULAR:
            found.append(at)
    return tuple(sorted(found))


def _narrowed(block: VelocityBlock, q: Array, joint: int, low: float, high: float) -> tuple[float, float]:
    """Return the place and the value of the smallest inverse condition in an interval."""
    for _ in range(ZOOMS):
        values = np.linspace(low, high, ZOOM_POINTS)
        inverse = measures(block.rows(_configurations(q, joint, values)), block.speeds).inverse_condition
        best = int(np.argmin(inverse))
        low, high = values[max(best - 1, 0)], values[min(best + 1, ZOOM_POINTS - 1)]
    return float(values[best]), float(inverse[best])
