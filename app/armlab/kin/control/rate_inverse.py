"""Inverses of the differential kinematics: from a wanted task velocity to joint speeds.

J is the task Jacobian and v the task velocity, both scaled (`armlab.kin.control.scaled_task`), so that no metre is
added to a radian. Where a method has no answer it says so in words; no number it returns is nan or infinite.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from armlab.kin.checks import as_floats, finite_floats, wrong
from armlab.kin.control import inverses as _folder
from armlab.kin.control.decomposed import Decomposed
from armlab.kin.field import Field, checked_options
from armlab.plugins import discover
from armlab.registry import Registry

Floats = NDArray[np.float64]

CUTOFF = 1e-6
"""Singular value, relative to the largest, below which one counts as zero in a pseudo-inverse, as in `ik.iterate`."""


class RateStep(NamedTuple):
    """The result of a method for one velocity.

    Attributes
    ----------
    qdot : ndarray, shape (n,), or None
        Scaled joint speeds; None where the method has no answer.
    damping : float
        The number added to the diagonal of J J^T.
    sigma_min : float
        Smallest of the min(m, n) singular values of J.
    says : str
        Why there is no answer; empty when there is one.
    """

    qdot: Floats | None
    damping: float
    sigma_min: float
    says: str = ""


Speeds = Callable[[Floats, Floats, Mapping[str, Any]], RateStep]
"""``speeds(J (m, n), v (m,), options) -> RateStep``; all options are present and checked."""


@dataclass(frozen=True)
class RateInverse:
    """The constant ``INVERSE`` of a module in `armlab.kin.control.inverses`.

    Parameters
    ----------
    key, title : str
        Short name for programs, name of the field for people.
    order : int
        Place in lists.
    fields : tuple of Field
        Options.
    speeds : callable
        See `Speeds`.
    formula : str
        The method in LaTeX.
    """

    key: str
    title: str
    order: int
    fields: tuple[Field, ...]
    speeds: Speeds
    formula: str = ""

    def options(self, given: Mapping[str, Any] | None = None) -> dict[str, Any]:
        """Return all options by key, those not given at their defaults; `InputError` when one is wrong."""
        return checked_options(self.key, self.fields, given or {})


@cache
def rate_inverses() -> Registry[RateInverse]:
    """Return all methods by key, in the order of lists."""
    return discover(_folder, "INVERSE", RateInverse)


def rate_inverse(key: str) -> RateInverse:
    """Return a method by key; `UnknownName` when there is none."""
    return rate_inverses()[key]


def rate_step(key: str, J: ArrayLike, v: ArrayLike, options: Mapping[str, Any] | None = None) -> RateStep:
    """Return the joint speeds of a method for a task velocity.

    Parameters
    ----------
    key : str
        Key of a `RateInverse`.
    J : array_like, shape (m, n)
        Task Jacobian, scaled.
    v : array_like, shape (m,)
        Task velocity, scaled.
    options : mapping, optional
        Options by key; see ``rate_inverse(key).fields``.

    Raises
    ------
    InputError
        An unknown method or option, or matrices that are not finite or do not fit.

    Examples
    --------
    >>> rate_step("pinv", [[2.0, 0.0], [0.0, 0.0]], [1.0, 1.0]).qdot.tolist()
    [0.5, 0.0]
    >>> rate_step("inverse", [[2.0, 0.0], [0.0, 0.0]], [1.0, 1.0]).qdot is None
    True
    """
    matrix = as_floats(J, "J", "a matrix of finite numbers")
    if matrix.ndim != 2 or not np.isfinite(matrix).all():
        raise wrong("J", "a matrix of finite numbers", J)
    velocity = finite_floats(v, "v", (len(matrix),), f"{len(matrix)} finite numbers")
    method = rate_inverse(key)
    return method.speeds(matrix, velocity, method.options(options))


def pseudo_inverse_speeds(found: Decomposed, v: Floats, cutoff: float = CUTOFF) -> Floats:
    """Return J# v (n,); singular values up to ``cutoff`` times the largest are taken as zero."""
    sigma = found.sigma
    if not len(sigma):
        return np.zeros(found.Vt.shape[1])
    if sigma[-1] > cutoff * sigma[0]:
        return found.spread(1.0 / sigma, v)
    kept = sigma > cutoff * sigma[0]
    return found.spread(np.where(kept, 1.0 / np.where(kept, sigma, 1.0), 0.0), v)


def damped_speeds(found: Decomposed, v: Floats, damping: float) -> Floats:
    """Return J^T (J J^T + damping I_m)^-1 v, (n,); the pseudo-inverse without damping.

    The sum of sigma / (sigma^2 + damping) v u^T v (notes 5.112-5.115; the I_n inside the inverse of 5.113 is I_m).
    """
    if damping <= 0.0:
        return pseudo_inverse_speeds(found, v)
    return found.spread(found.sigma / (found.sigma**2 + damping), v)
