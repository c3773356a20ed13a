"""The singularity microscope: which velocity the tool is asked for, and how the damped methods are damped."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, Literal, Self, get_args

import numpy as np

from armlab.benches.velocity.microscope.look import Look, Near, Place, look_at, near_at, places
from armlab.content.robots import Robot
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.control.rate_inverse import rate_inverse
from armlab.kin.control.scaled_task import ScaledTask
from armlab.kin.control.side_by_side import METHODS
from armlab.kin.field import Field
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.state import Command, Json, Part, PartType, State

Aim = Literal["lost", "across", "own"]

AIMS: tuple[Aim, ...] = get_args(Aim)

SPEED = 0.3
"""Size of the wanted velocity: m/s or rad/s; where both meet, metres count in length scales."""

DISTANCE = math.radians(3.0)
"""From a singularity: radians, or length scales of a sliding joint."""

SLOWEST, FASTEST = 1e-6, 100.0
"""Bounds of the scaled size of the wanted velocity."""

FARTHEST = 0.6

ROUNDING = 1e-9
"""By which the bounds of a size may be passed where it is computed of its components."""

VIEW = frozenset({"method", "distance"})
"""What may be changed while an example is still the example."""

DAMPING: dict[str, tuple[str, Field]] = {
    field.key: (method, field) for method in ("dls_constant", "dls_variable") for field in rate_inverse(method).fields
}
"""What can be set of the damped methods: key of the option to its method and its description."""


@dataclass(frozen=True, eq=False)
class Microscope(Part):
    """One velocity, and options.

    Attributes
    ----------
    arm : Arm
    aim : "lost", "across" or "own"
        Along the direction that is lost, or nearly; along the one in which the tool is fastest; or ``own``.
    speed : float
        Scaled size of the velocity where it is not ``own``.
    own : tuple of float
        A velocity of the tool, m/s and rad/s: one number for each component of the task.
    damping : tuple of (str, float)
        Options of the damped methods by key.
    method : str
        Key of the method whose answer is drawn in the scene.
    distance : float
        How near to a singularity the buttons bring the arm.
    example : str
        Key of the example it still is; empty when the velocity, the damping or the arm has been moved.
    """

    key: ClassVar[str] = "microscope"

    arm: Arm
    aim: Aim = "lost"
    speed: float = SPEED
    own: tuple[float, ...] = ()
    damping: tuple[tuple[str, float], ...] = tuple((key, float(field.default)) for key, (_, field) in DAMPING.items())
    method: str = "dls_variable"
    distance: float = DISTANCE
    example: str = ""

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the wish to move along the direction that is lost first."""
        return cls(robot.arm, own=(SPEED, *[0.0] * (robot.arm.task.m - 1)))

    def for_robot(self, robot: Robot) -> Self:
        """Keep all but a velocity that does not fit the other task."""
        kept = replace(self, arm=robot.arm, example="")
        size = _size(kept, self.own) if self.arm.task == robot.arm.task else 0.0
        if not SLOWEST <= size <= FASTEST:
            aim: Aim = self.aim if self.aim != "own" else "lost"
            return replace(kept, own=type(self).initial(robot).own, aim=aim)
        # Where metres and radians meet, another reach is another scale.
        return replace(kept, speed=size) if self.aim == "own" else kept

    def after(self, before: State, now: State) -> Self:
        """Be no example any more when the arm has been moved away from it."""
        moved = now[Joints].q is not before[Joints].q and self is before[Microscope]
        return replace(self, example="") if moved and self.example else self

    @cached_property
    def task(self) -> ScaledTask:
        """The scaled task of the arm."""
        return ScaledTask(self.arm)

    @cached_property
    def options(self) -> Mapping[str, Mapping[str, Any]]:
        """Options by key of the method."""
        found: dict[str, dict[str, Any]] = {}
        for key, value in self.damping:
            found.setdefault(DAMPING[key][0], {})[key] = value
        return found

    def to_json(self) -> Json:
        """Write everything but the arm."""
        return {
            "aim": self.aim,
            "speed": self.speed,
            "own": list(self.own),
            "damping": dict(self.damping),
            "method": self.method,
            "distance": self.distance,
            "example": self.example,
        }

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read it back; raises when nothing can be computed with it."""
        fresh = cls.initial(robot)
        given = {**fresh.to_json(), **data}
        damping = tuple((key, float(field.checked(given["damping"][key]))) for key, (_, field) in DAMPING.items())
        part = cls(
            robot.arm,
            given["aim"],
            float(given["speed"]),
            tuple(float(value) for value in given["own"]),
            damping,
            given["method"],
            float(given["distance"]),
            str(given["example"]),
        )
        check(part)
        return part


PART = PartType(Microscope, order=30)


def looked(state: State) -> Look:
    """Return what the microscope sees at the present configuration."""
    return look_at(state[Microscope], state[Joints].q)


def near(state: State) -> Near | None:
    """Return the singularity that is near, if any."""
    return near_at(state[Microscope], state[Joints].q)


def known_places(state: State) -> tuple[Place, ...]:
    """Return the singular configurations the arm can be brought near to."""
    robot = state[RobotPart].robot
    return places(robot.arm, tuple(float(value) for value in robot.home))


@dataclass(frozen=True)
class AimVelocity(Command):
    """Ask for a velocity along the lost direction, or across it."""

    aim: str
    label: ClassVar[str] = "velocity of the tool"

    def apply(self, state: State) -> State:
        """Return the state with the aim."""
        aim = next((known for known in ("lost", "across") if known == self.aim), None)
        if aim is None:
            raise UnknownName("velocity", self.aim, ("lost", "across"))
        return _with(state, aim=aim)


@dataclass(frozen=True)
class AimAlong(Command):
    """Ask for a velocity along one component of the task (0-based), as large as before."""

    component: int
    label: ClassVar[str] = "velocity of the tool"

    def apply(self, state: State) -> State:
        """Return the state with the velocity."""
        part = state[Microscope]
        if not 0 <= self.component < part.arm.task.m:
            raise InputError(f"component: expected 1 to {part.arm.task.m}, got {self.component + 1}")
        own = np.zeros(part.arm.task.m)
        own[self.component] = part.speed / part.task.row_units[self.component]
        return _with(state, aim="own", own=tuple(own.tolist()))


@dataclass(frozen=True)
class SetComponent(Command):
    """Set one component (0-based) of the velocity, m/s or rad/s; the others stay as they are seen."""

    component: int
    value: float
    label: ClassVar[str] = "velocity of the tool"

    def apply(self, state: State) -> State:
        """Return the state with the component."""
        look = state.derived(looked)
        own = look.natural(look.wish)
        if not 0 <= self.component < len(own):
            raise InputError(f"component: expected 1 to {len(own)}, got {self.component + 1}")
        own[self.component] = self.value
        typed = tuple(own.tolist())
        check_own(state[Microscope], typed)
        return _with(state, aim="own", own=typed, speed=_size(state[Microscope], typed))


@dataclass(frozen=True)
class SetSpeed(Command):
    """Set how large the velocity is, scaled; its direction stays."""

    speed: float
    label: ClassVar[str] = "speed of the tool"

    def apply(self, state: State) -> State:
        """Return the state with the speed."""
        part = state[Microscope]
        check_speed(self.speed)
        if part.aim != "own":
            return _with(state, speed=self.speed)
        factor = self.speed / _size(part, part.own)
        return _with(state, own=tuple(factor * value for value in part.own), speed=self.speed)


@dataclass(frozen=True)
class SetDamping(Command):
    """Set an option of the damped methods, by its key in `DAMPING`."""

    name: str
    value: Any
    label: ClassVar[str] = "damping"

    def apply(self, state: State) -> State:
        """Return the state with the option."""
        if self.name not in DAMPING:
            raise UnknownName("damping", self.name, DAMPING)
        value = DAMPING[self.name][1].checked(self.value)
        if value is None:
            raise InputError(f"{self.name}: expected a number")
        damping = dict(state[Microscope].damping) | {self.name: float(value)}
        return _with(state, damping=tuple(damping.items()))


@dataclass(frozen=True)
class WatchMethod(Command):
    """Draw what this method makes the tool do."""

    method: str
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the method."""
        return _with(state, method=self.method)


@dataclass(frozen=True)
class SetDistance(Command):
    """Set how near to a singularity the arm is brought: radians, or length scales of a sliding joint; 0 is at it."""

    distance: float
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the distance."""
        return _with(state, distance=self.distance)


@dataclass(frozen=True)
class BringNear(Command):
    """Move the arm near to one of the singular configurations that are known of it (0-based)."""

    place: int
    label: ClassVar[str] = "move near a singularity"

    def apply(self, state: State) -> State:
        """Return the state with the arm there, on the side on which the limits leave room."""
        found, part, joints = known_places(state), state[Microscope], state[Joints]
        if not 0 <= self.place < len(found):
            raise InputError(f"singularity: expected 1 to {len(found)}, got {self.place + 1}")
        pose = found[self.place].pose
        q, k = pose.q.copy(), pose.place
        step = part.distance * float(part.task.joint_units[k])
        # Back towards where one comes from: there is room.
        q[k] += step if pose.away <= 0.0 else -step
        held = np.flatnonzero(np.array(joints.locked) & ~np.isclose(q, joints.q, rtol=0.0, atol=ROUNDING))
        if len(held):
            raise InputError(f"joint {held[0] + 1} is held and would have to move: let it go in Joints")
        moved = joints.moved_to(q)
        return state if moved is joints else state.replace(moved)


def _with(state: State, **fields: Any) -> State:
    part = state[Microscope]
    if all(getattr(part, name) == value for name, value in fields.items()):
        return state
    example = part.example if VIEW.issuperset(fields) else ""
    changed = replace(part, **fields, example=example)
    check(changed)
    return state.replace(changed)


def check(part: Microscope) -> None:
    """Refuse what nothing can be computed with."""
    if part.aim not in AIMS:
        raise UnknownName("velocity", part.aim, AIMS)
    check_speed(part.speed)
    if part.method not in METHODS:
        raise UnknownName("method", part.method, METHODS)
    if not (math.isfinite(part.distance) and 0.0 <= part.distance <= FARTHEST):
        raise InputError(f"distance: expected 0 to {FARTHEST:g} rad or length scales, got {part.distance:g}")
    check_own(part, part.own)


def check_speed(speed: float) -> None:
    """Refuse a size of the velocity that nothing can be computed with."""
    if not (math.isfinite(speed) and SLOWEST * (1.0 - ROUNDING) <= speed <= FASTEST * (1.0 + ROUNDING)):
        raise InputError(f"speed: expected {SLOWEST:g} to {FASTEST:g}, got {speed:g}")


def check_own(part: Microscope, own: tuple[float, ...]) -> None:
    """Refuse components that are none of the task, or of a size that nothing can be computed with."""
    if len(own) != part.arm.task.m or not all(map(math.isfinite, own)):
        raise InputError(f"velocity: expected {part.arm.task.m} finite numbers, got {list(own)}")
    size = _size(part, own)
    if not SLOWEST * (1.0 - ROUNDING) <= size <= FASTEST * (1.0 + ROUNDING):
        raise InputError(f"velocity: expected another one than 0, and none larger than {FASTEST:g}")


def _size(part: Microscope, own: tuple[float, ...]) -> float:
    """Return the scaled size of a velocity in m/s and rad/s."""
    return math.hypot(*(value * float(unit) for value, unit in zip(own, part.task.row_units, strict=True)))
