"""The choice of the velocities or forces of the tool, and the ellipsoid of those that the configuration allows."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar, Literal, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.content.robots import Robot
from armlab.kin.arm import Arm
from armlab.kin.ellipsoid import RANK_TOLERANCE, Ellipsoid, velocity_ellipsoid
from armlab.kin.force_ellipsoid import ForceEllipsoid
from armlab.kin.joint_scale import angular_size, counted_speeds, joint_scale, linear_size
from armlab.registry import known_name
from armlab.session.fields import FieldPart, choice
from armlab.session.parts.joints import Joints
from armlab.session.round_numbers import round_below
from armlab.session.state import Command, Json, PartType, State

Array = NDArray[np.float64]
Block = Literal["translation", "rotation"]
Kinds = Literal["velocity", "force", "both"]

UNIT: dict[Block, str] = {"translation": "m/s", "rotation": "rad/s"}
FORCE_UNIT: dict[Block, str] = {"translation": "N", "rotation": "N m"}
KINDS: tuple[Kinds, ...] = ("velocity", "force", "both")

SAMPLES = 64
"""Number of random configurations from which the size of a typical ellipsoid is taken."""

DRAWN, DRAWN_FORCE = 0.2, 0.15
"""Size on screen, in reaches of the arm, of the longest half axis of a typical ellipsoid and of the middle one for
forces."""


ALIKE = 1e-6
"""Difference of half axes, relative to the longest, up to which no direction is that of the longest."""


@dataclass(frozen=True)
class VelocityBlock:
    """Rows of the geometric Jacobian that have one unit and that belong to the arm's task.

    Parameters
    ----------
    arm : Arm
    key : "translation" or "rotation"
        Velocities of the tool point in m/s, or angular velocities in rad/s.
    """

    arm: Arm
    key: Block

    @property
    def unit(self) -> str:
        """The unit of the half axes."""
        return UNIT[self.key]

    @property
    def force_unit(self) -> str:
        """The unit of the half axes of the force ellipsoid."""
        return FORCE_UNIT[self.key]

    @property
    def m(self) -> int:
        """Number of rows."""
        task = self.arm.task
        return len(task.position) if self.key == "translation" else task.m - len(task.position)

    @cached_property
    def speeds(self) -> Array | None:
        """Speed of each joint that counts as 1, shape (n,), rad/s or m/s; None if all joints turn or all slide.

        Joints that slide and joints that turn have no common unit: each is measured by its limit.
        """
        return counted_speeds(self.arm)

    @cached_property
    def size(self) -> float:
        """Half axis, m/s or rad/s, in a configuration where the block is large: rounding is small beside it."""
        size = linear_size if self.key == "translation" else angular_size
        return size(self.arm, joint_scale(self.arm))

    def axes(self, q: ArrayLike) -> Array:
        """Return the unit vectors of the rows in the world, (..., 3, m): those of frame 0, or x and y of the tool."""
        task, base = self.arm.task, self.arm.base[:3, :3]
        if self.key == "rotation" and task.rotation == "approach":
            return np.asarray(self.arm.fk(q)[..., :3, :2], dtype=np.float64)
        if self.key == "rotation":
            return np.array(base[:, 2:] if task.rotation == "phi" else np.eye(3))
        return np.eye(3) if task.position == "xyz" else np.array(base[:, task.coordinates])

    def rows(self, q: ArrayLike) -> Array:
        """Return the block, shape (..., m, n), of configurations of shape (..., n)."""
        J = self.arm.jacobian(q)
        half = J[..., :3, :] if self.key == "translation" else J[..., 3:, :]
        return np.asarray(np.swapaxes(self.axes(q), -1, -2) @ half)

    def ellipsoid(self, q: ArrayLike) -> Ellipsoid:
        """Return the ellipsoid of one configuration."""
        return velocity_ellipsoid(self.rows(q), self.speeds, self.size)

    @cached_property
    def _sigma(self) -> Array:
        """Half axes of configurations inside the limits, (SAMPLES, min(m, n))."""
        limits = self.arm.limits
        q = np.random.default_rng(0).uniform(limits[:, 0], limits[:, 1], (SAMPLES, self.arm.n))
        rows = self.rows(q) if self.speeds is None else self.rows(q) * self.speeds
        return np.asarray(np.linalg.svd(rows, compute_uv=False))

    @cached_property
    def typical(self) -> float:
        """The median of the longest half axis over configurations inside the limits; 1 if that counts as 0."""
        median = float(np.median(self._sigma[:, 0]))
        return median if median > RANK_TOLERANCE * self.size else 1.0

    @cached_property
    def typical_force(self) -> float:
        """The median of the geometric mean of the finite half axes of the force ellipsoid; 1 if there are none.

        Not of the longest of them, which is anything near a singularity.
        """
        sigma = self._sigma[self._sigma[:, 0] > RANK_TOLERANCE * self.size]
        if len(sigma) == 0:
            return 1.0
        there = sigma > RANK_TOLERANCE * np.maximum(sigma[:, :1], self.size)
        logarithms = np.where(there, -np.log(np.where(there, sigma, 1.0)), 0.0)
        return float(np.median(np.exp(logarithms.sum(axis=1) / there.sum(axis=1))))

    @cached_property
    def drawn(self) -> float:
        """Metres on screen for 1 m/s or 1 rad/s, from the series 1, 2, 5: the same in every configuration."""
        return round_below(DRAWN * 2.0 * self.arm.length_scale / self.typical)

    @cached_property
    def drawn_force(self) -> float:
        """Metres on screen for 1 N or 1 N m, from the series 1, 2, 5: the same in every configuration."""
        return round_below(DRAWN_FORCE * 2.0 * self.arm.length_scale / self.typical_force)


@dataclass(frozen=True, eq=False)
class PlacedEllipsoid:
    """An ellipsoid in the scene.

    Attributes
    ----------
    centre : ndarray, shape (3,)
        The tool point in the world, metres.
    axes : ndarray, shape (3, 3)
        A rotation: the principal axes in the world, then what completes them where there are fewer than three.
    sigma : ndarray, shape (3,)
        Half axes in the unit of the block; 0 beyond its rows.
    ellipsoid : Ellipsoid
    """

    centre: Array
    axes: Array
    sigma: Array
    ellipsoid: Ellipsoid

    @cached_property
    def force(self) -> ForceEllipsoid:
        """The force ellipsoid, which has the same axes."""
        return ForceEllipsoid(self.ellipsoid)

    @cached_property
    def half_forces(self) -> Array:
        """Half axes of the force ellipsoid, (3,), N or N m: infinite if no torque is needed, 0 beyond its rows."""
        half = np.zeros(3)
        half[: len(self.ellipsoid.sigma)] = self.force.half_axes
        return half

    @property
    def is_round(self) -> bool:
        """Whether it is a circle or a sphere, of velocities and of forces; half axes that are all 0 are alike, too."""
        sigma = self.ellipsoid.sigma
        return bool(sigma[0] - sigma[-1] <= ALIKE * sigma[0])

    @property
    def lost(self) -> tuple[int, ...]:
        """The axes, 0-based, along which there is no speed although they belong to the task."""
        return tuple(range(self.ellipsoid.rank, len(self.ellipsoid.sigma)))


def placed(block: VelocityBlock, q: Array) -> PlacedEllipsoid:
    """Return the ellipsoid of a configuration at the tool point."""
    found = block.ellipsoid(q)
    sigma = np.zeros(3)
    sigma[: block.m] = found.sigma
    return PlacedEllipsoid(
        np.asarray(block.arm.position(q), dtype=np.float64), _completed(block.axes(q) @ found.axes), sigma, found
    )


def _completed(columns: Array) -> Array:
    """Return a rotation whose first columns are given; the last of three is reversed if needed."""
    m = columns.shape[1]
    if m == 1:
        z = columns[:, 0]
        other = np.eye(3)[int(np.argmin(np.abs(z)))]
        side = np.cross(z, other)
        columns = np.column_stack([z, side / np.linalg.norm(side)])
    x, y = columns[:, 0], columns[:, 1]
    return np.column_stack([x, y, np.cross(x, y)])


def blocks_of(arm: Arm) -> tuple[Block, ...]:
    """Return the kinds of velocity that the arm's task controls."""
    found: list[Block] = []
    if arm.task.position:
        found.append("translation")
    if arm.task.rotation != "none":
        found.append("rotation")
    return tuple(found)


@dataclass(frozen=True)
class Manipulability(FieldPart):
    """The choice of velocities or forces that the ellipsoid shows.

    Attributes
    ----------
    block : VelocityBlock
    shown : "velocity", "force" or "both"
    """

    key: ClassVar[str] = "ellipsoid"
    kept_by_undo: ClassVar[bool] = True

    block: VelocityBlock
    shown: Kinds = choice("ellipsoid", "velocity", KINDS)

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the velocities of translation if the arm's task has them, else those of rotation."""
        return cls(VelocityBlock(robot.arm, blocks_of(robot.arm)[0]))

    def for_robot(self, robot: Robot) -> Self:
        """Keep the choice if the arm has it."""
        has = self.block.key in blocks_of(robot.arm)
        key = self.block.key if has else blocks_of(robot.arm)[0]
        return type(self)(VelocityBlock(robot.arm, key), self.shown)

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep the choice as for another arm."""
        return self.for_robot(robot)

    @property
    def velocity(self) -> bool:
        """Whether the velocity ellipsoid is shown."""
        return self.shown != "force"

    @property
    def force(self) -> bool:
        """Whether the force ellipsoid is shown."""
        return self.shown != "velocity"

    def to_json(self) -> Json:
        """Write the choice."""
        return self.block.key if self.shown == "velocity" else [self.block.key, self.shown]

    @classmethod
    def from_json(cls, data: Json, robot: Robot) -> Self:
        """Read the choice."""
        key, shown = data if isinstance(data, list) else (data, "velocity")
        return cls(VelocityBlock(robot.arm, _block_named(robot.arm, key))).with_values({"shown": shown})


PART = PartType(Manipulability, order=25)


def present(state: State) -> PlacedEllipsoid:
    """Return the ellipsoid of the present configuration."""
    return placed(state[Manipulability].block, state[Joints].q)


@dataclass(frozen=True)
class LookAtBlock(Command):
    """Look at translation or rotation."""

    key: str
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the choice made."""
        block = state[Manipulability].block
        key = _block_named(block.arm, self.key)
        part = replace(state[Manipulability], block=VelocityBlock(block.arm, key))
        return state if key == block.key else state.replace(part)


def _block_named(arm: Arm, key: Json) -> Block:
    known = blocks_of(arm)
    known_name("velocities", key, known)
    return next(block for block in known if block == key)
