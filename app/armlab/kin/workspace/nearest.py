"""A configuration whose tool point comes as near to a point as the limits allow, starting from a section."""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from armlab.kin.workspace.around import Around
from armlab.kin.workspace.first_joint import FirstJoint
from armlab.kin.workspace.pull import pull_in_space
from armlab.kin.workspace.section_grid import Grid

Floats = NDArray[np.float64]

CELLS = 12
"""Number of starts: the nearest cells of a section, and the nearest of those in which s is counted."""

FAR_CELLS = 48
"""Number of further starts, from all cells with s, those that joint 1 brings nearest within its limits."""

STARTS = 16

NEAR_ENOUGH = 1e-10
"""Distance from the point, in length scales, at which the search ends."""


class Cells(Protocol):
    """The data of a section; see `armlab.kin.workspace.section.Section`."""

    @property
    def grid(self) -> Grid:
        """The grid of the cells."""

    @property
    def joint(self) -> FirstJoint:
        """The first joint, which does not change u and v."""

    @property
    def filled(self) -> NDArray[np.bool_]:
        """Mask of the cells with a configuration, (Nu, Nv)."""

    @property
    def u(self) -> Floats:
        """Centres of the cells along u, (Nu,), metres."""

    @property
    def v(self) -> Floats:
        """Centres of the cells along v, (Nv,), metres."""

    @property
    def around(self) -> Around | None:
        """The values of s reached at q_1 = 0."""

    def at(self, i: NDArray[np.intp], j: NDArray[np.intp]) -> Floats:
        """Return the configurations (k, n) of cells, by row (k,) and column (k,)."""


def nearest_configuration(section: Cells, point: Floats) -> Floats:
    """Return a configuration (n,) inside the limits with the tool as near to a point of the world (3,) as was found."""
    joint = section.joint
    arm = joint.arm
    starts = _starts(section, point)
    q = with_first(joint, starts, point)
    away = np.linalg.norm(arm.position(q) - point, axis=1)
    q = q[np.argsort(away, kind="stable")[:STARTS]]
    found, error = pull_in_space(joint, q, np.broadcast_to(point, (len(q), 3)), NEAR_ENOUGH * arm.length_scale)
    return np.asarray(found[int(np.argmin(error))])


def with_first(joint: FirstJoint, q: Floats, point: Floats) -> Floats:
    """Return configurations (k, n) of q_1 = 0 with the q_1 inside its limits that brings them nearest to a point."""
    wanted = joint.split(point)[2] - joint.split(joint.arm.position(q))[:, 2]
    if joint.revolute:
        middle = 0.5 * (joint.low + joint.high)
        wanted = middle + np.remainder(wanted - middle + math.pi, math.tau) - math.pi
    chosen = q.copy()
    chosen[:, 0] = np.clip(wanted, joint.low, joint.high)
    return chosen


def _starts(section: Cells, point: Floats) -> Floats:
    """Return configurations (k, n) with q_1 = 0: of cells nearest in (u, v), and of those joint 1 brings nearest."""
    grid, joint, (u, v, _) = section.grid, section.joint, section.joint.split(point)
    i, j = np.nonzero(section.filled)
    away = (section.u[i] - u) ** 2 + (section.v[j] - v) ** 2
    nearest = np.argpartition(away, min(CELLS, len(away) - 1))[:CELLS]
    starts = section.at(i[nearest], j[nearest])
    around = section.around
    if around is None:
        return starts
    rows = around.row[np.unique(around.coarse(i[nearest] * grid.shape[1] + j[nearest]))]
    others = np.clip(around.q[rows][around.found(rows)].astype(np.float64), *joint.arm.limits.T)
    everywhere = np.clip(around.everything().astype(np.float64), *joint.arm.limits.T)
    brought = np.linalg.norm(joint.arm.position(with_first(joint, everywhere, point)) - point, axis=1)
    best = np.argpartition(brought, min(FAR_CELLS, len(brought) - 1))[:FAR_CELLS]
    return np.concatenate([starts, others, everywhere[best]])
