"""The film of the table: four moves a row, from frame 0 to the tool. It shows the arm as it stands; no joint moves."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.moves import MOVES, partial_product
from armlab.kin.transforms import inverse
from armlab.session.parts.joints import Joints
from armlab.session.parts.robot import RobotPart
from armlab.session.parts.timeline import Clip, Timeline
from armlab.session.state import State

MOVE_SECONDS = 1.5

JUST_AFTER = 1e-3
"""Seconds. The end of a row and the start of the next are one time: it shows the end, and a row starts just after."""

NO_TOOL = 1e-12
"""Largest difference, in metres and of entries of the rotation, at which a tool's frame is frame n itself."""


@dataclass(frozen=True)
class Place:
    """Where the film stands.

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
        """Moves of the row done, 0 to 4."""
        return self.move + self.part


def has_tool(arm: Arm) -> bool:
    """Return whether the tool's frame is another than frame n."""
    return bool(np.abs(arm.tool - np.eye(4)).max() > NO_TOOL)


def moves_in(arm: Arm) -> int:
    """Return how many moves the film has: four a row, and one to the tool if it has a frame of its own."""
    return MOVES * arm.n + int(has_tool(arm))


def place_at(arm: Arm, time: float) -> Place:
    """Return the place at a time; before the start and after the end, those."""
    last = moves_in(arm) - 1
    k = min(max(math.ceil(time / MOVE_SECONDS) - 1, 0), last)
    return Place(*divmod(k, MOVES), _eased(min(max(time / MOVE_SECONDS - k, 0.0), 1.0)))


def place_of(state: State) -> Place:
    """Return where the film of a state stands."""
    return place_at(state[RobotPart].robot.arm, state[Timeline].time)


def start_of(row: int) -> float:
    """Return the time at which a row (0-based; n for the tool) has not yet begun."""
    return MOVES * row * MOVE_SECONDS + (JUST_AFTER if row else 0.0)


def end_of(row: int, move: int) -> float:
    """Return the time at which a move of a row has just ended."""
    return (MOVES * row + move + 1) * MOVE_SECONDS


def moving_frame(state: State) -> NDArray[np.float64]:
    """Return the moving frame in the world, shape (4, 4): at the end of the film the pose of the tool."""
    joints, place = state[Joints], place_of(state)
    return partial_product(joints.arm, joints.q, place.row, place.progress)


def row_product(state: State) -> NDArray[np.float64]:
    """Return the moving frame in the frame its row starts from, shape (4, 4): at the end of row i its matrix."""
    joints, row = state[Joints], place_of(state).row
    start = joints.frames[row]
    return np.asarray(inverse(start) @ state.derived(moving_frame), dtype=np.float64)


def running_product(state: State) -> NDArray[np.float64]:
    """Return the moving frame in frame 0, shape (4, 4): at the end of row i the product of the matrices 1 to i."""
    return np.asarray(inverse(state[Joints].arm.base) @ state.derived(moving_frame), dtype=np.float64)


def _eased(s: float) -> float:
    """Return the minimum-jerk course from 0 to 1: each move begins and ends at rest."""
    return s * s * s * (10.0 + s * (6.0 * s - 15.0))


def _duration(state: State) -> float:
    return moves_in(state[RobotPart].robot.arm) * MOVE_SECONDS


def _stops(state: State) -> tuple[float, ...]:
    return tuple(k * MOVE_SECONDS for k in range(1, moves_in(state[RobotPart].robot.arm)))


CLIP = Clip("film", "DH film", _duration, _stops, lambda state, time: state, panel="film")
