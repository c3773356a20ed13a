"""The Frenet frame of the tool's path at a time of a planned motion."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from armlab.benches.motion.plan.question import Planned
from armlab.benches.motion.plan.samples import STANDS, tool_rates

Floats = NDArray[np.float64]

INSIDE = 1e-3
"""Part of a leg that is left out at its ends, where the tool rests and its path has no direction."""

STRAIGHT = 1e-4
"""Curvature, times the length scale of the arm, below which a path counts as straight and has no normal."""


class Trihedron(NamedTuple):
    """The tool point with unit tangent, normal and binormal, (3,) each, world; zeros if not defined.

    The curvature is in 1/m.
    """

    position: Floats
    t: Floats
    n: Floats
    b: Floats
    curvature: float


def trihedron(planned: Planned, time: float) -> Trihedron | None:
    """Return the Frenet frame of the tool's path, or None if there is no motion.

    From velocity and acceleration of the tool: t = v / |v|, kappa b = (v x a) / |v|^3, n = b x t.

    References
    ----------
    Notes 6.136-6.141, in time instead of the path parameter.
    """
    leg, arm = planned.leg_at(time), planned.question.arm
    if leg is None or leg.motion is None or planned.samples is None:
        return None
    T = leg.motion.duration
    inside = np.array([min(max(time - leg.start, INSIDE * T), (1.0 - INSIDE) * T)])
    v, a = (each[0] for each in tool_rates(arm, *leg.motion.derivatives(inside, (0, 1, 2))))
    here = np.asarray(arm.position(leg.motion.at(min(max(time - leg.start, 0.0), T))), dtype=np.float64)
    speed, nothing = float(np.linalg.norm(v)), np.zeros(3)
    if speed <= STANDS * max(float(planned.samples.tool_speed.max()), 1e-12):
        return Trihedron(here, nothing, nothing, nothing, 0.0)
    bend = np.cross(v, a) / speed**3
    curvature = float(np.linalg.norm(bend))
    t = v / speed
    if curvature * arm.length_scale < STRAIGHT:
        return Trihedron(here, t, nothing, nothing, 0.0)
    b = bend / curvature
    return Trihedron(here, t, np.cross(b, t), b, curvature)
