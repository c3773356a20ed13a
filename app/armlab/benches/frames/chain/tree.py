"""Poses in the world, and the way from one frame to another through their parents."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.benches.frames.chain.state import WORLD, Chain
from armlab.kin.operations import COSTS, Count, multiplied_first, one_by_one
from armlab.kin.transforms import inverse
from armlab.registry import known_name
from armlab.session.state import State

Floats = NDArray[np.float64]


class Step(NamedTuple):
    """One factor of a product: the pose of ``frame`` in ``reference``, of which one is the parent of the other.

    ``against`` tells that the reference is the child, so that the factor is the inverse of what is given.
    """

    reference: str
    frame: str
    against: bool


@dataclass(frozen=True, eq=False)
class Pair:
    """The transform between two frames.

    Attributes
    ----------
    reference, frame : str
    steps : tuple of Step
        Factors from the left; none if both are the same frame.
    factors : tuple of ndarray, each of shape (4, 4)
    T : ndarray, shape (4, 4)
        The product: the pose of ``frame`` in ``reference``.
    inverse : ndarray, shape (4, 4)
        ``[R^T, -R^T p]`` (notes 3.115).
    general : ndarray, shape (4, 4)
        The inverse as of any matrix.
    """

    reference: str
    frame: str
    steps: tuple[Step, ...]
    factors: tuple[Floats, ...]
    T: Floats
    inverse: Floats
    general: Floats

    @property
    def difference(self) -> float:
        """The largest difference of an entry of the two inverses."""
        return float(np.abs(self.inverse - self.general).max())


def poses(part: Chain) -> dict[str, Floats]:
    """Return the poses of all frames in the world, (4, 4) each, by name."""
    found: dict[str, Floats] = {WORLD: np.eye(4)}
    for frame in part.frames:
        found[frame.name] = found[frame.parent] @ frame.T
    return found


def line_of(part: Chain, name: str) -> tuple[str, ...]:
    """Return the frames from the world to a frame, both included."""
    known_name("frame", name, part.names)
    line = [name]
    while line[-1] != WORLD:
        line.append(part.named(line[-1]).parent)
    return tuple(reversed(line))


def steps_between(part: Chain, reference: str, frame: str) -> tuple[Step, ...]:
    """Return the factors of the pose of a frame in another one, from the left: up to where both lines part, and down.

    Examples
    --------
    >>> [(step.reference, step.frame) for step in steps_between(Chain(), "B", "w")]
    [('B', 'A'), ('A', 'w')]
    """
    up, down = line_of(part, reference), line_of(part, frame)
    shared = next((k for k, (one, other) in enumerate(zip(up, down, strict=False)) if one != other), None)
    common = min(len(up), len(down)) if shared is None else shared
    rising = [Step(up[k], up[k - 1], True) for k in range(len(up) - 1, common - 1, -1)]
    falling = [Step(down[k - 1], down[k], False) for k in range(common, len(down))]
    return *rising, *falling


def pair(part: Chain, reference: str, frame: str) -> Pair:
    """Return the transform between two frames, by their names."""
    steps = steps_between(part, reference, frame)
    factors = tuple(_factor(part, step) for step in steps)
    T = reduce(np.matmul, factors, np.eye(4))
    quick, general = (np.asarray(each, dtype=np.float64) for each in (inverse(T), np.linalg.inv(T)))
    return Pair(reference, frame, steps, factors, T, quick, general)


def _factor(part: Chain, step: Step) -> Floats:
    if step.against:
        return np.asarray(inverse(part.named(step.reference).T), dtype=np.float64)
    return part.named(step.frame).T


def pair_of(state: State) -> Pair:
    """Return the chosen transform."""
    part = state[Chain]
    return pair(part, part.reference, part.frame)


def poses_of(state: State) -> dict[str, Floats]:
    """Return the poses of all frames in the world."""
    return poses(state[Chain])


def point_of(state: State) -> Floats:
    """Return the point in the world, (3,)."""
    part = state[Chain]
    return moved(state.derived(poses_of)[part.given], part.point)


def moved(T: Floats, p: Sequence[float] | Floats) -> Floats:
    """Return the coordinates of a point (3,) after a change by T (4, 4): ``R p + p_ij`` (notes 3.109)."""
    return np.asarray(T[:3, :3] @ np.asarray(p, dtype=np.float64) + T[:3, 3])


def points_of(state: State) -> dict[str, Floats]:
    """Return the coordinates of the point in every frame, (3,) each, by name."""
    part, p = state[Chain], state.derived(point_of)
    found = {name: moved(np.asarray(inverse(T)), p) for name, T in state.derived(poses_of).items()}
    return found | {part.given: np.array(part.point)}


@dataclass(frozen=True)
class Counts:
    """Numbers of operations for the chosen transform: products multiplied first, and applied one by one, by kind."""

    steps: int
    points: int
    first: dict[str, Count]
    each: dict[str, Count]


def counts_of(state: State) -> Counts | None:
    """Return the numbers of operations; None if both frames of the pair are the same, so that nothing is done."""
    steps, points = len(state.derived(pair_of).steps), state[Chain].count
    if steps == 0:
        return None
    return Counts(
        steps,
        points,
        {kind: multiplied_first(steps, points, kind) for kind in COSTS},
        {kind: one_by_one(steps, points, kind) for kind in COSTS},
    )


def pose_in(part: Chain, name: str, world: Floats) -> Floats:
    """Return a pose (4, 4), given in the world, in a frame."""
    return np.asarray(inverse(poses(part)[known_name("frame", name, part.names)]) @ world)
