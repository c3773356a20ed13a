"""Lines at constant speeds with rounded corners: parabolic blends of constant acceleration."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.kin.field import Field
from armlab.kin.motion.path import PolynomialPath, timed
from armlab.kin.motion.path_types import PathType
from armlab.kin.motion.piecewise import Piecewise
from armlab.kin.paths._blending import SHAPE, blended, check_room, for_each

Floats = NDArray[np.float64]

SHARE = 0.25
"""Default distance d1, relative to the shorter neighbouring line."""

QUARTIC = "The acceleration is zero at both ends of each blend, and 1.5 times that of a parabola in its middle."
PARABOLA = (
    "At these speeds the acceleration jumps{jump} where a blend begins and ends: a parabola has constant acceleration, "
    "and the line has none."
)


class Overfly(PolynomialPath):
    """Lines and blends, with the numbers of each blend (notes 6.124-6.133).

    Attributes
    ----------
    blend_times : ndarray, shape (N-2,)
        Delta T of each inner waypoint.
    d1, d2 : ndarray, shape (N-2,)
        Distances before and after each waypoint at which the line is left and the next one met.
    accelerations : ndarray, shape (N-2, m)
        The constant one of a parabolic blend, (v2 k_BC - v1 k_AB) / Delta T: it jumps from zero to this and back.
    """

    def __init__(
        self,
        curve: Piecewise,
        duration: float,
        remarks: tuple[str, ...],
        blend_times: Floats,
        v: Floats,
        speeds: Floats,
    ) -> None:
        super().__init__(curve, duration, remarks)
        self.blend_times = blend_times
        self.d1, self.d2 = speeds[:-1] * blend_times / 2.0, speeds[1:] * blend_times / 2.0
        times = np.where(blend_times > 0.0, blend_times, np.inf)
        self.accelerations = np.diff(v, axis=0) / times[:, None]

    def remarks_in(self, unit: str, size: float) -> tuple[str, ...]:
        """Return the remarks, with the largest jump of a parabolic blend as a number."""
        jump = float(np.linalg.norm(self.accelerations, axis=1).max())
        # Three digits, and never with an exponent that a length would not have.
        known = PARABOLA.format(jump=f" by up to {float(f'{jump / size:.3g}'):g} {unit}/s²")
        return tuple(known if remark == PARABOLA.format(jump="") else remark for remark in self.remarks)


def make(knots: Floats, options: dict[str, Any]) -> Overfly:
    """Return the lines and blends over time.

    One of d1, d2 and Delta T is chosen, and the others follow: Delta T = 2 d1 / v1 = 2 d2 / v2.

    References
    ----------
    Notes 6.114-6.133. They also ask for zero acceleration at the ends of the blend (6.118-6.119), which contradicts the
    constant acceleration of 6.120; the quartic blend has it.
    """
    steps = np.diff(knots, axis=0)
    lengths = np.linalg.norm(steps, axis=1)
    speeds = for_each(options["speed"], "speed", len(steps), "line")
    blend_times = _blend_times(lengths, speeds, options)
    taken_after = np.concatenate([[0.0], speeds[1:] * blend_times / 2.0])
    taken_before = np.concatenate([speeds[:-1] * blend_times / 2.0, [0.0]])
    check_room(lengths, taken_after, taken_before, "")
    times = np.concatenate([[0.0], np.cumsum(lengths / speeds)])
    quartic = options["shape"] == "quartic"
    blends = np.concatenate([[0.0], blend_times, [0.0]])
    path = timed(blended(knots, times, blends, rest=False, quartic=quartic))
    v = steps * (speeds / lengths)[:, None]
    made = Overfly(path.curve, float(times[-1]), (), blend_times, v, speeds)
    made.remarks = () if not blend_times.any() else (QUARTIC if quartic else PARABOLA.format(jump=""),)
    return made


def _blend_times(lengths: Floats, speeds: Floats, options: dict[str, Any]) -> Floats:
    inner = len(lengths) - 1
    if options["amount"] is None:
        return np.asarray(2.0 * SHARE * np.minimum(lengths[:-1] / speeds[:-1], lengths[1:] / speeds[1:]))
    amount = for_each(options["amount"], "amount", inner, "inner waypoint")
    by: str = options["by"]
    if by == "time":
        return amount
    return np.asarray(2.0 * amount / (speeds[:-1] if by == "d1" else speeds[1:]))


PATH = PathType(
    "overfly",
    "Lines with over-fly",
    4,
    make,
    least=3,
    fields=(
        Field(
            "by",
            "",
            "a blend is given by",
            "choice",
            "d1",
            choices=(
                ("d1", "d₁, distance before the corner"),
                ("d2", "d₂, distance after it"),
                ("time", "ΔT, its time"),
            ),
        ),
        Field(
            "amount",
            "d_1",
            "that distance or time; left out: a quarter of the shorter line",
            "list",
            low=0.0,
            unit="q",
            by=(("by", "d2", "d_2", "q"), ("by", "time", "ΔT", "s")),
        ),
        Field("speed", "v", "constant speed on the lines", "list", 1.0, low=0.0, above=True, unit="q/s"),
        SHAPE,
    ),
    formula=r"X''(s)=0\ \text{or}\ \text{const.}",
    says="Straight lines, with a parabola instead of each corner: the knots between are flown over, not met.",
)
