"""A timing law within the bounds of a path, stretched until it meets a limit of the joints."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from armlab.errors import InputError
from armlab.kin.motion.bounds import law_bounds
from armlab.kin.motion.extremes import SLACK
from armlab.kin.motion.law import Law
from armlab.kin.motion.limits import Limits
from armlab.kin.motion.path import Path
from armlab.kin.motion.scaling import Moving, Scaling, as_fast_as_allowed
from armlab.kin.motion.trajectory import Trajectory

DOWN = "sddot_down"
"""Option by which a law slows down less hard than its limits allow."""

ROUNDS = 4
"""Rounds in which that deceleration is divided by the square of the stretch, on which it depends in turn."""

LEAST_SHARE = 1e-3
"""Least share of the typed deceleration that shapes a law."""


def moving_ends(options: dict[str, Any]) -> Moving:
    """Return whether the options make a law begin, and whether they make it end, with a speed."""
    return bool(options.get("sdot_start")), bool(options.get("sdot_end"))


def restless(options: dict[str, Any]) -> bool:
    """Return whether a law begins or ends with a speed: stretched in time it would be a different law."""
    return any(moving_ends(options))


def fastest_along(
    title: str,
    shaped: Callable[..., Law],
    path: Path,
    limits: Limits,
    shape: Limits,
    jumps: bool,
    options: dict[str, Any],
) -> Law:
    """Return the law; see `armlab.kin.motion.law_types.LawType.along`.

    Parameters
    ----------
    title : str
        Name of the law, which does not depend on the path.
    shaped : callable
        ``shaped(limits, **options)`` makes the law of a path whose length is 1.
    path : Path
    limits, shape : Limits
        Limits that are met, and limits that shape the law; with a number for each joint.
    jumps : bool
        Whether limits count between jumps only.
    options : dict
        Options of the law.
    """
    bounds = law_bounds(path, shape).usable
    form, moving = Limits(bounds.V, bounds.A, bounds.jerk), moving_ends(options)

    def fitted(options: dict[str, Any]) -> tuple[Law, Scaling]:
        law = shaped(form, **options)
        return law, as_fast_as_allowed(Trajectory(path, law), limits, jumps=jumps, moving=moving)[1]

    law, scaling = fitted(options)
    if not any(moving):
        return law.stretched(scaling.k) if options.get(DOWN) is None else _braking(fitted, options)
    if scaling.k > 1.0 + SLACK:
        raise InputError(
            f"{title}: with these speeds at its ends joint {scaling.joint} exceeds its limit of "
            f"{scaling.quantity}; lower sdot_start or sdot_end"
        )
    return law


def _braking(fitted: Callable[[dict[str, Any]], tuple[Law, Scaling]], options: dict[str, Any]) -> Law:
    """Return the law whose deceleration, as it is after stretching, is at most the typed one."""
    asked = shaping = float(options[DOWN])
    law, scaling = fitted(options)
    for _ in range(ROUNDS):
        if scaling.k >= 1.0:
            break
        shaping = asked * max(scaling.k**2, LEAST_SHARE)
        law, scaling = fitted({**options, DOWN: shaping})
    # Where the rounds have not come to an end, the deceleration and not a limit holds the motion back.
    return law.stretched(max(scaling.k, math.sqrt(shaping / asked)))
