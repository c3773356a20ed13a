"""The film of the table: four moves for each row, from frame 0 to the tool. The joints of the arm do not move."""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import dataclass
from functools import lru_cache
from itertools import accumulate

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.dh import Row
from armlab.kin.easing import eased
from armlab.kin.moves import MOVES, ORDER, partial_product
from armlab.kin.transforms import inverse
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Clip, Timeline
from armlab.session.state import State

MOVE_SECONDS, BEAT_SECONDS = 1.5, 0.3
"""Duration of a move, and of one that the table gives as zero, in seconds. A joint's own move keeps its time at any
joint value, so that the film does not jump while the student moves the joint."""

NOTHING = 1e-9
"""Constant of the table, metres or radians, below which it counts as zero."""

JUST_AFTER = 1e-3
"""Time, seconds, after the start of a row at which it is shown: at the start itself the film shows the end of the last
row."""

NO_TOOL = 1e-12
"""Largest difference, in metres and of entries of the rotation, at which the tool's frame is frame n itself."""


@dataclass(frozen=True)
class Place:
    """A place in the film.

    Attributes
    ----------
    row : int
        0 to n-1, or n for the step to the tool.
    move : int
        The move being made or just ended: 0 to 3, 0 for the tool.
    part : float
        How much of it is done, 0 to 1.
    """

    row: int
    move: int
    part: float

    @property
    def progress(self) -> float:
        """Number of moves of the row that are done, 0 to 4."""
        return self.move + self.part


def has_tool(arm: Arm) -> bool:
    """Return whether the tool's frame differs from frame n."""
    return bool(np.abs(arm.tool - np.eye(4)).max() > NO_TOOL)


def moves_in(arm: Arm) -> int:
    """Return the number of moves of the film: four for each row, and one to the tool if it has its own frame."""
    return MOVES * arm.n + int(has_tool(arm))


@lru_cache(maxsize=64)
def ends_of(arm: Arm) -> tuple[float, ...]:
    """Return the time at which each move ends, in seconds."""
    seconds = [_seconds(row, symbol) for row in arm.rows for symbol in ORDER[arm.convention]]
    return tuple(accumulate(seconds + [MOVE_SECONDS] * int(has_tool(arm))))


def _seconds(row: Row, symbol: str) -> float:
    moved_by_joint = symbol == ("theta" if row.revolute else "d")
    return MOVE_SECONDS if moved_by_joint or abs(getattr(row, symbol)) > NOTHING else BEAT_SECONDS


def place_at(arm: Arm, time: float) -> Place:
    """Return the place at a time, which is clipped to the start and the end."""
    ends = ends_of(arm)
    k = min(bisect_left(ends, time), len(ends) - 1)
    begin = ends[k - 1] if k else 0.0
    return Place(*divmod(k, MOVES), eased((time - begin) / (ends[k] - begin)))


def place_of(state: State) -> Place:
    """Return the place in the film of a state."""
    return place_at(state[RobotPart].robot.arm, state[Timeline].time)


def start_of(arm: Arm, row: int) -> float:
    """Return the time just after the start of a row (0-based; n for the tool)."""
    return end_of(arm, row - 1, MOVES - 1) + JUST_AFTER if row else 0.0


def end_of(arm: Arm, row: int, move: int) -> float:
    """Return the time at which a move of a row ends, or the end of the film for a row that the arm does not have."""
    ends = ends_of(arm)
    return ends[min(MOVES * row + move, len(ends) - 1)]


def moving_frame(state: State) -> NDArray[np.float64]:
    """Return the moving frame in the world, shape (4, 4), which is the pose of the tool at the end of the film."""
    joints, place = state[Joints], place_of(state)
    return partial_product(joints.arm, joints.q, place.row, place.progress)


def row_product(state: State) -> NDArray[np.float64]:
    """Return the moving frame in the first frame of its row, (4, 4); at the end of row i it is the row's matrix."""
    joints, row = state[Joints], place_of(state).row
    start = joints.frames[row]
    return np.asarray(inverse(start) @ state.derived(moving_frame), dtype=np.float64)


def running_product(state: State) -> NDArray[np.float64]:
    """Return the moving frame in frame 0, shape (4, 4); at the end of row i it is the product of matrices 1 to i."""
    return np.asarray(inverse(state[Joints].arm.base) @ state.derived(moving_frame), dtype=np.float64)


def _duration(state: State) -> float:
    return ends_of(state[RobotPart].robot.arm)[-1]


def _stops(state: State) -> tuple[float, ...]:
    return ends_of(state[RobotPart].robot.arm)[:-1]


CLIP = Clip("film", "DH film", _duration, _stops, lambda state, time: state, panel="film")
