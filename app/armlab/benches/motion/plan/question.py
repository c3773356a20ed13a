"""A plan, and the motion that is planned from it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import IntEnum
from itertools import takewhile
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.plan.figures import Figures, Overrun
from armlab.benches.motion.plan.moves import Move, Stretch, Waypoint, stretches
from armlab.kin.arm import Arm
from armlab.kin.motion import Followed, LawBounds, Motion, Path, ToolPath, Trajectory, Violation
from armlab.kin.motion import Limits as JointLimits

Floats = NDArray[np.float64]

TURN_SPEED, TURN_ACCELERATION = np.radians(90.0), np.radians(180.0)
"""Usual speed, rad/s, and acceleration, rad/s², of a joint without limits; in length scales if it slides."""

FULL_AFTER = 0.1
"""Time in which an acceleration is built up if a law needs a limit of jerk and none is given, seconds."""


SHORTEST, LONGEST = 0.01, 600.0
"""Shortest and longest motion, seconds."""


class Limits(NamedTuple):
    """Limits of a motion, besides the joint limits.

    Attributes
    ----------
    velocity, acceleration : tuple of float
        rad/s and rad/s², m/s and m/s², one for each joint.
    jerk_time : float or None
        Seconds in which the full acceleration may be built up, so that the jerk is at most a / jerk_time; None: any.
    tool_speed : float or None
        m/s of the tool point; None: any.
    """

    velocity: tuple[float, ...]
    acceleration: tuple[float, ...]
    jerk_time: float | None = None
    tool_speed: float | None = None

    def of_joints(self, needed: bool = False) -> JointLimits:
        """Return the limits of the joints; ``needed`` adds a usual limit of jerk if none is set, for a law's shape."""
        return JointLimits(self.velocity, self.acceleration, self.jerk(needed))

    def jerk(self, needed: bool = False) -> Floats:
        """Return the limits of jerk, infinite if there are none and none is needed."""
        time = FULL_AFTER if self.jerk_time is None and needed else self.jerk_time
        a = np.array(self.acceleration)
        return np.full(len(a), np.inf) if time is None else a / time


Rows = tuple[tuple[float, ...], ...]


class Recorded(NamedTuple):
    """A motion read from a file: samples joined by a spline, or by cubics with the velocities of the file.

    Attributes
    ----------
    t : tuple of float
        Seconds.
    q : tuple of tuple of float
        rad and m, a row for each time.
    qdot, qddot : tuple of tuple of float, or None
        Their derivatives, where the file has both.
    """

    t: tuple[float, ...]
    q: Rows
    qdot: Rows | None = None
    qddot: Rows | None = None


class Question(NamedTuple):
    """All that a motion is planned from; equal questions have equal answers."""

    arm: Arm
    waypoints: tuple[Waypoint, ...]
    moves: tuple[Move, ...]
    limits: Limits
    duration: float | None
    samples: int
    recorded: Recorded | None = None

    @property
    def parts(self) -> tuple[Stretch, ...]:
        """The stretches of the moves."""
        return stretches(self.moves, self.waypoints)


class Feasible(IntEnum):
    """Feasibility of a place of a path."""

    YES = 0
    NEAR_SINGULAR = 1
    OVER_LIMIT = 2
    NOT_REACHED = 3


@dataclass(frozen=True, eq=False)
class Leg:
    """A stretch, planned, and the wait at its end.

    Attributes
    ----------
    stretch : Stretch or None
        None of a recorded motion.
    start : float
        Seconds at which it begins, if the legs before can be run.
    points : ndarray, shape (k, 3)
        The way of the tool point, world, metres.
    worth : ndarray of int, shape (k,)
        `Feasible` of each point.
    times : ndarray, shape (k,), or None
        Seconds from the beginning of the motion; None when it cannot be run.
    trouble : str
        Why it cannot be run; empty when it can.
    remarks : tuple of str
        What is worth knowing although it can.
    path : Path or None
        In joint space.
    motion : Motion or None
    tool_path : ToolPath or None
        Of a Cartesian stretch.
    followed : Followed or None
        Its inverse kinematics.
    bounds : LawBounds or None
        What the limits of the joints leave to the law.
    deviation : float
        Metres by which the tool leaves its path between the samples of the inverse kinematics, at most.
    wait : float
        Seconds for which the arm rests at its end.
    """

    stretch: Stretch | None
    start: float
    points: Floats
    worth: NDArray[np.int_]
    times: Floats | None
    trouble: str = ""
    remarks: tuple[str, ...] = ()
    path: Path | None = None
    motion: Motion | None = None
    tool_path: ToolPath | None = None
    followed: Followed | None = None
    bounds: LawBounds | None = None
    deviation: float = 0.0
    wait: float = 0.0

    @property
    def arrival(self) -> float:
        """Seconds at which the arm comes to its end; where it begins if it cannot be run."""
        return self.start if self.motion is None else self.start + self.motion.duration

    @property
    def trajectory(self) -> Trajectory | None:
        """The motion of the leg if it is one path with one law."""
        return self.motion if isinstance(self.motion, Trajectory) else None


@dataclass(frozen=True, eq=False)
class Samples:
    """A motion at evenly spaced times, and at more during short legs, for plots and measures.

    Attributes
    ----------
    t : ndarray, shape (k,)
    q, qdot, qddot, qdddot : ndarray, shape (k, n)
    tool : ndarray, shape (k, 3)
        m, world.
    tool_speed : ndarray, shape (k,)
        m/s.
    s : ndarray, shape (k,)
        The path parameter of the leg that is on, 0 to 1.
    curvature : ndarray, shape (k,)
        1/m, of the way of the tool; nan where it stands or turns on the spot.
    """

    t: Floats
    q: Floats
    qdot: Floats
    qddot: Floats
    qdddot: Floats
    tool: Floats
    tool_speed: Floats
    s: Floats
    curvature: Floats


class Grip(NamedTuple):
    """An action of the gripper: when, seconds, whether it closes, and the waypoint, from 0."""

    time: float
    closes: bool
    waypoint: int


@dataclass(frozen=True, eq=False)
class Planned:
    """A planned motion: what has become of a plan, also where it cannot be run.

    Attributes
    ----------
    question : Question
    legs : tuple of Leg
    motion : Motion or None
        Of the legs that can be run, up to the first that cannot; None when there is none.
    samples : Samples or None
        Of that motion.
    violations : tuple of Violation
        When which limit is exceeded.
    fastest : float
        Seconds as fast as allowed by the limits that can be kept, without those of `unkept`; nan when there is no
        motion.
    unkept : tuple of str
        Limits that it cannot keep in any time, such as a velocity that would have to jump.
    overruns : tuple of Overrun
        The limits it exceeds, each once, in the order of time; that of the tool speed among them.
    figures : Figures or None
        The largest values of that motion; None when there is none. See `armlab.benches.motion.plan.measured`.
    in_shape : float or None
        Least seconds in the shape that typed ramps give the laws in a given time; None when the limits shape them.
    """

    question: Question
    legs: tuple[Leg, ...]
    motion: Motion | None
    samples: Samples | None
    violations: tuple[Violation, ...]
    fastest: float
    unkept: tuple[str, ...] = ()
    overruns: tuple[Overrun, ...] = ()
    figures: Figures | None = None
    in_shape: float | None = None

    @property
    def least(self) -> float:
        """Least duration within all limits, seconds; nan when there is no motion, and where no duration keeps them."""
        if self.unkept or any(violation.quantity == "position" for violation in self.violations):
            return math.nan
        return self.fastest if self.in_shape is None else self.in_shape

    @property
    def with_ramps(self) -> str:
        """Words behind that duration where typed ramps shape the laws; empty otherwise."""
        return "" if self.in_shape is None else " with these ramps"

    @property
    def whole(self) -> bool:
        """Whether the whole plan can be run."""
        return self.motion is not None and not any(leg.trouble for leg in self.legs)

    @property
    def trouble(self) -> str:
        """The first reason why the plan cannot be run; empty if it can."""
        return next((leg.trouble for leg in self.legs if leg.trouble), "")

    @property
    def duration(self) -> float:
        """Duration of the part that can be run, seconds."""
        return 0.0 if self.motion is None else self.motion.duration

    @property
    def running(self) -> tuple[Leg, ...]:
        """The legs of the motion: up to the first that cannot be run."""
        return tuple(takewhile(lambda leg: leg.motion is not None, self.legs))

    @property
    def boundaries(self) -> tuple[float, ...]:
        """Times at which one leg ends, a wait begins or ends, or the next leg begins, seconds."""
        times = {time for leg in self.running for time in (leg.start, leg.arrival)}
        return tuple(sorted(time for time in times if 0.0 < time < self.duration))

    @property
    def grips(self) -> tuple[Grip, ...]:
        """When the gripper opens or closes, in the order of time; a recorded motion passes no waypoints."""
        if self.question.recorded is not None:
            return ()
        reached = [(0, 0.0)] if self.running else []
        stretches = [(leg.stretch, leg.arrival) for leg in self.running if leg.stretch is not None]
        reached += [(stretch.end, time) for stretch, time in stretches if stretch.end is not None]
        points = self.question.waypoints
        return tuple(Grip(t, points[k].gripper == "close", k) for k, t in reached if points[k].gripper != "leave")

    def leg_at(self, time: float) -> Leg | None:
        """Return the leg at a time; in a wait the one before."""
        on = [leg for leg in self.running if leg.start <= time + 1e-9]
        return on[-1] if on else next(iter(self.running), None)
