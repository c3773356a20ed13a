"""Nodes on the half plane of a revolute joint 1, in layers along its axis."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class HalfGrid:
    """Nodes at u = 0, step, 2 step, ... and v = low, low + step, ...

    Attributes
    ----------
    low, step : float
        Metres.
    shape : (int, int)
        Nodes along u, and along v.
    """

    low: float
    step: float
    shape: tuple[int, int]

    @property
    def places(self) -> Floats:
        """(u, v) of the nodes, shape (U, V, 2), metres."""
        u, v = (self.step * np.arange(n) for n in self.shape)
        return np.stack(np.meshgrid(u, self.low + v, indexing="ij"), axis=-1)

    def nearest(self, places: Floats) -> tuple[Indices, NDArray[np.bool_]]:
        """Return the flat index of the node nearest to places (k, 2), and which places have one."""
        i = np.rint(places[:, 0] / self.step).astype(np.intp)
        j = np.rint((places[:, 1] - self.low) / self.step).astype(np.intp)
        on = (i < self.shape[0]) & (j >= 0) & (j < self.shape[1])
        return np.where(on, i * self.shape[1] + j, 0), on
