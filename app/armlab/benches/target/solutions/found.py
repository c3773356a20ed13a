"""All solutions in a lasting order: while the target moves, each keeps its place and its colour."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import count

import numpy as np
from numpy.typing import NDArray

from armlab.benches.target.solutions.motion import Motion
from armlab.benches.target.solutions.question import Question
from armlab.kin.arm import Arm
from armlab.kin.ik.self_motion import distance_to
from armlab.kin.ik.solutions import IkSolutions
from armlab.session.way_to_solution import HERE, ON_CURVE, gap

Vector = NDArray[np.float64]

FOLLOWS = 1.0
"""Largest change of a joint, radians or length scales, over which a solution without a name is still the same one."""

NEAR = 0.3
"""Largest distance of a joint to a solution of an old list at which a moving arm counts as being at it."""

MOST_NAMES = 200
"""Number of names that are remembered while a target is dragged."""


@dataclass(frozen=True, eq=False)
class Row:
    """One solution.

    Attributes
    ----------
    slot : int
        What it keeps while the target moves: its colour, and its place in the order.
    index : int
        Its place in `IkSolutions`.
    name : str
    q : ndarray, shape (n,)
    beyond : ndarray, shape (n,)
        How far each joint is out of its limits; see `IkSolutions.beyond`.
    family : int
        Which of the curves it stands for, 0-based; -1 for none.
    """

    slot: int
    index: int
    name: str
    q: Vector
    beyond: Vector
    family: int = -1

    @property
    def within(self) -> bool:
        """Whether it is inside the limits."""
        return not self.beyond.any()


@dataclass(frozen=True, eq=False)
class Found:
    """Results for a question.

    Attributes
    ----------
    question : Question
    solutions : IkSolutions
    rows : tuple of Row
        As they are listed.
    motion : Motion or None
        The self-motion through the arm, where there is one.
    traced : ndarray or None
        Where the arm was when it was looked for last.
    slots : dict
        Name to slot, of all names since the arm was chosen.
    """

    question: Question
    solutions: IkSolutions
    rows: tuple[Row, ...]
    motion: Motion | None = None
    traced: Vector | None = None
    slots: Mapping[str, int] = field(default_factory=dict)

    @property
    def families(self) -> list[int]:
        """The curve of each solution, as `families_of` returns it."""
        return [row.family for row in sorted(self.rows, key=lambda row: row.index)]

    def row(self, slot: int) -> Row | None:
        """Return the row with this slot, if it is there."""
        return next((row for row in self.rows if row.slot == slot), None)

    def nearest(
        self, q: NDArray[np.float64], skip: Iterable[int] = (), inside: bool = False
    ) -> tuple[Row | None, float]:
        """Return the row nearest to joint values (n,), and the largest distance of a joint.

        Parameters
        ----------
        q : ndarray, shape (n,)
        skip : iterable of int
            Slots that do not count.
        inside : bool
            Whether only rows inside the limits count.
        """
        left_out = set(skip)
        rows = [row for row in self.rows if row.slot not in left_out and (row.within or not inside)]
        if not rows:
            return None, float("inf")
        far = np.abs(gap(self.question.arm, np.array([row.q for row in rows]), q)).max(axis=1)
        k = int(np.argmin(far))
        return rows[k], float(far[k])

    def present(self, q: NDArray[np.float64], fresh: bool) -> Row | None:
        """Return the row at which the arm is; in an old list it counts while the arm is near it."""
        row, far = self.nearest(q)
        return row if far < (HERE if fresh else NEAR) else None


def listed(question: Question, solutions: IkSolutions, families: Sequence[int], before: Found | None) -> Found:
    """Return solutions in the order of an earlier list of the same arm.

    A solution is the one before with its name, else the nearest without a partner; what is new takes the slot its name
    had once, or the next free one.

    Parameters
    ----------
    question : Question
    solutions : IkSolutions
    families : sequence of int
        See `families_of`.
    before : Found or None
    """
    arm, names = question.arm, solutions.names
    if before is not None and before.question.arm is not arm:
        before = None
    slots = _slots(arm, solutions, before)
    rows = [Row(slots[k], k, names[k], solutions.q[k], solutions.beyond[k], families[k]) for k in range(len(solutions))]
    known = {} if before is None or len(before.slots) > MOST_NAMES else dict(before.slots)
    known |= dict(zip(names, slots, strict=True))
    return Found(question, solutions, tuple(sorted(rows, key=lambda row: row.slot)), slots=known)


def _slots(arm: Arm, solutions: IkSolutions, before: Found | None) -> list[int]:
    names = solutions.names
    numbered = any(name.startswith("solution ") for name in names)
    known = {} if before is None or numbered else before.slots
    slots = [known.get(name, -1) for name in names]
    if before is not None:
        _pair(arm, solutions.q, slots, {row.slot: row.q for row in before.rows if row.slot not in slots})
    kept = set(known.values())
    for k, slot in enumerate(slots):
        if slot < 0:
            slots[k] = next(i for i in count() if i not in slots and i not in kept)
    return slots


def _pair(arm: Arm, q: Vector, slots: list[int], old: Mapping[int, Vector]) -> None:
    """Give each solution without a slot that of the nearest old configuration, in place."""
    new = [k for k, slot in enumerate(slots) if slot < 0]
    if not new or not old:
        return
    slots_before, before = list(old), np.array(list(old.values()))
    far = np.abs(gap(arm, q[new][:, None], before[None])).max(axis=2)
    while far.size and float(far.min()) < FOLLOWS:
        i, j = divmod(int(np.argmin(far)), far.shape[1])
        slots[new[i]] = slots_before[j]
        far[i], far[:, j] = np.inf, np.inf


def families_of(arm: Arm, solutions: IkSolutions) -> list[int]:
    """Return for each solution the index of its traced curve, or -1."""
    if not solutions.families:
        return [-1] * len(solutions)
    found = []
    for q in solutions.q:
        far = [distance_to(arm, q, [curve]) for curve in solutions.families]
        k = int(np.argmin(far))
        found.append(k if far[k] < ON_CURVE else -1)
    return found
