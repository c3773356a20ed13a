"""The sheet a derivation is written on: it holds the target, the choices, the joint values and the steps so far."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.ik.by_hand.step import Branch, Case, Line, Quantity, Shape, Step, Vector
from armlab.kin.ik.screws import Screws, screws_of
from armlab.kin.ik.trig import wrap
from armlab.kin.transforms import inverse


class NoValueError(Exception):
    """A step has no value: the derivation ends with it."""


class Work:
    """A derivation in progress.

    Parameters
    ----------
    arm : Arm
    T : ndarray, shape (4, 4)
        The target in frame 0.
    near : ndarray, shape (n,)
        Where the arm is: a joint that may have any value keeps this one.
    choices : mapping of str to int
        Branches by the key of their step; the first one where nothing is said.

    Attributes
    ----------
    s : Screws
    H : ndarray, shape (4, 4)
        The motion that carries the tool from its place at q = 0 to the target.
    q : dict of int to float
        Joint values found so far.
    steps : list of Step
    taken : dict of str to int
        The branch taken at each step that offered more than one, in their order.
    """

    def __init__(self, arm: Arm, T: Vector, near: Vector, choices: Mapping[str, int]) -> None:
        self.arm, self.T, self.near, self._choices = arm, T, near, choices
        self.s: Screws = screws_of(arm)
        self.H: Vector = np.asarray(T @ inverse(self.s.home), dtype=np.float64)
        self.q: dict[int, float] = {}
        self.steps: list[Step] = []
        self.taken: dict[str, int] = {}

    @cached_property
    def tiny(self) -> float:
        """The length in metres below which a point counts as lying on an axis."""
        return 1e-10 * self.s.scale

    def carried(self, point: Vector) -> Vector:
        """Return where the target has a point that is fixed in the tool, given where it is at q = 0."""
        return np.asarray(self.H[:3, :3] @ point + self.H[:3, 3])

    def choose(self, key: str, count: int) -> int:
        """Return the branch that is chosen at a step with so many."""
        if count < 2:
            return 0
        k = min(max(self._choices.get(key, 0), 0), count - 1)
        self.taken[key] = k
        return k

    def kept(self, joint: int) -> float:
        """Return the value that a joint keeps when any will do."""
        value = float(self.near[joint])
        return wrap(value) if self.s.kinds[joint] == "R" else value

    def add(
        self,
        key: str,
        symbol: str,
        title: str,
        by: str,
        values: Mapping[str, Quantity],
        lines: tuple[Line, ...],
        *,
        index: int = -1,
        branches: tuple[Branch, ...] = (),
        chosen: int = 0,
        case: Case = "direct",
        note: str = "",
        gap: float = 0.0,
        shapes: tuple[Shape, ...] = (),
    ) -> None:
        """Write down a step, and the value of its joint; `NoValueError` when it has none."""
        self.steps.append(Step(key, symbol, title, by, values, lines, branches, chosen, case, note, gap, index, shapes))
        if case == "none":
            raise NoValueError
        if index >= 0:
            value = branches[chosen].value
            assert value is not None
            self.q[index] = value


def triple(point: Vector) -> tuple[float, ...]:
    """Return the coordinates of a point as numbers."""
    return tuple(float(value) for value in point)
