"""A path in other units of its coordinates, so that lengths along it need not add radians and metres."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.kin.field import Field, Options
from armlab.kin.motion.path import Path

Floats = NDArray[np.float64]


class ScaledPath(Path):
    """A path whose coordinates are multiplied by constants.

    Parameters
    ----------
    path : Path
        The path in other units.
    scales : ndarray, shape (m,)
        The size of its unit of each coordinate.
    """

    def __init__(self, path: Path, scales: Floats) -> None:
        self.path, self.scales = path, scales
        self.m, self.pieces, self.degree = path.m, path.pieces, path.degree
        self.duration, self.remarks = path.duration, path.remarks

    def _values(self, s: Floats, orders: Sequence[int], before: bool) -> list[Floats]:
        return [values * self.scales for values in self.path.derivatives(s, orders, before=before)]


def in_scales(fields: Mapping[str, Field], options: Options, scales: Floats) -> dict[str, Any]:
    """Return options with those that have a number for each coordinate, in its unit, in units of ``scales``.

    A number or a list in the unit of the coordinates, such as a speed along the way, is a length over all of them: it
    has the unit of the scaled ones already.
    """
    found = dict(options)
    for key, value in options.items():
        field = fields[key].seen(options)
        each = field.kind in ("vector", "rows") and field.unit.startswith("q")
        # With another length the maker of the path refuses the option by name.
        if each and value is not None and value.shape[-1] == len(scales):
            found[key] = value / scales
    return found
