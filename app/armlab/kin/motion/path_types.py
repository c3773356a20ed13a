"""The kinds of geometric paths, found by folder."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.errors import InputError
from armlab.kin import paths as _folder
from armlab.kin.checks import as_floats, finite_floats, wrong
from armlab.kin.field import Field, checked_options
from armlab.kin.motion.knots import checked_knots
from armlab.kin.motion.path import Path
from armlab.kin.motion.scaled_path import ScaledPath, in_scales
from armlab.plugins import discover
from armlab.registry import Registry

Floats = NDArray[np.float64]
Space = Literal["joint", "cartesian"]


@dataclass(frozen=True)
class PathType:
    """One kind of path, the constant ``PATH`` of a module in `armlab.kin.paths`.

    Attributes
    ----------
    key, title : str
        Short name for programs, name of the field for people.
    order : int
        Place in lists.
    make : callable
        ``make(knots (N, m), options) -> Path``; both are checked before.
    least, most : int
        Number of waypoints.
    spaces : tuple of str
        ``"joint"``, ``"cartesian"``: where it makes sense.
    fields : tuple of Field
        Options.
    dimensions : tuple of int
        Allowed numbers of coordinates; empty for any.
    apart : bool
        Whether neighbouring waypoints must differ.
    rests : bool
        Whether it begins and ends at rest where s runs evenly, as its options come; of paths that have their own time.
    formula : str
        LaTeX, with X for what runs along it.
    says : str
        Description in a sentence.
    """

    key: str
    title: str
    order: int
    make: Callable[[Floats, dict[str, Any]], Path]
    least: int = 2
    most: int | None = None
    spaces: tuple[Space, ...] = ("joint", "cartesian")
    fields: tuple[Field, ...] = ()
    dimensions: tuple[int, ...] = ()
    apart: bool = True
    rests: bool = True
    formula: str = ""
    says: str = ""

    def path(self, knots: ArrayLike, *, scales: ArrayLike | None = None, **options: Any) -> Path:
        """Return the path through waypoints.

        Parameters
        ----------
        knots : array_like, shape (N, m)
            Waypoints; (N,) for one coordinate.
        scales : array_like, shape (m,), optional
            Where coordinates have different units, such as radians and metres: how much of each counts as 1 in a
            length over all of them, which times and speeds may depend on; for a sliding joint the length scale of its
            arm. Distances and speeds along the way among the options are in these units.
        **options
            By the keys of ``fields``; those that have a number for each coordinate are in its own unit.

        Raises
        ------
        InputError
            Not numbers, too few or too many, two the same (the text names the waypoint, from 1), or a wrong option.
        """
        points = checked_knots(knots, self.title, self.least, self.most, self.apart)
        if self.dimensions and points.shape[1] not in self.dimensions:
            allowed = " or ".join(map(str, self.dimensions))
            raise InputError(f"waypoints: {self.title} needs {allowed} coordinates, got {points.shape[1]}")
        checked = checked_options(self.key, self.fields, options)
        if scales is None:
            return self.make(points, checked)
        m = points.shape[1]
        sizes = finite_floats(scales, "scales", (m,), f"{m} positive numbers")
        if not (sizes > 0.0).all():
            raise wrong("scales", f"{m} positive numbers", sizes)
        fields = {field.key: field for field in self.fields}
        return ScaledPath(self.make(points / sizes, in_scales(fields, checked, sizes)), sizes)


@cache
def path_types() -> Registry[PathType]:
    """Return all kinds of paths by key, in the order of lists."""
    return discover(_folder, "PATH", PathType)


def path_type(key: str) -> PathType:
    """Return a kind of path by key; `UnknownName` when there is none."""
    return path_types()[key]


def coordinates(value: Any, where: str, m: int) -> Floats:
    """Return a vector option (m,), zeros when it was left out; `InputError` for another length."""
    if value is None:
        return np.zeros(m)
    vector = as_floats(value, where, f"{m} numbers")
    if vector.shape != (m,):
        raise wrong(where, f"{m} numbers, one for each coordinate" if m > 1 else "one number", value)
    return vector
