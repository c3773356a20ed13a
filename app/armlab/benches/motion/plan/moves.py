"""Parts of a plan of motion: waypoints, and the moves between them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Literal, Self, cast, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.benches.motion.chosen import Chosen
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.field import Field
from armlab.kin.motion import law_types, path_types
from armlab.kin.motion.path_types import PathType, Space
from armlab.kin.transforms import as_pose
from armlab.registry import known_name
from armlab.session.state import Json

Floats = NDArray[np.float64]

Turning = Literal["axis", "euler", "kept", "wrist"]

TURNINGS: dict[Turning, str] = {
    "axis": "about one axis",
    "euler": "Euler angles ZYX",
    "kept": "kept constant",
    "wrist": "separately, by the wrist",
}
"""Rotations of the tool during a Cartesian move, in words."""

EULER_AXES = "zyx"

MOST_WAYPOINTS = 100
"""Largest number of waypoints in a list; longer lists of samples are read as a recorded motion."""


Gripper = Literal["leave", "open", "close"]

LONGEST_WAIT = 60.0
"""Longest wait at a waypoint, seconds."""

AT_WAYPOINT: dict[str, Field] = {
    field.key: field
    for field in (
        Field(
            "gripper",
            "",
            "gripper",
            "choice",
            "leave",
            choices=(("leave", "leave as it is"), ("open", "open"), ("close", "close")),
        ),
        Field("wait", "", "wait", "number", 0.0, 0.0, LONGEST_WAIT, unit="s"),
    )
}
"""Actions of the arm at a waypoint besides being there, by name."""


LINE, TRAPEZOID = Chosen("line"), Chosen("trapezoidal")


@dataclass(frozen=True)
class Waypoint:
    """A configuration of the plan, and what is done there.

    Attributes
    ----------
    q : tuple of float
        rad and m, inside the limits.
    pose : tuple of float or None
        The 16 numbers of the wanted tool pose in the world where it was typed or dragged; None: the one of ``q``.
    gripper : str
        What the gripper does when the arm has come there.
    wait : float
        Seconds for which the arm then rests.
    """

    q: tuple[float, ...]
    pose: tuple[float, ...] | None = None
    gripper: Gripper = "leave"
    wait: float = 0.0

    @property
    def rests(self) -> bool:
        """Whether the arm rests there, since it waits or its gripper opens or closes."""
        return self.wait > 0.0 or self.gripper != "leave"

    @property
    def does(self) -> dict[str, Any]:
        """Actions there, by the names of `AT_WAYPOINT`, without those that are left as they come."""
        given = {name: getattr(self, name) for name in AT_WAYPOINT}
        return {name: value for name, value in given.items() if value != AT_WAYPOINT[name].default}

    def doing(self, other: Waypoint) -> Self:
        """Return the waypoint with what is done at another one."""
        return replace(self, gripper=other.gripper, wait=other.wait)

    def wanted(self, arm: Arm) -> Floats:
        """Return the wanted pose of the tool in the world, (4, 4)."""
        pose = arm.fk(self.q) if self.pose is None else np.reshape(self.pose, (4, 4))
        return np.asarray(pose, dtype=np.float64)

    def to_json(self) -> Json:
        """Write the waypoint."""
        return {"q": list(self.q), **({} if self.pose is None else {"pose": list(self.pose)}), **self.does}

    @classmethod
    def from_json(cls, data: Json, arm: Arm) -> Self:
        """Read the waypoint back; raises if it does not fit the arm."""
        pose = data.get("pose")
        does = {name: field.checked(data.get(name, field.default)) for name, field in AT_WAYPOINT.items()}
        return cls(checked_q(arm, data["q"]), None if pose is None else flat_pose(np.reshape(pose, (4, 4))), **does)


@dataclass(frozen=True)
class Move:
    """The move of the arm from the previous waypoint.

    Moves in a row that are the same, of a path that takes several waypoints, are one stretch of it.

    Attributes
    ----------
    space : str
        ``"joint"`` or ``"cartesian"``: what runs through the waypoints, the configurations or the poses of the tool.
    path, law : Chosen
        Kinds of `path_types` and `law_types`.
    turning : str
        One of `TURNINGS`; of a joint move it has no effect. Through several waypoints "about one axis" is from corner
        to corner; where the path has none the angular velocity does not jump.
    stop : bool
        Whether the arm rests at the waypoint it comes to, although the path could go through.
    apart : bool
        Whether in a straight joint move each joint goes by itself, as fast as it can, instead of all together.
    """

    space: Space = "joint"
    path: Chosen = LINE
    law: Chosen = TRAPEZOID
    turning: Turning = "axis"
    stop: bool = False
    apart: bool = False

    @property
    def independent(self) -> bool:
        """Whether each joint moves by itself."""
        return self.apart and self.space == "joint" and self.path.key == LINE.key

    @property
    def kind(self) -> PathType:
        """The kind of path of the move."""
        return path_types()[self.path.key]

    @property
    def returns(self) -> bool:
        """Whether its path comes back to where it began, as a whole circle does."""
        return bool(self.path.options.get("full"))

    def through(self) -> Self:
        """Return the move without its stop; equal moves can then form one stretch."""
        return replace(self, stop=False)

    def to_json(self) -> Json:
        """Write the move."""
        return {
            "space": self.space,
            "path": self.path.to_json(),
            "law": self.law.to_json(),
            "turning": self.turning,
            "stop": self.stop,
            "apart": self.apart,
        }

    @classmethod
    def from_json(cls, data: Json) -> Self:
        """Read the move back; `InputError` if it is not usable."""
        path = Chosen.from_json(data.get("path", LINE.to_json()), path_types())
        law = Chosen.from_json(data.get("law", TRAPEZOID.to_json()), law_types())
        turning = checked_turning(data.get("turning", "axis"))
        space, stop, apart = data.get("space", "joint"), bool(data.get("stop", False)), bool(data.get("apart", False))
        return cls(checked_space(space), path, law, turning, stop, apart)


@dataclass(frozen=True)
class Stretch:
    """Moves that form one path.

    Attributes
    ----------
    first, last : int
        Waypoints, from 0.
    move : Move
        The first of its moves.
    """

    first: int
    last: int
    move: Move

    @property
    def title(self) -> str:
        """Waypoints that the stretch joins, such as ``"1 → 3"``."""
        return f"{self.first + 1} → {self.last + 1}"

    @property
    def end(self) -> int | None:
        """The waypoint at which it ends; None if it passes the last one and ends where it began."""
        return None if self.move.returns else self.last


def stretches(moves: tuple[Move, ...], waypoints: tuple[Waypoint, ...]) -> tuple[Stretch, ...]:
    """Return the stretches of the moves between the waypoints, in order; where the arm rests one ends."""
    found: list[Stretch] = []
    for k, move in enumerate(moves):
        before = found[-1] if found else None
        most = move.kind.most
        joins = (
            before is not None
            and not moves[k - 1].stop
            and not waypoints[k].rests
            and before.move.through() == move.through()
            and (most is None or before.last - before.first + 2 <= most)
        )
        if joins and before is not None:
            found[-1] = replace(before, last=k + 1)
        else:
            found.append(Stretch(k, k + 1, move))
    return tuple(each for stretch in found for each in _straightened(stretch, moves))


def as_laid(moves: tuple[Move, ...], waypoints: tuple[Waypoint, ...]) -> tuple[Move, ...]:
    """Return each move with the path and the law that it has in its stretch; see `stretches`."""
    return tuple(
        replace(moves[k], path=stretch.move.path, law=stretch.move.law)
        for stretch in stretches(moves, waypoints)
        for k in range(stretch.first, stretch.last)
    )


def _straightened(stretch: Stretch, moves: tuple[Move, ...]) -> tuple[Stretch, ...]:
    """Return a stretch with enough waypoints for its path; one with too few, as half an arc, becomes straight lines.

    The moves keep their path, so that a stop that is taken away again brings it back.
    """
    if stretch.last - stretch.first + 1 >= stretch.move.kind.least:
        return (stretch,)
    straight = (replace(move, path=LINE, law=resting(move.law)) for move in moves[stretch.first : stretch.last])
    return tuple(Stretch(k, k + 1, move) for k, move in enumerate(straight, start=stretch.first))


def resting(law: Chosen) -> Chosen:
    """Return a law that rests at its ends, because constant speed is only for paths with their own time."""
    return TRAPEZOID if law.key == "constant" else law


def checked_q(arm: Arm, q: ArrayLike) -> tuple[float, ...]:
    """Return joint values inside the limits; `InputError` if they are not n finite numbers or far outside."""
    values = np.array(q, dtype=float)
    if values.shape != (arm.n,) or not np.isfinite(values).all():
        raise InputError(f"waypoint: expected {arm.n} finite joint values, got {values.size}")
    return tuple(np.asarray(arm.clip(values)).tolist())


def checked_joint(arm: Arm, joint: int) -> int:
    """Return the index of a joint, from 0; `InputError` if the arm does not have it."""
    if not 0 <= joint < arm.n:
        raise InputError(f"joint: expected 1 to {arm.n}, got {joint + 1}")
    return joint


def flat_pose(pose: ArrayLike) -> tuple[float, ...]:
    """Return the 16 numbers of a pose; `InputError` if it is none."""
    return tuple(np.asarray(as_pose(pose, "pose of the waypoint"), dtype=float).reshape(16).tolist())


def checked_space(space: object) -> Space:
    """Return a space; `UnknownName` for another word."""
    return cast(Space, known_name("space", space, get_args(Space)))


def checked_turning(turning: object) -> Turning:
    """Return a rotation of the tool; `UnknownName` for another word."""
    return known_name("turning", turning, TURNINGS)
