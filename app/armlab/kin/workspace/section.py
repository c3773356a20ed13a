"""The section of a workspace: what can be reached in the two coordinates that joint 1 does not change.

All that an arm reaches inside its limits follows from it (see `armlab.kin.workspace.first_joint`): of an arm whose
first joint turns it is the side view of a data sheet, the (rho, z) half-plane. It is filled from samples, then by
inverse kinematics from cell to cell; its boundary is found by inverse kinematics too. Anything that no search found
counts as out of reach: a separate part that no sample hit is missing.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin.checks import as_floats, finite_floats, wrong
from armlab.kin.workspace.around import Arcs, Around
from armlab.kin.workspace.boundary import Boundary, To
from armlab.kin.workspace.first_joint import FirstJoint
from armlab.kin.workspace.nearest import nearest_configuration
from armlab.kin.workspace.outline import Outline
from armlab.kin.workspace.section_grid import Grid

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Section:
    """The workspace of an arm as a section, over which joint 1 moves it.

    Attributes
    ----------
    grid : Grid
    filled : ndarray, shape (Nu, Nv)
        Cells with a configuration whose point lies in them.
    row : ndarray, shape (Nu, Nv)
        Row of the cell among those configurations; -1 for a cell that is not filled.
    configurations : ndarray, shape (rows, n)
        Rad and m, with q_1 = 0 even where joint 1 must not be there.
    outline : Outline
        The region; until it is finished, roughly.
    around : Around or None
        Which s are reached at q_1 = 0; None where joint 1 turns all the way round, and all are. It is counted on while
        the section is not finished.
    arcs : Arcs or None
        Ranges of s covered by joint 1; None when all s are covered, and until the section is finished.
    finished : bool
    """

    grid: Grid
    filled: Bools
    row: NDArray[np.int32]
    configurations: Floats
    outline: Outline
    around: Around | None
    arcs: Arcs | None
    finished: bool

    @property
    def joint(self) -> FirstJoint:
        """Joint 1 with its coordinates u, v, s."""
        return self.grid.joint

    @property
    def u(self) -> Floats:
        """Centres of the cells, shape (Nu,), metres."""
        return self.grid.u

    @property
    def v(self) -> Floats:
        """Centres of the cells, shape (Nv,), metres; one for a planar arm."""
        return self.grid.v

    @property
    def step(self) -> float:
        """Side of a cell, metres."""
        return self.grid.step

    def at(self, i: Indices, j: Indices) -> Floats:
        """Return the configurations (k, n) of filled cells, given by row (k,) and column (k,)."""
        return np.asarray(self.configurations[self.row[i, j]])

    @property
    def blur(self) -> float:
        """Distance from the boundary below which a point may be told wrong, metres.

        A cell, and one and a half of those `Grid.coarser` times as large in which s is counted where joint 1 is
        limited.
        """
        return self.step * (1.0 if self.arcs is None else 1.5 * self.grid.coarser)

    @cached_property
    def covered(self) -> Floats:
        """Covered range of s at each cell, (Nu, Nv), rad when joint 1 is revolute and m when prismatic."""
        if self.arcs is None:
            return np.where(self.filled, 2.0 * np.pi, 0.0)
        rows, columns = self.filled.shape
        wide = self.grid.coarser
        coarse = self.arcs.covered.reshape(-(-rows // wide), -(-columns // wide))
        return np.where(self.filled, np.repeat(np.repeat(coarse, wide, 0), wide, 1)[:rows, :columns], 0.0)

    @cached_property
    def boundary(self) -> Boundary:
        """The boundary of the section."""
        return Boundary(self.grid, self.outline, self.arcs, self.filled)

    @property
    def contours(self) -> tuple[Floats, ...]:
        """Closed polylines (k, 2) around the reached part in (u, v), metres; of a planar arm there and back along u."""
        return self.boundary.contours

    def holds(self, points: ArrayLike) -> Bools:
        """Return which points of the world, shape (..., 3), are reached inside the limits; none with NaN is.

        Points nearer than `blur` to the boundary may be told wrong.

        Raises
        ------
        InputError
            Not points of three numbers.
        """
        expected = "points of 3 numbers"
        given = as_floats(points, "points", expected)
        if given.ndim == 0 or given.shape[-1] != 3:
            raise wrong("points", expected, points)
        finite = np.asarray(np.isfinite(given).all(axis=-1))
        return np.asarray(finite & self.boundary.holds(np.where(finite[..., None], given, 0.0)))

    def distance(self, point: ArrayLike) -> To:
        """Return how far a point of the world, shape (3,), is inside the boundary (+) or outside it (-).

        To about a cell; where joint 1 is limited, and the nearest boundary is where what it covers changes, to about
        one in which s is counted.

        Raises
        ------
        InputError
            Not three finite numbers.
        """
        return self.boundary.distance(finite_floats(point, "point", (3,), "3 finite numbers"))

    def nearest(self, point: ArrayLike) -> Floats:
        """Return a configuration (n,) inside the limits whose tool point is as near to a point as any that was found.

        Joints that do not move the tool point are as near to 0 as they can be.

        Raises
        ------
        InputError
            Not three finite numbers, or nothing has been reached yet.
        """
        given = finite_floats(point, "point", (3,), "3 finite numbers")
        if not self.filled.any():
            raise InputError("section: no cell has been reached yet")
        return nearest_configuration(self, given)
