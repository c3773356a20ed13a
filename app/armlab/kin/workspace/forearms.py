"""Orientations of the forearm for each place of the wrist centre; they decide on the directions of a limited wrist.

Joint 1 turns all of it. So it is told for places (u, v) of the half plane behind joint 1, as seen from there: the turn
of the forearm from its place with all joints at 0, and from which angle on joint 1 brings it about.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from armlab.kin.arm import Arm
from armlab.kin.workspace.elbow_points import ElbowPoints
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.half_grid import HalfGrid
from armlab.kin.workspace.pull import pull
from armlab.kin.workspace.section_grid import random_configurations

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

CHUNKS, CHUNK, SEED = 40, 32_768, 0
"""Chunks, their size and the seed of random configurations of the joints before the wrist, without a closed form."""

PULLED, PULLS, THERE = 2048, 8, 1e-2
"""Configurations pulled in one piece of work, iterations, and the distance, in steps, at which a node is reached."""

COARSE = 6
"""Intervals of a component of an axis from -1 to 1 within which two forearms at one place count as the same."""


@dataclass(frozen=True, eq=False)
class Forearms:
    """Forearms at nodes of a half plane.

    Attributes
    ----------
    node : ndarray, shape (k,)
        Flat index of the node.
    turn : ndarray, shape (k, 3, 3)
        Rotation from world axes with all joints at 0 to the axes of `FirstJoint` turned to the wrist centre.
    start : ndarray, shape (k,)
        The least s to which joint 1 carries it, rad.
    """

    node: Indices
    turn: Floats
    start: Floats


def elbow_forearms(front: Arm, elbow: ElbowPoints, grid: HalfGrid) -> Forearms:
    """Return the forearms of an elbow at the nodes themselves, in closed form."""
    joint = first_joint(front)
    nodes = grid.places.reshape(-1, 2)
    points = joint.join(np.column_stack([nodes, np.zeros(len(nodes))]))
    found: list[tuple[Indices, Floats, Floats]] = []
    for rows, q1, bend, inside in elbow.ways(points):
        some = np.flatnonzero(inside)
        found.append((rows[some], joint.axes.T @ elbow.forearm(q1[some], bend[some]), joint.low - q1[some]))
    return Forearms(*(np.concatenate(each) for each in zip(*found, strict=True)))


def sampled_forearms(front: Arm, grid: HalfGrid) -> Iterator[Forearms | None]:
    """Yield None after each piece of work of some 30 ms, and at last those that were found.

    Random configurations near a node, different ones, are pulled onto it inside the limits; those that get there count.
    """
    joint, rng = first_joint(front), np.random.default_rng(SEED)
    keys, kept = [], []
    for _ in range(CHUNKS):
        q = random_configurations(joint, CHUNK, rng).astype(np.float32)
        node, turn, _, on = _stands(front, q, grid)
        level = np.clip((turn[:, :, :2] + 1.0) * (0.5 * COARSE), 0, COARSE - 1e-6).astype(np.int64).reshape(-1, 6)
        key = node.astype(np.int64) * COARSE**6 + level @ (COARSE ** np.arange(6))
        _, first = np.unique(key[on], return_index=True)
        some = np.flatnonzero(on)[first]
        keys.append(key[some])
        kept.append(q[some])
        yield None
    key, first = np.unique(np.concatenate(keys), return_index=True)
    pulled, node = np.concatenate(kept)[first].astype(np.float64), key // COARSE**6
    pulled[:, 1:] = np.clip(pulled[:, 1:], *front.limits[1:].T)
    there = np.zeros(len(pulled), dtype=bool)
    places = grid.places.reshape(-1, 2)
    yield None
    for begin in range(0, len(pulled), PULLED):
        block = slice(begin, begin + PULLED)
        tolerance = THERE * grid.step
        pulled[block], error = pull(joint, pulled[block], places[node[block]], tolerance, iterations=PULLS)
        there[block] = error <= tolerance
        yield None
    _, turn, s, _ = _stands(front, pulled[there], grid)
    yield Forearms(node[there], turn, s + joint.low)


def _stands(front: Arm, q: NDArray[np.floating], grid: HalfGrid) -> tuple[Indices, Floats, Floats, NDArray[np.bool_]]:
    """Return the nearest nodes of configurations, the rotations of the forearm, s, and which have a node."""
    joint = first_joint(front)
    T = np.asarray(front.fk(q), dtype=np.float64)
    home = np.asarray(front.fk(np.zeros(front.n)))[:3, :3]
    coordinates = joint.split(T[:, :3, 3])
    node, on = grid.nearest(coordinates[:, :2])
    s = coordinates[:, 2]
    local = joint.axes.T @ (T[:, :3, :3] @ home.T)
    c, n = np.cos(s)[:, None], np.sin(s)[:, None]
    turn = np.stack([c * local[:, 0] + n * local[:, 1], c * local[:, 1] - n * local[:, 0], local[:, 2]], axis=1)
    return node, turn, s, on


def rank(node: Indices) -> Indices:
    """Return for each entry the number of equal ones before it, (k,)."""
    order = np.argsort(node, kind="stable")
    first = np.concatenate([[True], np.diff(node[order]) != 0]) if len(node) else np.zeros(0, dtype=bool)
    begin = np.maximum.accumulate(np.where(first, np.arange(len(node)), 0))
    found = np.empty(len(node), dtype=np.intp)
    found[order] = np.arange(len(node)) - begin
    return found


def whole_turn(start: Floats, stroke: float, bins: int) -> NDArray[np.uint64]:
    """Return the bins of a whole turn in start (k,) + [0, stroke], radians, as bits of words (k,); at least one."""
    width = math.tau / bins
    count = min(max(round(stroke / width), 1), bins)
    if count == bins:
        return np.full(len(start), np.uint64(2**64 - 1))
    begin = np.mod(np.rint(start / width).astype(np.int64), bins).astype(np.uint64)
    return turned(np.full(len(start), np.uint64(2**count - 1)), np.mod(np.uint64(bins) - begin, np.uint64(bins)))


def turned(words: NDArray[np.uint64], by: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """Return words with bit b taken from bit b + by, modulo the number of bits."""
    back = np.mod(np.uint64(64) - by, np.uint64(64))
    return np.asarray((words >> by) | (words << back))
