"""Straight lines from waypoint to waypoint, with corners."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.kin.motion.path import PolynomialPath
from armlab.kin.motion.path_types import PathType
from armlab.kin.motion.piecewise import Piecewise

REMARK = (
    "The direction jumps at each corner: the motion must stop there (speed of the law zero), or the velocity jumps, "
    "which no motor can do. Fly over the corner to keep moving."
)


def make(knots: NDArray[np.float64], options: dict[str, Any]) -> PolynomialPath:
    """Return the lines one after the other, s proportional to the distance gone.

    References
    ----------
    Notes, beginning of section 6.3.2.
    """
    steps = np.diff(knots, axis=0)
    shares = np.cumsum(np.linalg.norm(steps, axis=1))
    places = np.concatenate([[0.0], shares / shares[-1]])
    slopes = steps / np.diff(places)[:, None]
    remarks = (REMARK,) if len(knots) > 2 else ()
    return PolynomialPath(Piecewise(places, np.stack([knots[:-1], slopes], axis=1)), remarks=remarks)


PATH = PathType(
    "polyline",
    "Straight lines with corners",
    2,
    make,
    formula=r"X(s)=X_k+\frac{s-s_k}{s_{k+1}-s_k}(X_{k+1}-X_k)",
    says="With corners at the knots: the arm has to stop there.",
)
