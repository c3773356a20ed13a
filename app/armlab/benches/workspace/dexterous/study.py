"""Requests and results of the study: coverage by a spherical wrist, by samples, or numbers of solutions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np

from armlab.kin.arm import Arm
from armlab.kin.ik.closed_form import closed_form_of
from armlab.kin.workspace.approach import keeps_upright
from armlab.kin.workspace.first_joint import first_joint
from armlab.kin.workspace.planar import lengths_of
from armlab.kin.workspace.section_size import dimension
from armlab.kin.workspace.sheet_maps import SheetMap, approach_maps, count_maps, sheet_of
from armlab.kin.workspace.spherical_wrist import Coverage, coverages
from armlab.kin.workspace.wrist_points import front_of
from armlab.kin.wrist import wrist_centre

Method = Literal["rings", "wrist", "sampled", "count"]

CELLS = {"sampled": 48, "count": 64}
"""Number of cells along the longer side of a map; orientations need many samples in each cell."""

SEED = 0

TRIED, SMALL = 32, 1e-6
"""Number of random configurations that tell how far the tool turns in place, and the rate, in half reaches, that counts
as 0."""

SPATIAL = 3
"""Dimension of what the centre of a wrist reaches where it has a volume."""

STRIDE = 0.08
"""Share of the whole work that is done from one picture to the next."""


@dataclass(frozen=True)
class Question:
    """Request of a study.

    Attributes
    ----------
    arm : Arm
    method : "wrist", "sampled" or "count"
    s : float
        Which half plane, rad or m; 0 where it does not matter.
    count : int
        Samples; 0 where there are none.
    turned : tuple of 9 floats
        The tool's orientation in the world, by rows; empty where it does not matter.
    """

    arm: Arm
    method: Method
    s: float = 0.0
    count: int = 0
    turned: tuple[float, ...] = ()


@dataclass(frozen=True, eq=False)
class Study:
    """Results of a study so far.

    Attributes
    ----------
    question : Question
    wrist : Coverage or None
        Of a spherical wrist.
    map : SheetMap or None
        Of the other methods.
    finished : bool
    """

    question: Question
    wrist: Coverage | None = None
    map: SheetMap | None = None
    finished: bool = False

    @property
    def done(self) -> float:
        """The share of the work that is done, 0 to 1."""
        if self.finished:
            return 1.0
        return self.map.done if self.map is not None else 0.2 if self.wrist is not None else 0.0


@lru_cache(maxsize=64)
def methods(arm: Arm) -> tuple[Method, ...]:
    """Return the methods for an arm, the most informative first (arms are compared by identity).

    Shares of the directions are counted in cells that the centre of a wrist reaches. Where it stays on a line or a
    surface, all of them are zero, and cells, which have a volume, would tell of others.
    """
    found: list[Method] = []
    if lengths_of(arm) is not None:
        found.append("rings")
    if arm.n > 3 and wrist_centre(arm) is not None and dimension(first_joint(front_of(arm))) == SPATIAL:
        found.append("wrist")
    found.append("sampled")
    if closed_form_of(arm) is not None:
        found.append("count")
    return tuple(found)


def why_sampled_alone(arm: Arm) -> str:
    """Return one sentence that says why an arm has neither of the methods "wrist" and "count"."""
    if arm.n <= 3:
        wrist = "no joint is in front of three that could be a wrist"
    elif wrist_centre(arm) is not None:
        wrist = "the joints in front of the wrist keep its centre on a line or a surface"
    else:
        wrist = "the last three axes do not meet in one point"
    spare = arm.n > arm.task.m
    many = f"{arm.n} joints for {arm.task.m} task components leave infinitely many"
    none = "no closed form of the inverse kinematics is known here"
    return f"Not by Wrist: {wrist}; not by Solutions: {many if spare else none}."


def never_turns(arm: Arm) -> bool:
    """Return whether no joint turns the tool, so that it has one orientation."""
    return not bool(np.any(arm.revolute & (np.ptp(arm.limits, axis=1) > 0.0)))


@lru_cache(maxsize=64)
def turns_in_place(arm: Arm) -> int:
    """Return in how many independent ways the tool turns about its point, 0 to 3, where the arm is not singular.

    The rank of the angular velocities of joint velocities that do not move the tool point.
    """
    low, high = arm.limits.T
    q = low + (high - low) * np.random.default_rng(SEED).random((TRIED, arm.n))
    J = arm.jacobian(q)[:, :, high > low]
    found = []
    for linear, angular in zip(J[:, :3], J[:, 3:], strict=True):
        sizes, rows = np.linalg.svd(linear)[1:]
        rank = int((sizes > SMALL * arm.length_scale).sum())
        still = angular @ rows[rank:].T
        found.append((rank, int((np.linalg.svd(still, compute_uv=False) > SMALL).sum()) if still.size else 0))
    return max(found)[1]


def misses_orientations(arm: Arm) -> bool:
    """Return whether the joints are too few for all orientations at any point where the arm is not singular."""
    return turns_in_place(arm) < (1 if keeps_upright(arm) else 3)


def studying(question: Question) -> Iterator[Study | None]:
    """Yield the results, again and again; None if there is nothing new."""
    if question.method == "wrist":
        for coverage in coverages(question.arm):
            yield None if coverage is None else Study(question, coverage, finished=coverage.finished)
        return
    sheet, last = sheet_of(question.arm, question.s), None
    cells = CELLS[question.method]
    maps = (
        count_maps(sheet, np.reshape(question.turned, (3, 3)), cells)
        if question.method == "count"
        else approach_maps(sheet, question.count, cells, SEED)
    )
    shown = 0.0
    for last in maps:
        # A picture now and then, and the first one early.
        new = last.done >= min(1.6 * shown, shown + STRIDE)
        shown = last.done if new else shown
        yield Study(question, map=last) if new else None
    if last is not None:
        yield Study(question, map=last, finished=True)
