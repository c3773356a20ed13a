"""The request for a map of basins of attraction, and the map so far."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.benches.iterate.runs.worked import Run
from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.ik.iterate import Basins as Found
from armlab.kin.ik.iterate import TaskVector, basins
from armlab.kin.ik.iterate.record import Limits


@dataclass(frozen=True, eq=False)
class Question:
    """All arguments of a map; each request is made once, so it equals only itself.

    Attributes
    ----------
    arm : Arm
    target : bytes
        Of the pose (4, 4).
    task : TaskVector
    run : Run
        Method and parameters.
    joints : (int, int)
        0-based; the joints that vary across and up.
    rest : tuple of float
        Start values, rad or m; of the two joints they do not matter.
    locked : tuple of bool
    limits : "clamp" or "none"
    most : int
        Largest number of steps.
    points : int
        Starts along either side.
    """

    arm: Arm
    target: bytes
    task: TaskVector
    run: Run
    joints: tuple[int, int]
    rest: tuple[float, ...]
    locked: tuple[bool, ...]
    limits: Limits
    most: int
    points: int

    def pieces(self, solutions: NDArray[np.float64] | None = None) -> Iterator[Found]:
        """Return the map in pieces; `InputError` at once if there can be none."""
        return basins(
            self.arm,
            np.frombuffer(self.target).reshape(4, 4).copy(),
            self.run.method,
            (self.points, self.points),
            joints=(self.joints[0] + 1, self.joints[1] + 1),
            rest=self.rest,
            parameters=self.run.values,
            most=self.most,
            limits=self.limits,
            task=self.task,
            locked=self.locked,
            solutions=solutions,
        )


@dataclass(frozen=True, eq=False)
class Map:
    """A map with the rows computed so far.

    Attributes
    ----------
    question : Question
    found : Found
    names : tuple of str
        Of the solutions, in the order of their numbers.
    known : str
        What is known about all solutions, in a sentence; empty when nothing is.
    """

    question: Question
    found: Found
    names: tuple[str, ...]
    known: str = ""

    @property
    def finished(self) -> bool:
        """Whether every start has been tried."""
        return self.found.rows == self.question.points

    @property
    def done(self) -> float:
        """The share of the starts that has been tried, 0 to 1."""
        return self.found.rows / self.question.points

    def start(self, x: float, y: float) -> tuple[float, ...]:
        """Return the start at a place of the map, in parts of its sides from the lower left corner."""
        row, column = self._place(x, y)
        q = self.found.rest.copy()
        across, up = self.question.joints
        q[across], q[up] = self.found.across[column], self.found.up[row]
        return tuple(q.tolist())

    def outcome(self, x: float, y: float) -> tuple[int, int]:
        """Return the number of the solution reached from a place, see `start`, and the number of steps."""
        row, column = self._place(x, y)
        return int(self.found.index[row, column]), int(self.found.iterations[row, column])

    def _place(self, x: float, y: float) -> tuple[int, int]:
        points = self.question.points
        if not (0.0 <= x <= 1.0 and 0.0 <= y <= 1.0):
            raise InputError(f"place in the map: expected parts of its sides, 0 to 1, got {x:g}, {y:g}")
        return min(int(y * points), points - 1), min(int(x * points), points - 1)

    def part(self, joint: int, value: float) -> float:
        """Return the place of a joint value on a side, 0 to 1 from its low end; it may be outside, or need whole turns.

        Parameters
        ----------
        joint : int
            0 for the one across, 1 for the one up.
        value : float
            rad or m.
        """
        values = (self.found.across, self.found.up)[joint]
        step = float(values[1] - values[0])
        low, length = float(values[0]) - 0.5 * step, step * len(values)
        part = (value - low) / length if length > 0.0 else 0.5
        if self.question.arm.revolute[self.question.joints[joint]] and not 0.0 <= part <= 1.0:
            part = (value - low) % math.tau / length
        return part
