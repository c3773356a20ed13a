"""Arms for the judge: the robots of the lab, random tables, and where they are singular."""

from __future__ import annotations

import functools
from collections.abc import Sequence

import numpy as np

from armlab.content.robots import catalogue
from armlab.kin.arm import Arm
from armlab.kin.rotations import rotation_from_quaternion
from judging.probe import Probe

QUARTERS = (0.0, np.pi / 2, -np.pi / 2)

Rows = list[list]
"""Of a table, as lists: kind, a, alpha, d, theta."""


@functools.cache
def robots() -> dict[str, Arm]:
    """Return all robots of the lab."""
    return {key: robot.arm for key, robot in catalogue().robots.items()}


@functools.cache
def sixes(turning: bool = False) -> dict[str, Arm]:
    """Return those with six joints for a whole pose, or only the ones whose joints all turn."""
    found = {key: arm for key, arm in robots().items() if arm.n == 6 and arm.task.m == 6}
    return {key: arm for key, arm in found.items() if arm.revolute.all() or not turning}


def arm_of(rows: Rows, **more: object) -> Arm:
    """Return the arm of a table."""
    return Arm.from_dh([(kind, *map(float, numbers)) for kind, *numbers in rows], **more)


def general_rows(rng: np.random.Generator, n: int = 6) -> Rows:
    """Return turning joints with any lengths up to 1 m and any twists."""
    a, alpha, d = rng.uniform(-1, 1, n), rng.uniform(-np.pi, np.pi, n), rng.uniform(-1, 1, n)
    return [["R", a[i], alpha[i], d[i], 0.0] for i in range(n)]


def structured_rows(rng: np.random.Generator) -> Rows:
    """Return six turning joints with quarter-turn twists and half their lengths zero, and not singular everywhere."""
    while True:
        a, d = rng.uniform(-1, 1, (2, 6)) * (rng.random((2, 6)) > 0.5)
        rows = [["R", a[i], rng.choice(QUARTERS), d[i], 0.0] for i in range(6)]
        probe = Probe(arm_of(rows, task="pose"))
        if any(probe.least(turns(rng)) > 1e-2 for _ in range(4)):
            return rows


def moved_rows(rows: Rows, size: float, rng: np.random.Generator) -> Rows:
    """Return rows with every length and twist moved by up to a size."""
    return [
        [kind, *(np.array([a, alpha, d]) + size * rng.uniform(-1, 1, 3)), theta] for kind, a, alpha, d, theta in rows
    ]


def first_rows(rng: np.random.Generator, n: int, wrist: bool) -> Rows:
    """Return joints that turn or slide, with quarter- and half-turn twists and half their lengths zero; and a wrist."""
    a, d = rng.uniform(-1, 1, (2, n)) * (rng.random((2, n)) > 0.5)
    twists = rng.choice([*QUARTERS, np.pi], n)
    rows = [["P" if rng.random() < 0.4 else "R", a[i], twists[i], d[i], 0.0] for i in range(n)]
    for row in rows:
        row[4] = float(rng.choice([0.0, 0.0, np.pi / 2])) if row[0] == "P" else 0.0
    turning = [["R", 0.0, np.pi / 2, rng.uniform(-1, 1), 0.0], ["R", 0.0, -np.pi / 2, 0.0, 0.0]]
    return [*rows, *turning, ["R", 0.0, 0.0, rng.uniform(-1, 1), 0.0]] if wrist else rows


def some_six(rng: np.random.Generator) -> tuple[str, Arm]:
    """Return a random arm of six turning joints with its kind, or a robot with its name."""
    kind = rng.integers(4)
    if kind < 2:
        rows = (general_rows, structured_rows)[kind](rng)
        return ("general", "structured")[kind], arm_of(rows, task="pose")
    key = str(rng.choice(list(sixes(turning=True))))
    return key, robots()[key]


def grown(arm: Arm, size: float) -> Arm:
    """Return an arm of turning joints with all lengths multiplied."""
    tool = arm.tool.copy()
    tool[:3, 3] *= size
    rows = [["R", size * row.a, row.alpha, size * row.d, row.theta] for row in arm.rows]
    return arm_of(rows, convention=arm.convention, tool=tool, task=arm.task)


def some_pose(rng: np.random.Generator) -> np.ndarray:
    """Return any rotation, and a place up to half a metre away in each direction."""
    T = np.eye(4)
    T[:3, :3] = rotation_from_quaternion(rng.normal(size=4))
    T[:3, 3] = rng.uniform(-0.5, 0.5, 3)
    return T


def turns(rng: np.random.Generator, n: int = 6) -> np.ndarray:
    """Return angles anywhere."""
    return rng.uniform(-np.pi, np.pi, n)


def inside(arm: Arm, rng: np.random.Generator) -> np.ndarray:
    """Return joint values inside the limits, of each angle within half a turn where these are wider."""
    low, high = np.where(arm.revolute[:, None], np.clip(arm.limits, -np.pi, np.pi), arm.limits).T
    return rng.uniform(low, np.maximum(low, high))


def at_limits(arm: Arm, rng: np.random.Generator) -> np.ndarray:
    """Return joint values inside the limits, about a third of them at one and a tenth as near to zero as can be."""
    q, draw = inside(arm, rng), rng.random(arm.n)
    end = arm.limits[np.arange(arm.n), rng.integers(0, 2, arm.n)]
    return np.asarray(np.where(draw < 0.35, end, np.where(draw < 0.45, arm.clip(np.zeros(arm.n)), q)))


def on_lattice(arm: Arm, step: int, rng: np.random.Generator) -> np.ndarray:
    """Return angles that are multiples of some degrees; slides anywhere inside their limits."""
    angles = np.radians(step * rng.integers(-180 // step + 1, 180 // step + 1, arm.n))
    return np.where(arm.revolute, angles, inside(arm, rng))


def fold_along(probe: Probe, q: np.ndarray, way: np.ndarray, rng: np.random.Generator) -> np.ndarray | None:
    """Return a singular configuration on a line through q (n,), where there are as many joints as the task needs.

    The line is as long as two times ``way``; a change of sign of the determinant is bisected to the last digit. None
    where it does not change its sign.
    """
    s = np.linspace(0.0, 2.0, 25)
    values = _determinants(probe, q + s[:, None] * way)
    changes = np.flatnonzero(values[1:] * values[:-1] < 0)
    if not len(changes):
        return None
    k = rng.choice(changes)
    low, high, sign = s[k], s[k + 1], np.sign(values[k])
    for _ in range(60):
        middle = 0.5 * (low + high)
        if np.sign(_determinants(probe, q[None] + middle * way)[0]) == sign:
            low = middle
        else:
            high = middle
    return np.asarray(q + low * way)


def _determinants(probe: Probe, q: np.ndarray) -> np.ndarray:
    J, _ = probe.linearised(np.ascontiguousarray(q.T), np.eye(4))
    return np.asarray(np.linalg.det(J.transpose(2, 1, 0)))


def some_fold(rng: np.random.Generator) -> tuple[str, Probe, np.ndarray]:
    """Return the name or kind of an arm of six turning joints, its probe and a fold: where two solutions merge."""
    while True:
        label, arm = some_six(rng)
        probe = Probe(arm)
        for _ in range(10):
            q = fold_along(probe, turns(rng), rng.normal(size=6), rng)
            if q is not None:
                return label, probe, q


def stretched(arm: Arm, q: np.ndarray, among: Sequence[int], rng: np.random.Generator) -> np.ndarray:
    """Return joint values with one joint, among some, turned to where the arm is singular; as they are if it is not."""
    if arm.n == arm.task.m:
        for joint in rng.permutation([j for j in among if arm.revolute[j]]):
            found = fold_along(Probe(arm), q, np.pi * np.eye(arm.n)[joint], rng)
            if found is not None:
                return found
    return q
