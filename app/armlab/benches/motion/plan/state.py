"""The plan of a motion: waypoints, the moves between them, the limits, and the motion planned from them."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.benches.motion.plan.moves import Move, Stretch, Waypoint, as_laid, checked_q, stretches
from armlab.benches.motion.plan.question import (
    LONGEST,
    SHORTEST,
    TURN_ACCELERATION,
    TURN_SPEED,
    Limits,
    Planned,
    Question,
    Recorded,
    Rows,
)
from armlab.benches.motion.plan.read import entry, route_from
from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.field import positive
from armlab.session.parts.joints import Joints
from armlab.session.parts.timeline import Timeline
from armlab.session.state import Json, Part, PartType, State

CLIP_KEY = "motion"

SAMPLES, MOST_SAMPLES = 201, 1001
"""Usual and largest number of poses along a Cartesian stretch for which the inverse kinematics is solved."""

LEAST, MOST = 1e-4, 1e6
"""Least and largest limit in SI units."""

LEAST_SHARE = 0.01
"""Least share of the limits that can be used."""

FULL = 1.0, 1.0
"""Shares of the limits of velocity and acceleration that are used."""

ASIDE = np.array([0.8, -0.5, 0.6, 0.7, -0.6, 0.5])
"""Offset of each joint from the home pose to the second initial waypoint, rad, or parts of half a stroke."""


@dataclass(frozen=True, eq=False)
class Plan(Part):
    """Waypoints, moves and limits.

    Attributes
    ----------
    waypoints : tuple of Waypoint
    moves : tuple of Move
        One fewer: moves[k] comes to waypoint k + 1, both from 0.
    velocity, acceleration : tuple of float
        Limits of the joints, rad/s and rad/s², m/s and m/s².
    shares : (float, float)
        Parts of these limits that are used, more than 0 and at most 1.
    jerk_time, tool_speed : float or None
        See `Limits`.
    duration : float or None
        Seconds of the whole; None: as fast as allowed.
    samples : int
        Poses along a Cartesian stretch.
    selected : int
        The waypoint whose values, and whose move, are shown.
    handled : bool
        Whether the handle in the scene is that of the selected waypoint, and not that of the arm.
    compared : bool
        Whether the same waypoints are also planned with the other kind of moves, joint for Cartesian ones.
    recorded : Recorded or None
        A motion from a file, which then stands in place of the waypoints.
    example : str
        Key of the loaded example; empty if it has been changed or there is none.
    before : tuple of float or None
        Where the arm stood when the motion was put on; None while it is not on.
    kinds : str
        Of the joints, such as ``"RRP"``.
    planned, other : Planned or None
        What has become of it, and of the one compared; may be of a question that has passed. Not saved.
    """

    key: ClassVar[str] = "plan"

    waypoints: tuple[Waypoint, ...]
    moves: tuple[Move, ...]
    velocity: tuple[float, ...]
    acceleration: tuple[float, ...]
    shares: tuple[float, float] = FULL
    jerk_time: float | None = None
    tool_speed: float | None = None
    duration: float | None = None
    samples: int = SAMPLES
    selected: int = 1
    handled: bool = False
    compared: bool = False
    recorded: Recorded | None = None
    example: str = ""
    before: tuple[float, ...] | None = None
    kinds: str = ""
    planned: Planned | None = None
    other: Planned | None = None

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return one joint move from the home pose, at the limits of the robot file."""
        arm = robot.arm
        points = tuple(Waypoint(checked_q(arm, q)) for q in (robot.home, _aside(robot)))
        return cls(points, (Move(),), *default_limits(arm), kinds=_kinds(arm))

    def for_robot(self, robot: Robot) -> Self:
        """Begin anew, because waypoints belong to an arm."""
        return self.initial(robot)

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep the plan if the joints are the same, else begin anew."""
        arm, same = robot.arm, origin == tuple(range(len(self.velocity)))
        # Radians are no metres: a joint that has become a sliding one has neither values nor limits yet.
        if not same or self.kinds != _kinds(arm):
            return self.initial(robot)
        points = tuple(Waypoint(checked_q(arm, point.q)).doing(point) for point in self.waypoints)
        return replace(self, waypoints=points, recorded=None, example="", before=None, planned=None, other=None)

    def after(self, before: State, now: State) -> Self:
        """Forget the earlier configuration when the motion is closed."""
        off = self.before is not None and now[Timeline].clip != CLIP_KEY
        return replace(self, before=None) if off else self

    @cached_property
    def parts(self) -> tuple[Stretch, ...]:
        """The stretches of the moves."""
        return stretches(self.moves, self.waypoints)

    @cached_property
    def laid(self) -> tuple[Move, ...]:
        """The moves with the paths and laws that they run along, as they are shown; see `as_laid`."""
        return as_laid(self.moves, self.waypoints)

    @property
    def limits(self) -> Limits:
        """The limits with their shares."""
        v, a = self.shares
        return Limits(
            tuple(v * each for each in self.velocity),
            tuple(a * each for each in self.acceleration),
            self.jerk_time,
            self.tool_speed,
        )

    @property
    def stretch(self) -> Stretch | None:
        """The stretch that ends at the selected waypoint, or None if there is no move."""
        return self.stretch_to(max(self.selected, 1)) if self.moves else None

    def stretch_to(self, k: int) -> Stretch:
        """Return the stretch of the move to waypoint k, counted from 0; the first has none."""
        return next(stretch for stretch in self.parts if stretch.first < k <= stretch.last)

    def to_json(self) -> Json:
        """Write all but the planned motions."""
        recorded = self.recorded
        return {
            "waypoints": [point.to_json() for point in self.waypoints],
            "moves": [move.to_json() for move in self.moves],
            "velocity": list(self.velocity),
            "acceleration": list(self.acceleration),
            "shares": list(self.shares),
            "jerk_time": self.jerk_time,
            "tool_speed": self.tool_speed,
            "duration": self.duration,
            "samples": self.samples,
            "selected": self.selected,
            "handled": self.handled,
            "compared": self.compared,
            "recorded": None if recorded is None else _recorded_to(recorded),
            "example": self.example,
            "before": None if self.before is None else list(self.before),
        }

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read the plan back; raises if it cannot be used with this arm."""
        arm, opened = robot.arm, cls.initial(robot)
        points, moves = route_from(data, arm)
        selected = entry(data, "selected", 0, int)
        return cls(
            points,
            moves,
            entry(data, "velocity", opened.velocity, lambda values: checked_limits(arm, "velocity", values)),
            entry(
                data, "acceleration", opened.acceleration, lambda values: checked_limits(arm, "acceleration", values)
            ),
            entry(data, "shares", FULL, checked_shares),
            entry(data, "jerk_time", None, lambda value: optional_positive(value, "jerk time")),
            entry(data, "tool_speed", None, lambda value: optional_positive(value, "tool speed")),
            entry(data, "duration", None, checked_duration),
            entry(data, "samples", SAMPLES, checked_samples),
            min(max(selected, 0), len(points) - 1),
            bool(data.get("handled", False)),
            bool(data.get("compared", False)),
            entry(data, "recorded", None, lambda value: _recorded_from(value, arm)),
            str(data.get("example", "")),
            entry(data, "before", None, lambda q: None if q is None else checked_q(arm, q)),
            _kinds(arm),
        )


PART = PartType(Plan, order=98)


def default_limits(arm: Arm) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return limits of velocity and acceleration: those of the robot file, or usual ones if it gives none."""
    unit = np.where(arm.revolute, 1.0, arm.length_scale)
    v = np.where(np.isfinite(arm.speed_limits), arm.speed_limits, TURN_SPEED * unit)
    a = np.where(np.isfinite(arm.acceleration_limits), arm.acceleration_limits, TURN_ACCELERATION * unit)
    return tuple(v.tolist()), tuple(a.tolist())


def _kinds(arm: Arm) -> str:
    return "".join(row.kind for row in arm.rows)


def _aside(robot: Robot) -> np.ndarray:
    arm, home = robot.arm, np.array(robot.home, dtype=float)
    step = np.resize(ASIDE, arm.n)
    half = 0.5 * np.diff(arm.limits)[:, 0]
    way = np.where(arm.revolute, step, step * half)
    # Away from the nearer limit, so that an arm that rests at one moves.
    middle = arm.limits.mean(axis=1)
    inside = (home + way >= arm.limits[:, 0]) & (home + way <= arm.limits[:, 1])
    return np.asarray(home + np.where(inside, way, np.sign(middle - home) * np.abs(way)))


def question(state: State) -> Question:
    """Return all arguments of the plan of a state."""
    part = state[Plan]
    return Question(
        state[Joints].arm, part.waypoints, part.moves, part.limits, part.duration, part.samples, part.recorded
    )


def planned_now(state: State) -> Planned | None:
    """Return the planned motion, or None while it is not that of the present plan."""
    part = state[Plan]
    known = part.planned is not None and part.planned.question == state.derived(question)
    return part.planned if known else None


def last_planned(state: State) -> Planned | None:
    """Return the motion of this arm that was planned last, which is played and drawn until there is a newer one."""
    found = state[Plan].planned
    return found if found is not None and found.question.arm is state[Joints].arm else None


def checked_limits(arm: Arm, name: str, values: ArrayLike) -> tuple[float, ...]:
    """Return limits of the joints; `InputError` names the joint whose limit is not a positive number."""
    array = np.array(values, dtype=float)
    if array.shape != (arm.n,):
        raise InputError(f"limits of {name}: expected {arm.n}, one for each joint, got {array.size}")
    return tuple(_in_range(value, f"limit of {name} of joint {i + 1}") for i, value in enumerate(array.tolist()))


def _in_range(value: float, name: str) -> float:
    """Return a positive number in the range that can be drawn; `InputError` for any other."""
    number = positive(value, name)
    if not LEAST <= number <= MOST:
        raise InputError(f"{name}: too {'small' if number < LEAST else 'large'}, no motion can be drawn with it")
    return number


def checked_shares(shares: ArrayLike) -> tuple[float, float]:
    """Return shares of the limits; `InputError` unless they are more than 0 and at most 1."""
    array = np.array(shares, dtype=float)
    if array.shape != (2,) or not ((array >= LEAST_SHARE) & (array <= 1.0)).all():
        raise InputError(f"share of the limits: expected {100.0 * LEAST_SHARE:g} to 100 %")
    return float(array[0]), float(array[1])


def optional_positive(value: float | None, name: str) -> float | None:
    """Return a positive number or None; `InputError` for anything else."""
    return None if value is None else _in_range(value, name)


def checked_duration(duration: float | None) -> float | None:
    """Return a duration; `InputError` unless it is more than 0 and at most `LONGEST`."""
    if duration is not None and not (SHORTEST <= positive(duration, "duration") <= LONGEST):
        raise InputError(f"duration: expected {SHORTEST:g} to {LONGEST:g} s, got {duration:g}")
    return None if duration is None else float(duration)


def checked_samples(samples: float) -> int:
    """Return a number of samples; `InputError` unless it is a whole number in range."""
    if not (math.isfinite(samples) and samples == int(samples) and 2 <= samples <= MOST_SAMPLES):
        raise InputError(f"samples: expected a whole number from 2 to {MOST_SAMPLES}, got {samples:g}")
    return int(samples)


def _recorded_to(recorded: Recorded) -> Json:
    rows = {"q": recorded.q, "qdot": recorded.qdot, "qddot": recorded.qddot}
    written = {name: [list(row) for row in values] for name, values in rows.items() if values is not None}
    return {"t": list(recorded.t), **written}


def _recorded_from(data: Json, arm: Arm) -> Recorded | None:
    if data is None:
        return None
    return checked_recorded(arm, data["t"], data["q"], data.get("qdot"), data.get("qddot"))


def checked_recorded(
    arm: Arm, t: ArrayLike, q: ArrayLike, qdot: ArrayLike | None = None, qddot: ArrayLike | None = None
) -> Recorded:
    """Return a recorded motion; `InputError` names the wrong row. Rates are used only if both are given."""
    times, values = np.array(t, dtype=float), np.array(q, dtype=float)
    if values.ndim != 2 or values.shape[1] != arm.n or times.shape != (len(values),):
        raise InputError(f"recorded motion: expected a time and {arm.n} joint values in each row")
    if len(times) < 2:
        raise InputError("recorded motion: expected at least two rows")
    bad = np.flatnonzero(~(np.isfinite(values).all(axis=1) & np.isfinite(times)))
    if len(bad):
        raise InputError(f"recorded motion, row {bad[0] + 1}: not all numbers are finite")
    late = np.flatnonzero(np.diff(times) <= 0.0)
    if len(late):
        raise InputError(f"recorded motion, row {late[0] + 2}: its time is not later than the one before")
    if times[-1] - times[0] > LONGEST:
        raise InputError(f"recorded motion: it lasts {times[-1] - times[0]:g} s; at most {LONGEST:g} s can be shown")
    both = qdot is not None and qddot is not None
    rates = (
        _checked_rates("velocities", qdot if both else None, values.shape),
        _checked_rates("accelerations", qddot if both else None, values.shape),
    )
    room = 1e-6 * np.where(arm.revolute, 1.0, arm.length_scale)
    outside = (values < arm.limits[:, 0] - room) | (values > arm.limits[:, 1] + room)
    if outside.any():
        row, joint = np.argwhere(outside)[0]
        raise InputError(f"recorded motion, row {row + 1}: joint {joint + 1} is outside its limits")
    if np.ptp(values, axis=0).max() == 0.0:
        raise InputError("recorded motion: the arm stands still in all rows")
    return Recorded(tuple(times.tolist()), _rows(values), *rates)


def _rows(values: NDArray[np.float64]) -> Rows:
    return tuple(map(tuple, values.tolist()))


def _checked_rates(name: str, values: ArrayLike | None, shape: tuple[int, ...]) -> Rows | None:
    if values is None:
        return None
    array = np.array(values, dtype=float)
    if array.shape != shape or not np.isfinite(array).all():
        raise InputError(f"recorded motion: expected as many finite {name} as joint values")
    return _rows(array)
