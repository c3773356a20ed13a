"""An arm: a Denavit-Hartenberg table with limits, base and tool, and what follows from it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin import formulas
from armlab.kin.checks import as_floats, wrong
from armlab.kin.dh import CONVENTIONS, Convention, Row, RowLike, row_of
from armlab.kin.graph.kernel import Kernel
from armlab.kin.print_arm import table
from armlab.kin.rotations import Array
from armlab.kin.task import Task, task_named
from armlab.kin.task_choice import default_task
from armlab.kin.transforms import as_pose
from armlab.registry import known_name

MAX_JOINTS = 12
DEFAULT_STROKE = (0.0, 1.0)
"""Limits, in metres, of a prismatic joint that is given none; a revolute joint gets a full turn."""


@dataclass(frozen=True, eq=False)
class Arm:
    """A serial arm of 1 to 12 joints. Immutable; make one with `from_dh`.

    Joint values are radians for revolute and metres for prismatic joints. Poses are in the world: ``base`` is frame 0
    in the world and ``tool`` the tool frame in frame n, so that ``T_we = base @ A_1 @ ... @ A_n @ tool`` (notes
    4.15-4.16).

    Attributes
    ----------
    rows : tuple of Row
    convention : "standard" or "modified"
    base, tool : ndarray, shape (4, 4)
    limits : ndarray, shape (n, 2)
        Smallest and largest value of each joint.
    speed_limits, acceleration_limits : ndarray, shape (n,)
        In rad/s or m/s and rad/s² or m/s²; infinite where none is known.
    task : Task
    name : str
    """

    rows: tuple[Row, ...]
    convention: Convention
    base: NDArray[np.float64]
    tool: NDArray[np.float64]
    limits: NDArray[np.float64]
    speed_limits: NDArray[np.float64]
    acceleration_limits: NDArray[np.float64]
    task: Task
    name: str = ""

    @classmethod
    def from_dh(
        cls,
        rows: Sequence[RowLike],
        convention: Convention = "standard",
        base: ArrayLike | None = None,
        tool: ArrayLike | None = None,
        limits: ArrayLike | None = None,
        speed_limits: ArrayLike | None = None,
        acceleration_limits: ArrayLike | None = None,
        task: str | Task | None = None,
        name: str = "",
    ) -> Arm:
        """Make an arm from its Denavit-Hartenberg table.

        Parameters
        ----------
        rows : sequence
            One entry for each joint: ``(kind, a, alpha, d, theta)`` with kind "R" or "P", or a mapping with these
            names, or a `Row`. Metres and radians; the variable's own entry is its offset. In the modified convention
            row i holds a_{i-1} and alpha_{i-1}.
        convention : "standard" or "modified"
        base, tool : array_like, shape (4, 4), optional
            The identity when left out.
        limits : array_like, shape (n, 2), optional
            [-pi, pi] rad and [0, 1] m when left out.
        speed_limits, acceleration_limits : array_like, shape (n,), optional
            Positive; infinite when left out.
        task : str or Task, optional
            Such as ``"xy phi"`` or ``"pose"``; chosen from the geometry when left out.
        name : str, optional

        Raises
        ------
        InputError
            Anything wrong with the above; the text names the row and the field.

        Examples
        --------
        >>> import math
        >>> arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0), ("R", 0.5, 0.0, 0.0, 0.0)])
        >>> arm.position([0.0, math.pi / 2]).round(3).tolist()
        [1.0, 0.5, 0.0]
        """
        if not isinstance(rows, Sequence) or isinstance(rows, str):
            raise wrong("rows", "a list of rows", rows)
        if not 1 <= len(rows) <= MAX_JOINTS:
            raise InputError(f"rows: an arm has 1 to {MAX_JOINTS} joints, got {len(rows)}")
        known_name("convention", convention, CONVENTIONS)
        checked = tuple(row_of(row, f"row {i + 1}") for i, row in enumerate(rows))
        n = len(checked)
        base_pose = as_pose(np.eye(4) if base is None else base, "base")
        tool_pose = as_pose(np.eye(4) if tool is None else tool, "tool")
        if task is None:
            task = default_task(checked, convention, tool_pose)
        return cls(
            rows=checked,
            convention=convention,
            base=base_pose,
            tool=tool_pose,
            limits=_limits(limits, checked),
            speed_limits=_bounds(speed_limits, n, "speed_limits"),
            acceleration_limits=_bounds(acceleration_limits, n, "acceleration_limits"),
            task=task if isinstance(task, Task) else task_named(task),
            name=name,
        )

    @property
    def n(self) -> int:
        """Number of joints."""
        return len(self.rows)

    @cached_property
    def revolute(self) -> NDArray[np.bool_]:
        """Whether each joint turns, shape (n,)."""
        return np.array([row.revolute for row in self.rows])

    @cached_property
    def reach(self) -> float:
        """Upper bound, in metres, of the distance from frame 0 to the tool point: the sum of all lengths."""
        fixed = sum(abs(row.a) + abs(row.d) for row in self.rows) + float(np.linalg.norm(self.tool[:3, 3]))
        strokes = np.abs(self.limits[~self.revolute]).max(axis=1).sum()
        return float(fixed + strokes)

    @cached_property
    def length_scale(self) -> float:
        """Half the reach in metres, or 1 m for an arm without lengths: a length that algorithms weigh like a radian."""
        return self.reach / 2 or 1.0

    @cached_property
    def description(self) -> formulas.Description:
        """The constants of the arm from which its formulas are made."""
        return formulas.Description(self.rows, self.convention, self.base, self.tool, self.task)

    # One kernel for each kind of result, built on first use.
    @cached_property
    def _position(self) -> Kernel:
        return formulas.position(self.description)

    @cached_property
    def _pose(self) -> Kernel:
        return formulas.pose(self.description)

    @cached_property
    def _frames(self) -> Kernel:
        return formulas.frames(self.description)

    @cached_property
    def _jacobian(self) -> Kernel:
        return formulas.jacobian(self.description)

    @cached_property
    def _manipulability(self) -> Kernel:
        return formulas.manipulability(self.description)

    def fk(self, q: ArrayLike, out: Array | None = None) -> Array:
        """Return the pose of the tool in the world.

        Parameters
        ----------
        q : array_like, shape (..., n)
            Joint values in rad or m; a single configuration must be finite, in a batch a row that is not gives nan.
            Single precision in, single precision out.
        out : ndarray, shape (..., 4, 4), optional
            Written and returned; saves the time of allocating fresh memory.

        Returns
        -------
        ndarray, shape (..., 4, 4)
        """
        return self._evaluate(self._pose, q, (4, 4), out)

    def frames(self, q: ArrayLike, out: Array | None = None) -> Array:
        """Return the poses of frames 0 to n in the world, shape (..., n+1, 4, 4); the tool is not included."""
        return self._evaluate(self._frames, q, (self.n + 1, 4, 4), out)

    def position(self, q: ArrayLike, out: Array | None = None) -> Array:
        """Return the tool point in the world in metres, shape (..., 3)."""
        return self._evaluate(self._position, q, (3,), out)

    def jacobian(self, q: ArrayLike, out: Array | None = None) -> Array:
        """Return the geometric Jacobian at the tool point, shape (..., 6, n).

        Rows are the linear then the angular velocity, both in world axes: ``(v; omega) = J qdot``. Columns are
        ``(z x p; z)`` for revolute and ``(z; 0)`` for prismatic joints.

        References
        ----------
        Notes 5.52-5.65.
        """
        return self._evaluate(self._jacobian, q, (6, self.n), out)

    def manipulability(self, q: ArrayLike, out: Array | None = None) -> Array:
        """Return w = sqrt(det(J J^T)) of the task Jacobian, shape (...).

        With more task components than joints it is sqrt(det(J^T J)) (notes, section 5.1.4). Its unit is m^p for p
        controlled coordinates of an all-revolute arm.

        References
        ----------
        Yoshikawa 1985; notes 5.144.
        """
        return self._evaluate(self._manipulability, q, (), out)

    def _evaluate(self, kernel: Kernel, q: ArrayLike, shape: tuple[int, ...], out: Array | None) -> Array:
        values = self._values(q)
        if values.ndim == 1 and out is None:
            # Everything a student's slider does comes through here: no batch machinery.
            numbers = values.tolist()
            if not all(map(math.isfinite, numbers)):
                raise wrong("q", f"{self.n} finite numbers", numbers)
            return np.array(kernel.scalar(*numbers), dtype=values.dtype).reshape(shape)
        batch = values.shape[:-1]
        if out is None:
            out = np.empty(batch + shape, values.dtype)
        elif not isinstance(out, np.ndarray):
            raise wrong("out", f"a C-contiguous float array of shape {batch + shape}", out)
        elif out.shape != batch + shape or out.dtype.char not in "fd" or not _writable_rows(out):
            raise InputError(
                f"out: expected a C-contiguous, writable float array of shape {batch + shape}, "
                f"got {out.dtype} of shape {out.shape}"
            )
        kernel.batch(values.reshape(-1, self.n), out.reshape(-1, len(kernel.outputs)))
        return out

    def __getstate__(self) -> dict[str, object]:
        """Leave out what is computed from the table: a copy computes it again."""
        return {each.name: getattr(self, each.name) for each in fields(self)}

    def __setstate__(self, state: dict[str, object]) -> None:
        """Restore the attributes; copies of read-only arrays are writable and have to be protected again."""
        for value in state.values():
            if isinstance(value, np.ndarray):
                value.setflags(write=False)
        vars(self).update(state)

    def _values(self, q: ArrayLike) -> Array:
        """Return joint values (..., n). Floats are not copied: a batch may be large."""
        ready = isinstance(q, np.ndarray) and q.dtype.char in "fd"
        values: Array = np.asarray(q) if ready else as_floats(q, "q", f"numbers of shape (..., {self.n})")
        if values.shape[-1:] != (self.n,):
            raise InputError(f"q: expected shape (..., {self.n}), got {values.shape}")
        return values

    def clip(self, q: ArrayLike) -> Array:
        """Return joint values moved inside the limits, shape (..., n)."""
        inside: Array = np.clip(self._values(q), self.limits[:, 0], self.limits[:, 1])
        return inside

    def within_limits(self, q: ArrayLike, tolerance: float = 1e-9) -> bool:
        """Return whether one configuration is inside the limits, in rad or m within the tolerance."""
        values = self._values(q)
        inside = (values >= self.limits[:, 0] - tolerance) & (values <= self.limits[:, 1] + tolerance)
        return bool(np.all(inside))

    def __str__(self) -> str:
        title, task = self.name or "Arm", self.task.title
        return table(title, self.convention, self.rows, self.limits, self.base, self.tool, task)


def _writable_rows(out: Array) -> bool:
    return out.flags.c_contiguous and out.flags.writeable


def _limits(limits: ArrayLike | None, rows: Sequence[Row]) -> NDArray[np.float64]:
    if limits is None:
        values = np.array([(-math.pi, math.pi) if row.revolute else DEFAULT_STROKE for row in rows])
    else:
        values = as_floats(limits, "limits", f"numbers of shape ({len(rows)}, 2)")
        if values.shape != (len(rows), 2):
            raise InputError(f"limits: expected shape ({len(rows)}, 2), got {values.shape}")
        for i, (low, high) in enumerate(values):
            if not (math.isfinite(low) and math.isfinite(high)):
                raise InputError(f"limits of joint {i + 1}: expected finite numbers, got [{low}, {high}]")
            if low > high:
                raise InputError(f"limits of joint {i + 1}: the smaller comes first, got [{low}, {high}]")
    values.setflags(write=False)
    return values


def _bounds(bounds: ArrayLike | None, n: int, where: str) -> NDArray[np.float64]:
    values = np.full(n, np.inf) if bounds is None else as_floats(bounds, where, f"{n} numbers")
    if values.shape != (n,):
        raise InputError(f"{where}: expected {n} numbers, got shape {values.shape}")
    if not np.all(values > 0):
        raise InputError(f"{where}: expected positive numbers, got {values.tolist()}")
    values.setflags(write=False)
    return values
