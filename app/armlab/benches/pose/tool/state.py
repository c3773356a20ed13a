"""The chosen transform, and the angles in which its rotation is written."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from armlab.content.robots import Robot
from armlab.errors import InputError, UnknownName
from armlab.kin.arm import Arm
from armlab.kin.euler import SEQUENCES
from armlab.kin.transforms import inverse
from armlab.session.fields import FieldPart, choice, flag, text
from armlab.session.parts.joints import Joints
from armlab.session.state import Command, PartType, State

WORLD, TOOL = "w", "E"

MATRIX = "pose"
"""Key of the transform's matrix in the selection."""


def frame_names(n: int) -> tuple[str, ...]:
    """Return the names of the frames of an arm of n joints, from the world outwards: w, 0 to n, E."""
    return (WORLD, *(str(i) for i in range(n + 1)), TOOL)


@dataclass(frozen=True)
class PoseView(FieldPart):
    """Choices of the bench Pose.

    Attributes
    ----------
    n : int
        Number of joints, which says what frames there are.
    reference, frame : str
        Two different names of `frame_names`: the pose of the second in the first is shown.
    axes : str
        One of `SEQUENCES`.
    fixed : bool
        Whether its axes stay where they were before the first turn.
    """

    key: ClassVar[str] = "pose_view"
    kept_by_undo: ClassVar[bool] = True

    n: int
    reference: str = text("frame of reference", WORLD)
    frame: str = text("frame", TOOL)
    axes: str = choice("sequence of axes", "zyx", SEQUENCES)
    fixed: bool = flag("fixed axes", False)

    @classmethod
    def initial(cls, robot: Robot) -> Self:
        """Return the tool in the world, in yaw, pitch and roll."""
        return cls(robot.arm.n)

    def for_robot(self, robot: Robot) -> Self:
        """Keep the sequence, and the two frames if the arm has them."""
        return replace(super().for_robot(robot), axes=self.axes, fixed=self.fixed)

    def for_edited(self, robot: Robot, origin: tuple[int | None, ...]) -> Self:
        """Keep the same as for another arm."""
        return self.for_robot(robot)

    def check(self) -> None:
        """Refuse frames that do not exist, and a frame in itself."""
        for name in (self.reference, self.frame):
            if name not in frame_names(self.n):
                raise UnknownName("frame", name, frame_names(self.n))
        if self.reference == self.frame:
            raise InputError(f"transform: expected two different frames, got {self.frame!r} for both")

    @property
    def inward(self) -> bool:
        """Whether the transform leads from the tool towards the world, the inverse of the usual direction."""
        names = frame_names(self.n)
        return names.index(self.frame) < names.index(self.reference)

    @property
    def outer_pair(self) -> tuple[str, str]:
        """Reference and frame of the transform, or of its inverse if that has the usual direction."""
        return (self.frame, self.reference) if self.inward else (self.reference, self.frame)

    def exchanged(self) -> Self:
        """Return the part with the inverse transform."""
        return replace(self, reference=self.frame, frame=self.reference)


PART = PartType(PoseView, order=81)


@dataclass(frozen=True)
class LookAt(Command):
    """Choose the pose of one frame in another.

    Parameters
    ----------
    reference, frame : str
    keeps_sense : bool
        Whether, while an inverse is looked at, the inverse of this one is meant.
    """

    reference: str
    frame: str
    keeps_sense: bool = False
    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with the transform chosen."""
        view = state[PoseView]
        changed = view.with_values({"reference": self.reference, "frame": self.frame})
        if self.keeps_sense and view.inward:
            changed = changed.exchanged()
        return state if changed == view else state.replace(changed)


@dataclass(frozen=True)
class Invert(Command):
    """Choose the inverse of the present transform."""

    undoable: ClassVar[bool] = False

    def apply(self, state: State) -> State:
        """Return the state with reference and frame exchanged."""
        return state.replace(state[PoseView].exchanged())


@dataclass(frozen=True, eq=False)
class Pair:
    """Two frames and the transform between them.

    Attributes
    ----------
    reference, frame : ndarray, shape (4, 4)
        Their poses in the world.
    transform : ndarray, shape (4, 4)
        The frame in the reference, in metres.
    """

    reference: NDArray[np.floating]
    frame: NDArray[np.floating]
    transform: NDArray[np.floating]

    @property
    def distance(self) -> float:
        """Length of p in metres."""
        return float(np.linalg.norm(self.transform[:3, 3]))

    def angle(self, i: int, j: int) -> float:
        """Return the angle in [0, pi] between axis i of the reference and axis j of the frame, both 0-based.

        Its cosine is entry (i, j); from the sine too, which keeps all digits near 0 and pi.
        """
        axis = self.transform[:3, j]
        return math.atan2(math.hypot(*np.delete(axis, i).tolist()), float(axis[i]))


def pair_at(arm: Arm, q: NDArray[np.floating], view: PoseView) -> Pair:
    """Return the chosen frames in a configuration, shape (n,)."""
    frames = arm.frames(q)

    def pose(name: str) -> NDArray[np.floating]:
        if name == WORLD:
            return np.eye(4)
        return arm.fk(q) if name == TOOL else frames[int(name)]

    reference, frame = pose(view.reference), pose(view.frame)
    return Pair(reference, frame, inverse(reference) @ frame)


def pair_of(state: State) -> Pair:
    """Return the chosen frames at the present configuration."""
    joints = state[Joints]
    return pair_at(joints.arm, joints.q, state[PoseView])


def step_of(view: PoseView) -> int | None:
    """Return i if the transform is A_i, frame i in frame i-1, or its inverse; else None."""
    reference, frame = view.outer_pair
    if reference in (WORLD, TOOL) or frame in (WORLD, TOOL) or int(frame) - int(reference) != 1:
        return None
    return int(frame)


def link_parameters(arm: Arm, q: NDArray[np.floating], i: int) -> dict[str, float]:
    """Return a, alpha, d, theta of A_i (1-based) with the joint variable in its place; metres and radians."""
    row = arm.rows[i - 1]
    moved = float(q[i - 1])
    d, theta = (row.d, row.theta + moved) if row.revolute else (row.d + moved, row.theta)
    return {"a": row.a, "alpha": row.alpha, "d": d, "theta": theta}
