"""A timing law within the bounds of a path, stretched until it meets a limit of the joints."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from armlab.errors import InputError
from armlab.kin.motion.bounds import law_bounds
from armlab.kin.motion.extremes import SLACK
from armlab.kin.motion.law import Law
from armlab.kin.motion.limits import Limits
from armlab.kin.motion.path import Path
from armlab.kin.motion.scaling import Moving, as_fast_as_allowed
from armlab.kin.motion.trajectory import Trajectory


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
    law = shaped(Limits(bounds.V, bounds.A, bounds.jerk), **options)
    found, scaling = as_fast_as_allowed(Trajectory(path, law), limits, jumps=jumps, moving=moving_ends(options))
    if not restless(options):
        assert isinstance(found, Trajectory)
        return found.law
    if scaling.k > 1.0 + SLACK:
        raise InputError(
            f"{title}: with these speeds at its ends joint {scaling.joint} exceeds its limit of "
            f"{scaling.quantity}; lower sdot_start or sdot_end"
        )
    return law
