"""Basins of attraction: which solution a method reaches from each start of a grid.

The steps are those of `iterate`, taken for many starts at once, so that a film begun at a point of the map ends in the
solution the map shows. (From a start on the very edge of a basin rounding decides.)
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import as_floats, whole_number, wrong
from armlab.kin.ik.iterate.loop import Fate, march
from armlab.kin.ik.iterate.method import IterationMethod, iteration_method
from armlab.kin.ik.iterate.problem import Floats, Problem
from armlab.kin.ik.iterate.record import TOLERANCE, Limits, checked_tolerance, checked_vector, keeps_limits
from armlab.kin.ik.iterate.task_vector import TaskVector
from armlab.kin.ik.verdict import checked_locks, joint_values
from armlab.kin.transforms import as_pose

FAILED, NOT_YET = -1, -2
"""Entries of a map: no solution was reached from this start; this row is not computed yet."""

SAME = 1e-3
"""Distance, of angles (chord) and of lengths in length scales, below which two solutions are one."""

PIECE = 3072
"""Starts computed at once, times the number of joints: enough to make the cost of a call small against the work."""

BREATH = 4096
"""Steps of single starts, times the number of joints, after which the map so far is given out: some 15 ms of Newton's
method."""

MOST_PIXELS = 1_000_000


@dataclass(frozen=True, eq=False)
class Basins:
    """A map of basins of attraction, possibly unfinished.

    Attributes
    ----------
    rows : int
        Rows done.
    index : ndarray of int, shape (rows, columns)
        Number of the solution reached from each start, `FAILED` or `NOT_YET`.
    iterations : ndarray of int, shape (rows, columns)
        Steps taken.
    solutions : ndarray, shape (k, n)
        Solutions so far in the order of their numbers, angles in [-pi, pi).
    across, up : ndarray, shapes (columns,) and (rows,)
        Values of the two joints at the centres of columns and rows, rad or m, ascending.
    rest : ndarray, shape (n,)
        Start values of the other joints; of locked ones, their values.
    """

    rows: int
    index: NDArray[np.int64]
    iterations: NDArray[np.int64]
    solutions: Floats
    across: Floats
    up: Floats
    rest: Floats


def basins(
    arm: Arm,
    target: ArrayLike,
    method: str = "newton",
    grid: tuple[int, int] = (96, 96),
    *,
    joints: tuple[int, int] = (1, 2),
    rest: ArrayLike | None = None,
    seed: int = 0,
    parameters: Mapping[str, float] | None = None,
    tolerance: tuple[float, float] = TOLERANCE,
    most: int = 100,
    limits: Limits = "none",
    task: TaskVector | str | None = None,
    locked: Sequence[bool] | None = None,
    solutions: ArrayLike | None = None,
) -> Iterator[Basins]:
    """Yield the map of basins of attraction while it is computed; stop iterating to cancel.

    Between two of these comes a short spell of work, so a slow method may yield more than once before rows are added.

    Parameters
    ----------
    arm : Arm
        An arm with at most as many free joints as task components, so that solutions are single configurations.
    target : array_like, shape (4, 4)
    method : str
        Key of an iterative method.
    grid : (int, int)
        Rows and columns.
    joints : (int, int)
        The free joints (1-based) that vary across and up; over one turn, or their limits when these are kept and
        narrower.
    rest : array_like, shape (n,), optional
        Start values of the other joints; drawn inside their limits with ``seed`` when left out.
    seed : int
    parameters, tolerance, most, limits, task
        As for `iterate`.
    locked : sequence of bool, optional
        Joints that stay at their value in ``rest``.
    solutions : array_like, shape (k, n), optional
        Solutions known before, which get the first numbers; others are numbered as they are found.

    Raises
    ------
    InputError
        At once, before the first piece: wrong shapes, numbers or names, or a redundant arm.
    """
    chosen, vector = iteration_method(method), checked_vector(arm, task)
    rows, columns = _checked_grid(grid)
    held = checked_locks(arm, locked) or [False] * arm.n
    first, second = _checked_joints(arm, joints, held)
    free = [i for i in range(arm.n) if not held[i]]
    if len(free) > vector.m:
        raise InputError(
            f"arm: expected as many task components as free joints, got {vector.m} and {len(free)}: a redundant arm "
            "has infinitely many solutions; lock joints or take one as a task component"
        )
    clamp = keeps_limits(limits)
    problem = Problem(arm, as_pose(target, "target"), vector, free, None, clamp, chosen.chord)
    values, pair = chosen.values(parameters), checked_tolerance(tolerance)
    steps, start = whole_number(most, "most", 1), _rest(arm, rest, whole_number(seed, "seed", 0))
    if clamp:
        start[free] = arm.clip(start)[free]
    known = np.zeros((0, arm.n)) if solutions is None else as_floats(solutions, "solutions", "numbers")
    if known.ndim != 2 or known.shape[1] != arm.n or not np.isfinite(known).all():
        raise wrong("solutions", f"finite numbers of shape (k, {arm.n})", solutions)
    across, up = _centres(problem, first, columns), _centres(problem, second, rows)
    run = _Run(problem, chosen, values, steps, pair, known)
    return _pieces(run, start, (first, second), across, up)


def _pieces(run: _Run, rest: Floats, joints: tuple[int, int], across: Floats, up: Floats) -> Iterator[Basins]:
    rows, columns = len(up), len(across)
    index = np.full((rows, columns), NOT_YET)
    iterations = np.zeros((rows, columns), dtype=np.int64)
    height = max(1, PIECE // len(rest) // columns)
    for row in range(0, rows, height):
        done = min(row + height, rows)
        starts = np.tile(rest, (done - row, columns, 1))
        starts[:, :, joints[0]] = across
        starts[:, :, joints[1]] = up[row:done, None]
        for _ in run.from_starts(starts.reshape(-1, len(rest))):
            yield Basins(row, index.copy(), iterations.copy(), run.solutions.copy(), across, up, rest)
        found, taken = run.found
        index[row:done], iterations[row:done] = found.reshape(-1, columns), taken.reshape(-1, columns)
        yield Basins(done, index.copy(), iterations.copy(), run.solutions.copy(), across, up, rest)


class _Run:
    """A method, and the solutions that it has reached so far."""

    def __init__(
        self,
        problem: Problem,
        method: IterationMethod,
        parameters: Mapping[str, float],
        most: int,
        tolerance: tuple[float, float],
        solutions: Floats,
    ) -> None:
        self.problem, self.method, self.parameters = problem, method, parameters
        self.most, self.tolerance, self.solutions = most, tolerance, solutions
        self.found = np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64)

    def from_starts(self, starts: Floats) -> Iterator[None]:
        """Put into ``found`` the solution's number and steps (B,) from starts (B, n); yield now and then."""
        index, taken = np.full(len(starts), FAILED), np.zeros(len(starts), dtype=np.int64)
        self.found, work = (index, taken), 0
        if len(self.problem.free) < self.problem.vector.m and not self.method.tall:
            return
        reached, ends = np.zeros(len(starts), dtype=np.bool_), starts.copy()
        problem, most, breath = self.problem, self.most, BREATH // self.problem.arm.n
        stages = march(problem, self.method, self.parameters, starts, most, self.tolerance)
        for k, stage in enumerate(stages):
            ended = stage.fate != Fate.GOING
            taken[stage.rows[ended]] = k
            good = stage.fate == Fate.CONVERGED
            reached[stage.rows[good]] = True
            ends[stage.rows[good]] = stage.point.q[good]
            work += len(stage.rows)
            if work >= breath:
                work = 0
                yield
        index[reached] = self._numbered(ends[reached])

    def _numbered(self, q: Floats) -> NDArray[np.int64]:
        """Return the numbers of solutions (B, n); new ones get new numbers."""
        index, open_rows = np.full(len(q), FAILED), np.arange(len(q))
        number = 0
        while len(open_rows):
            if number == len(self.solutions):
                self.solutions = np.vstack([self.solutions, self._in_one_turn(q[open_rows[0]])])
            same = self._is_same(q[open_rows], self.solutions[number])
            index[open_rows[same]] = number
            open_rows = open_rows[~same]
            number += 1
        return index

    def _is_same(self, q: Floats, solution: Floats) -> NDArray[np.bool_]:
        arm = self.problem.arm
        chord = np.abs(2.0 * np.sin(0.5 * (q - solution)))
        apart = np.where(arm.revolute, chord, np.abs(q - solution) / arm.length_scale)
        return np.asarray(np.max(apart, axis=-1) < SAME)

    def _in_one_turn(self, q: Floats) -> Floats:
        turned = (q + math.pi) % (2.0 * math.pi) - math.pi
        return np.where(self.problem.arm.revolute, turned, q)


def _centres(problem: Problem, joint: int, count: int) -> Floats:
    """Return the middle values of ``count`` equal parts of a joint's range."""
    low, high = problem.arm.limits[joint]
    if problem.arm.revolute[joint]:
        whole = -math.pi, math.pi
        low, high = (max(low, whole[0]), min(high, whole[1])) if problem.clamp else whole
        if low > high:
            low, high = problem.arm.limits[joint]
    return np.asarray(low + (high - low) * (np.arange(count) + 0.5) / count)


def _rest(arm: Arm, rest: ArrayLike | None, seed: int) -> Floats:
    if rest is not None:
        return joint_values(arm, rest, "rest")
    low, high = arm.limits.T
    return np.asarray(np.random.default_rng(seed).uniform(low, high))


def _checked_grid(grid: tuple[int, int]) -> tuple[int, int]:
    if not isinstance(grid, (tuple, list)) or len(grid) != 2:
        raise wrong("grid", "two numbers, rows and columns", grid)
    rows, columns = (whole_number(value, "grid", 1) for value in grid)
    if rows * columns > MOST_PIXELS:
        raise InputError(f"grid: expected at most {MOST_PIXELS} starts, got {rows} x {columns}")
    return rows, columns


def _checked_joints(arm: Arm, joints: tuple[int, int], held: Sequence[bool]) -> tuple[int, int]:
    if not isinstance(joints, (tuple, list)) or len(joints) != 2 or joints[0] == joints[1]:
        raise wrong("joints", "two different joints, the first is 1", joints)
    first, second = (whole_number(value, "joints", 1) for value in joints)
    if max(first, second) > arm.n:
        raise wrong("joints", f"two joints of 1 to {arm.n}", joints)
    if held[first - 1] or held[second - 1]:
        raise wrong("joints", "two joints that are not locked", joints)
    return first - 1, second - 1
