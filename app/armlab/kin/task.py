"""The task of an arm: which components of the tool's pose it is asked to control.

A planar 2R cannot turn its hand at will, a SCARA cannot tilt it. Handles, inverse kinematics, manipulability and
verdicts all use the arm's task, so nothing is ever asked that the arm cannot do by construction.
Components are taken in the axes of frame 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from armlab.kin.graph import vector as vec
from armlab.kin.graph.expression import Number
from armlab.kin.graph.vector import Vector
from armlab.kin.graph.walker import Frame
from armlab.registry import Registry

Rotation = Literal["none", "phi", "approach", "full"]

_TITLES: dict[Rotation, str] = {
    "none": "",
    "phi": "angle φ about z",
    "approach": "approach direction",
    "full": "orientation",
}


@dataclass(frozen=True)
class Task:
    """Task components.

    Parameters
    ----------
    position : str
        The controlled coordinates of the tool point, a part of ``"xyz"``.
    rotation : str
        ``"none"``; ``"phi"``: the turn about z of frame 0; ``"approach"``: the direction of the tool's z axis (two
        components); ``"full"``: the orientation (three components).
    """

    position: str
    rotation: Rotation

    @property
    def key(self) -> str:
        """The name used in files, such as ``"xyz phi"`` or ``"pose"``."""
        if self.position == "xyz" and self.rotation == "full":
            return "pose"
        parts = (self.position, "" if self.rotation == "none" else self.rotation)
        return " ".join(part for part in parts if part)

    @property
    def m(self) -> int:
        """Number of components."""
        return len(self.position) + {"none": 0, "phi": 1, "approach": 2, "full": 3}[self.rotation]

    @property
    def title(self) -> str:
        """The components in words."""
        position = f"position ({', '.join(self.position)})" if self.position else ""
        return " and ".join(part for part in (position, _TITLES[self.rotation]) if part)

    @property
    def coordinates(self) -> list[int]:
        """Indices of the controlled position coordinates."""
        return ["xyz".index(letter) for letter in self.position]

    def jacobian_rows(self, linear: Sequence[Vector], angular: Sequence[Vector], tool: Frame) -> list[list[Number]]:
        """Return the m rows of the task Jacobian from the columns of the geometric one, in axes of frame 0."""
        rows = [[column[k] for column in linear] for k in self.coordinates]
        if self.rotation == "phi":
            rows.append([column[2] for column in angular])
        elif self.rotation == "approach":
            rows += [[vec.dot(axis, column) for column in angular] for axis in (tool.x, tool.y)]
        elif self.rotation == "full":
            rows += [[column[k] for column in angular] for k in range(3)]
        return rows

    def rotation_error(self, turn: Vector, tool: Frame) -> list[Number]:
        """Return the controlled components of a small rotation, in axes of frame 0."""
        if self.rotation == "phi":
            return [turn[2]]
        if self.rotation == "approach":
            return [vec.dot(axis, turn) for axis in (tool.x, tool.y)]
        return list(turn) if self.rotation == "full" else []


NAMED: Registry[Task] = Registry(
    "task",
    (
        Task("x", "none"),
        Task("y", "none"),
        Task("z", "none"),
        Task("xy", "none"),
        Task("xz", "none"),
        Task("yz", "none"),
        Task("", "phi"),
        Task("x", "phi"),
        Task("y", "phi"),
        Task("z", "phi"),
        Task("xy", "phi"),
        Task("xz", "phi"),
        Task("yz", "phi"),
        Task("xyz", "none"),
        Task("xyz", "phi"),
        Task("xyz", "approach"),
        Task("xyz", "full"),
    ),
)


def task_named(key: str) -> Task:
    """Return the task of this name, such as ``"xy phi"``, ``"xyz approach"`` or ``"pose"``."""
    return NAMED[key]
