"""The fastest law along a given path: at each place some joint is at a limit of velocity or acceleration."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from armlab.errors import InputError
from armlab.kin.field import Field
from armlab.kin.motion.law import Law, PolynomialLaw
from armlab.kin.motion.law_types import LawType
from armlab.kin.motion.limits import Limits
from armlab.kin.motion.path import Path
from armlab.kin.motion.piecewise import Piecewise
from armlab.kin.timing._along_path import Grid, grid_of
from armlab.kin.timing._phase_plane import Bands, controllable, fastest_speeds

Floats = NDArray[np.float64]

ROUNDS = 12
"""Rounds in which limits are tightened where they are exceeded between grid points; two or three are enough."""

HELD = 1e-10
"""Relative excess that is rounding: a tenth of what counts as exceeding a limit."""

NEAR = 1e-6
"""Relative excess that is removed by slowing down the whole law, if it begins and ends at rest."""

ALIKE, ROUNDING = 1e-12, 1e-13
"""Relative difference of s'' of neighbouring steps, and rounding of the squared speeds it comes from, below which two
steps are one piece of the law."""

REMARK = "The acceleration jumps wherever another joint or another limit takes over."


def on_path(path: Path, limits: Limits, options: dict[str, Any]) -> Law:
    """Return the law.

    Raises
    ------
    InputError
        No limit of acceleration, a part of the path on which no limit holds the motion back, or speeds at the ends that
        cannot be had.

    Notes
    -----
    Limits are kept at both ends and in the middle of each step, then looked at in between, and made tighter there as
    far as needed. Where the direction of the path jumps s stands still for an instant, and where dq/ds is zero inside
    the path the joints do, as s would have to be infinitely fast there to go on; at the ends of the path s may be fast.

    References
    ----------
    Pham and Pham, *A new approach to time-optimal path parameterization based on reachability analysis*, 2018; steps
    with constant s'' as in their section III.
    """
    if not limits.bounded[1]:
        raise InputError("limit of acceleration: the time-optimal law needs one")
    grid = grid_of(path, limits, options["steps"])
    restful = not any(options[name] for name in ("sdot_start", "sdot_end"))
    tight = np.ones(len(grid.h))
    for _ in range(ROUNDS):
        x = _speeds(grid, grid.bands(tight), options)
        over = grid.used(x)
        most = float(over.max())
        if most <= 1.0 + (NEAR if restful else HELD):
            break
        tight = tight * np.maximum(over, 1.0) * (1.0 + HELD)
    law = _law(grid, x)
    if most <= 1.0 + HELD:
        return law
    if not restful:
        raise InputError(
            f"sdot_start, sdot_end: at these speeds a limit is exceeded by {100.0 * (most - 1.0):.2g} % between two of "
            f"{len(grid.h)} steps; take more steps or lower them"
        )
    return law.stretched(math.sqrt(most))


def _speeds(grid: Grid, bands: Bands, options: dict[str, Any]) -> Floats:
    """Return the squared speeds at the grid points."""
    start, end = options["sdot_start"], options["sdot_end"]
    most = grid.most_at_end(bands)
    if end is not None and not end * end <= most * (1.0 + HELD):
        raise InputError(f"sdot_end: expected at most {math.sqrt(most):.6g} to keep the limits, got {end:g}")
    last = 0.0 if end is None else min(end * end, most)
    sets = controllable(bands, (last, most if end is None and grid.still[1] else last), grid.stops)
    if not np.isfinite(sets.most).all():
        raise InputError("limits: on a part of the path none of them holds the motion back")
    if (sets.least[1:] > sets.most[1:] * (1.0 + HELD)).any():
        raise InputError(f"sdot_end: {end:g} cannot be reached within the limits on what is left of the path")
    low, high = float(sets.least[0]), float(sets.most[0])
    if start is None and grid.still[0]:
        return fastest_speeds(bands, sets, high)
    start = 0.0 if start is None else start
    if not low * (1.0 - HELD) <= start * start <= high * (1.0 + HELD):
        least, most = math.sqrt(low), math.sqrt(max(high, 0.0))
        raise InputError(f"sdot_start: expected {least:.6g} to {most:.6g} to keep the limits, got {start:g}")
    return fastest_speeds(bands, sets, min(max(start * start, low), high))


def _law(grid: Grid, x: Floats) -> PolynomialLaw:
    """Return the law with constant s'' in each step, from the squared speeds at the ends of the steps."""
    speed = np.sqrt(x)
    if not (speed[:-1] + speed[1:] > 0.0).all():
        raise InputError("steps: within the limits the motion comes to a halt on the path; take more steps")
    times = 2.0 * grid.h / (speed[:-1] + speed[1:])
    push = np.diff(x) / (2.0 * grid.h)
    size, blur = np.abs(push), ROUNDING * np.maximum(x[:-1], x[1:]) / grid.h
    alike = ALIKE * np.maximum(size[1:], size[:-1]) + blur[1:] + blur[:-1]
    first = np.concatenate([[True], np.abs(np.diff(push)) > alike])
    knots = np.concatenate([[0.0], np.cumsum(times)])
    rows = np.stack([grid.s[:-1], speed[:-1], 0.5 * push], axis=1)[first]
    return PolynomialLaw(Piecewise(np.append(knots[:-1][first], knots[-1]), rows[:, :, None]), (REMARK,))


LAW = LawType(
    "time_optimal",
    "Time-optimal along the path",
    10,
    on_path=on_path,
    fields=(
        Field("steps", "N", "steps along the path", "whole", 1000, low=20, high=20000),
        Field("sdot_start", "ṡ_i", "speed of s at the start; left out: rest", "number", low=0.0, unit="1/s"),
        Field("sdot_end", "ṡ_f", "speed of s at the end; left out: rest", "number", low=0.0, unit="1/s"),
    ),
    needs=("acceleration",),
)
