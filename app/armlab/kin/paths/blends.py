"""Linear segments with parabolic or quartic blends, past timed waypoints in joint space."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.kin.field import Field
from armlab.kin.motion.knots import TIMES, knot_times
from armlab.kin.motion.path import PolynomialPath, timed
from armlab.kin.motion.path_types import PathType
from armlab.kin.paths._blending import SHAPE, blended, check_room, for_each

SHARE = 0.4
"""Default blend time, relative to the shorter neighbouring interval."""

REMARK = (
    "Inner waypoints are not met: the arm passes at |v_k − v_(k−1)| Δt/8 from each. The acceleration is constant in a "
    "parabolic blend, so it jumps at both its ends."
)


def make(knots: NDArray[np.float64], options: dict[str, Any]) -> PolynomialPath:
    """Return lines and blends over time.

    References
    ----------
    Notes 6.86-6.88, with one parameter: they mix a velocity per unit of s with a blend time in seconds. They do not
    mention that the blend begins half its time before the waypoint's.
    """
    times = knot_times(knots, options)
    steps = np.diff(times)
    padded = np.concatenate([[np.inf], steps, [np.inf]])
    shorter = np.minimum(padded[:-1], padded[1:])
    given = options["blend"]
    blends = SHARE * shorter if given is None else for_each(given, "blend", len(knots), "waypoint")
    rest = options["ends"] == "rest"
    if not rest:
        blends[[0, -1]] = 0.0
    after, before = blends[:-1] / 2.0, blends[1:] / 2.0
    after[0], before[-1] = blends[0], blends[-1]
    check_room(steps, after, before, "s")
    curve = blended(knots, times, blends, rest=rest, quartic=options["shape"] == "quartic")
    return timed(curve, (REMARK,) if len(knots) > 2 and options["shape"] == "parabola" else ())


PATH = PathType(
    "blends",
    "Linear segments with blends",
    5,
    make,
    spaces=("joint",),
    fields=(
        Field(
            "blend", "Δt_k−1,k", "blend time; left out: 0.4 of the shorter interval beside", "list", low=0.0, unit="s"
        ),
        Field(
            "ends",
            "",
            "at the first and last waypoint",
            "choice",
            "rest",
            choices=(("rest", "blend from and to rest"), ("moving", "already moving⟦, as in the notes⟧")),
        ),
        SHAPE,
        *TIMES,
    ),
    apart=False,
    formula=r"X''(s)=0\ \text{or}\ \text{const.}",
    says="Straight lines, with a parabola instead of each corner.",
)
