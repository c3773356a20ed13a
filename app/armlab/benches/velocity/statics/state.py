"""The wrench that the robot exerts on the environment, and the torques with which the joints balance it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, ClassVar, Literal, NamedTuple, Self, cast

import numpy as np
from numpy.typing import NDArray

from armlab.content.robots import Robot
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import finite_floats
from armlab.kin.joint_scale import angular_size, joint_scale, linear_size
from armlab.kin.statics import Duality, VirtualWork, duality, joint_torques, torque_free, virtual_work
from armlab.registry import known_name
from armlab.session.counted import refuse_beyond
from armlab.session.fields import FieldPart, choice, own, put, setting, text, vector, whole
from armlab.session.parts.joints import Joints
from armlab.session.round_numbers import round_above
from armlab.session.state import Command, Json, PartType, State

Array = NDArray[np.float64]
Triple = tuple[float, float, float]
Axes = Literal["world", "tool"]
Kind = Literal["force", "moment"]

AXES: tuple[Axes, ...] = ("world", "tool")
KINDS: tuple[Kind, ...] = ("force", "moment")
UNITS: dict[Kind, str] = {"force": "N", "moment": "N m"}
ZERO: Triple = (0.0, 0.0, 0.0)

MOST = 1e6
"""Largest component of force or moment that can be given, N or N m."""

LONGEST = math.sqrt(3.0) * MOST * (1.0 + 1e-9)
"""Largest size of force or moment, N or N m: along other axes a component may be as large, up to rounding."""

USUAL = 20.0
"""Initial force, N, which also sets the scale of the arrow while there is no force."""

STEP = 0.01
"""Size of a virtual displacement: radians for a joint that turns, length scales of the arm for one that slides."""

IN_PLANE = 1e-9
"""Sine of the angle within which an axis of the world lies in a plane."""

NOTHING = 1e-9
"""Torque that counts as zero, as a share of the torque of the wrench at the length of the whole arm."""


def _triple(kind: str, values: Json) -> Triple:
    unit = "N" if kind == "force" else "N m"
    x, y, z = finite_floats(values, kind, (3,), f"three finite numbers, in {unit}").tolist()
    size = math.hypot(x, y, z)
    if size > LONGEST:
        raise InputError(f"{kind}: expected a size of at most {LONGEST:.3g} {unit}, got {size:.6g} {unit}")
    return x, y, z


@dataclass(frozen=True)
class Statics(FieldPart):
    """A wrench at the tool point.

    Attributes
    ----------
    force, moment : (float, float, float)
        N and N m, by the robot on the environment, along the chosen axes; the moment about the tool point.
    axes : "world" or "tool"
        A wrench along the axes of the tool turns with it.
    full : (float, float)
        N and N m that are drawn in full length: round numbers, the same during a drag; 0 if there is nothing.
    draws : int
        How many virtual displacements were drawn; with 0 every joint moves a little forward.
    example : str
        Key of the loaded example; empty if it has been changed or there is none.
    """

    key: ClassVar[str] = "statics"
    leave_example: ClassVar[tuple[str, ...]] = ("example", "draws")

    force: Triple = own("force, N", (0.0, 0.0, USUAL), partial(_triple, "force"), kept="edits")
    moment: Triple = own("moment, N m", ZERO, partial(_triple, "moment"), kept="edits")
    axes: Axes = choice("axes of the wrench", "world", AXES, kept="edits")
    full: tuple[float, ...] = vector("", "drawn in full length", (USUAL, 0.0), 0.0, 10.0 * MOST, kept="edits")
    draws: int = whole("virtual displacements drawn", 0, 0, kept="edits")
    example: str = text("example", kept="")

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return a force that holds a weight, or one in the plane of an arm that cannot lift."""
        if "z" in robot.arm.task.position:
            return cls()
        x, y, z = (robot.arm.base[:3, :2] @ (0.6 * USUAL, 0.8 * USUAL)).round(9).tolist()
        return cls((x, y, z))

    def after(self, before: State, now: State) -> Self:
        """Forget the example when the arm is moved away from it."""
        moved = now[Joints].q is not before[Joints].q and self is before[Statics]
        return replace(self, example="") if self.example and moved else self

    def with_values(self, values: Mapping[str, Any]) -> Self:
        """Return the part with some fields set; another wrench also sets a scale that shows it well."""
        part = super().with_values(values)
        return part if "full" in values or not {*KINDS} & {*values} else part.fitted()

    @property
    def full_force(self) -> float:
        """The force that is drawn in full length, N."""
        return self.full[0]

    @property
    def full_moment(self) -> float:
        """The moment that is drawn in full length, N m."""
        return self.full[1]

    def fitted(self) -> Self:
        """Return the part with a scale that shows the present wrench well."""
        return replace(self, full=tuple(round_above(math.hypot(*each)) for each in (self.force, self.moment)))

    def wrench(self, tool: Array) -> Array:
        """Return the wrench in world axes about the tool point, (6,), with the tool at a pose (4, 4)."""
        turn = np.eye(3) if self.axes == "world" else tool[:3, :3]
        return np.concatenate([turn @ self.force, turn @ self.moment])

    def full_torque(self, arm: Arm) -> float:
        """Return the torque that is drawn in full size, N m: about the largest that the full wrench can need."""
        return round_above(self.full_force * 2.0 * arm.length_scale + self.full_moment)

    def shares(self, arm: Arm, torques: Array) -> Array:
        """Return torques (n,), of slides forces, over those that are drawn in full size; 0 where none can be needed."""
        whole = np.where(arm.revolute, self.full_torque(arm), self.full_force)
        return np.divide(torques, whole, out=np.zeros(arm.n), where=whole > 0.0)


PART = PartType(Statics, order=26)


class Balance(NamedTuple):
    """An arm at rest that exerts a wrench.

    Attributes
    ----------
    tool : ndarray, shape (4, 4)
        Pose of the tool in the world.
    wrench : ndarray, shape (6,)
        World axes, about the tool point, N and N m.
    torques : ndarray, shape (n,)
        N m of joints that turn, N of those that slide.
    least : ndarray, shape (n,)
        What counts as no torque, in these units.
    """

    tool: Array
    wrench: Array
    torques: Array
    least: Array

    @property
    def nothing(self) -> bool:
        """Whether there is a wrench and no joint needs a torque for it."""
        return bool(self.wrench.any()) and bool(np.all(np.abs(self.torques) <= self.least))


def balance_at(part: Statics, arm: Arm, q: Array) -> Balance:
    """Return the torques at any configuration."""
    tool = np.asarray(arm.fk(q), dtype=np.float64)
    wrench = part.wrench(tool)
    force, moment = np.linalg.norm(wrench[:3]), np.linalg.norm(wrench[3:])
    metres = 2.0 * arm.length_scale
    least = NOTHING * np.where(arm.revolute, force * metres + moment, force + moment / metres)
    return Balance(tool, wrench, joint_torques(arm.jacobian(q), wrench), least)


def balance(state: State) -> Balance:
    """Return the torques at the present configuration."""
    joints = state[Joints]
    return balance_at(state[Statics], joints.arm, joints.q)


def displacement(state: State) -> Array:
    """Return the chosen virtual displacement, (n,), rad and m."""
    arm, draws = state[Joints].arm, state[Statics].draws
    parts = np.random.default_rng(draws).uniform(-1.0, 1.0, arm.n) if draws else np.ones(arm.n)
    return STEP * parts * np.where(arm.revolute, 1.0, arm.length_scale)


def work(state: State) -> VirtualWork:
    """Return the virtual work of tool and joints over that displacement, J."""
    joints = state[Joints]
    return virtual_work(joints.arm.jacobian(joints.q), state.derived(balance).wrench, state.derived(displacement))


class Dualities(NamedTuple):
    """The four subspaces for whole wrenches, for forces alone, and for moments alone."""

    whole: Duality
    force: Duality
    moment: Duality


def dualities(state: State) -> Dualities:
    """Return the subspaces of J and J^T at the present configuration, with the characteristic length of the arm."""
    arm = state[Joints].arm
    J, speeds = arm.jacobian(state[Joints].q), joint_scale(arm)
    linear, angular = linear_size(arm, speeds), angular_size(arm, speeds)
    return Dualities(
        duality(J, arm.length_scale, speeds, linear / arm.length_scale),
        duality(J[:3], None, speeds, linear),
        duality(J[3:], None, speeds, angular),
    )


def free_forces_at(arm: Arm, q: Array) -> Array:
    """Return unit vectors, (3, k), that span the forces at the tool point that need no torque at a configuration.

    They are at right angles; in a plane that holds an axis of the world, this is the last of them.
    """
    speeds = joint_scale(arm)
    free = torque_free(arm.jacobian(q)[:3], None, speeds, linear_size(arm, speeds))
    if free.shape[1] == 3:
        return np.eye(3)
    if free.shape[1] < 2:
        return free
    normal = np.cross(free[:, 0], free[:, 1])
    k = int(np.argmin(np.abs(normal)))
    if abs(float(normal[k])) > IN_PLANE:
        return free
    axis = np.eye(3)[k]
    other = np.cross(axis, normal)
    return np.column_stack([other / np.linalg.norm(other), axis])


@dataclass(frozen=True)
class SetComponent(Command):
    """Set one component of the force, N, or of the moment, N m, along the chosen axes."""

    kind: str
    axis: int
    value: float
    label: ClassVar[str] = "wrench"

    def apply(self, state: State) -> State:
        """Return the state with the component set."""
        known_name("part of a wrench", self.kind, KINDS)
        refuse_beyond(self.axis, 3, "component of a wrench")
        if abs(self.value) > MOST:
            unit = UNITS[cast(Kind, self.kind)]
            raise InputError(f"{self.kind}: expected at most {MOST:g} {unit} either way, got {self.value:.6g} {unit}")
        values = list(getattr(state[Statics], self.kind))
        values[self.axis] = self.value
        return setting(state, Statics, {self.kind: values})


@dataclass(frozen=True)
class ReleaseWrench(Command):
    """Remove the wrench."""

    label: ClassVar[str] = "wrench"

    def apply(self, state: State) -> State:
        """Return the state without force and moment."""
        return setting(state, Statics, dict.fromkeys(KINDS, ZERO))


@dataclass(frozen=True)
class DragForce(Command):
    """Drag the tip of the force's arrow; this is one event of a drag.

    Parameters
    ----------
    force : (float, float, float)
        N, in world axes.
    drag : object
        Which drag it belongs to. One drag is one step of undo.
    """

    force: Triple
    drag: object
    snapshot: ClassVar[bool] = True
    label: ClassVar[str] = "force"

    @property
    def stroke(self) -> object:
        """Make one step of history of one drag."""
        return DragForce, self.drag

    def apply(self, state: State) -> State:
        """Return the state with the force in the chosen axes; the scale of the picture stays."""
        part = state[Statics]
        given = np.array(_triple("force", self.force))
        turn = np.eye(3) if part.axes == "world" else state[Joints].tool_pose[:3, :3].T
        full = part.full_force or round_above(float(np.linalg.norm(given)))
        return setting(state, Statics, {"force": turn @ given, "full": (full, part.full_moment)})


@dataclass(frozen=True)
class WriteAlong(Command):
    """Write the wrench along the axes of the world or of the tool; the wrench itself stays."""

    axes: str
    label: ClassVar[str] = "axes of the wrench"

    def apply(self, state: State) -> State:
        """Return the state with the wrench written in those axes."""
        part = state[Statics]
        changed = part.with_values({"axes": self.axes})
        if changed == part:
            return state
        tool = np.asarray(state[Joints].tool_pose, dtype=np.float64)
        world = part.wrench(tool)
        turn = np.eye(3) if changed.axes == "world" else tool[:3, :3].T
        force, moment = _clean(turn @ world[:3]), _clean(turn @ world[3:])
        return put(state, replace(changed, force=force, moment=moment, example=""))


@dataclass(frozen=True)
class DrawDisplacement(Command):
    """Choose another virtual displacement; the same history gives the same one."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the next displacement."""
        return state.replace(replace(state[Statics], draws=state[Statics].draws + 1))


def _clean(vector: Array) -> Triple:
    """Return a rotated vector without the rounding errors of the rotation."""
    size = float(np.abs(vector).max())
    x, y, z = np.where(np.abs(vector) < 1e-14 * size, 0.0, vector).tolist()
    return x, y, z
