"""The singularity microscope: the wanted velocity of the tool, and the damping of the damped methods."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, Literal, Self, get_args

from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.control.rate_inverse import rate_inverse
from armlab.kin.control.scaled_task import ScaledTask
from armlab.kin.control.side_by_side import METHODS
from armlab.kin.field import Field
from armlab.session import fields
from armlab.session.fields import FieldPart, choice, number, text, vector
from armlab.session.parts.joints import Joints
from armlab.session.state import Json, PartType, State

Aim = Literal["lost", "across", "own"]
Damping = tuple[tuple[str, float], ...]

AIMS: tuple[Aim, ...] = get_args(Aim)

SPEED = 0.3
"""Size of the wanted velocity, m/s or rad/s; if the task has both, metres count in length scales."""

DISTANCE = math.radians(3.0)
"""Distance from a singularity, radians, or length scales for a sliding joint."""

ROUNDING = 1e-9
"""Relative rounding by which a size may pass its bounds when it is computed from its components."""

SLOWEST, FASTEST = 1e-6 * (1.0 - ROUNDING), 100.0 * (1.0 + ROUNDING)
"""Bounds of the scaled size of the wanted velocity."""

FARTHEST = 0.6

DAMPING: dict[str, tuple[str, Field]] = {
    field.key: (method, field) for method in ("dls_constant", "dls_variable") for field in rate_inverse(method).fields
}
"""Options of the damped methods: the key of each, with its method and its description."""


def _damping(data: Json) -> Damping:
    """Return the options of the damped methods from a mapping or from pairs."""
    given = dict(data)
    return tuple((key, field.checked(given[key])) for key, (_, field) in DAMPING.items())


@dataclass(frozen=True, eq=False)
class Microscope(FieldPart):
    """The wanted velocity and the options of the microscope.

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

    looks: ClassVar[tuple[str, ...]] = ("method", "distance")

    arm: Arm
    aim: Aim = choice("direction of the velocity", "lost", AIMS)
    speed: float = number("", "size of the velocity where it is not own, scaled", SPEED, SLOWEST, FASTEST)
    own: tuple[float, ...] = vector("", "own velocity of the tool, m/s and rad/s", kept="edits")
    damping: Damping = fields.own(
        "damping", _damping({key: field.default for key, (_, field) in DAMPING.items()}), _damping, dict
    )
    method: str = choice("method that is watched", "dls_variable", METHODS)
    distance: float = number("", "distance from a singularity", DISTANCE, 0.0, FARTHEST, "rad")
    example: str = text("example", kept="")

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the wish to move along the direction that is nearest to being lost."""
        first = float(ScaledTask(robot.arm).row_units[0])
        # Where metres and radians meet, 0.3 m/s are too fast for an arm of a few millimetres.
        speed = SPEED if SPEED * first <= FASTEST else SPEED / first
        return cls(robot.arm, own=(speed, *[0.0] * (robot.arm.task.m - 1)))

    def for_robot(self, robot: Robot) -> Self:
        """Keep everything except a velocity that does not fit the new task."""
        kept = replace(self, arm=robot.arm, example="")
        size = kept.sized(self.own) if self.arm.task == robot.arm.task else 0.0
        if not SLOWEST <= size <= FASTEST:
            aim: Aim = self.aim if self.aim != "own" else "lost"
            return replace(kept, own=type(self).initial(robot).own, aim=aim)
        # Where metres and radians meet, another reach is another scale.
        return replace(kept, speed=size) if self.aim == "own" else kept

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep the same as for another arm."""
        return self.for_robot(robot)

    def check(self) -> None:
        """Refuse a velocity whose size is out of bounds."""
        if not SLOWEST <= self.sized(self.own) <= FASTEST:
            raise InputError(f"velocity: expected another one than 0, and none larger than {FASTEST:g}")

    def after(self, before: State, now: State) -> Self:
        """Forget the example when the arm has been moved away from it."""
        moved = now[Joints].q is not before[Joints].q and self is before[Microscope]
        return replace(self, example="") if moved and self.example else self

    @cached_property
    def task(self) -> ScaledTask:
        """The scaled task of the arm."""
        return ScaledTask(self.arm)

    @cached_property
    def options(self) -> Mapping[str, Mapping[str, Any]]:
        """Options of each method, by the method's key."""
        found: dict[str, dict[str, Any]] = {}
        for key, value in self.damping:
            found.setdefault(DAMPING[key][0], {})[key] = value
        return found

    @property
    def size(self) -> float:
        """The scaled size of the velocity."""
        return self.sized(self.own) if self.aim == "own" else self.speed

    def sized(self, velocity: Sequence[float]) -> float:
        """Return the scaled size of a velocity in m/s and rad/s."""
        return math.hypot(*(value * float(unit) for value, unit in zip(velocity, self.task.row_units, strict=True)))


PART = PartType(Microscope, order=30)
