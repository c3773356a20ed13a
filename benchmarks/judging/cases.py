"""The arms and poses of the judge: each is made from joint values, so that there is a solution; some are moved."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.rotations import rotation_from_axis_angle
from armlab.kin.task import task_named
from judging.arms import (
    QUARTERS,
    arm_of,
    first_rows,
    fold_along,
    general_rows,
    grown,
    inside,
    moved_rows,
    on_lattice,
    robots,
    sixes,
    some_fold,
    some_pose,
    stretched,
    structured_rows,
    turns,
)
from judging.probe import Probe

SIZES = (0.0, *(10.0**-k for k in range(10, 1, -1)))
"""How far special arms and poses are moved, m and rad."""

LATTICES = (90, 45, 30)
"""Degrees."""


@dataclass(frozen=True, eq=False)
class Case:
    """An arm, the joint values a pose was made from, and that pose.

    Attributes
    ----------
    arm : Arm
    q : ndarray, shape (n,)
    T : ndarray, shape (4, 4)
        The tool's pose at q, in some classes moved or rounded since.
    label : str
    beside : ndarray, shape (n,), or None
        Where a second solution is expected.
    """

    arm: Arm
    q: np.ndarray
    T: np.ndarray
    label: str
    beside: np.ndarray | None = None


Maker = Callable[[np.random.Generator], Iterator[Case]]


def made(arm: Arm, q: np.ndarray, label: str, beside: np.ndarray | None = None) -> Case:
    values = np.asarray(q, dtype=float)
    return Case(arm, values, np.asarray(arm.fk(values)), label, beside)


def general(rng: np.random.Generator) -> Iterator[Case]:
    """Both conventions, on a base and with a tool anywhere."""
    while True:
        convention = ("standard", "modified")[rng.integers(2)]
        base, tool = some_pose(rng), some_pose(rng)
        arm = arm_of(general_rows(rng), convention=convention, base=base, tool=tool, task="pose")
        for _ in range(3):
            yield made(arm, turns(rng), "general")


def structured(rng: np.random.Generator) -> Iterator[Case]:
    while True:
        rows = structured_rows(rng)
        for size in SIZES:
            arm = arm_of(moved_rows(rows, size, rng), task="pose")
            yield made(arm, turns(rng), f"moved by {size:.0e}")
            yield made(arm, on_lattice(arm, 90, rng), f"moved by {size:.0e}, lattice of 90 degrees")


def nearly_one_line(rng: np.random.Generator) -> Iterator[Case]:
    while True:
        rows = general_rows(rng) if rng.random() < 0.5 else structured_rows(rng)
        k = int(rng.integers(5))
        for size in SIZES:
            a, twist = size * rng.uniform(0.3, 1, 2)
            rows[k][1:3] = [a, twist + rng.choice([0.0, 0.0, np.pi])]
            arm = arm_of(rows, task="pose")
            for _ in range(2):
                yield made(arm, turns(rng), f"axes {k + 1} and {k + 2} one line to {size:.0e}")


def lattices(rng: np.random.Generator) -> Iterator[Case]:
    while True:
        for key, arm in sixes().items():
            for step in LATTICES:
                yield made(arm, on_lattice(arm, step, rng), f"{key}, lattice of {step} degrees")


def zeros(rng: np.random.Generator) -> Iterator[Case]:
    """Joints at zero, a half or a quarter turn, or nearly."""
    choices = [(1,), (5,), (1, 5), (3,), (3, 5), (2, 3), (1, 3, 5), (4, 6), (1, 4, 6), (2, 3, 5)]
    while True:
        for key, arm in sixes().items():
            q, label = inside(arm, rng), key
            for joint in choices[rng.integers(len(choices))]:
                if arm.revolute[joint - 1]:
                    off = float(rng.choice(SIZES)) if rng.random() < 0.6 else 0.0
                    q[joint - 1] = rng.choice([0.0, 0.0, np.pi, *QUARTERS[1:]]) + off
                    label += f", q{joint} special + {off:.0e}"
            yield made(arm, q, label)


def singular(rng: np.random.Generator) -> Iterator[Case]:
    """Singular poses of robots, for one reason, two or three at once, and beside them."""
    while True:
        for key, arm in sixes(turning=True).items():
            probe, q = Probe(arm), turns(rng)
            first, second = rng.permutation(4)[:2] + 1
            # Away from a straight wrist, where the determinant is 0 whatever the others do.
            q[4] = 0.7 if 4 not in (first, second) else q[4]
            folds = [first, second] if rng.random() < 0.6 else [first]
            label = key
            for joint in folds:
                folded = fold_along(probe, q + 0.3 * np.eye(6)[joint], np.pi * np.eye(6)[joint], rng)
                if folded is not None:
                    q, label = folded, f"{label}, fold along q{joint + 1}"
            if rng.random() < 0.6:
                q[4], label = 0.0, f"{label}, q5 = 0"
            size = float(rng.choice(SIZES))
            yield made(arm, q + size * rng.uniform(-1, 1, 6), f"{label}, beside by {size:.0e}")


def merging(rng: np.random.Generator) -> Iterator[Case]:
    """Two solutions on both sides of a fold."""
    while True:
        label, probe, q = some_fold(rng)
        v = probe.singular(q)[1][-1]
        for _ in range(3):
            half = 0.5 * 10.0 ** rng.uniform(-6, -2)
            yield made(probe.arm, q + half * v, f"{label}, a pair {2 * half:.0e} apart", q - half * v)


def out_of_reach(rng: np.random.Generator) -> Iterator[Case]:
    """A fold, left in the direction the tool cannot take, and in the opposite one."""
    while True:
        label, probe, q = some_fold(rng)
        J, _ = probe.linearised(q[:, None], np.eye(4))
        U = np.linalg.svd(J[:, :, 0].T)[0][:, -1]
        turn = probe.arm.base[:3, :3] @ U[3:]
        for sign in (1.0, -1.0):
            size = sign * 10.0 ** rng.uniform(-9, -2)
            fold = made(probe.arm, q, f"{label}, pushed off a fold by {size:.0e}")
            T = fold.T.copy()
            T[:3, 3] += probe.arm.base[:3, :3] @ U[:3] * size * probe.length
            angle = float(np.linalg.norm(turn))
            if angle > 1e-12:
                T[:3, :3] = rotation_from_axis_angle(turn / angle, size * angle) @ T[:3, :3]
            yield replace(fold, T=T)


def typed(rng: np.random.Generator) -> Iterator[Case]:
    """Poses as they are typed, most of them of stretched arms."""
    few = [key for key, arm in robots().items() if arm.n <= 5 and arm.n == arm.task.m]
    while True:
        for key in [*few, *few, *sixes(turning=True)]:
            arm, q, label = robots()[key], inside(robots()[key], rng), key
            if rng.random() < 0.8:
                q, label = stretched(arm, q, range(1, min(arm.n, 5)), rng), f"{key}, stretched"
            decimals = int(rng.integers(3, 13))
            T = np.asarray(arm.fk(q)).copy()
            T[:3, 3] = np.round(T[:3, 3], decimals)
            # A rotation is taken as one only where it has more digits than that.
            T[:3, :3] = np.round(T[:3, :3], max(decimals, 8))
            yield Case(arm, q, T, f"{label}, {decimals} decimals")


def sized(rng: np.random.Generator) -> Iterator[Case]:
    """Huge and tiny arms, robots among them."""
    while True:
        size, kind = 10.0 ** int(rng.choice([-6, -5, -4, -3, 3, 4, 5, 6])), rng.integers(3)
        if kind < 2:
            label, arm = (
                ("general", "structured")[kind],
                arm_of((general_rows, structured_rows)[kind](rng), task="pose"),
            )
        else:
            label = str(rng.choice(list(sixes(turning=True))))
            arm = robots()[label]
        arm = grown(arm, size)
        yield made(arm, turns(rng), f"{label}, {size:.0e} times as large")
        yield made(arm, on_lattice(arm, 45, rng), f"{label}, {size:.0e} times as large, lattice of 45 degrees")


def limited(rng: np.random.Generator) -> Iterator[Case]:
    """Limits narrow and wide around joint values, some of these at a limit or turns away from zero."""
    while True:
        kind = rng.integers(3)
        if kind < 2:
            label, arm = (
                ("general", "structured")[kind],
                arm_of((general_rows, structured_rows)[kind](rng), task="pose"),
            )
        else:
            label = str(rng.choice(list(sixes(turning=True))))
            arm = robots()[label]
        for _ in range(2):
            q = on_lattice(arm, 45, rng) if rng.random() < 0.3 else turns(rng) * rng.choice([1.0, 1.0, 3.0])
            width = 10.0 ** rng.uniform(-3, 0, 6) if rng.random() < 0.5 else rng.uniform(0.5, 13, 6)
            part = rng.choice([0.0, 1.0, 0.3, 0.7], 6)
            limits = np.stack([q - part * width, q + (1.0 - part) * width], axis=1)
            yield made(replace(arm, limits=limits), q, f"{label}, limits {width.min():.0e} to {width.max():.0e} wide")


def fewer(rng: np.random.Generator) -> Iterator[Case]:
    """Robots of fewer than six joints with their tasks: anywhere, on lattices, at zero or half a turn, stretched."""
    arms = {key: arm for key, arm in robots().items() if arm.n < 6 and arm.n - arm.task.m < 2}
    for key in ("scorbot", "youbot"):
        arms[f"{key}, approach"] = replace(robots()[key], task=task_named("xyz approach"))
    while True:
        for key, arm in arms.items():
            q, label, kind, size = inside(arm, rng), key, rng.integers(4), float(rng.choice(SIZES))
            if kind == 1:
                step = int(rng.choice(LATTICES))
                q, label = on_lattice(arm, step, rng), f"{key}, lattice of {step} degrees"
            elif kind == 2:
                j = int(rng.integers(arm.n))
                q[j] = rng.choice([0.0, np.pi]) * arm.revolute[j] + size
                label = f"{key}, q{j + 1} special + {size:.0e}"
            elif kind == 3:
                q = stretched(arm, q, range(1, min(arm.n, 5)), rng) + size * rng.uniform(-1, 1, arm.n)
                label = f"{key}, stretched, beside by {size:.0e}"
            yield made(arm, q, label)


def sliding(rng: np.random.Generator) -> Iterator[Case]:
    """Random arms with one to three slides."""
    while True:
        n = int(rng.integers(2, 7))
        rows = structured_rows(rng)[:n] if rng.random() < 0.6 else general_rows(rng, n)
        for row in rows:
            row[0] = "P" if rng.random() < 0.4 else "R"
        kinds = "".join(row[0] for row in rows)
        if not 1 <= kinds.count("P") <= 3:
            continue
        arm = arm_of(rows, task="pose") if n == 6 else arm_of(rows)
        if Probe(arm).least(inside(arm, rng)) > 1e-3:
            for _ in range(2):
                yield made(arm, inside(arm, rng), f"{kinds} for {arm.task.key}")


def rounded(rng: np.random.Generator) -> Iterator[Case]:
    """Tables whose quarter and half turns are typed with 3 to 12 decimals, of any size; joints at zero among others."""
    while True:
        n, wrist, decimals = int(rng.integers(2, 6)), rng.random() < 0.3, int(rng.integers(3, 13))
        size = 10.0 ** float(rng.choice([0, 0, 0, -3, 3]))
        rows = first_rows(rng, 3 if wrist else n, wrist)
        for row in rows:
            row[1:] = [size * row[1], np.round(row[2], decimals), size * row[3], np.round(row[4], decimals)]
        arm = arm_of(rows, task="pose") if wrist else arm_of(rows)
        if Probe(arm).least(turns(rng, arm.n)) > 1e-3:
            for _ in range(3):
                zeros = rng.choice([0.0, 0.0, np.pi, np.pi / 2], arm.n)
                q = np.where(rng.random(arm.n) < 0.3, np.where(arm.revolute, zeros, 0.0), turns(rng, arm.n))
                q = np.where(arm.revolute, q, size * q / np.pi)
                kinds = "".join(row[0] for row in rows)
                yield made(arm, q, f"{kinds} for {arm.task.key}, {decimals} decimals, {size:.0e} times as large")


def spare(rng: np.random.Generator) -> Iterator[Case]:
    """Robots with joints to spare, anywhere and on lattices, and random arms of seven to twelve joints with limits."""
    arms = {key: arm for key, arm in robots().items() if arm.n > 6}
    while True:
        for key, arm in arms.items():
            yield made(arm, inside(arm, rng), key)
            step = int(rng.choice(LATTICES))
            yield made(arm, arm.clip(on_lattice(arm, step, rng)), f"{key}, lattice of {step} degrees")
        for _ in range(10):
            arm = limited_arm(rng)
            yield made(arm, inside(arm, rng), f"{arm.n} joints with limits")


def limited_arm(rng: np.random.Generator) -> Arm:
    """Return a random arm of seven to twelve turning joints with limits on all of them."""
    n = int(rng.integers(7, 13))
    a, d = rng.uniform(-0.5, 0.5, (2, n))
    alpha = rng.choice(QUARTERS, n) if rng.random() < 0.5 else turns(rng, n)
    centre, half = rng.uniform(-1.5, 1.5, n), rng.uniform(0.15, 1.5, n)
    rows = [["R", a[i], alpha[i], d[i], 0.0] for i in range(n)]
    return arm_of(rows, task="pose", limits=np.stack([centre - half, centre + half], axis=1))


def hard(rng: np.random.Generator) -> Iterator[Case]:
    """Poses with roots of high multiplicity: the PUMA where shoulder and wrist are singular, Manseur-Doty at q1 = 0."""
    puma, manseur = robots()["puma560"], robots()["manseur_doty"]
    while True:
        yield made(
            puma, np.radians([*rng.choice([0, 90, -90, 180], 2), 90, *rng.choice([0, 90, -90, 180], 3)]), "puma560"
        )
        for off in (0.0, float(rng.choice(SIZES))):
            q = turns(rng)
            q[0] = off
            yield made(manseur, q, f"manseur_doty, q1 = {off:.0e}")
            q = on_lattice(manseur, 45, rng)
            q[0] = off
            yield made(manseur, q, f"manseur_doty, q1 = {off:.0e}, lattice of 45 degrees")


CLASSES: dict[str, tuple[Maker, int]] = {
    "general 6R": (general, 1500),
    "structured 6R, moved by 0, 1e-10 to 1e-2": (structured, 3200),
    "neighbouring axes one line to 0, 1e-10 to 1e-2": (nearly_one_line, 2000),
    "robots of 6 joints on lattices of 90, 45, 30 degrees": (lattices, 3200),
    "joints at 0, a quarter, half a turn + 0, 1e-10 to 1e-2": (zeros, 1500),
    "singular for one to three reasons + 0, 1e-10 to 1e-2": (singular, 1500),
    "pairs 1e-6 to 1e-2 apart": (merging, 1200),
    "pushed off a fold by 1e-9 to 1e-2": (out_of_reach, 800),
    "roots of high multiplicity": (hard, 500),
    "typed with 3 to 12 decimals": (typed, 800),
    "1e-6 to 1e6 times as large": (sized, 600),
    "limits narrow and wide": (limited, 700),
    "fewer than 6 joints": (fewer, 1000),
    "with slides": (sliding, 300),
    "7 to 12 joints": (spare, 400),
    "tables with 3 to 12 decimals": (rounded, 800),
}
"""By title: who makes them, and how many there are of 20,000."""
