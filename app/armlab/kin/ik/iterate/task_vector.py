"""The task vector r of an iteration: which numbers a method drives to their wanted values.

Usually the components of the arm's own task. A lesson may choose others: position alone, an orientation by three Euler
angles, or a joint itself, such as (p_x, p_y, q_3) of the planar 3R, whose two solutions are the two arms of a 2R.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.arm import Arm
from armlab.kin.checks import finite_floats, whole_number, wrong
from armlab.kin.euler import SEQUENCES
from armlab.kin.ik.weights import one_for_the_orientation, positive_factors
from armlab.kin.task import Task, task_named

Kind = Literal["m", "rad"]


@dataclass(frozen=True)
class TaskVector:
    """A choice of components; make one with `task_vector`.

    Attributes
    ----------
    task : Task
        Coordinates of the tool point and kind of orientation, in axes of frame 0.
    joints : tuple of (int, float)
        Joints (1-based) that are components themselves, with the value wanted, rad or m.
    euler : str or None
        None: the orientation error is theta r, the rotation vector from the present to the wanted orientation, and its
        Jacobian the geometric one. A sequence such as ``"zyx"``: it is the difference of three Euler angles, and its
        Jacobian the analytic one (notes 4.113).
    fixed : bool
        Whether the Euler angles are about fixed axes.
    """

    task: Task
    joints: tuple[tuple[int, float], ...] = ()
    euler: str | None = None
    fixed: bool = False

    @property
    def m(self) -> int:
        """Number of components."""
        return self.task.m + len(self.joints)

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the components as in the notes."""
        rotation = {"none": (), "phi": ("φ",), "approach": ("o_1", "o_2"), "full": ("o_x", "o_y", "o_z")}
        turns = ("φ", "θ", "ψ") if self.euler else rotation[self.task.rotation]
        return (*(f"p_{letter}" for letter in self.task.position), *turns, *(f"q_{i}" for i, _ in self.joints))

    def kinds(self, arm: Arm) -> tuple[Kind, ...]:
        """Return the unit of each component."""
        place: list[Kind] = ["m" for _ in self.task.position]
        turns: list[Kind] = ["rad" for _ in range(self.task.m - len(place))]
        own: list[Kind] = ["rad" if arm.rows[i - 1].revolute else "m" for i, _ in self.joints]
        return (*place, *turns, *own)

    def factors(self, values: ArrayLike, where: str) -> NDArray[np.float64]:
        """Return one positive factor for each component, (m,).

        Raises
        ------
        InputError
            Other numbers than these, or different ones for the components of one rotation vector.
        """
        found = positive_factors(values, where, self.m)
        if self.euler is None:
            one_for_the_orientation(found[len(self.task.position) : self.task.m], where)
        return found


def task_vector(
    arm: Arm,
    task: str | Task | None = None,
    *,
    joints: Mapping[int, float] | None = None,
    euler: str | None = None,
    fixed: bool = False,
) -> TaskVector:
    """Return a checked choice of task components for an arm.

    Parameters
    ----------
    arm : Arm
    task : str or Task, optional
        Such as ``"xy"``, ``"xy phi"`` or ``"pose"``; the arm's own when left out.
    joints : mapping, optional
        Joint (1-based) to the value wanted, rad or m: these joints become components.
    euler : str, optional
        Sequence of Euler angles whose difference is the orientation error; for a full orientation only.
    fixed : bool
        Whether they are about fixed axes.

    Raises
    ------
    InputError
        An unknown task, joint or sequence, a value that is no number, or Euler angles without a full orientation.

    Examples
    --------
    >>> arm = Arm.from_dh([("R", 1.0, 0.0, 0.0, 0.0)] * 3)
    >>> task_vector(arm, "xy", joints={3: 0.5}).names
    ('p_x', 'p_y', 'q_3')
    """
    chosen = arm.task if task is None else task if isinstance(task, Task) else task_named(task)
    own: list[tuple[int, float]] = []
    for joint, value in (joints or {}).items():
        number = whole_number(joint, "joints", 1)
        if number > arm.n:
            raise wrong("joints", f"joints 1 to {arm.n}", joint)
        own.append((number, float(finite_floats(value, f"joints[{number}]", (), "a finite number"))))
    if euler is not None:
        if not isinstance(euler, str) or euler.lower() not in SEQUENCES:
            raise wrong("euler", f"one of {', '.join(SEQUENCES)}", euler)
        if chosen.rotation != "full":
            raise InputError(f"euler: expected a task with a full orientation, got the task {chosen.key!r}")
        euler = euler.lower()
    return TaskVector(chosen, tuple(sorted(own)), euler, bool(fixed))


def wrapped_angle(angle: np.ndarray) -> np.ndarray:
    """Return angles in [-pi, pi), of any shape."""
    return np.asarray((angle + math.pi) % (2.0 * math.pi) - math.pi)
