"""Joint space and task space of the arm: their dimensions, the present r, and how both numbers compare."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from armlab.benches.pose.spaces.state import Spaces
from armlab.kin.arm import Arm
from armlab.kin.rotations import euler_zyx
from armlab.kin.task import Task, task_named
from armlab.kin.transforms import inverse
from armlab.kin.velocity.subspaces import task_subspaces
from armlab.session.parts.joints import Joints
from armlab.session.state import State

SAMPLES = 12
"""Number of random configurations, with a fixed seed, that represent the generic one."""


KINDS = {
    "square": "m = n, as many numbers as joints",
    "redundant": "m < n, redundant",
    "more": "m > n, more numbers than joints",
    "fixed": "r has numbers that this arm cannot choose",
}
"""Ways in which n and m compare, in words."""


class Component(NamedTuple):
    """One component of r.

    Attributes
    ----------
    symbol : str
        Such as ``"p_x"``.
    value : float
        Metres or radians; of a direction a pure number.
    kind : "length", "angle" or "number"
    """

    symbol: str
    value: float
    kind: str


class Maps(NamedTuple):
    """Dimensions of the spaces.

    Attributes
    ----------
    n, m : int
        Joints, and components of r.
    generic, rank : int
        Dimensions in which r can change: nearly everywhere, and here.
    task : Task
    """

    n: int
    m: int
    generic: int
    rank: int
    task: Task

    @property
    def kind(self) -> str:
        """``"fixed"`` where r has components that never change by themselves, else ``"more"`` task components than
        joints, ``"square"`` or ``"redundant"``."""
        if self.m > self.n:
            return "more"
        if self.generic < self.m:
            return "fixed"
        return "square" if self.m == self.n else "redundant"

    @property
    def spare(self) -> int:
        """Dimension of the set of joint values that belong to one r, nearly everywhere."""
        return self.n - self.generic


def task_of(state: State) -> Task:
    """Return what r describes: the choice of the page, or the task of the arm."""
    chosen = state[Spaces].task
    return state[Joints].arm.task if chosen == "own" else task_named(chosen)


def maps_of(state: State) -> Maps:
    """Return the dimensions of the spaces at the present configuration."""
    arm, task = state[Joints].arm, task_of(state)
    asked = _asked(arm, task)
    return Maps(arm.n, task.m, _generic(asked), task_subspaces(asked, state[Joints].q).rank, task)


def components_of(state: State) -> list[Component]:
    """Return r = f_r(q), component by component, in frame 0."""
    arm, task = state[Joints].arm, task_of(state)
    T = inverse(arm.base) @ state[Joints].tool_pose
    found = [Component(f"p_{letter}", float(T["xyz".index(letter), 3]), "length") for letter in task.position]
    if task.rotation == "phi":
        found.append(Component("φ", float(np.arctan2(T[1, 0], T[0, 0])), "angle"))
    elif task.rotation == "approach":
        found += [Component(f"a_{letter}", float(T[k, 2]), "number") for k, letter in enumerate("xyz")]
    elif task.rotation == "full":
        angles = np.asarray(euler_zyx(T[:3, :3])[0], dtype=float).tolist()
        found += [Component(name, value, "angle") for name, value in zip(("yaw", "pitch", "roll"), angles, strict=True)]
    return found


@lru_cache(maxsize=32)
def _asked(arm: Arm, task: Task) -> Arm:
    return arm if task == arm.task else replace(arm, task=task)


@lru_cache(maxsize=32)
def _generic(arm: Arm) -> int:
    rng = np.random.default_rng(0)
    drawn = rng.uniform(arm.limits[:, 0], arm.limits[:, 1], (SAMPLES, arm.n))
    return max(task_subspaces(arm, q).rank for q in drawn)
